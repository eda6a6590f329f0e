// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

#include "base/options.h"

namespace frond {

enum class AnalyticShape { kCylinder, kCone, kSphere, kTorus };
const std::vector<std::string>& AnalyticShapeNames();  // in the order of AnalyticShape

// An open patch of a surface of revolution about z, u the angle about it. Lengths in the unit of the result.
//   cylinder: `radius`, height `height`;  cone: a frustum, `radius` at z = 0, `top_radius` at z = `height`;
//   sphere: `radius`, latitudes within ± `profile_angle` / 2;
//   torus: `radius` of the ring, `tube_radius`, tube angles within ± `profile_angle` / 2 of the outer
//   equator.
// Each is a rational surface of degree 2 along u, and of degree 1 (cylinder, cone) or 2 along v.
struct AnalyticPatch {
  AnalyticShape shape = AnalyticShape::kCone;
  double radius = 30, top_radius = 15, tube_radius = 12, height = 40;
  double angle = 90, profile_angle = 80;  // degrees

  Eigen::Vector3d Position(double u, double v) const;   // u, v in [0, 1]
  double Distance(const Eigen::Vector3d& point) const;  // to the whole unbounded shape
};

struct AnalyticScanOptions {
  int points = 4000;  // uniform in (u, v)
  double noise = 0;   // standard deviation of each coordinate
  bool random_pose = true;
  std::uint64_t seed = 1;
};

struct AnalyticScan {
  std::vector<Eigen::Vector3d> points, clean_points;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  // patch to scan
};

// The four corners of the domain are among the points. The same options give the same bytes.
AnalyticScan ScanAnalyticPatch(const AnalyticPatch& patch, const AnalyticScanOptions& options);

// Options of `frond synth cylinder` and its kin, and their reading. Throws ConfigError where a torus's tube
// is as wide as its ring or wider.
std::vector<OptionSpec> AnalyticPatchSpecs(AnalyticShape shape);
AnalyticPatch AnalyticPatchFrom(AnalyticShape shape, const Options& options);
AnalyticScanOptions AnalyticScanOptionsFrom(const Options& options, std::uint64_t seed);

}  // namespace frond
