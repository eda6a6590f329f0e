// SPDX-License-Identifier: BSD-3-Clause
// The customary functions of global optimisation, f: R^n → R, n ≥ 2, least value 0. Each is a struct with its
// box [−kLimit, kLimit]^n, the coordinate kMinimiser of its minimiser (the same in all n), its value, and
// residuals r with f = ½ Σ r² for T double or Jet. i counts from 1.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace frond {

// √(2 f + 1e-30) of a value f that is no sum of squares by itself: the tiny term keeps the derivative finite
// at f = 0, and adds 5e-31 to the cost. A value below 0, which only rounding makes, counts as 0.
template <typename T>
T RootOfTwice(const T& f) {
  using std::sqrt;
  constexpr double kTiny = 1e-30;
  return f < T(0.0) ? T(std::sqrt(kTiny)) : sqrt(2.0 * f + kTiny);
}

// Σ z_i². Residuals √2 z_i.
struct SphereFunction {
  static constexpr double kLimit = 100, kMinimiser = 0;
  static int ResidualCount(int n) { return n; }

  static double Value(std::span<const double> z) {
    double sum = 0;
    for (const double v : z) sum += v * v;
    return sum;
  }

  template <typename T>
  static void Residuals(int n, const T* z, T* r) {
    for (int i = 0; i < n; ++i) r[i] = std::numbers::sqrt2 * z[i];
  }
};

// Rosenbrock (1960), chained: Σ_{i<n} 100 (z_{i+1} − z_i²)² + (1 − z_i)². Residuals √2 · 10 (z_{i+1} − z_i²),
// √2 (1 − z_i). From n = 4 on there is a second minimum near (−1, 1, …, 1).
struct RosenbrockFunction {
  static constexpr double kLimit = 30, kMinimiser = 1;
  static int ResidualCount(int n) { return 2 * (n - 1); }

  static double Value(std::span<const double> z) {
    double sum = 0;
    for (std::size_t i = 0; i + 1 < z.size(); ++i) {
      const double valley = z[i + 1] - z[i] * z[i], slope = 1 - z[i];
      sum += 100 * valley * valley + slope * slope;
    }
    return sum;
  }

  template <typename T>
  static void Residuals(int n, const T* z, T* r) {
    for (int i = 0; i + 1 < n; ++i) {
      r[i] = 10 * std::numbers::sqrt2 * (z[i + 1] - z[i] * z[i]);
      r[n - 1 + i] = std::numbers::sqrt2 * (1.0 - z[i]);
    }
  }
};

// Rastrigin (1974): 10 n + Σ z_i² − 10 cos 2πz_i = Σ z_i² + 20 sin² πz_i. Residuals √2 z_i, √40 sin πz_i.
struct RastriginFunction {
  static constexpr double kLimit = 5.12, kMinimiser = 0;
  static int ResidualCount(int n) { return 2 * n; }

  static double Value(std::span<const double> z) {
    double sum = 0;
    for (const double v : z) {
      const double wave = std::sin(std::numbers::pi * v);
      sum += v * v + 20 * wave * wave;
    }
    return sum;
  }

  template <typename T>
  static void Residuals(int n, const T* z, T* r) {
    using std::sin;
    for (int i = 0; i < n; ++i) {
      r[i] = std::numbers::sqrt2 * z[i];
      r[n + i] = std::sqrt(40.0) * sin(std::numbers::pi * z[i]);
    }
  }
};

// Griewank (1981): 1 + Σ z_i²/4000 − Π cos(z_i/√i). Residuals z_i/√2000, and one √(2 (1 − Π cos(z_i/√i))).
struct GriewankFunction {
  static constexpr double kLimit = 600, kMinimiser = 0;
  static int ResidualCount(int n) { return n + 1; }

  template <typename T>
  static T Wave(int n, const T* z) {  // 1 − Π cos(z_i/√i), in [0, 2]
    using std::cos;
    T product(1.0);
    for (int i = 0; i < n; ++i) product *= cos(z[i] / std::sqrt(i + 1.0));
    return 1.0 - product;
  }

  static double Value(std::span<const double> z) {
    return SphereFunction::Value(z) / 4000 + Wave(static_cast<int>(z.size()), z.data());
  }

  template <typename T>
  static void Residuals(int n, const T* z, T* r) {
    for (int i = 0; i < n; ++i) r[i] = z[i] / std::sqrt(2000.0);
    r[n] = RootOfTwice(Wave(n, z));
  }
};

// Ackley (1987), a = 20, b = 0.2, c = 2π:
//   20 (1 − exp(−0.2 √(Σ z_i²/n))) + e − exp(Σ cos(2πz_i)/n),
// evaluated as −20 expm1(…) − e expm1(−Σ 2 sin²(πz_i)/n), which keeps all digits near 0. Residual √(2 f).
struct AckleyFunction {
  static constexpr double kLimit = 32.768, kMinimiser = 0;
  static int ResidualCount(int /*n*/) { return 1; }

  template <typename T>
  static T Formula(int n, const T* z) {
    using std::expm1;
    using std::sin;
    using std::sqrt;
    T square(0.0), wave(0.0);
    for (int i = 0; i < n; ++i) {
      const T s = sin(std::numbers::pi * z[i]);
      square += z[i] * z[i];
      wave += s * s;
    }
    const double count = n;
    // At 0 the root has no derivative; 0 is a subgradient.
    const T distance = square == T(0.0) ? T(0.0) : T(sqrt(square / count));
    return -20.0 * expm1(-0.2 * distance) - std::numbers::e * expm1(-2.0 * wave / count);
  }

  static double Value(std::span<const double> z) { return Formula(static_cast<int>(z.size()), z.data()); }

  template <typename T>
  static void Residuals(int n, const T* z, T* r) {
    r[0] = RootOfTwice(Formula(n, z));
  }
};

// Schwefel (1981), problem 2.26: Σ 418.98… − z_i sin √|z_i|, the constant to all digits so that the least
// value is 0. Its terms fall below 0 outside of the box: there, where rotation or a solver can lead, the term
// is that of the nearest z_i in the box plus 0.01 (|z_i| − 500)², so that the minimiser stays the least.
// Residuals √(2 · term).
struct SchwefelFunction {
  static constexpr double kLimit = 500, kMinimiser = 420.96874635998203;
  static constexpr double kLargest = 418.98288727243370628;  // of z sin √|z| in the box
  static int ResidualCount(int n) { return n; }

  template <typename T>
  static T Term(const T& z) {
    using std::abs;
    using std::sin;
    using std::sqrt;
    const T size = abs(z);
    if (!(size > T(0.0))) return kLargest + 0.0 * z;  // the root has no derivative at 0; NaN stays
    if (size > T(kLimit)) {
      const double edge = kLimit * std::sin(std::sqrt(kLimit));
      const T beyond = size - kLimit;
      return kLargest - (z > T(0.0) ? edge : -edge) + 0.01 * beyond * beyond;
    }
    return kLargest - z * sin(sqrt(size));
  }

  static double Value(std::span<const double> z) {
    double sum = 0;
    for (const double v : z) sum += Term(v);
    return sum;
  }

  template <typename T>
  static void Residuals(int n, const T* z, T* r) {
    for (int i = 0; i < n; ++i) r[i] = RootOfTwice(Term(z[i]));
  }
};

// What `use` returns for the function `name`: "sphere", "rosenbrock", …
template <typename Use>
auto WithAnalyticFunction(std::string_view name, const Use& use) {
  if (name == "ackley") return use(AckleyFunction());
  if (name == "griewank") return use(GriewankFunction());
  if (name == "rastrigin") return use(RastriginFunction());
  if (name == "rosenbrock") return use(RosenbrockFunction());
  if (name == "schwefel") return use(SchwefelFunction());
  if (name == "sphere") return use(SphereFunction());
  throw std::invalid_argument("no analytic function '" + std::string(name) + "'");
}

}  // namespace frond
