// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/principal_axes.h"

#include <Eigen/Eigenvalues>
#include <stdexcept>

namespace frond {

PrincipalAxes FindPrincipalAxes(std::span<const Eigen::Vector3d> points,
                                const std::vector<std::uint8_t>& left_out) {
  // Two passes about a point of the cloud, so that coordinates far from 0 cost no digits.
  const Eigen::Vector3d shift = points.empty() ? Eigen::Vector3d::Zero() : points.front();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  std::size_t count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (left_out[i]) continue;
    sum += points[i] - shift;
    ++count;
  }
  if (count == 0) throw std::invalid_argument("FindPrincipalAxes: no points");
  PrincipalAxes result;
  const Eigen::Vector3d mean = sum / static_cast<double>(count);
  result.origin = shift + mean;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (left_out[i]) continue;
    const Eigen::Vector3d d = points[i] - shift - mean;
    covariance += d * d.transpose();
  }
  covariance /= static_cast<double>(count);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  result.axes = solver.eigenvectors().rowwise().reverse();
  result.deviations = solver.eigenvalues().reverse().cwiseMax(0).cwiseSqrt();
  return result;
}

}  // namespace frond
