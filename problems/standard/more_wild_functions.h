// SPDX-License-Identifier: BSD-3-Clause
// The 22 vector functions of Moré and Wild, "Benchmarking derivative-free optimization algorithms", SIAM J.
// Optim. 20 (2009), section 3 and its supplement: 1 to 18 after Moré, Garbow and Hillstrom, "Testing
// unconstrained optimization software", ACM TOMS 7 (1981), cited below as MGH with the number there; 19 to 22
// after CUTEr (Gould, Orban and Toint 2003). r: R^n → R^m, i and j count from 1 as in the papers, for T
// double, long double or Jet.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace frond {
namespace more_wild {

// 1. MGH 32, m ≥ n: r_i = x_i − (2/m) Σ_j x_j − 1 for i ≤ n, −(2/m) Σ_j x_j − 1 for the rest.
template <typename T>
void LinearFullRank(int n, int m, const T* x, T* r) {
  T sum(0.0);
  for (int j = 0; j < n; ++j) sum += x[j];
  const T common = -2.0 / m * sum - 1.0;
  for (int i = 0; i < m; ++i) r[i] = i < n ? x[i] + common : common;
}

// 2. MGH 33: r_i = i Σ_j j x_j − 1.
template <typename T>
void LinearRank1(int n, int m, const T* x, T* r) {
  T sum(0.0);
  for (int j = 1; j <= n; ++j) sum += static_cast<double>(j) * x[j - 1];
  for (int i = 1; i <= m; ++i) r[i - 1] = static_cast<double>(i) * sum - 1.0;
}

// 3. MGH 34: r_1 = r_m = −1, r_i = (i − 1) Σ_{1<j<n} j x_j − 1.
template <typename T>
void LinearRank1Zeros(int n, int m, const T* x, T* r) {
  T sum(0.0);
  for (int j = 2; j < n; ++j) sum += static_cast<double>(j) * x[j - 1];
  for (int i = 1; i < m; ++i) r[i - 1] = static_cast<double>(i - 1) * sum - 1.0;
  r[m - 1] = T(-1.0);
}

// 4. MGH 1: 10 (x_2 − x_1²), 1 − x_1.
template <typename T>
void Rosenbrock(const T* x, T* r) {
  r[0] = 10.0 * (x[1] - x[0] * x[0]);
  r[1] = 1.0 - x[0];
}

// 5. MGH 7: 10 (x_3 − 10 θ), 10 (√(x_1² + x_2²) − 1), x_3, where θ = arctan(x_2/x_1)/2π, plus ½ for x_1 < 0;
// a quarter turn with the sign of x_2 for x_1 = 0. Not differentiable at x_1 = x_2 = 0.
template <typename T>
void HelicalValley(const T* x, T* r) {
  using std::atan;
  using std::atan2;
  using std::sqrt;
  constexpr double kTurn = 2 * std::numbers::pi;
  T theta = x[0] == T(0.0) ? T(atan2(x[1], x[0]) / kTurn) : T(atan(x[1] / x[0]) / kTurn);
  if (x[0] < T(0.0)) theta += T(0.5);
  r[0] = 10.0 * (x[2] - 10.0 * theta);
  r[1] = 10.0 * (sqrt(x[0] * x[0] + x[1] * x[1]) - 1.0);
  r[2] = x[2];
}

// 6. MGH 13: x_1 + 10 x_2, √5 (x_3 − x_4), (x_2 − 2 x_3)², √10 (x_1 − x_4)².
template <typename T>
void PowellSingular(const T* x, T* r) {
  const T third = x[1] - 2.0 * x[2], fourth = x[0] - x[3];
  r[0] = x[0] + 10.0 * x[1];
  r[1] = std::sqrt(5.0) * (x[2] - x[3]);
  r[2] = third * third;
  r[3] = std::sqrt(10.0) * fourth * fourth;
}

// 7. MGH 2: −13 + x_1 + ((5 − x_2) x_2 − 2) x_2, −29 + x_1 + ((x_2 + 1) x_2 − 14) x_2.
template <typename T>
void FreudensteinRoth(const T* x, T* r) {
  r[0] = x[0] - 13.0 + ((5.0 - x[1]) * x[1] - 2.0) * x[1];
  r[1] = x[0] - 29.0 + ((x[1] + 1.0) * x[1] - 14.0) * x[1];
}

// 8. MGH 8: y_i − (x_1 + u_i / (v_i x_2 + w_i x_3)), u = i, v = 16 − i, w = min(u, v).
template <typename T>
void Bard(const T* x, T* r) {
  constexpr double kY[15] = {.14, .18, .22, .25, .29, .32, .35, .39, .37, .58, .73, .96, 1.34, 2.1, 4.39};
  for (int i = 1; i <= 15; ++i) {
    const double u = i, v = 16 - i, w = std::min(u, v);
    r[i - 1] = kY[i - 1] - (x[0] + u / (v * x[1] + w * x[2]));
  }
}

// 9. MGH 15: y_i − x_1 (u_i² + u_i x_2) / (u_i² + u_i x_3 + x_4).
template <typename T>
void KowalikOsborne(const T* x, T* r) {
  constexpr double kY[11] = {.1957, .1947, .1735, .16, .0844, .0627, .0456, .0342, .0323, .0235, .0246};
  constexpr double kU[11] = {4, 2, 1, .5, .25, .167, .125, .1, .0833, .0714, .0625};
  for (int i = 0; i < 11; ++i) {
    r[i] = kY[i] - x[0] * (kU[i] * (kU[i] + x[1])) / (kU[i] * (kU[i] + x[2]) + x[3]);
  }
}

// 10. MGH 10: x_1 exp(x_2 / (t_i + x_3)) − y_i, t_i = 45 + 5 i.
template <typename T>
void Meyer(const T* x, T* r) {
  using std::exp;
  constexpr double kY[16] = {34780, 28610, 23650, 19630, 16370, 13720, 11540, 9744,
                             8261,  7030,  6005,  5147,  4427,  3820,  3307,  2872};
  for (int i = 1; i <= 16; ++i) r[i - 1] = x[0] * exp(x[1] / (45.0 + 5.0 * i + x[2])) - kY[i - 1];
}

// 11. MGH 20, t_i = i/29: Σ_{j≥2} (j − 1) x_j t_i^{j−2} − (Σ_j x_j t_i^{j−1})² − 1 for i ≤ 29, then x_1 and
// x_2 − x_1² − 1.
template <typename T>
void Watson(int n, const T* x, T* r) {
  for (int i = 1; i <= 29; ++i) {
    const double t = i / 29.0;
    T value(0.0), slope(0.0);  // of the polynomial with the coefficients x, by Horner
    for (int j = n - 1; j >= 0; --j) {
      slope = slope * t + value;
      value = value * t + x[j];
    }
    r[i - 1] = slope - value * value - 1.0;
  }
  r[29] = x[0];
  r[30] = x[1] - x[0] * x[0] - 1.0;
}

// 12. MGH 12, t_i = i/10: exp(−t_i x_1) − exp(−t_i x_2) − x_3 (exp(−t_i) − exp(−10 t_i)).
template <typename T>
void Box3d(int m, const T* x, T* r) {
  using std::exp;
  for (int i = 1; i <= m; ++i) {
    const double t = i / 10.0;
    r[i - 1] = exp(-t * x[0]) - exp(-t * x[1]) - x[2] * (std::exp(-t) - std::exp(-1.0 * i));
  }
}

// 13. MGH 6: 2 + 2 i − (exp(i x_1) + exp(i x_2)).
template <typename T>
void JennrichSampson(int m, const T* x, T* r) {
  using std::exp;
  for (int i = 1; i <= m; ++i) {
    const double t = i;
    r[i - 1] = 2.0 + 2.0 * t - (exp(t * x[0]) + exp(t * x[1]));
  }
}

// 14. MGH 16, t_i = i/5: (x_1 + t_i x_2 − exp t_i)² + (x_3 + x_4 sin t_i − cos t_i)².
template <typename T>
void BrownDennis(int m, const T* x, T* r) {
  for (int i = 1; i <= m; ++i) {
    const double t = i / 5.0;
    const T first = x[0] + t * x[1] - std::exp(t), second = x[2] + std::sin(t) * x[3] - std::cos(t);
    r[i - 1] = first * first + second * second;
  }
}

// 15. MGH 35: (1/n) Σ_j T_i(2 x_j − 1) − ∫₀¹ T_i(2 t − 1) dt, T_i Chebyshev's polynomials; the integral is 0
// for odd i, −1/(i² − 1) for even i.
template <typename T>
void Chebyquad(int n, int m, const T* x, T* r) {
  for (int i = 1; i <= m; ++i) r[i - 1] = T(i % 2 == 0 ? 1.0 / (1.0 * i * i - 1.0) : 0.0);
  for (int j = 0; j < n; ++j) {
    const T argument = 2.0 * x[j] - 1.0;
    T before(1.0), current = argument;
    for (int i = 0; i < m; ++i) {
      r[i] += current / static_cast<double>(n);
      const T next = 2.0 * argument * current - before;
      before = current;
      current = next;
    }
  }
}

// 16. MGH 27, m = n: x_i + Σ_j x_j − (n + 1) for i < n, then Π_j x_j − 1.
template <typename T>
void BrownAlmostLinear(int n, const T* x, T* r) {
  T sum(-1.0 - n), product(1.0);
  for (int j = 0; j < n; ++j) {
    sum += x[j];
    product *= x[j];
  }
  for (int i = 0; i < n - 1; ++i) r[i] = x[i] + sum;
  r[n - 1] = product - 1.0;
}

// 17. MGH 17, t_i = 10 (i − 1): y_i − (x_1 + x_2 exp(−t_i x_4) + x_3 exp(−t_i x_5)).
template <typename T>
void Osborne1(const T* x, T* r) {
  using std::exp;
  constexpr double kY[33] = {.844, .908, .932, .936, .925, .908, .881, .85,  .818, .784, .751,
                             .718, .685, .658, .628, .603, .58,  .558, .538, .522, .506, .49,
                             .478, .467, .457, .448, .438, .431, .424, .42,  .414, .411, .406};
  for (int i = 0; i < 33; ++i) {
    const double t = 10.0 * i;
    r[i] = kY[i] - (x[0] + x[1] * exp(-t * x[3]) + x[2] * exp(-t * x[4]));
  }
}

// 18. MGH 19, t_i = (i − 1)/10: y_i − (x_1 exp(−t_i x_5) + Σ_{k=2..4} x_k exp(−(t_i − x_{k+7})² x_{k+4})).
template <typename T>
void Osborne2(const T* x, T* r) {
  using std::exp;
  constexpr double kY[65] = {1.366, 1.191, 1.112, 1.013, .991, .885, .831, .847, .786, .725, .746,
                             .679,  .608,  .655,  .616,  .606, .602, .626, .651, .724, .649, .649,
                             .694,  .644,  .624,  .661,  .612, .558, .533, .495, .5,   .423, .395,
                             .375,  .372,  .391,  .396,  .405, .428, .429, .523, .562, .607, .653,
                             .672,  .708,  .633,  .668,  .645, .632, .591, .559, .597, .625, .739,
                             .71,   .729,  .72,   .636,  .581, .428, .292, .162, .098, .054};
  for (int i = 0; i < 65; ++i) {
    const double t = i / 10.0;
    T sum = x[0] * exp(-t * x[4]);
    for (int k = 1; k <= 3; ++k) {
      const T distance = t - x[k + 7];
      sum += x[k] * exp(-distance * distance * x[k + 4]);
    }
    r[i] = kY[i] - sum;
  }
}

// 19. CUTEr BDQRTIC, m = 2 (n − 4): 3 − 4 x_i, then x_i² + 2 x_{i+1}² + 3 x_{i+2}² + 4 x_{i+3}² + 5 x_n²,
// for i ≤ n − 4. The sum of squares is convex.
template <typename T>
void Bdqrtic(int n, const T* x, T* r) {
  const int half = n - 4;
  for (int i = 0; i < half; ++i) {
    r[i] = 3.0 - 4.0 * x[i];
    r[half + i] = 5.0 * x[n - 1] * x[n - 1];
    for (int k = 0; k < 4; ++k) r[half + i] += (1.0 + k) * x[i + k] * x[i + k];
  }
}

// 20. CUTEr CUBE, m = n: x_1 − 1, then 10 (x_i − x_{i−1}³).
template <typename T>
void Cube(int n, const T* x, T* r) {
  r[0] = x[0] - 1.0;
  for (int i = 1; i < n; ++i) r[i] = 10.0 * (x[i] - x[i - 1] * x[i - 1] * x[i - 1]);
}

// 21. CUTEr MANCINO with the constants of its n = 100, m = n: 1400 x_i + (i − 50)³ + Σ_j v_ij (sin⁵(log v_ij)
// + cos⁵(log v_ij)), v_ij = √(x_i² + i/j).
template <typename T>
void Mancino(int n, const T* x, T* r) {
  using std::cos;
  using std::log;
  using std::sin;
  using std::sqrt;
  for (int i = 1; i <= n; ++i) {
    r[i - 1] = 1400.0 * x[i - 1] + std::pow(i - 50.0, 3);
    for (int j = 1; j <= n; ++j) {
      const T v = sqrt(x[i - 1] * x[i - 1] + static_cast<double>(i) / j), angle = log(v);
      const T s = sin(angle), c = cos(angle);
      r[i - 1] += v * (s * s * s * s * s + c * c * c * c * c);
    }
  }
}

// 22. CUTEr HEART8LS, the dipole model of the heart, x = (a, b, c, d, t, u, v, w): sums of the moments of two
// dipoles, z_1 = a + i c at p_1 = t + i v and z_2 = b + i d at p_2 = u + i w. Residuals: real and imaginary
// part of z_1 p_1^k + z_2 p_2^k − s_k for k = 0 … 3 (written out in CUTEr), s_k the measured moments.
template <typename T>
void Heart8ls(const T* x, T* r) {
  constexpr double kMoments[8] = {-.69, -.044, -1.57, -1.31, -2.65, 2, -12.6, 9.48};
  for (int k = 0; k < 8; ++k) r[k] = T(-kMoments[k]);
  for (int dipole = 0; dipole < 2; ++dipole) {
    T real = x[dipole], imaginary = x[2 + dipole];
    const T &p_real = x[4 + dipole], &p_imaginary = x[6 + dipole];
    for (T* moment = r; moment != r + 8; moment += 2) {
      moment[0] += real;
      moment[1] += imaginary;
      const T turned = real * p_real - imaginary * p_imaginary;
      imaginary = real * p_imaginary + imaginary * p_real;
      real = turned;
    }
  }
}

}  // namespace more_wild

// r(x) of `function` (1 … 22); n and m as in Moré and Wild's table.
template <typename T>
void MoreWildResiduals(int function, int n, int m, const T* x, T* r) {
  switch (function) {
    case 1:
      return more_wild::LinearFullRank(n, m, x, r);
    case 2:
      return more_wild::LinearRank1(n, m, x, r);
    case 3:
      return more_wild::LinearRank1Zeros(n, m, x, r);
    case 4:
      return more_wild::Rosenbrock(x, r);
    case 5:
      return more_wild::HelicalValley(x, r);
    case 6:
      return more_wild::PowellSingular(x, r);
    case 7:
      return more_wild::FreudensteinRoth(x, r);
    case 8:
      return more_wild::Bard(x, r);
    case 9:
      return more_wild::KowalikOsborne(x, r);
    case 10:
      return more_wild::Meyer(x, r);
    case 11:
      return more_wild::Watson(n, x, r);
    case 12:
      return more_wild::Box3d(m, x, r);
    case 13:
      return more_wild::JennrichSampson(m, x, r);
    case 14:
      return more_wild::BrownDennis(m, x, r);
    case 15:
      return more_wild::Chebyquad(n, m, x, r);
    case 16:
      return more_wild::BrownAlmostLinear(n, x, r);
    case 17:
      return more_wild::Osborne1(x, r);
    case 18:
      return more_wild::Osborne2(x, r);
    case 19:
      return more_wild::Bdqrtic(n, x, r);
    case 20:
      return more_wild::Cube(n, x, r);
    case 21:
      return more_wild::Mancino(n, x, r);
    case 22:
      return more_wild::Heart8ls(x, r);
    default:
      throw std::invalid_argument("Moré and Wild have functions 1 to 22");
  }
}

}  // namespace frond
