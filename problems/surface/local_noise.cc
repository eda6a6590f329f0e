// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/local_noise.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/median.h"

namespace frond {

double LocalNoise(std::span<const Eigen::Vector3d> points, const std::vector<std::uint8_t>& outlier,
                  const KdTree& tree) {
  constexpr int kNeighbours = 24;
  using Vector6d = Eigen::Matrix<double, 6, 1>;
  std::vector<double> residuals;
  const std::size_t stride = std::max<std::size_t>(1, points.size() / 2000);
  std::array<KdTree::Neighbour, kNeighbours + 1> neighbours;
  for (std::size_t i = 0; i < points.size(); i += stride) {
    if (!outlier.empty() && outlier[i]) continue;
    if (tree.Nearest(points[i], neighbours) < neighbours.size()) continue;
    Eigen::Matrix<double, 3, kNeighbours + 1> local;
    for (Eigen::Index k = 0; k <= kNeighbours; ++k) {
      local.col(k) = points[neighbours[static_cast<std::size_t>(k)].index] - points[i];
    }
    const Eigen::Vector3d mean = local.rowwise().mean();
    const Eigen::Matrix3d spread = (local.colwise() - mean) * (local.colwise() - mean).transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);  // the normal's direction comes first
    const Eigen::Matrix<double, 3, kNeighbours + 1> turned =
        axes.eigenvectors().transpose() * (local.colwise() - mean);
    const double scale = std::sqrt(axes.eigenvalues()[2] / kNeighbours);
    if (!(scale > 0)) continue;
    Eigen::Matrix<double, kNeighbours + 1, 6> terms;
    for (Eigen::Index k = 0; k <= kNeighbours; ++k) {
      const double x = turned(2, k) / scale, y = turned(1, k) / scale;
      terms.row(k) << 1, x, y, x * x, x * y, y * y;
    }
    const Eigen::Matrix<double, kNeighbours + 1, 1> height = turned.row(0).transpose();
    const Vector6d fit = (terms.transpose() * terms).ldlt().solve(terms.transpose() * height);
    residuals.push_back((terms * fit - height).norm() / std::sqrt(kNeighbours + 1));
  }
  return Median(std::move(residuals));
}

}  // namespace frond
