// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/axis_start.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "base/errors.h"
#include "base/median.h"
#include "problems/turntable/intrinsics.h"

namespace frond {
namespace {

constexpr double kSmallestSine = 0.03;  // of the angle between two views: nearer to 0 or 180 says too little
constexpr int kReweightings = 50;

double Wrapped(double angle) { return std::remainder(angle, 2 * std::numbers::pi); }

// By how much less than the table the board seems to turn, or more.
double TurnMismatch(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to, double turn) {
  const Eigen::AngleAxisd seen(to.linear() * from.linear().transpose());
  return std::abs(seen.angle() - std::abs(Wrapped(turn)));
}

struct WeightedDirection {
  Eigen::Vector3d direction;
  double weight;
};

Eigen::Vector3d GeometricMedian(const std::vector<WeightedDirection>& directions) {
  Eigen::Vector3d median = Eigen::Vector3d::Zero();
  for (const WeightedDirection& d : directions) median += d.weight * d.direction;
  // A mean near zero (half of the signs wrong) is a poor start: take the direction nearest to all others.
  double least = std::numeric_limits<double>::infinity();
  for (const WeightedDirection& candidate : directions) {
    double sum = 0;
    for (const WeightedDirection& d : directions) {
      sum += d.weight * (d.direction - candidate.direction).norm();
    }
    if (sum < least) {
      least = sum;
      median = candidate.direction;
    }
  }
  for (int i = 0; i < kReweightings; ++i) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const WeightedDirection& d : directions) {
      sum += d.weight / std::max(1e-9, (d.direction - median).norm()) * d.direction;
    }
    median = sum.normalized();
  }
  return median;
}

// The point p of the axis, p ⊥ up: for views k, l with the board's centre at c_k, c_l,
//   (I − R(up, θ_l − θ_k)) p = c_l − R c_k,
// by least absolute deviations.
Eigen::Vector3d AxisPoint(const std::vector<AxisView>& views, const std::vector<Eigen::Isometry3d>& poses,
                          const Eigen::Vector3d& board_centre, const Eigen::Vector3d& up) {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  for (int i = 0; i < kReweightings; ++i) {
    // Along `up` nothing is known: the point is held in the plane through the camera's centre.
    Eigen::Matrix3d H = up * up.transpose();
    Eigen::Vector3d g = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < views.size(); ++k) {
      for (std::size_t l = k + 1; l < views.size(); ++l) {
        const Eigen::Matrix3d turn =
            Eigen::AngleAxisd(views[l].angle - views[k].angle, up).toRotationMatrix();
        const Eigen::Matrix3d A = Eigen::Matrix3d::Identity() - turn;
        Eigen::Vector3d b = poses[l] * board_centre - turn * (poses[k] * board_centre);
        b -= b.dot(up) * up;
        const double residual = (A * point - b).norm();
        const double weight = i == 0 ? 1 : 1 / std::max(1e-9 * b.norm() + 1e-300, residual);
        H += weight * A.transpose() * A;
        g += weight * A.transpose() * b;
      }
    }
    point = H.ldlt().solve(g);
  }
  return point;
}

}  // namespace

std::vector<Eigen::Isometry3d> LocateBoards(const PinholeCamera& camera, std::vector<AxisView>* views) {
  std::vector<Eigen::Isometry3d> poses;
  for (const AxisView& view : *views) poses.push_back(LocateBoard(camera, view.corners, view.name));
  std::vector<std::size_t> order(views->size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return (*views)[a].angle < (*views)[b].angle; });
  for (std::size_t i = 1; i < order.size(); ++i) {
    const std::size_t before = order[i - 1], k = order[i];
    AxisView& view = (*views)[k];
    if (!view.corners.may_be_upside_down) continue;
    const BoardCorners turned = TurnedUpsideDown(view.corners);
    const Eigen::Isometry3d other = LocateBoard(camera, turned, view.name);
    const double turn = view.angle - (*views)[before].angle;
    if (TurnMismatch(poses[before], other, turn) < TurnMismatch(poses[before], poses[k], turn)) {
      view.corners = turned;
      poses[k] = other;
    }
  }
  return poses;
}

Eigen::Vector3d TurnDirection(const std::vector<AxisView>& views,
                              const std::vector<Eigen::Isometry3d>& poses) {
  std::vector<WeightedDirection> directions;
  for (std::size_t k = 0; k < views.size(); ++k) {
    for (std::size_t l = k + 1; l < views.size(); ++l) {
      const double sine = std::sin(views[l].angle - views[k].angle);
      if (std::abs(sine) < kSmallestSine) continue;
      // The skew part of a rotation is sin(angle) times its axis.
      const Eigen::Matrix3d turn = poses[l].linear() * poses[k].linear().transpose();
      const Eigen::Vector3d skew(turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1));
      if (!(skew.norm() > 0)) continue;
      directions.push_back({skew.normalized() * (sine > 0 ? 1 : -1), std::abs(sine)});
    }
  }
  if (directions.empty()) {
    throw InputError(
        "the table's angles are all 0 or 180 degrees apart, which does not tell the axis: add views of the "
        "board at angles between, 10 and more");
  }
  return GeometricMedian(directions);
}

AxisState AxisStart(const PinholeCamera& camera, const std::vector<AxisView>& views,
                    const std::vector<Eigen::Isometry3d>& poses, const Eigen::Vector3d& up) {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : views[0].corners.points) centre += point;
  centre /= static_cast<double>(views[0].corners.points.size());
  AxisState state{.camera = camera,
                  .frame = MakeAxisFrame(AxisPoint(views, poses, centre, up), up),
                  .corrections = std::vector<double>(views.size(), 0.0)};
  // Each view puts the board at 0 degrees: the one that explains the median view best.
  double least = std::numeric_limits<double>::infinity();
  AxisState best = state;
  for (std::size_t k = 0; k < views.size(); ++k) {
    state.camera_from_board = TurnAbout(state.frame, -views[k].angle) * poses[k];
    std::vector<double> view_rms;
    for (const AxisView& view : views) view_rms.push_back(AxisViewRms(state, view, 0));
    const double median = Median(view_rms);
    if (median < least) {
      least = median;
      best = state;
    }
  }
  return best;
}

}  // namespace frond
