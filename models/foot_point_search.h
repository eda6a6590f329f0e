// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include "models/kd_tree.h"
#include "models/surface_cells.h"

namespace frond {

// The nearest point of a surface to a given one. Where a coordinate is held at an end of the domain because
// the distance would fall further outside, its flag is set: the foot lies on an edge (or, with both, in a
// corner) of the domain.
struct FootPoint {
  double u = 0, v = 0;
  double squared_distance = 0;
  bool at_edge_u = false, at_edge_v = false;
  bool converged = false;
};

struct FootPointOptions {
  int max_iterations = 20;
  // Newton stops after a step of at most this length (the data's unit); the error left is of its square.
  double step_tolerance = 0;
};

// Safeguarded Newton in the box of the domain from (u, v): Newton's matrix where it is positive definite,
// Gauss–Newton's otherwise; a coordinate at a bound that pulls outwards is held; steps that do not lower the
// distance are halved. Periodic directions wrap; steps lead over poles (PoleEnds), which are no edges. About
// three evaluations from a near start.
FootPoint RefineFootPoint(const SurfaceCells& cells, const Eigen::Vector3d& point, double u, double v,
                          const FootPointOptions& options);

// Global search: the nearest of a grid of surface samples (a k-d tree) give the starts, RefineFootPoint the
// foot, and the least distance wins. The grid and the tree are made once; searches are re-entrant.
class FootPointSearch {
 public:
  static constexpr int kThorough = 8;  // seeds for results; one leaves a few stuck feet (MATH.md §1)

  // About `samples` samples, about equally far apart in both directions, the same number in every knot span.
  explicit FootPointSearch(const SurfaceCells& cells, int samples = 16000);

  // The nearest sample is the first start. With `seeds` above 1 (to 8) the samples that a better foot could
  // lie beside, those within that foot's distance and a sample spacing, are tried too, as far as they are not
  // grid neighbours of a start or foot before: a surface may come near a point in several places.
  FootPoint Find(const Eigen::Vector3d& point, int seeds = 1) const;

  // The better of Find and the foot refined from a given start.
  FootPoint FindFrom(const Eigen::Vector3d& point, double u, double v, int seeds = 1) const;

  const FootPointOptions& options() const { return options_; }

 private:
  const SurfaceCells* cells_;
  std::vector<Eigen::Vector3d> samples_;
  std::vector<Eigen::Vector2d> parameters_;
  double step_u_, step_v_;  // in parameters
  double sample_spacing_;   // largest distance of neighbours along a grid line
  FootPointOptions options_;
  std::unique_ptr<KdTree> tree_;
};

}  // namespace frond
