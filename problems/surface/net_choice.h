// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "problems/surface/sheet_fit.h"

namespace frond {

struct NetChoice {
  std::array<int, 2> net;
  SolverReport report;  // what all trials took together
};

// The smallest of the nets 5, 7, 10, 14, 20 and 28 square within 2 % of the least RMS distance of held-out
// points (every fifth, in spatial order; MATH.md §1, "Automatic net"). Nets that the points cannot hold three
// times over are not tried, nor any after the budget is used up.
NetChoice ChooseNet(const std::vector<Eigen::Vector3d>& points, const std::optional<NurbsSurface>& start,
                    const SheetFitOptions& options, const ScanResolution& scan, const Solver& solver,
                    const Budget& budget, const SolveContext& context);

}  // namespace frond
