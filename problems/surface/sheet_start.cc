// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/sheet_start.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "models/foot_point_search.h"

namespace frond {

std::vector<Eigen::Vector2d> RectangleParameters(std::span<const Eigen::Vector3d> points,
                                                 std::span<const Eigen::Vector3d> extent, double margin) {
  Eigen::AlignedBox3d box;
  for (const auto& point : extent) box.extend(point);
  const Eigen::Vector3d scale = (1 - 2 * margin) * box.sizes().cwiseInverse();
  std::vector<Eigen::Vector2d> parameters;
  parameters.reserve(points.size());
  for (const auto& point : points) {
    const Eigen::Vector3d local = (point - box.min()).cwiseProduct(scale);
    parameters.emplace_back(std::clamp(margin + local.y(), 0.0, 1.0),
                            std::clamp(margin + local.x(), 0.0, 1.0));
  }
  return parameters;
}

std::vector<Eigen::Vector2d> OutlineParameters(std::span<const Eigen::Vector3d> points,
                                               const std::vector<Eigen::Vector3d>& ring) {
  constexpr int kLines = 200;
  Eigen::AlignedBox3d box;
  for (const auto& point : ring) box.extend(point);
  const double step = box.sizes().x() / kLines;
  // Lowest and highest y of the outline on lines of constant x, at the middle of each of kLines strips.
  std::vector<double> low(kLines, std::numeric_limits<double>::infinity()), high(kLines, -low[0]);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector3d &a = ring[i], &b = ring[(i + 1) % ring.size()];
    const double from = (std::min(a.x(), b.x()) - box.min().x()) / step - 0.5;
    const double to = (std::max(a.x(), b.x()) - box.min().x()) / step - 0.5;
    for (int k = std::max(0, static_cast<int>(std::ceil(from))); k <= std::min<double>(kLines - 1, to); ++k) {
      const double x = box.min().x() + (k + 0.5) * step;
      const double y = a.x() == b.x() ? a.y() : a.y() + (b.y() - a.y()) * (x - a.x()) / (b.x() - a.x());
      low[static_cast<std::size_t>(k)] = std::min(low[static_cast<std::size_t>(k)], y);
      high[static_cast<std::size_t>(k)] = std::max(high[static_cast<std::size_t>(k)], y);
    }
  }
  std::vector<Eigen::Vector2d> parameters;
  parameters.reserve(points.size());
  for (const auto& point : points) {
    const double along = (point.x() - box.min().x()) / step - 0.5;
    const double line = std::clamp(along, 0.0, kLines - 1.001);
    const auto k = static_cast<std::size_t>(line);
    const double t = line - static_cast<double>(k);
    const double y0 = (1 - t) * low[k] + t * low[k + 1], y1 = (1 - t) * high[k] + t * high[k + 1];
    const double u = y1 > y0 ? std::clamp((point.y() - y0) / (y1 - y0), 0.0, 1.0) : 0.5;
    parameters.emplace_back(u, std::clamp((along + 0.5) / kLines, 0.0, 1.0));
  }
  return parameters;
}

std::vector<Eigen::Vector2d> FootParameters(std::span<const Eigen::Vector3d> points,
                                            const NurbsSurface& surface, int threads) {
  const SurfaceCells cells(surface);
  const FootPointSearch search(cells);
  const BSplineBasis &bu = surface.u(), &bv = surface.v();
  std::vector<Eigen::Vector2d> parameters(points.size());
  ParallelFor(points.size(), 1024, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const FootPoint foot = search.Find(points[i], FootPointSearch::kThorough);
      parameters[i] = {(foot.u - bu.begin()) / (bu.end() - bu.begin()),
                       (foot.v - bv.begin()) / (bv.end() - bv.begin())};
    }
  });
  return parameters;
}

}  // namespace frond
