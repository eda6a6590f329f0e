// SPDX-License-Identifier: BSD-3-Clause
#include "problems/stereo/curvature_bias.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "base/parallel.h"

namespace frond {
namespace {

constexpr int kFewestNeighbours = 12;  // for the six coefficients of the quadratic
constexpr double kSameSide = 1;        // pixels, where the options ask for no check of edges
constexpr double kLeastSigma = 0.01;   // pixels, in the weights

using Quadratic = Eigen::Matrix<double, 6, 1>;  // of 1, ξ, η, ξ²/2, ξη, η²/2

Quadratic Terms(double xi, double eta) {
  return (Quadratic() << 1, xi, eta, xi * xi / 2, xi * eta, eta * eta / 2).finished();
}

struct SecondDerivatives {
  Eigen::Vector3d value = Eigen::Vector3d::Zero();  // xx, xy, yy
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

// Of the disparity near the window in grid node (column, row).
std::optional<SecondDerivatives> Curvature(const WindowGrid& grid, const StereoMatchOptions& options,
                                           std::span<const MatchedWindow> windows, int column, int row) {
  const MatchedWindow& centre = windows[static_cast<std::size_t>(grid(column, row))];
  const double limit = options.discontinuity > 0 ? options.discontinuity : kSameSide;
  const int reach = std::max(1, 3 * options.window.size / options.step / 2);
  Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
  Quadratic right = Quadratic::Zero();
  double squares = 0, weights = 0;
  int count = 0;
  for (int j = -reach; j <= reach; ++j) {
    for (int i = -reach; i <= reach; ++i) {
      if (!grid.Contains(column + i, row + j) || grid(column + i, row + j) < 0) continue;
      const MatchedWindow& near = windows[static_cast<std::size_t>(grid(column + i, row + j))];
      if (near.status != WindowStatus::kAccepted) continue;
      const double xi = near.x - centre.x, eta = near.y - centre.y;
      // Half way between the two centres both planes should say the same.
      const double here = ExtrapolatedWarp(options.window.warp, centre.match.warp, xi / 2, eta / 2)[0],
                   there = ExtrapolatedWarp(options.window.warp, near.match.warp, -xi / 2, -eta / 2)[0];
      if (std::abs(here - there) > limit) continue;
      const double weight = 1 / std::pow(std::max(near.match.sigma, kLeastSigma), 2);
      const Quadratic terms = Terms(xi, eta);
      normal.noalias() += weight * terms * terms.transpose();
      right.noalias() += weight * near.match.warp[0] * terms;
      squares += weight * near.match.warp[0] * near.match.warp[0];
      weights += weight;
      ++count;
    }
  }
  if (count < kFewestNeighbours) return std::nullopt;
  const Eigen::LDLT<Eigen::Matrix<double, 6, 6>> factor(normal);
  if (factor.info() != Eigen::Success || factor.rcond() < 1e-12) return std::nullopt;
  const Quadratic solution = factor.solve(right);
  // Windows overlap: about (size / step)² of them share their noise. Where the surface is no quadratic, the
  // scatter about it says so.
  const double shared = std::max(1.0, std::pow(static_cast<double>(options.window.size) / options.step, 2));
  const double scatter = std::max(squares - solution.dot(right), 0.0) / (count - 6);
  const Eigen::Matrix<double, 6, 6> inverse = factor.solve(Eigen::Matrix<double, 6, 6>::Identity());
  return SecondDerivatives{.value = solution.tail<3>(),
                           .covariance = std::max(scatter, 1.0) * shared * inverse.bottomRightCorner<3, 3>()};
}

// What a plane fitted to the window gives at its centre for disparities of ξ²/2, ξη and η²/2, each pixel
// weighted by its squared slope of grey.
std::optional<Eigen::Vector3d> PlaneResponse(const Image& left, const Mask& mask, int size, int x, int y) {
  const int half = size / 2;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero(), right = Eigen::Matrix3d::Zero();
  for (int eta = -half; eta <= half; ++eta) {
    for (int xi = -half; xi <= half; ++xi) {
      const int column = x + xi, row = y + eta;
      if (row < 0 || row >= left.height || column < 1 || column >= left.width - 1) continue;
      if (!mask.empty() && !(mask(column - 1, row) && mask(column, row) && mask(column + 1, row))) continue;
      const double slope = (left(column + 1, row) - left(column - 1, row)) / 2, weight = slope * slope;
      const Quadratic terms = Terms(xi, eta);
      normal.noalias() += weight * terms.head<3>() * terms.head<3>().transpose();
      right.noalias() += weight * terms.head<3>() * terms.tail<3>().transpose();
    }
  }
  const Eigen::LDLT<Eigen::Matrix3d> factor(normal);
  if (factor.info() != Eigen::Success || factor.rcond() < 1e-12) return std::nullopt;
  return Eigen::Vector3d(factor.solve(right).row(0).transpose());
}

}  // namespace

void RemoveCurvatureBias(const WindowGrid& grid, const Image& left, const Mask& left_mask,
                         const StereoMatchOptions& options, int threads, std::span<MatchedWindow> windows) {
  if (options.window.warp != WarpKind::kLinear) return;
  std::vector<WindowMatch> corrected(windows.size());
  ParallelFor(static_cast<std::size_t>(grid.height), 4, threads, [&](std::size_t begin, std::size_t end) {
    for (int row = static_cast<int>(begin); row < static_cast<int>(end); ++row) {
      for (int column = 0; column < grid.width; ++column) {
        if (grid(column, row) < 0) continue;
        const auto k = static_cast<std::size_t>(grid(column, row));
        corrected[k] = windows[k].match;
        if (windows[k].status != WindowStatus::kAccepted) continue;
        const auto curvature = Curvature(grid, options, windows, column, row);
        if (!curvature) continue;
        const auto response = PlaneResponse(left, left_mask, options.window.size, windows[k].x, windows[k].y);
        if (!response) continue;
        corrected[k].warp[0] -= response->dot(curvature->value);
        corrected[k].sigma =
            std::sqrt(std::pow(windows[k].match.sigma, 2) + response->dot(curvature->covariance * *response));
      }
    }
  });
  for (std::size_t k = 0; k < windows.size(); ++k) windows[k].match = corrected[k];
}

}  // namespace frond
