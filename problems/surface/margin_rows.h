// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "models/surface_cells.h"

namespace frond {

// Pulls a surface's edges and a cloud's boundary onto each other (MATH.md §1, "Conforming" and "Tubes with an
// open rim"). Closed directions and poles have no edge.
struct MarginOptions {
  std::vector<std::vector<Eigen::Vector3d>> rings;  // closed polygons through the cloud's boundary points
  double weight = 0.1;                              // of each direction, against the N points together
  int samples_per_edge = 60;
  // How often a point counts whose foot lies on an edge: the margin's teeth, where the largest distances are.
  double outside_weight = 60;
  // Where the middle of the edge at v's end should lie (a leaf's tip, which few points tell of), and the
  // share of `weight` for it.
  std::optional<Eigen::Vector3d> tip = {};
  double tip_share = 0.05;
};

// One row group: the surface at fixed (u, v) should lie at `target`, as far as `matrix` (Σ d dᵀ over the
// rows' unit directions d) tells.
struct MarginRow {
  double u, v, weight;
  Eigen::Vector3d target;
  Eigen::Matrix3d matrix;
};

// The rows at the present surface: ring points to the nearest point of the edges, square to the edge;
// edge samples to the nearest segment of the ring, square to the segment, each weighted by the length it
// stands for. `num_points` is N.
std::vector<MarginRow> MakeMarginRows(const SurfaceCells& cells, const MarginOptions& options,
                                      std::size_t num_points);

}  // namespace frond
