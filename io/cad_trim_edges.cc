// SPDX-License-Identifier: BSD-3-Clause
#include "io/cad_trim_edges.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace frond {
namespace {

// (w (S − origin), w) at (u, v).
Eigen::Vector4d HomogeneousPoint(const NurbsSurface& s, const Eigen::Vector2d& uv,
                                 const Eigen::Vector3d& origin) {
  std::array<double, kMaxDegree + 1> nu, nv;
  const double u = s.u().IntoDomain(uv.x()), v = s.v().IntoDomain(uv.y());
  const int p = s.u().degree(), q = s.v().degree();
  const int span_u = s.u().FindSpan(u), span_v = s.v().FindSpan(v);
  s.u().Evaluate(span_u, u, 0, nu.data());
  s.v().Evaluate(span_v, v, 0, nv.data());
  Eigen::Vector4d sum = Eigen::Vector4d::Zero();
  for (int a = 0; a <= p; ++a) {
    for (int b = 0; b <= q; ++b) {
      const int i = span_u - p + a, j = span_v - q + b;
      const double factor =
          nu[static_cast<std::size_t>(a)] * nv[static_cast<std::size_t>(b)] * s.weight(i, j);
      sum.head<3>() += factor * (s.control_point(i, j) - origin);
      sum[3] += factor;
    }
  }
  return sum;
}

// Chebyshev–Lobatto nodes on [0, 1], both ends included: well conditioned up to degree 24.
std::vector<double> Nodes(int degree) {
  std::vector<double> nodes;
  for (int k = 0; k <= degree; ++k) nodes.push_back(0.5 - 0.5 * std::cos(std::numbers::pi * k / degree));
  return nodes;
}

// Row k: the Bernstein polynomials of `degree` at node k.
Eigen::MatrixXd BernsteinMatrix(int degree, const std::vector<double>& nodes) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(degree + 1, degree + 1);
  for (Eigen::Index row = 0; row <= degree; ++row) {
    const double t = nodes[static_cast<std::size_t>(row)];
    matrix(row, 0) = 1;
    for (Eigen::Index d = 1; d <= degree; ++d) {  // raise the degree one by one
      for (Eigen::Index k = d; k > 0; --k) matrix(row, k) = (1 - t) * matrix(row, k) + t * matrix(row, k - 1);
      matrix(row, 0) *= 1 - t;
    }
  }
  return matrix;
}

// Where the segment a → b crosses knot lines, as fractions strictly between 0 and 1.
std::vector<double> Crossings(const NurbsSurface& s, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  constexpr double kNearest = 1e-7;  // of the segment: shorter pieces are of no use
  std::vector<double> all;
  for (int direction = 0; direction < 2; ++direction) {
    const double begin = a[direction], step = b[direction] - a[direction];
    const BSplineBasis& basis = direction == 0 ? s.u() : s.v();
    for (const double knot : basis.knots()) {
      const double t = (knot - begin) / step;
      if (t > kNearest && t < 1 - kNearest) all.push_back(t);
    }
  }
  std::sort(all.begin(), all.end());
  std::vector<double> crossings;
  for (const double t : all) {
    if (crossings.empty() || t - crossings.back() > kNearest) crossings.push_back(t);
  }
  return crossings;
}

}  // namespace

CurveOnSurface ComposePolyline(const NurbsSurface& surface, std::span<const Eigen::Vector2d> polyline) {
  CurveOnSurface curve;
  curve.degree = surface.u().degree() + surface.v().degree();
  const std::vector<double> nodes = Nodes(curve.degree);
  const Eigen::MatrixXd to_bezier = BernsteinMatrix(curve.degree, nodes).inverse();
  const Eigen::Vector3d origin = surface.Evaluate(polyline[0].x(), polyline[0].y());
  Eigen::MatrixXd samples(curve.degree + 1, 4);
  const auto add = [&](const Eigen::Vector4d& homogeneous) {
    const double weight = surface.IsRational() ? homogeneous[3] : 1.0;
    curve.control_points.push_back(origin + homogeneous.head<3>() / homogeneous[3]);
    curve.weights.push_back(weight);
  };
  curve.breaks.push_back(0);
  add(HomogeneousPoint(surface, polyline[0], origin));
  for (std::size_t k = 0; k + 1 < polyline.size(); ++k) {
    const Eigen::Vector2d &a = polyline[k], &b = polyline[k + 1];
    std::vector<double> ends = Crossings(surface, a, b);
    ends.push_back(1);
    double begin = 0;
    for (const double end : ends) {
      for (Eigen::Index row = 0; row <= curve.degree; ++row) {
        const double t = begin + (end - begin) * nodes[static_cast<std::size_t>(row)];
        samples.row(row) = HomogeneousPoint(surface, a + t * (b - a), origin).transpose();
      }
      const Eigen::MatrixXd bezier = to_bezier * samples;
      for (Eigen::Index row = 1; row < curve.degree; ++row) add(bezier.row(row).transpose());
      add(samples.row(curve.degree).transpose());  // shared by the next piece
      curve.breaks.push_back(static_cast<double>(k) + end);
      begin = end;
    }
  }
  return curve;
}

}  // namespace frond
