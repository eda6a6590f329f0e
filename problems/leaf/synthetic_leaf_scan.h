// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "problems/leaf/synthetic_leaf.h"

namespace frond {

enum class NoiseDirection { kIsotropic, kNormal };

// A scanner and what goes wrong with it. Lengths in mm, whatever the unit of the result.
struct LeafScanOptions {
  std::uint64_t seed = 0;  // of points, noise, outliers and holes
  int points = 40000;      // in the scan, outliers and petiole included
  double noise = 0.05;     // standard deviation: of each coordinate, or along the normal
  NoiseDirection noise_direction = NoiseDirection::kIsotropic;
  double outlier_share = 0;                   // of the points, thrown off the surface …
  double outlier_near = 2, outlier_far = 20;  // … by a distance between these, in any direction
  int holes = 0;                              // round gaps without points
  double hole_radius = 3;
  double missing_tip = 0;     // share of the length at the tip that was not scanned
  double petiole_length = 0;  // left on the leaf; half a tube of petiole_width (of the shape)
  bool random_pose = false;   // any rotation, and a shift of up to `pose_shift` in each coordinate
  std::uint64_t pose_seed = 0;
  double pose_shift = 300;
  double unit_mm = 1;         // the result's unit in mm: 1 mm, 10 cm, 1000 m
  int dense_points = 100000;  // of the clean sample
};

enum class ScanPointKind : std::uint8_t { kBlade, kPetiole, kOutlier };

// A scan with its truth; positions in the pose and unit asked for.
struct LeafScan {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3d> clean_points;  // the surface's point that points[i] was measured (thrown) from
  std::vector<ScanPointKind> kinds;           // of points[i]
  // Uniform by area over the whole blade inside its outline, holes and missing tip included, without noise
  // and independent of `points`; scanned[i] is 0 where that place lies in a hole or the missing tip.
  std::vector<Eigen::Vector3d> dense_clean;
  std::vector<std::uint8_t> dense_scanned;
  LeafMeasures measures;                 // of the whole blade, in the scan's unit
  double scanned_area = 0;               // of the blade without holes and missing tip (from the sample)
  Eigen::Isometry3d pose;                // leaf coordinates (mm) to scan, before the unit: x = pose(p) / unit
  std::map<std::string, double> values;  // shape, options and measures by name, for truth.json
};

// Throws ConfigError on an option out of its range. The same shape and options give the same bytes.
LeafScan ScanLeaf(const LeafShape& shape, const LeafScanOptions& options);

}  // namespace frond
