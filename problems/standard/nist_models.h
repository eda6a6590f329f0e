// SPDX-License-Identifier: BSD-3-Clause
// The models of NIST's regressions (nist_data.h), formulas as the data files print them, b1 being b[0]. Each
// is a function of the parameters b and of one observation's predictors x, for T double, long double or Jet.
#pragma once

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <string_view>

namespace frond {

struct Bennett5Model {  // b1 (b2 + x)^(−1/b3)
  static constexpr int kParameters = 3;
  template <typename T>
  T operator()(const T* b, const double* x) const {
    using std::pow;
    return b[0] * pow(b[1] + x[0], -1.0 / b[2]);
  }
};

struct ChwirutModel {  // exp(−b1 x) / (b2 + b3 x)
  static constexpr int kParameters = 3;
  template <typename T>
  T operator()(const T* b, const double* x) const {
    using std::exp;
    return exp(-b[0] * x[0]) / (b[1] + b[2] * x[0]);
  }
};

struct DanWoodModel {  // b1 x^b2
  static constexpr int kParameters = 2;
  template <typename T>
  T operator()(const T* b, const double* x) const {
    using std::pow;
    return b[0] * pow(x[0], b[1]);
  }
};

// b1 + b2 cos(2πx/12) + b3 sin(2πx/12) + b5 cos(2πx/b4) + b6 sin(2πx/b4) + b8 cos(2πx/b7) + b9 sin(2πx/b7)
struct EnsoModel {
  static constexpr int kParameters = 9;
  template <typename T>
  T operator()(const T* b, const double* x) const {
    using std::cos;
    using std::sin;
    const double turns = 2 * std::numbers::pi * x[0];
    const T first = turns / b[3], second = turns / b[6];
    return b[0] + b[1] * std::cos(turns / 12) + b[2] * std::sin(turns / 12) + b[4] * cos(first) +
           b[5] * sin(first) + b[7] * cos(second) + b[8] * sin(second);
  }
};

struct Eckerle4Model {  // (b1/b2) exp(−½ ((x − b3)/b2)²)
  static constexpr int kParameters = 3;
  template <typename T>
  T operator()(const T* b, const double* x) const {
    using std::exp;
    const T z = (x[0] - b[2]) / b[1];
    return b[0] / b[1] * exp(-0.5 * z * z);
  }
};

struct GaussModel {  // b1 exp(−b2 x) + b3 exp(−(x − b4)²/b5²) + b6 exp(−(x − b7)²/b8²)
  static constexpr int kParameters = 8;
  template <typename T>
  T operator()(const T* b, const double* x) const {
    using std::exp;
    const T first = (x[0] - b[3]) / b[4], second = (x[0] - b[6]) / b[7];
    return b[0] * exp(-b[1] * x[0]) + b[2] * exp(-first * first) + b[5] * exp(-second * second);
  }
};

struct CubicRationalModel {  // (b1 + b2 x + b3 x² + b4 x³) / (1 + b5 x + b6 x² + b7 x³)
  static constexpr int kParameters = 7;
  template <typename T>
  T operator()(const T* b, const double* x) const {
    return (b[0] + x[0] * (b[1] + x[0] * (b[2] + x[0] * b[3]))) /
           (1.0 + x[0] * (b[4] + x[0] * (b[5] + x[0] * b[6])));
  }
};

struct Kirby2Model {  // (b1 + b2 x + b3 x²) / (1 + b4 x + b5 x²)
  static constexpr int kParameters = 5;
  template <typename T>
  T operator()(const T* b, const double* x) const {
    return (b[0] + x[0] * (b[1] + x[0] * b[2])) / (1.0 + x[0] * (b[3] + x[0] * b[4]));
  }
};

struct LanczosModel {  // b1 exp(−b2 x) + b3 exp(−b4 x) + b5 exp(−b6 x)
  static constexpr int kParameters = 6;
  template <typename T>
  T operator()(const T* b, const double* x) const {
    using std::exp;
    return b[0] * exp(-b[1] * x[0]) + b[2] * exp(-b[3] * x[0]) + b[4] * exp(-b[5] * x[0]);
  }
};

struct Mgh09Model {  // b1 (x² + x b2) / (x² + x b3 + b4)
  static constexpr int kParameters = 4;
  template <typename T>
  T operator()(const T* b, const double* x) const {
    return b[0] * (x[0] * (x[0] + b[1])) / (x[0] * (x[0] + b[2]) + b[3]);
  }
};

struct Mgh10Model {  // b1 exp(b2 / (x + b3))
  static constexpr int kParameters = 3;
  template <typename T>
  T operator()(const T* b, const double* x) const {
    using std::exp;
    return b[0] * exp(b[1] / (x[0] + b[2]));
  }
};

struct Mgh17Model {  // b1 + b2 exp(−x b4) + b3 exp(−x b5)
  static constexpr int kParameters = 5;
  template <typename T>
  T operator()(const T* b, const double* x) const {
    using std::exp;
    return b[0] + b[1] * exp(-x[0] * b[3]) + b[2] * exp(-x[0] * b[4]);
  }
};

struct Misra1aModel {  // b1 (1 − exp(−b2 x)); BoxBOD too
  static constexpr int kParameters = 2;
  template <typename T>
  T operator()(const T* b, const double* x) const {
    using std::exp;
    return b[0] * (1.0 - exp(-b[1] * x[0]));
  }
};

struct Misra1bModel {  // b1 (1 − (1 + b2 x/2)^(−2))
  static constexpr int kParameters = 2;
  template <typename T>
  T operator()(const T* b, const double* x) const {
    const T base = 1.0 + b[1] * (x[0] / 2);
    return b[0] * (1.0 - 1.0 / (base * base));
  }
};

struct Misra1cModel {  // b1 (1 − (1 + 2 b2 x)^(−½))
  static constexpr int kParameters = 2;
  template <typename T>
  T operator()(const T* b, const double* x) const {
    using std::sqrt;
    return b[0] * (1.0 - 1.0 / sqrt(1.0 + b[1] * (2 * x[0])));
  }
};

struct Misra1dModel {  // b1 b2 x / (1 + b2 x)
  static constexpr int kParameters = 2;
  template <typename T>
  T operator()(const T* b, const double* x) const {
    const T product = b[1] * x[0];
    return b[0] * product / (1.0 + product);
  }
};

struct NelsonModel {  // log y = b1 − b2 x1 exp(−b3 x2)
  static constexpr int kParameters = 3;
  template <typename T>
  T operator()(const T* b, const double* x) const {
    using std::exp;
    return b[0] - b[1] * x[0] * exp(-b[2] * x[1]);
  }
};

struct Rat42Model {  // b1 / (1 + exp(b2 − b3 x))
  static constexpr int kParameters = 3;
  template <typename T>
  T operator()(const T* b, const double* x) const {
    using std::exp;
    return b[0] / (1.0 + exp(b[1] - b[2] * x[0]));
  }
};

struct Rat43Model {  // b1 / (1 + exp(b2 − b3 x))^(1/b4)
  static constexpr int kParameters = 4;
  template <typename T>
  T operator()(const T* b, const double* x) const {
    using std::exp;
    using std::pow;
    return b[0] / pow(1.0 + exp(b[1] - b[2] * x[0]), 1.0 / b[3]);
  }
};

struct Roszman1Model {  // b1 − b2 x − arctan(b3 / (x − b4)) / π
  static constexpr int kParameters = 4;
  template <typename T>
  T operator()(const T* b, const double* x) const {
    using std::atan;
    return b[0] - b[1] * x[0] - atan(b[2] / (x[0] - b[3])) / std::numbers::pi;
  }
};

// What `use` returns for the model of the dataset `name` (as NIST writes it).
template <typename Use>
auto WithNistModel(std::string_view name, const Use& use) {
  if (name == "Bennett5") return use(Bennett5Model());
  if (name == "BoxBOD" || name == "Misra1a") return use(Misra1aModel());
  if (name == "Chwirut1" || name == "Chwirut2") return use(ChwirutModel());
  if (name == "DanWood") return use(DanWoodModel());
  if (name == "Eckerle4") return use(Eckerle4Model());
  if (name == "ENSO") return use(EnsoModel());
  if (name == "Gauss1" || name == "Gauss2" || name == "Gauss3") return use(GaussModel());
  if (name == "Hahn1" || name == "Thurber") return use(CubicRationalModel());
  if (name == "Kirby2") return use(Kirby2Model());
  if (name == "Lanczos1" || name == "Lanczos2" || name == "Lanczos3") return use(LanczosModel());
  if (name == "MGH09") return use(Mgh09Model());
  if (name == "MGH10") return use(Mgh10Model());
  if (name == "MGH17") return use(Mgh17Model());
  if (name == "Misra1b") return use(Misra1bModel());
  if (name == "Misra1c") return use(Misra1cModel());
  if (name == "Misra1d") return use(Misra1dModel());
  if (name == "Nelson") return use(NelsonModel());
  if (name == "Rat42") return use(Rat42Model());
  if (name == "Rat43") return use(Rat43Model());
  if (name == "Roszman1") return use(Roszman1Model());
  throw std::invalid_argument("no NIST model '" + std::string(name) + "'");
}

}  // namespace frond
