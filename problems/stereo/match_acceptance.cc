// SPDX-License-Identifier: BSD-3-Clause
#include "problems/stereo/match_acceptance.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace frond {
namespace {

constexpr double kMostDeparting = 0.01;  // share of the start's disparities: a few speckles
constexpr double kMostLeaning = 0.2;     // beyond half the limit

// Displacement x_left − x_right at the centre and its slopes.
struct LocalShift {
  Eigen::Vector2d at_centre = Eigen::Vector2d::Zero();
  Eigen::Matrix2d slopes = Eigen::Matrix2d::Zero();

  LocalShift(WarpKind kind, const WarpValues& w) {
    at_centre[0] = w[0];
    if (kind != WarpKind::kShift) slopes.row(0) << w[1], w[2];
    if (kind != WarpKind::kAffine) return;
    at_centre[1] = w[3];
    slopes.row(1) << w[4], w[5];
  }
};

}  // namespace

double WindowTexture(const Image& image, const Mask& mask, int size, int x, int y) {
  const int half = size / 2;
  double slopes = 0;
  int count = 0;
  for (int row = std::max(0, y - half); row <= std::min(image.height - 1, y + half); ++row) {
    for (int column = std::max(1, x - half); column <= std::min(image.width - 2, x + half); ++column) {
      if (!mask.empty() && !(mask(column - 1, row) && mask(column + 1, row))) continue;
      const double slope = (image(column + 1, row) - image(column - 1, row)) / 2;
      slopes += slope * slope;
      ++count;
    }
  }
  return count > 0 ? std::sqrt(slopes / count) : 0;
}

WindowStatus JudgeFit(const WindowMatch& match, const StereoMatchOptions& options) {
  const int area = options.window.size * options.window.size;
  if (3 * match.pixels < area) return WindowStatus::kOutside;
  if (!match.converged) return WindowStatus::kNotConverged;
  if (!(match.correlation >= options.min_correlation)) return WindowStatus::kLowCorrelation;
  if (!(match.sigma <= options.max_sigma)) return WindowStatus::kUncertain;
  return WindowStatus::kAccepted;
}

bool Straddles(const Image& start, const Mask& mask, const WindowModel& model, const MatchedWindow& window,
               double limit) {
  const int half = model.size / 2;
  int count = 0, departing = 0, leaning = 0;
  for (int eta = -half; eta <= half; ++eta) {
    for (int xi = -half; xi <= half; ++xi) {
      const int column = window.x + xi, row = window.y + eta;
      if (!start.Contains(column, row) || std::isnan(start(column, row))) continue;
      if (!mask.empty() && !mask(column, row)) continue;
      ++count;
      const double departure =
          std::abs(start(column, row) - ExtrapolatedWarp(model.warp, window.match.warp, xi, eta)[0]);
      if (departure > limit) ++departing;
      if (departure > limit / 2) ++leaning;
    }
  }
  return departing > kMostDeparting * count || leaning > kMostLeaning * count;
}

double BackMatchDistance(const MatchedWindow& window, WarpKind kind, const MatchWindow& back) {
  const LocalShift there(kind, window.match.warp);
  const Eigen::Vector2d centre(window.x, window.y), counterpart = centre - there.at_centre;
  const Eigen::Vector2d pixel = counterpart.array().round();
  // An offset from the counterpart in the right image is this one from the centre in the left.
  const Eigen::Matrix2d unwarp = (Eigen::Matrix2d::Identity() - there.slopes).inverse();
  if (!unwarp.allFinite()) return std::numeric_limits<double>::infinity();
  const Eigen::Matrix2d slopes = Eigen::Matrix2d::Identity() - unwarp;
  const Eigen::Vector2d offset = unwarp * (pixel - counterpart);
  const Eigen::Vector2d shift = pixel - (centre + offset);  // x_right − x_left at the pixel
  WarpValues start{shift[0], slopes(0, 0), slopes(0, 1)};
  if (kind == WarpKind::kShift) start = {shift[0]};
  if (kind == WarpKind::kAffine) {
    start = {shift[0], slopes(0, 0), slopes(0, 1), shift[1], slopes(1, 0), slopes(1, 1)};
  }
  const WindowMatch match = back(static_cast<int>(pixel[0]), static_cast<int>(pixel[1]), start);
  if (!match.converged) return std::numeric_limits<double>::infinity();
  const LocalShift again(kind, match.warp);
  // Where the counterpart itself, a part of a pixel from the pixel, is sent.
  const Eigen::Vector2d off = counterpart - pixel;
  return (counterpart - (again.at_centre + again.slopes * off) - centre).norm();
}

}  // namespace frond
