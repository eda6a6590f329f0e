// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/board_bundle.h"

#include <ceres/manifold.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "problems/turntable/pose_step.h"
#include "solvers/compressed_cost_function.h"

namespace frond {
namespace {

constexpr int kTangential1 = 2, kTangential2 = 3;
constexpr std::array<int, 3> kRadial = {0, 1, 4};  // k1, k2, k3 among k1, k2, p1, p2, k3

// Residual i: π(length, centre, distortion; board pose · X_i) − pixel_i, through the first camera.
struct FirstCameraResidual {
  const BoardCorners* corners;
  Eigen::Matrix3d board_rotation;

  template <typename T>
  bool operator()(int i, const T* length, const T* centre, const T* distortion, const T* board,
                  T* residual) const {
    T point[3];
    Place(i, board, point);
    return Compare(i, length, centre, distortion, point, residual);
  }

  template <typename T>
  void Place(int i, const T* board, T* point) const {
    const Eigen::Vector3d& X = corners->points[static_cast<std::size_t>(i)];
    const T on_board[3] = {T(X.x()), T(X.y()), T(X.z())};
    MoveByPose(board_rotation, board, on_board, point);
  }

  template <typename T>
  bool Compare(int i, const T* length, const T* centre, const T* distortion, const T* point,
               T* residual) const {
    if (!(point[2] > T(0))) return false;
    const T focal[4] = {length[0], length[0] * length[1], centre[0], centre[1]};
    ProjectPinhole(focal, distortion, point, residual);
    const Eigen::Vector2d& pixel = corners->pixels[static_cast<std::size_t>(i)];
    residual[0] -= T(pixel.x());
    residual[1] -= T(pixel.y());
    return true;
  }
};

// The same through the second camera, at `pose` from the first.
struct SecondCameraResidual {
  FirstCameraResidual first;
  Eigen::Matrix3d pose_rotation;

  template <typename T>
  bool operator()(int i, const T* length, const T* centre, const T* distortion, const T* pose, const T* board,
                  T* residual) const {
    T point[3], moved[3];
    first.Place(i, board, point);
    MoveByPose(pose_rotation, pose, point, moved);
    return first.Compare(i, length, centre, distortion, moved, residual);
  }
};

void Hold(std::vector<int> held, int size, ParameterBlock* block) {
  if (held.empty()) return;
  if (static_cast<int>(held.size()) == size) {
    block->constant = true;
  } else {
    block->manifold = std::make_shared<ceres::SubsetManifold>(size, held);
  }
}

}  // namespace

BoardBundle::BoardBundle(const PinholeCamera& first, const std::vector<BundleView>& views,
                         const BundleOptions& options)
    : views_(views), robust_width_(options.robust_width) {
  AddCamera(first, 0, options);
  for (std::size_t k = 0; k < views_.size(); ++k) {
    const std::array<double, 6> start = PoseStart(views_[k].first_from_board);
    const Offsets at = Append({.name = "board" + std::to_string(k), .start = {start.begin(), start.end()}});
    if (k == 0) first_board_ = at;
  }
}

BoardBundle::BoardBundle(const PinholeCamera& first, const PinholeCamera& second,
                         const Eigen::Isometry3d& second_from_first, const std::vector<BundleView>& views,
                         const BundleOptions& options)
    : views_(views),
      cameras_(2),
      robust_width_(options.robust_width),
      pose_rotation_(second_from_first.linear()) {
  AddCamera(first, 0, options);
  AddCamera(second, 1, options);
  const std::array<double, 6> start = PoseStart(second_from_first);
  pose_ = Append({.name = "pose", .start = {start.begin(), start.end()}});
  for (std::size_t k = 0; k < views_.size(); ++k) {
    const std::array<double, 6> board = PoseStart(views_[k].first_from_board);
    const Offsets at = Append({.name = "board" + std::to_string(k), .start = {board.begin(), board.end()}});
    if (k == 0) first_board_ = at;
  }
}

BoardBundle::Offsets BoardBundle::Append(ParameterBlock block) {
  const Offsets at{.block = parameters_.size(), .value = num_values_};
  num_values_ += block.start.size();
  parameters_.push_back(std::move(block));
  return at;
}

void BoardBundle::AddCamera(const PinholeCamera& camera, int index, const BundleOptions& options) {
  const auto c = static_cast<std::size_t>(index);
  const std::string name = index == 0 ? "first" : "second";
  start_[c] = camera;
  if (index == 1 && options.same_focal_length) {
    length_[1] = length_[0];
  } else {
    ParameterBlock length{.name = name + ".length", .start = {camera.focal[0], 0}};
    length.start[1] = options.square_pixels ? 1 : camera.focal[1] / camera.focal[0];
    if (options.square_pixels) Hold({1}, 2, &length);
    length_[c] = Append(std::move(length));
  }
  centre_[c] = Append(
      {.name = name + ".centre", .start = {camera.focal[2], camera.focal[3]}, .constant = options.centred});
  ParameterBlock distortion{.name = name + ".distortion",
                            .start = {camera.distortion.begin(), camera.distortion.end()}};
  std::vector<int> held;
  for (int k = options.radial_distortion; k < 3; ++k) held.push_back(kRadial[static_cast<std::size_t>(k)]);
  if (!options.tangential_distortion) held.insert(held.end(), {kTangential1, kTangential2});
  std::sort(held.begin(), held.end());
  Hold(std::move(held), 5, &distortion);
  distortion_[c] = Append(std::move(distortion));
}

void BoardBundle::AddResiduals(const std::vector<double*>& blocks, ceres::EvaluationCallback* /*state*/,
                               ceres::Problem* problem) const {
  RobustLoss loss;
  if (robust_width_ > 0) loss = {.type = RobustLossType::kHuber, .scale = robust_width_};
  for (std::size_t k = 0; k < views_.size(); ++k) {
    const Eigen::Matrix3d board_rotation = views_[k].first_from_board.linear();
    double* const board = blocks[first_board_.block + k];
    const BoardCorners& first = views_[k].corners[0];
    if (!first.pixels.empty()) {
      const FirstCameraResidual functor{&first, board_rotation};
      problem->AddResidualBlock(new CompressedAutoDiffCostFunction<FirstCameraResidual, 2, 2, 2, 5, 6>(
                                    functor, static_cast<int>(first.pixels.size()), loss),
                                nullptr, blocks[length_[0].block], blocks[centre_[0].block],
                                blocks[distortion_[0].block], board);
    }
    const BoardCorners& second = views_[k].corners[1];
    if (cameras_ == 2 && !second.pixels.empty()) {
      const SecondCameraResidual functor{{&second, board_rotation}, pose_rotation_};
      problem->AddResidualBlock(new CompressedAutoDiffCostFunction<SecondCameraResidual, 2, 2, 2, 5, 6, 6>(
                                    functor, static_cast<int>(second.pixels.size()), loss),
                                nullptr, blocks[length_[1].block], blocks[centre_[1].block],
                                blocks[distortion_[1].block], blocks[pose_.block], board);
    }
  }
}

PinholeCamera BoardBundle::CameraAt(std::span<const double> x, int camera) const {
  const auto c = static_cast<std::size_t>(camera);
  PinholeCamera result = start_[c];
  const double* const length = &x[length_[c].value];
  const double* const centre = &x[centre_[c].value];
  result.focal = {length[0], length[0] * length[1], centre[0], centre[1]};
  std::copy_n(&x[distortion_[c].value], 5, result.distortion.begin());
  return result;
}

Eigen::Isometry3d BoardBundle::PoseAt(std::span<const double> x) const {
  if (cameras_ == 1) return Eigen::Isometry3d::Identity();
  return PoseOf(pose_rotation_, &x[pose_.value]);
}

Eigen::Isometry3d BoardBundle::BoardAt(std::span<const double> x, int view) const {
  const auto k = static_cast<std::size_t>(view);
  return PoseOf(views_[k].first_from_board.linear(), &x[first_board_.value + 6 * k]);
}

std::array<double, 9> BoardBundle::CameraSigma(std::span<const double> x, const Eigen::MatrixXd& covariance,
                                               int camera) const {
  const auto c = static_cast<std::size_t>(camera);
  const auto variance = [&](std::size_t i, std::size_t j) {
    return covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  };
  const std::size_t length = length_[c].value;
  const double fx = x[length], ratio = x[length + 1];
  std::array<double, 9> sigma{};
  sigma[0] = std::sqrt(variance(length, length));
  // fy = fx · ratio.
  sigma[1] = std::sqrt(std::max(0.0, ratio * ratio * variance(length, length) +
                                         2 * ratio * fx * variance(length, length + 1) +
                                         fx * fx * variance(length + 1, length + 1)));
  for (std::size_t k = 0; k < 2; ++k) {
    const std::size_t i = centre_[c].value + k;
    sigma[2 + k] = std::sqrt(variance(i, i));
  }
  for (std::size_t k = 0; k < 5; ++k) {
    const std::size_t i = distortion_[c].value + k;
    sigma[4 + k] = std::sqrt(variance(i, i));
  }
  return sigma;
}

std::array<double, 6> BoardBundle::PoseSigma(const Eigen::MatrixXd& covariance) const {
  std::array<double, 6> sigma{};
  for (std::size_t k = 0; k < 6; ++k) {
    const auto i = static_cast<Eigen::Index>(pose_.value + k);
    sigma[k] = std::sqrt(covariance(i, i));
  }
  return sigma;
}

double BoardBundle::SumOfSquares(std::span<const double> x, int view, int camera) const {
  const BoardCorners& corners =
      views_[static_cast<std::size_t>(view)].corners[static_cast<std::size_t>(camera)];
  const PinholeCamera lens = CameraAt(x, camera);
  Eigen::Isometry3d pose = BoardAt(x, view);
  if (camera == 1) pose = PoseAt(x) * pose;
  double sum = 0;
  for (std::size_t i = 0; i < corners.pixels.size(); ++i) {
    sum += (lens.Project(pose * corners.points[i]) - corners.pixels[i]).squaredNorm();
  }
  return sum;
}

double BoardBundle::ViewRms(std::span<const double> x, int view, int camera) const {
  const std::size_t count =
      views_[static_cast<std::size_t>(view)].corners[static_cast<std::size_t>(camera)].pixels.size();
  return count == 0 ? 0 : std::sqrt(SumOfSquares(x, view, camera) / static_cast<double>(count));
}

std::size_t BoardBundle::NumCorners() const {
  std::size_t count = 0;
  for (const BundleView& view : views_) {
    for (std::size_t c = 0; c < static_cast<std::size_t>(cameras_); ++c)
      count += view.corners[c].pixels.size();
  }
  return count;
}

double BoardBundle::Rms(std::span<const double> x) const {
  double sum = 0;
  for (int view = 0; view < static_cast<int>(views_.size()); ++view) {
    for (int camera = 0; camera < cameras_; ++camera) sum += SumOfSquares(x, view, camera);
  }
  return std::sqrt(sum / static_cast<double>(NumCorners()));
}

double BoardBundle::CornerVariance(std::span<const double> x) const {
  double free = 0;
  for (const ParameterBlock& block : parameters_) {
    if (block.constant) continue;
    free += block.manifold != nullptr ? block.manifold->TangentSize() : static_cast<int>(block.start.size());
  }
  const auto corners = static_cast<double>(NumCorners());
  const double rms = Rms(x);
  return rms * rms * corners / std::max(1.0, 2 * corners - free);
}

}  // namespace frond
