// SPDX-License-Identifier: BSD-3-Clause
#include "problems/skinning/local_quadric.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/QR>
#include <array>
#include <cmath>

namespace frond {
namespace {

constexpr std::size_t kNeighbours = 20;
constexpr double kLeastRise = 0.17;  // sin 10°
constexpr int kNewtonSteps = 12;

}  // namespace

Eigen::Vector3d LocalQuadric::At(double a, double b) const {
  const auto& c = coefficients;
  return point + a * x + b * y + (c[0] * a + c[1] * b + c[2] * a * a + c[3] * a * b + c[4] * b * b) * n;
}

std::optional<LocalQuadric> FitLocalQuadric(std::span<const Eigen::Vector3d> points, const KdTree& tree,
                                            const Eigen::Vector3d& point) {
  std::array<KdTree::Neighbour, kNeighbours> found;
  const std::size_t count = tree.Nearest(point, found);
  if (count < 6) return std::nullopt;
  // The spacing from the disc that holds them all; a Gaussian of 1.5 spacings.
  const double squared_spacing = found[count - 1].squared_distance * 3.14159 / static_cast<double>(count);
  if (!(squared_spacing > 0)) return std::nullopt;
  std::array<double, kNeighbours> weight;
  double sum = 0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < count; ++k) {
    weight[k] = std::exp(-found[k].squared_distance / (4.5 * squared_spacing));
    sum += weight[k];
    mean += weight[k] * points[found[k].index];
  }
  mean /= sum;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (std::size_t k = 0; k < count; ++k) {
    const Eigen::Vector3d d = points[found[k].index] - mean;
    covariance += weight[k] / sum * d * d.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(covariance);
  if (!(eigen.eigenvalues()[1] > 1e-4 * eigen.eigenvalues()[2])) return std::nullopt;
  LocalQuadric quadric;
  quadric.point = point;
  quadric.n = eigen.eigenvectors().col(0);
  quadric.x = eigen.eigenvectors().col(2);
  quadric.y = quadric.n.cross(quadric.x);
  Eigen::MatrixXd left(static_cast<Eigen::Index>(count), 6);
  Eigen::VectorXd right(static_cast<Eigen::Index>(count));
  for (std::size_t k = 0; k < count; ++k) {
    const Eigen::Vector3d d = points[found[k].index] - point;
    const double a = d.dot(quadric.x), b = d.dot(quadric.y), w = std::sqrt(weight[k]);
    const auto row = static_cast<Eigen::Index>(k);
    left.row(row) << w, w * a, w * b, w * a * a, w * a * b, w * b * b;
    right[row] = w * d.dot(quadric.n);
  }
  quadric.coefficients = left.colPivHouseholderQr().solve(right).tail<5>();
  return quadric;
}

std::optional<MovedPoint> MoveToPlane(const LocalQuadric& quadric, const Eigen::Vector3d& origin,
                                      const Eigen::Vector3d& normal, double reach) {
  const auto& c = quadric.coefficients;
  const double rise_n = normal.dot(quadric.n);
  Eigen::Vector2d way(normal.dot(quadric.x) + c[0] * rise_n, normal.dot(quadric.y) + c[1] * rise_n);
  if (!(way.norm() > 0)) return std::nullopt;
  way.normalize();
  const double slope = c[0] * way[0] + c[1] * way[1];
  const double curvature = c[2] * way[0] * way[0] + c[3] * way[0] * way[1] + c[4] * way[1] * way[1];
  const double flat = normal.dot(quadric.x) * way[0] + normal.dot(quadric.y) * way[1];
  const double height = (quadric.point - origin).dot(normal), stretch = std::sqrt(1 + slope * slope);
  // height + flat t + rise_n (slope t + curvature t²) = 0
  double t = 0;
  for (int k = 0; k < kNewtonSteps; ++k) {
    const double rise = flat + rise_n * (slope + 2 * curvature * t);
    if (!(rise > kLeastRise * stretch)) return std::nullopt;
    t -= (height + flat * t + rise_n * (slope * t + curvature * t * t)) / rise;
    if (!(std::abs(t) * stretch <= 2 * reach)) return std::nullopt;
  }
  if (!(std::abs(t) * stretch <= reach)) return std::nullopt;
  Eigen::Vector3d position = quadric.At(t * way[0], t * way[1]);
  position -= (position - origin).dot(normal) * normal;
  return MovedPoint{position, std::abs(t) * stretch};
}

Eigen::Vector3d HighestPoint(const LocalQuadric& quadric, const Eigen::Vector3d& direction, double reach) {
  const auto& c = quadric.coefficients;
  const double up = direction.dot(quadric.n);
  Eigen::Matrix2d hessian;
  hessian << 2 * c[2], c[3], c[3], 2 * c[4];
  hessian *= up;
  const Eigen::Vector2d gradient(direction.dot(quadric.x) + c[0] * up, direction.dot(quadric.y) + c[1] * up);
  if (!(hessian.determinant() > 0) || !(hessian.trace() < 0)) return quadric.point;
  const Eigen::Vector2d step = -hessian.inverse() * gradient;
  return step.norm() <= reach ? quadric.At(step[0], step[1]) : quadric.point;
}

}  // namespace frond
