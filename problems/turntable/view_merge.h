// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "problems/turntable/scan_point.h"

namespace frond {

struct MergeOptions {
  std::optional<double> spacing = {};  // of the merged points; default: that of the views' own points
  double reach = 2.5;                  // radius of a neighbourhood, in spacings
  double normal_agreement = 0.5;       // least cosine between the normals of one surface
  double outlier_sigmas = 4;           // a neighbour farther off the local surface than this is left out
  std::size_t least_neighbours = 6;
};

struct MergedPoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();
  double sigma = 0;  // standard deviation along the normal
  std::array<std::uint8_t, 3> colour{128, 128, 128};
  int views = 1;  // that it was made of
};

struct MergedCloud {
  std::vector<MergedPoint> points;
  double spacing = 0;
  std::size_t points_in = 0;      // of all views
  std::size_t isolated = 0;       // places with too few neighbours
  std::size_t contradicted = 0;   // places of one view alone that several others saw elsewhere
  double thickness = 0;           // RMS of the views' points about the merged surface, along its normals
  double relative_thickness = 0;  // the same in standard deviations of the points: about 1 where these hold

  std::vector<Eigen::Vector3d> Positions() const;
};

// One surface of all views. At a point in each cube of a grid of `spacing` a quadratic is fitted to the
// neighbours of all views whose normals agree (moving least squares, Levin 1998), with the weights
// cos²/σ² · a bell of the distance, those far off left out (Tukey's weights); the point moves onto it along
// the normal. Points that end nearer to each other than 0.6 spacings are thinned out. σ: all the neighbours
// of one view count as one measurement (their windows overlap), views as independent ones, widened by the
// scatter between the views where that is larger. Order of the result: by the grid; the same for any number
// of threads. Linear in the points. Throws InputError where all views are empty.
MergedCloud MergeViews(const std::vector<std::vector<ScanPoint>>& views, const MergeOptions& options,
                       int threads);

}  // namespace frond
