// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/cell_moments.h"

#include <algorithm>
#include <array>

#include "models/bspline_basis.h"

namespace frond {
namespace {

constexpr int kMaxPowers = 2 * kMaxDegree + 4;

void Powers(double x, int count, double* out) {
  double power = 1;
  for (int m = 0; m < count; ++m, power *= x) out[m] = power;
}

// sums[e][m][n] += factors[e] s^m t^n; kColumns columns where known at compile time, −1 otherwise.
template <int kColumns>
void AddMoments(const double* factors, int entries, const double* s, int rows, const double* t, int columns,
                double* sums) {
  const int width = kColumns > 0 ? kColumns : columns;
  for (int e = 0; e < entries; ++e) {
    for (int m = 0; m < rows; ++m, sums += width) {
      const double factor = factors[e] * s[m];
      for (int n = 0; n < width; ++n) sums[n] += factor * t[n];
    }
  }
}

int PaddedTo4(int n) { return (n + 3) / 4 * 4; }

// Products of two functions of one direction: row i * count + k holds the powers of N_i N_k.
Eigen::MatrixXd Products(const Eigen::MatrixXd& c) {
  const Eigen::Index n = c.rows();
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(n * n, 2 * n - 1);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index k = 0; k < n; ++k) {
      for (Eigen::Index m = 0; m < n; ++m) products.row(i * n + k).segment(m, n) += c(i, m) * c.row(k);
    }
  }
  return products;
}

// Coefficients in powers of s − ½ from those in powers of s.
Eigen::MatrixXd AboutTheMiddle(const Eigen::MatrixXd& c) {
  Eigen::MatrixXd shifted = c;
  for (Eigen::Index m = 0; m + 1 < c.cols();
       ++m) {  // Horner's scheme, one division by (s − ½) after the other
    for (Eigen::Index k = c.cols() - 2; k >= m; --k) shifted.col(k) += 0.5 * shifted.col(k + 1);
  }
  return shifted;
}

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace

CellMoments::CellMoments(int degree_u, int degree_v, int components, int right_hand_sides)
    : p_(degree_u),
      q_(degree_v),
      components_(components),
      right_hand_sides_(right_hand_sides),
      entries_(components * (components + 1) / 2),
      columns_(PaddedTo4(2 * degree_v + 1)),
      matrix_(static_cast<std::size_t>(entries_ * (2 * p_ + 1) * columns_)),
      vector_(static_cast<std::size_t>(right_hand_sides_ * (p_ + 1) * (q_ + 1))) {}

void CellMoments::Reset() {
  std::fill(matrix_.begin(), matrix_.end(), 0.0);
  std::fill(vector_.begin(), vector_.end(), 0.0);
}

void CellMoments::Add(double s, double t, const double* matrix, const double* vector) {
  std::array<double, kMaxPowers> sm, tn;
  Powers(s - 0.5, 2 * p_ + 1, sm.data());
  Powers(t - 0.5, columns_, tn.data());
  if (columns_ == 8) {
    AddMoments<8>(matrix, entries_, sm.data(), 2 * p_ + 1, tn.data(), 8, matrix_.data());
  } else {
    AddMoments<-1>(matrix, entries_, sm.data(), 2 * p_ + 1, tn.data(), columns_, matrix_.data());
  }
  if (q_ == 3) {
    AddMoments<4>(vector, right_hand_sides_, sm.data(), p_ + 1, tn.data(), 4, vector_.data());
  } else {
    AddMoments<-1>(vector, right_hand_sides_, sm.data(), p_ + 1, tn.data(), q_ + 1, vector_.data());
  }
}

void CellMoments::AddTo(const Eigen::MatrixXd& coefficients_u, const Eigen::MatrixXd& coefficients_v,
                        Eigen::MatrixXd* h, Eigen::VectorXd* g) const {
  const Eigen::MatrixXd u = AboutTheMiddle(coefficients_u), v = AboutTheMiddle(coefficients_v);
  const Eigen::Index nu = p_ + 1, nv = q_ + 1, d = components_;
  const Eigen::MatrixXd pu = Products(u), pv = Products(v);
  Eigen::Index e = 0;
  for (Eigen::Index x = 0; x < d; ++x) {
    for (Eigen::Index y = 0; y <= x; ++y, ++e) {
      const Eigen::Map<const RowMajor, 0, Eigen::OuterStride<>> moments(
          matrix_.data() + e * (2 * p_ + 1) * columns_, 2 * p_ + 1, 2 * q_ + 1,
          Eigen::OuterStride<>(columns_));
      const Eigen::MatrixXd block = pu * moments * pv.transpose();  // (i, k) × (j, l)
      for (Eigen::Index i = 0; i < nu; ++i) {
        for (Eigen::Index k = 0; k < nu; ++k) {
          for (Eigen::Index j = 0; j < nv; ++j) {
            for (Eigen::Index l = 0; l < nv; ++l) {
              const double value = block(i * nu + k, j * nv + l);
              (*h)((i * nv + j) * d + x, (k * nv + l) * d + y) += value;
              if (x != y) (*h)((i * nv + j) * d + y, (k * nv + l) * d + x) += value;
            }
          }
        }
      }
    }
  }
  for (Eigen::Index x = 0; x < right_hand_sides_; ++x) {
    const Eigen::Map<const RowMajor> moments(vector_.data() + x * nu * nv, nu, nv);
    const Eigen::MatrixXd block = u * moments * v.transpose();
    for (Eigen::Index a = 0; a < nu; ++a) {
      for (Eigen::Index b = 0; b < nv; ++b) (*g)((a * nv + b) * right_hand_sides_ + x) += block(a, b);
    }
  }
}

}  // namespace frond
