// SPDX-License-Identifier: BSD-3-Clause
#include "problems/leaf/leaf_metrics.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/parallel.h"
#include "models/foot_point_search.h"

namespace frond {

LeafError ErrorOf(std::span<const double> squared_distances, const LeafObjective& objective) {
  double sum = 0, largest = 0;
  for (const double d : squared_distances) {
    sum += d;
    largest = std::max(largest, d);
  }
  LeafError error;
  if (squared_distances.empty()) return error;
  error.rmse = std::sqrt(sum / static_cast<double>(squared_distances.size()));
  error.max = std::sqrt(largest);
  error.objective = objective.rmse_share * error.rmse + objective.max_share * error.max;
  return error;
}

LeafError MeasureLeaf(const NurbsSurface& surface, std::span<const Eigen::Vector3d> points,
                      const LeafObjective& objective, int threads) {
  const SurfaceCells cells(surface);
  const FootPointSearch search(cells);
  std::vector<double> squared(points.size());
  ParallelFor(points.size(), 1024, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      squared[i] = search.Find(points[i], FootPointSearch::kThorough).squared_distance;
  });
  return ErrorOf(squared, objective);
}

}  // namespace frond
