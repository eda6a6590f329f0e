// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/pose_refinement.h"

#include <ceres/autodiff_cost_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/errors.h"
#include "problems/turntable/overlap_pairs.h"
#include "problems/turntable/point_to_plane.h"
#include "solvers/compressed_cost_function.h"

namespace frond {
namespace {

using Views = std::vector<std::vector<ScanPoint>>;
constexpr double kRadians = std::numbers::pi / 180;
constexpr double kHuber = 2;  // standard deviations

Eigen::AlignedBox3d BoxOf(const Views& views) {
  Eigen::AlignedBox3d box;
  for (const auto& view : views) {
    for (const ScanPoint& p : view) box.extend(p.position);
  }
  return box;
}

Eigen::Vector3d MiddleOf(const std::vector<ScanPoint>& view) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const ScanPoint& p : view) sum += p.position;
  return view.empty() ? sum : Eigen::Vector3d(sum / static_cast<double>(view.size()));
}

// Moves the points about `centre` by small rotations and shifts; the result is a motion of the disk's frame.
template <int kSize>
Eigen::Isometry3d MotionOf(const std::array<double, kSize>& x, const Eigen::Vector3d& centre) {
  Eigen::Vector3d turn = Eigen::Vector3d::Zero(), shift = Eigen::Vector3d::Zero();
  if constexpr (kSize == 1) {
    turn.z() = x[0];
  } else {
    turn = Eigen::Vector3d(x[0], x[1], x[2]);
    shift = Eigen::Vector3d(x[3], x[4], x[5]);
  }
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  const double angle = turn.norm();
  if (angle > 0) motion.linear() = Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
  motion.translation() = centre + shift - motion.linear() * centre;
  return motion;
}

// r = what is left of a correction in its expected standard deviations: total so far (`done`) plus the step.
template <int kSize>
struct PriorResidual {
  std::array<double, kSize> done, deviation;

  template <typename T>
  bool operator()(const T* x, T* residual) const {
    for (std::size_t k = 0; k < kSize; ++k) residual[k] = (x[k] + done[k]) / deviation[k];
    return true;
  }
};

template <int kSize>
class Refiner {
 public:
  Refiner(const Views& views, const PoseRefinementOptions& options) : views_(views), options_(options) {
    const Eigen::AlignedBox3d box = BoxOf(views);
    // The angle alone turns about the disk's axis, which is where the frame's origin is.
    centre_ = kSize == 1 ? Eigen::Vector3d::Zero() : Eigen::Vector3d(box.center());
    deviation_.fill(options.angle_deviation * kRadians);
    for (std::size_t k = 3; k < kSize; ++k) {
      deviation_[k] = options.position_deviation * box.sizes().maxCoeff();
    }
    total_.resize(views.size(), std::array<double, kSize>{});
    motion_.resize(views.size(), Eigen::Isometry3d::Identity());
  }

  void Step(const std::vector<OverlapPair>& overlaps) {
    std::vector<std::array<double, kSize>> x(views_.size(), std::array<double, kSize>{});
    ceres::Problem problem;
    for (std::size_t v = 0; v < x.size(); ++v) {
      problem.AddResidualBlock(new ceres::AutoDiffCostFunction<PriorResidual<kSize>, kSize, kSize>(
                                   new PriorResidual<kSize>{total_[v], deviation_}),
                               nullptr, x[v].data());
    }
    for (const OverlapPair& overlap : overlaps) {
      using Cost = CompressedAutoDiffCostFunction<PointToPlaneResidual<kSize>, 1, kSize, kSize>;
      const auto count = static_cast<double>(overlap.rows.size());
      const double share = std::sqrt(std::min(1.0, options_.independent_points / count));
      const RobustLoss loss{RobustLossType::kHuber, kHuber * share};
      problem.AddResidualBlock(new Cost(PointToPlaneResidual<kSize>{&overlap.rows, centre_, share},
                                        static_cast<int>(overlap.rows.size()), loss),
                               nullptr, x[overlap.first].data(), x[overlap.second].data());
    }
    ceres::Solver::Options solver;
    solver.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
    solver.max_num_iterations = 20;
    solver.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(solver, &problem, &summary);
    if (!summary.IsSolutionUsable()) {
      throw FitError("the refinement of the views' poses failed: " + summary.message);
    }
    for (std::size_t v = 0; v < x.size(); ++v) {
      for (std::size_t k = 0; k < kSize; ++k) total_[v][k] += x[v][k];
      motion_[v] = MotionOf<kSize>(x[v], centre_) * motion_[v];
    }
  }

  const std::vector<Eigen::Isometry3d>& motion() const { return motion_; }

 private:
  const Views& views_;
  const PoseRefinementOptions& options_;
  Eigen::Vector3d centre_;
  std::array<double, kSize> deviation_{};
  std::vector<std::array<double, kSize>> total_;
  std::vector<Eigen::Isometry3d> motion_;
};

template <int kSize>
std::vector<Eigen::Isometry3d> Refine(const Views& views, const PoseRefinementOptions& options, int threads) {
  Refiner<kSize> refiner(views, options);
  for (int k = 0; k < options.repetitions; ++k) {
    refiner.Step(FindOverlaps(views, refiner.motion(), options, threads));
  }
  return refiner.motion();
}

void Describe(const Views& views, const PoseRefinementOptions& options, PoseRefinement* refinement) {
  bool large = false;
  for (std::size_t v = 0; v < views.size(); ++v) {
    const Eigen::Isometry3d& motion = refinement->correction[v];
    const Eigen::Vector3d middle = MiddleOf(views[v]);
    const Eigen::AngleAxisd turn(motion.linear());
    refinement->angle.push_back(turn.angle() * turn.axis().z() / kRadians);
    refinement->shift.push_back((motion * middle - middle).norm());
    large = large || std::abs(refinement->angle.back()) > 3 * options.angle_deviation;
  }
  if (large) {
    refinement->warnings.emplace_back(
        "a view's angle was corrected by more than three times what was expected; check the angles of the "
        "views and the calibration of the axis");
  }
  std::optional<std::string> warning = OverlapWarning(refinement->after);
  if (warning) refinement->warnings.push_back(*std::move(warning));
}

}  // namespace

std::optional<std::string> OverlapWarning(const OverlapErrors& errors) {
  constexpr double kMost = 3;
  if (errors.normalised <= kMost) return std::nullopt;
  return "the views do not fit together: their surfaces lie " + std::to_string(errors.normalised) +
         " standard deviations apart; check the angles (their sign too) and the calibration of the axis, or "
         "let the poses be refined";
}

OverlapErrors MeasureOverlaps(const Views& views, const PoseRefinementOptions& options, int threads) {
  return ErrorsOfOverlaps(FindOverlaps(
      views, std::vector<Eigen::Isometry3d>(views.size(), Eigen::Isometry3d::Identity()), options, threads));
}

PoseRefinement RefinePoses(const Views& views, const PoseRefinementOptions& options, int threads) {
  PoseRefinement refinement;
  refinement.before = MeasureOverlaps(views, options, threads);
  if (refinement.before.correspondences == 0) {
    refinement.correction.assign(views.size(), Eigen::Isometry3d::Identity());
    refinement.warnings.emplace_back("no two views see the same surface; their poses are not refined");
  } else {
    refinement.correction = options.freedom == PoseFreedom::kAngle ? Refine<1>(views, options, threads)
                                                                   : Refine<6>(views, options, threads);
  }
  refinement.after = ErrorsOfOverlaps(FindOverlaps(views, refinement.correction, options, threads));
  Describe(views, options, &refinement);
  return refinement;
}

void ApplyCorrections(const PoseRefinement& refinement, Views* views) {
  for (std::size_t v = 0; v < views->size(); ++v) {
    const Eigen::Isometry3d& motion = refinement.correction.at(v);
    for (ScanPoint& p : (*views)[v]) {
      p.position = motion * p.position;
      p.normal = motion.linear() * p.normal;
      p.to_camera = motion.linear() * p.to_camera;
    }
  }
}

void CheckTurningSense(const Views& views) {
  // A closed body's mean is about .8, a thin sheet's 0.
  constexpr double kHollow = -0.15;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  double count = 0;
  for (const auto& view : views) {
    for (const ScanPoint& p : view) middle += p.position;
    count += static_cast<double>(view.size());
  }
  if (count == 0) return;
  middle /= count;
  double outwards = 0, lengths = 0;
  for (const auto& view : views) {
    for (const ScanPoint& p : view) {
      const Eigen::Vector2d from_middle = (p.position - middle).head<2>();
      outwards += p.normal.head<2>().dot(from_middle);
      lengths += p.normal.head<2>().norm() * from_middle.norm();
    }
  }
  if (outwards < kHollow * lengths) {
    throw InputError(
        "the object looks hollow from nearly every view: the angles have the wrong sign (they have to count "
        "counter-clockwise seen from above); turn the sign of the views' angles");
  }
}

}  // namespace frond
