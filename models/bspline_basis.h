// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

namespace frond {

inline constexpr int kMaxDegree = 12;

// B-spline functions N_{i,p} of degree p on a knot vector (Piegl and Tiller, The NURBS Book, ch. 2).
//
// Knots are whole: control points + degree + 1 values, not decreasing; the domain is [knots[p], knots[n]]
// with n control points. A periodic basis has the same form with unclamped knots that repeat with the
// domain's length; its last p control points repeat the first p (so it has n − p distinct ones, at least p +
// 1: no control point acts twice on one span).
class BSplineBasis {
 public:
  // Throws InputError (naming the rule that is broken) unless 1 ≤ degree ≤ kMaxDegree, there are at least
  // 2(degree + 1) finite, non-decreasing knots, the domain is not empty, no knot inside it has a multiplicity
  // above the degree, and, where periodic, there are at least 2 degree + 1 control points, no knot at all
  // has a multiplicity above the degree, and the knots repeat with the domain's length (to 1e-9 of it; they
  // are then made to repeat exactly).
  BSplineBasis(int degree, std::vector<double> knots, bool periodic = false);

  int degree() const { return degree_; }
  bool periodic() const { return periodic_; }
  const std::vector<double>& knots() const { return knots_; }
  int num_control_points() const { return static_cast<int>(knots_.size()) - degree_ - 1; }
  // Without the repeated ones of a periodic basis.
  int num_distinct_control_points() const { return num_control_points() - (periodic_ ? degree_ : 0); }
  double begin() const { return knots_[static_cast<std::size_t>(degree_)]; }
  double end() const { return knots_[static_cast<std::size_t>(num_control_points())]; }

  // t moved into the domain: by whole periods where periodic, to the nearest end otherwise.
  double IntoDomain(double t) const;

  // The index s with knots[s] <= t < knots[s + 1] inside the domain (the last non-empty span at its end).
  // The functions s − degree … s are the ones that do not vanish there.
  int FindSpan(double t) const;

  // The non-empty spans of the domain, in order (each as the index s above).
  const std::vector<int>& spans() const { return spans_; }

  // Values and derivatives up to `order` of the degree + 1 functions of `span` at t: out[d * (degree + 1) +
  // k] is the d-th derivative of N_{span − degree + k}. T is double or a ceres::Jet. Algorithm A2.3.
  template <typename T>
  void Evaluate(int span, const T& t, int order, T* out) const;

 private:
  int degree_;
  std::vector<double> knots_;
  bool periodic_;
  std::vector<int> spans_;
};

template <typename T>
void BSplineBasis::Evaluate(int span, const T& t, int order, T* out) const {
  const int p = degree_;
  const double* knot = knots_.data();
  // ndu[j][r]: upper triangle basis functions, lower triangle knot differences.
  std::array<std::array<T, kMaxDegree + 1>, kMaxDegree + 1> ndu;
  std::array<T, kMaxDegree + 1> left, right;
  const auto at = [](int i) { return static_cast<std::size_t>(i); };
  ndu[0][0] = T(1.0);
  for (int j = 1; j <= p; ++j) {
    left[at(j)] = t - knot[span + 1 - j];
    right[at(j)] = knot[span + j] - t;
    T saved = T(0.0);
    for (int r = 0; r < j; ++r) {
      ndu[at(j)][at(r)] = right[at(r + 1)] + left[at(j - r)];
      const T term = ndu[at(r)][at(j - 1)] / ndu[at(j)][at(r)];
      ndu[at(r)][at(j)] = saved + right[at(r + 1)] * term;
      saved = left[at(j - r)] * term;
    }
    ndu[at(j)][at(j)] = saved;
  }
  for (int k = 0; k <= p; ++k) out[k] = ndu[at(k)][at(p)];
  for (int d = 1; d <= order; ++d) {
    for (int k = 0; k <= p; ++k) out[d * (p + 1) + k] = T(0.0);
  }
  std::array<std::array<T, kMaxDegree + 1>, 2> a;
  for (int r = 0; r <= p; ++r) {
    std::size_t now = 0, next = 1;
    a[0][0] = T(1.0);
    for (int d = 1; d <= order && d <= p; ++d) {
      T sum = T(0.0);
      const int rk = r - d, pk = p - d;
      if (r >= d) {
        a[next][0] = a[now][0] / ndu[at(pk + 1)][at(rk)];
        sum = a[next][0] * ndu[at(rk)][at(pk)];
      }
      const int j1 = rk >= -1 ? 1 : -rk;
      const int j2 = r - 1 <= pk ? d - 1 : p - r;
      for (int j = j1; j <= j2; ++j) {
        a[next][at(j)] = (a[now][at(j)] - a[now][at(j - 1)]) / ndu[at(pk + 1)][at(rk + j)];
        sum += a[next][at(j)] * ndu[at(rk + j)][at(pk)];
      }
      if (r <= pk) {
        a[next][at(d)] = -a[now][at(d - 1)] / ndu[at(pk + 1)][at(r)];
        sum += a[next][at(d)] * ndu[at(r)][at(pk)];
      }
      out[d * (p + 1) + r] = sum;
      std::swap(now, next);
    }
  }
  double factor = p;
  for (int d = 1; d <= order && d <= p; ++d) {
    for (int k = 0; k <= p; ++k) out[d * (p + 1) + k] *= factor;
    factor *= p - d;
  }
}

}  // namespace frond
