// SPDX-License-Identifier: BSD-3-Clause
#include "problems/stereo/dense_disparity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "base/parallel.h"

namespace frond {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
constexpr std::size_t kMostPlanes = 24;
constexpr std::size_t kEnoughPlanes = 4;
constexpr double kOneSided = 0.7;  // of the mean direction to the windows: beyond it they lie on one side
constexpr double kInFront = 1;     // pixels of disparity: what is nearer hides what is behind
constexpr double kAgreement = 1;   // pixels, where the options ask for no check of edges

// A window's plane at a pixel.
struct PlaneHere {
  double u = 0, v = 0;
  double sigma = 0;
  double weight = 0;
  double dx = 0, dy = 0;  // to the window's centre
};

struct PixelDisparity {
  double u = 0, v = 0, sigma = 0;
};

class DensePixels {
 public:
  DensePixels(const DenseInput& input, std::span<const MatchedWindow> windows)
      : in_(input),
        windows_(windows),
        step_(input.options.step),
        half_(input.options.window.size / 2),
        limit_(input.options.discontinuity > 0 ? input.options.discontinuity : kAgreement) {}

  std::optional<PixelDisparity> At(int x, int y) const {
    std::array<PlaneHere, kMostPlanes> planes;
    const std::size_t count = Gather(x, y, planes);
    if (count == 0) return std::nullopt;
    const float start = in_.starts.u(x, y);
    const PlaneHere* side = &planes[0];
    for (std::size_t k = 1; k < count; ++k) {
      const bool better = std::isnan(start) ? Distance(planes[k]) < Distance(*side)
                                            : std::abs(planes[k].u - start) < std::abs(side->u - start);
      if (better) side = &planes[k];
    }
    // The start is of a whole window too, and of whole pixels: it tells edges, no less.
    if (!std::isnan(start) && std::abs(side->u - start) > limit_) return std::nullopt;
    return Mean(planes, count, *side, !std::isnan(start));
  }

 private:
  static double Distance(const PlaneHere& plane) { return std::hypot(plane.dx, plane.dy); }

  // Of the accepted windows ring by ring round the pixel, until there are enough; the last ring is completed.
  std::size_t Gather(int x, int y, std::array<PlaneHere, kMostPlanes>& planes) const {
    const int column = (x + step_ / 2) / step_, row = (y + step_ / 2) / step_;
    const int rings = std::max(1, (2 * half_ + step_ - 1) / step_);
    std::size_t count = 0;
    for (int ring = 0; ring <= rings && (ring <= 1 || count < kEnoughPlanes); ++ring) {
      for (int j = -ring; j <= ring; ++j) {
        const int across = std::abs(j) == ring ? 1 : std::max(1, 2 * ring);
        for (int i = -ring; i <= ring && count < kMostPlanes; i += across) {
          if (!in_.grid.Contains(column + i, row + j)) continue;
          const int index = in_.grid(column + i, row + j);
          if (index < 0) continue;
          const MatchedWindow& window = windows_[static_cast<std::size_t>(index)];
          if (window.status == WindowStatus::kAccepted) planes[count++] = Here(window, x, y);
        }
      }
    }
    return count;
  }

  PlaneHere Here(const MatchedWindow& window, int x, int y) const {
    const double dx = x - window.x, dy = y - window.y;
    const WarpValues warp = ExtrapolatedWarp(in_.options.window.warp, window.match.warp, dx, dy);
    const double distance2 = dx * dx + dy * dy, size = in_.options.window.size;
    PlaneHere plane{.u = warp[0], .v = in_.options.rectified ? 0 : warp[3], .dx = dx, .dy = dy};
    // A plane's slopes over size × size pixels have the variance 12 σ² / size².
    plane.sigma = window.match.sigma * std::sqrt(1 + 12 * distance2 / (size * size));
    const double near = std::exp(-distance2 / (2.0 * step_ * step_));
    plane.weight = std::max(near, 1e-6) / std::max(plane.sigma * plane.sigma, 1e-6);
    return plane;
  }

  std::optional<PixelDisparity> Mean(const std::array<PlaneHere, kMostPlanes>& planes, std::size_t count,
                                     const PlaneHere& side, bool has_start) const {
    PixelDisparity mean;
    double weights = 0, nearest = std::numeric_limits<double>::infinity(), east = 0, south = 0, spread = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const PlaneHere& plane = planes[k];
      if (std::hypot(plane.u - side.u, plane.v - side.v) > limit_) continue;
      const double distance = Distance(plane);
      nearest = std::min(nearest, std::max(std::abs(plane.dx), std::abs(plane.dy)));
      weights += plane.weight;
      mean.u += plane.weight * plane.u;
      mean.v += plane.weight * plane.v;
      mean.sigma += plane.weight * plane.sigma;  // windows overlap: their errors do not average out
      spread += plane.weight * plane.u * plane.u;
      if (distance > 0) {
        east += plane.weight * plane.dx / distance;
        south += plane.weight * plane.dy / distance;
      }
    }
    mean.u /= weights;
    mean.v /= weights;
    const double variance = std::max(0.0, spread / weights - mean.u * mean.u);
    mean.sigma = std::sqrt(std::pow(mean.sigma / weights, 2) + variance);
    if (nearest > half_ && !has_start && std::hypot(east, south) > kOneSided * weights) return std::nullopt;
    return mean;
  }

  const DenseInput& in_;
  std::span<const MatchedWindow> windows_;
  int step_, half_;
  double limit_;
};

// Whether the counterpart is on the right image and its object.
bool IsSeenOnTheRight(const Mask& mask, const Image& left, double x, double y) {
  const int column = static_cast<int>(std::lround(x)), row = static_cast<int>(std::lround(y));
  return left.Contains(column, row) && (mask.empty() || mask(column, row));
}

// Takes away interpolated pixels of a row whose place in the right image is that of a nearer one.
void ClearHidden(StereoMatches& matches, int y) {
  const int width = matches.disparity.width;
  std::vector<float> nearest(static_cast<std::size_t>(width), -std::numeric_limits<float>::infinity());
  const auto place = [&](int x) {
    return static_cast<std::size_t>(
        std::clamp(std::lround(static_cast<float>(x) - matches.disparity(x, y)), 0L, width - 1L));
  };
  for (int x = 0; x < width; ++x) {
    if (std::isnan(matches.disparity(x, y))) continue;
    float& there = nearest[place(x)];
    there = std::max(there, matches.disparity(x, y));
  }
  for (int x = 0; x < width; ++x) {
    if (!matches.interpolated(x, y)) continue;
    if (static_cast<double>(nearest[place(x)] - matches.disparity(x, y)) <= kInFront) continue;
    matches.disparity(x, y) = matches.sigma(x, y) = kNone;
    matches.interpolated(x, y) = 0;
  }
}

void SetAccepted(const StereoMatchOptions& options, StereoMatches& matches) {
  for (const MatchedWindow& window : matches.windows) {
    if (window.status != WindowStatus::kAccepted) continue;
    matches.disparity(window.x, window.y) = static_cast<float>(window.match.warp[0]);
    matches.sigma(window.x, window.y) = static_cast<float>(window.match.sigma);
    if (!options.rectified)
      matches.displacement_y(window.x, window.y) = static_cast<float>(window.match.warp[3]);
  }
}

}  // namespace

void FillDisparities(const DenseInput& input, int threads, StereoMatches& matches) {
  const int width = input.left.width, height = input.left.height;
  matches.disparity = matches.sigma = Image(width, height, kNone);
  if (!input.options.rectified) matches.displacement_y = Image(width, height, kNone);
  matches.interpolated = Mask(width, height);
  SetAccepted(input.options, matches);
  if (!input.options.interpolate) return;
  const DensePixels pixels(input, matches.windows);
  ParallelFor(static_cast<std::size_t>(height), 8, threads, [&](std::size_t begin, std::size_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      for (int x = 0; x < width; ++x) {
        if (!input.left_mask.empty() && !input.left_mask(x, y)) continue;
        if (!std::isnan(matches.disparity(x, y))) continue;
        const std::optional<PixelDisparity> pixel = pixels.At(x, y);
        if (!pixel || !IsSeenOnTheRight(input.right_mask, input.left, x - pixel->u, y - pixel->v)) continue;
        matches.disparity(x, y) = static_cast<float>(pixel->u);
        matches.sigma(x, y) = static_cast<float>(pixel->sigma);
        if (!input.options.rectified) matches.displacement_y(x, y) = static_cast<float>(pixel->v);
        matches.interpolated(x, y) = 1;
      }
      if (input.options.rectified) ClearHidden(matches, y);
    }
  });
}

}  // namespace frond
