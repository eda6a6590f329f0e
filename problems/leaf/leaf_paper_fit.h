// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/stage_clock.h"
#include "models/nurbs_surface.h"
#include "problems/leaf/leaf_frame.h"
#include "problems/leaf/leaf_metrics.h"
#include "problems/leaf/leaf_surface.h"
#include "problems/leaf/leaf_weights.h"
#include "problems/leaf/point_set.h"
#include "solvers/solver.h"

namespace frond {

// The whole of Wu et al. 2021: frame → slices → point set → B-spline surface → weights. Lengths in the
// cloud's unit.
struct LeafPaperOptions {
  LeafFrameOptions frame;
  PointSetOptions point_set;
  TestSubsetOptions test_subset;
  LeafSurfaceOptions surface;
  bool free_weights = false;  // then a solver is needed
  LeafWeightsOptions weights;
};

struct LeafPaperFit {
  NurbsSurface surface;  // in the cloud's coordinates; u across from left to right, v base to tip
  LeafFrame frame;
  PointSetKind point_set_kind = PointSetKind::kUnordered;  // what was used after a fall-back
  double midrib_offset = 0;
  // The subset that the errors are of, in the cloud's coordinates.
  std::vector<Eigen::Vector3d> test_points = {};
  LeafError unweighted = {};                // of the B-spline surface, before weights
  LeafError error = {};                     // of `surface`
  std::optional<SolverReport> report = {};  // where the weights were free
  std::vector<std::string> warnings = {};
  std::vector<StageTime> stages = {};  // frame, point_set, surface, weights, metrics
};

// `solver` may be null unless free_weights. Throws ConfigError and InputError as the steps do,
// std::invalid_argument for the missing solver, and FitError where the solver fails.
LeafPaperFit FitLeafAsInPaper(std::span<const Eigen::Vector3d> points, const LeafPaperOptions& options,
                              const Solver* solver = nullptr, const Budget& budget = {},
                              const SolveContext& context = {});

// The surface moved from frame to input coordinates: control points by frame.ToInput.
NurbsSurface ToInput(const NurbsSurface& surface, const LeafFrame& frame);

}  // namespace frond
