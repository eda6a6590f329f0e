// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "problems/surface/surface_fit.h"

namespace frond {

// One net fitted to four fifths of the points, in spatial order, and judged by every fifth.
struct NetTrial {
  double held_out_rmse = 0;
  SolverReport report;
};
NetTrial TryNet(const std::vector<Eigen::Vector3d>& points, const std::optional<NurbsSurface>& start,
                const SurfaceFitOptions& options, std::array<int, 2> net, const ScanResolution& scan,
                const Solver& solver, const Budget& budget, const SolveContext& context);

struct NetChoice {
  std::array<int, 2> net;
  SolverReport report;  // what all trials took together
};

// The smallest net within 1 % of the least RMS distance of held-out points (every fifth, in spatial order;
// MATH.md §1, "Automatic net", takes 2 %) of those tried. They grow from 5 × 5 by the steps 5, 7, 10, 14, 20,
// 28 along u or v, whichever lowers that distance more, by at least 1 % within two steps. Nets that the
// points cannot hold three times over are not tried, nor any after the budget is used up.
NetChoice ChooseNet(const std::vector<Eigen::Vector3d>& points, const std::optional<NurbsSurface>& start,
                    const SurfaceFitOptions& options, const ScanResolution& scan, const Solver& solver,
                    const Budget& budget, const SolveContext& context);

}  // namespace frond
