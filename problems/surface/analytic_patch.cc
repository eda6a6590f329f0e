// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/analytic_patch.h"

#include <cmath>
#include <numbers>

#include "base/errors.h"
#include "base/random.h"

namespace frond {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

OptionSpec Length(const std::string& name, double value, const std::string& help) {
  return {.name = name,
          .type = OptionType::kNumber,
          .default_value = value,
          .help = help,
          .minimum = 1e-9,
          .maximum = 1e9};
}

OptionSpec Angle(const std::string& name, double value, double most, const std::string& help) {
  return {.name = name,
          .type = OptionType::kNumber,
          .default_value = value,
          .help = help + ", degrees",
          .minimum = 1,
          .maximum = most};
}

}  // namespace

const std::vector<std::string>& AnalyticShapeNames() {
  static const std::vector<std::string> names = {"cylinder", "cone", "sphere", "torus"};
  return names;
}

Eigen::Vector3d AnalyticPatch::Position(double u, double v) const {
  const double turn = (u - 0.5) * angle * kDegree, tilt = (v - 0.5) * profile_angle * kDegree;
  double r = radius, z = v * height;
  if (shape == AnalyticShape::kCone) r = radius + v * (top_radius - radius);
  if (shape == AnalyticShape::kSphere) {
    r = radius * std::cos(tilt);
    z = radius * std::sin(tilt);
  }
  if (shape == AnalyticShape::kTorus) {
    r = radius + tube_radius * std::cos(tilt);
    z = tube_radius * std::sin(tilt);
  }
  return {r * std::cos(turn), r * std::sin(turn), z};
}

double AnalyticPatch::Distance(const Eigen::Vector3d& point) const {
  const double r = point.head<2>().norm(), z = point.z();
  switch (shape) {
    case AnalyticShape::kCylinder:
      return std::abs(r - radius);
    case AnalyticShape::kCone:
      return std::abs((r - radius) * height - (top_radius - radius) * z) /
             std::hypot(height, top_radius - radius);
    case AnalyticShape::kSphere:
      return std::abs(point.norm() - radius);
    case AnalyticShape::kTorus:
      break;
  }
  return std::abs(std::hypot(r - radius, z) - tube_radius);
}

AnalyticScan ScanAnalyticPatch(const AnalyticPatch& patch, const AnalyticScanOptions& options) {
  Random places = Random::ForKey(options.seed, "points"), noise = Random::ForKey(options.seed, "noise"),
         pose = Random::ForKey(options.seed, "pose");
  AnalyticScan scan;
  if (options.random_pose) {
    const Eigen::Vector4d q(pose.Normal(), pose.Normal(), pose.Normal(), pose.Normal());
    scan.pose.linear() = Eigen::Quaterniond(q.normalized()).toRotationMatrix();
    for (Eigen::Index c = 0; c < 3; ++c) scan.pose.translation()[c] = patch.radius * pose.Uniform(-5, 5);
  }
  for (int i = 0; i < options.points; ++i) {
    const double u = i < 4 ? i % 2 : places.Uniform(), v = i < 4 ? i / 2 : places.Uniform();
    scan.clean_points.push_back(scan.pose * patch.Position(u, v));
    Eigen::Vector3d moved = scan.clean_points.back();
    for (Eigen::Index c = 0; c < 3; ++c) moved[c] += options.noise * noise.Normal();
    scan.points.push_back(moved);
  }
  return scan;
}

std::vector<OptionSpec> AnalyticPatchSpecs(AnalyticShape shape) {
  const AnalyticPatch patch;
  std::vector<OptionSpec> specs = {{.name = "points",
                                    .type = OptionType::kInteger,
                                    .default_value = std::int64_t{AnalyticScanOptions{}.points},
                                    .help = "Points in the scan",
                                    .minimum = 100,
                                    .maximum = 1e8},
                                   {.name = "noise",
                                    .type = OptionType::kNumber,
                                    .default_value = AnalyticScanOptions{}.noise,
                                    .help = "Standard deviation of each coordinate, in the unit",
                                    .minimum = 0,
                                    .maximum = 1e9},
                                   {.name = "random_pose",
                                    .type = OptionType::kFlag,
                                    .default_value = true,
                                    .help = "Turned and moved at random; else the axis is z"},
                                   Angle("angle", patch.angle, 170, "Opening about the axis")};
  specs.push_back(Length("radius", patch.radius,
                         shape == AnalyticShape::kTorus  ? "Of the ring"
                         : shape == AnalyticShape::kCone ? "At the wide end"
                                                         : "Radius"));
  if (shape == AnalyticShape::kCone)
    specs.push_back(Length("top_radius", patch.top_radius, "At the other end"));
  if (shape == AnalyticShape::kTorus)
    specs.push_back(Length("tube_radius", patch.tube_radius, "Of the tube"));
  if (shape == AnalyticShape::kCylinder || shape == AnalyticShape::kCone) {
    specs.push_back(Length("height", patch.height, "Along the axis"));
  } else {
    specs.push_back(Angle("profile_angle", patch.profile_angle, 170, "Opening of the profile"));
  }
  return specs;
}

AnalyticPatch AnalyticPatchFrom(AnalyticShape shape, const Options& options) {
  AnalyticPatch patch;
  patch.shape = shape;
  patch.angle = options.Number("angle");
  patch.radius = options.Number("radius");
  if (shape == AnalyticShape::kCone) patch.top_radius = options.Number("top_radius");
  if (shape == AnalyticShape::kTorus) patch.tube_radius = options.Number("tube_radius");
  if (shape == AnalyticShape::kCylinder || shape == AnalyticShape::kCone) {
    patch.height = options.Number("height");
  } else {
    patch.profile_angle = options.Number("profile_angle");
  }
  if (shape == AnalyticShape::kTorus && patch.tube_radius >= patch.radius) {
    throw ConfigError("option 'tube_radius' must be less than 'radius'");
  }
  return patch;
}

AnalyticScanOptions AnalyticScanOptionsFrom(const Options& options, std::uint64_t seed) {
  return {.points = static_cast<int>(options.Integer("points")),
          .noise = options.Number("noise"),
          .random_pose = options.Flag("random_pose"),
          .seed = seed};
}

}  // namespace frond
