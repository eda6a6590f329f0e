// SPDX-License-Identifier: BSD-3-Clause
#include "problems/skinning/skin_fit.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <set>

#include "base/errors.h"
#include "base/random.h"
#include "bent_tube.h"
#include "io/mesh_file.h"
#include "models/enclosed_volume.h"
#include "models/tessellation.h"
#include "self_intersection.h"

namespace frond {
namespace {

struct Ventricle {
  std::vector<Eigen::Vector3d> points, rim;
};

// The mesh's distinct vertices, and those on edges of one face only.
Ventricle ReadVentricle(const std::string& wall) {
  const std::filesystem::path path =
      std::filesystem::path(FROND_SHARED_DATA) / "closed" / ("lv_mean_ED_" + wall + ".off");
  if (!std::filesystem::exists(path)) return {};
  const SurfaceMesh mesh = ReadMesh(path);
  Ventricle ventricle;
  std::map<std::array<double, 3>, int> seen;
  std::vector<int> distinct;
  for (const auto& p : mesh.vertices) {
    const auto [place, added] = seen.emplace(std::array{p.x(), p.y(), p.z()}, static_cast<int>(seen.size()));
    if (added) ventricle.points.push_back(p);
    distinct.push_back(place->second);
  }
  std::map<std::pair<int, int>, int> faces;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = distinct[static_cast<std::size_t>(t[k])],
                b = distinct[static_cast<std::size_t>(t[(k + 1) % 3])];
      if (a != b) ++faces[{std::min(a, b), std::max(a, b)}];
    }
  }
  std::set<int> rim;
  for (const auto& [edge, count] : faces) {
    if (count == 1) rim.insert({edge.first, edge.second});
  }
  for (const int i : rim) ventricle.rim.push_back(ventricle.points[static_cast<std::size_t>(i)]);
  return ventricle;
}

SkinFitOptions VentricleOptions() {
  SkinFitOptions options;
  options.count = 24;
  options.axis = Eigen::Vector3d(1, 0, 0);
  options.skin.control_points = 8;
  return options;
}

class VentricleSkin : public ::testing::TestWithParam<const char*> {};

TEST_P(VentricleSkin, MeetsItsPointsAndItsRim) {
  const Ventricle ventricle = ReadVentricle(GetParam());
  if (ventricle.points.empty()) GTEST_SKIP() << "no shared data";
  ASSERT_EQ(ventricle.points.size(), 785U);
  ASSERT_EQ(ventricle.rim.size(), 28U);
  const SkinFit fit = FitSkin(ventricle.points, VentricleOptions(), {});
  EXPECT_EQ(fit.surface.u().num_distinct_control_points(), 20);
  EXPECT_EQ(fit.surface.count_v(), 8);
  EXPECT_LE(100 * fit.errors.relative_mean, 0.4);
  EXPECT_LT(fit.twist_max_degrees, 2);
  EXPECT_EQ(fit.quality.flipped_normals, 0);
  EXPECT_EQ(CountSelfIntersections(Tessellate({fit.surface, {}}, 4)), 0);
  double mean = 0, largest = 0;
  for (const auto& point : ventricle.rim) {
    double nearest = 1e9;
    for (int k = 0; k < 720; ++k)
      nearest = std::min(nearest, (fit.surface.Evaluate(k / 720.0, 0) - point).norm());
    mean += nearest / 28;
    largest = std::max(largest, nearest);
  }
  EXPECT_LT(mean, 0.15);  // of a radius of 25 and a spacing of 4
  EXPECT_LT(largest, 0.4);
}

TEST_P(VentricleSkin, PredictsAQuarterOfTheInnerPoints) {
  const Ventricle ventricle = ReadVentricle(GetParam());
  if (ventricle.points.empty()) GTEST_SKIP() << "no shared data";
  std::set<std::array<double, 3>> rim;
  for (const auto& p : ventricle.rim) rim.insert({p.x(), p.y(), p.z()});
  std::vector<Eigen::Vector3d> fitted, held, held_inside;
  Random random(1);
  for (const auto& p : ventricle.points) {
    if (random.Uniform() >= 0.25) {
      fitted.push_back(p);
      continue;
    }
    held.push_back(p);
    if (!rim.contains({p.x(), p.y(), p.z()})) held_inside.push_back(p);
  }
  const SkinFit fit = FitSkin(fitted, VentricleOptions(), {});
  const auto error = [&](const std::vector<Eigen::Vector3d>& points) {
    const TrimmedSurface surface{fit.surface, {}};
    return 100 * MeasureSurfaceErrors(points, {}, MeasureDistances(points, fit.surface, 1), surface,
                                      fit.quality.point_spacing, 1)
                     .relative_mean;
  };
  EXPECT_LE(error(held), 0.5);
  EXPECT_LE(error(held_inside), 0.33);  // a rim point that is held out lies beyond what is left
}

INSTANTIATE_TEST_SUITE_P(Walls, VentricleSkin, ::testing::Values("endo", "epi"),
                         [](const auto& info) { return std::string(info.param); });

TEST(SkinFit, BentTube_IsFollowedWithoutTwistOrSelfIntersection) {
  for (const double degrees : {90.0, 150.0, 220.0}) {
    const BentTube tube{.degrees = degrees};
    SkinFitOptions options;
    options.by = SectionsBy::kCentreLine;
    const SkinFit fit = FitSkin(tube.Scan(1), options, {});
    EXPECT_LT(fit.twist_max_degrees, 2) << degrees;
    EXPECT_EQ(CountSelfIntersections(Tessellate({fit.surface, {}}, 4)), 0) << degrees;
    EXPECT_LT(fit.quality.rmse, 0.02) << degrees;  // noise 0.005, radius 1
    EXPECT_EQ(fit.quality.flipped_normals, 0) << degrees;
    EXPECT_LT(fit.planes.front().normal.dot(fit.planes.back().normal), 0.5) << degrees;  // not parallel
  }
}

std::vector<Eigen::Vector3d> Ellipsoid(const Eigen::Vector3d& axes, int count) {
  Random random(3);
  std::vector<Eigen::Vector3d> points;
  for (int k = 0; k < count; ++k) {
    const Eigen::Vector3d direction(random.Normal(), random.Normal(), random.Normal());
    points.push_back(direction.normalized().cwiseProduct(axes));
  }
  return points;
}

TEST(SkinFit, Ellipsoid_ClosesAtBothPolesWithItsVolume) {
  const SkinFit fit = FitSkin(Ellipsoid({3, 2, 1.8}, 4000), {.count = 20}, {});
  EXPECT_NEAR(EnclosedVolume(fit.surface) / (4.0 / 3 * std::numbers::pi * 3 * 2 * 1.8), 1, 0.01);
  EXPECT_LT(fit.quality.rmse, 0.025);
  EXPECT_EQ(fit.quality.flipped_normals, 0);
  EXPECT_NEAR(std::abs(fit.surface.Evaluate(0, 0).x()), 3, 0.02);
}

TEST(SkinFit, MovedCloud_GivesTheMovedSurface) {
  const std::vector<Eigen::Vector3d> points = Ellipsoid({3, 2, 1.8}, 2000);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  std::vector<Eigen::Vector3d> moved;
  for (const auto& p : points) moved.push_back(turn * p + Eigen::Vector3d(10, -20, 5));
  const SkinFit a = FitSkin(points, {}, {}), b = FitSkin(moved, {}, {});
  EXPECT_NEAR(a.quality.rmse, b.quality.rmse, 1e-3 * a.quality.rmse);
}

TEST(SkinFit, ThreadCount_DoesNotChangeABit) {
  const std::vector<Eigen::Vector3d> points = Ellipsoid({3, 2, 1.8}, 2000);
  SkinFitOptions options;
  options.skin.control_points = 8;
  const SkinFit a = FitSkin(points, options, {.threads = 1}), b = FitSkin(points, options, {.threads = 3});
  EXPECT_EQ(a.surface.control_points(), b.surface.control_points());
}

// A tube of radius 1 along z, points on rings.
std::vector<Eigen::Vector3d> Cylinder() {
  std::vector<Eigen::Vector3d> points;
  for (int j = 0; j <= 60; ++j) {
    for (int i = 0; i < 60; ++i) {
      const double angle = 2 * std::numbers::pi * (i + 0.5 * (j % 2)) / 60;
      points.emplace_back(std::cos(angle), std::sin(angle), 0.1 * j);
    }
  }
  return points;
}

SkinFitOptions Planes(const std::vector<Eigen::Vector3d>& origins,
                      const std::vector<Eigen::Vector3d>& normals) {
  SkinFitOptions options;
  options.by = SectionsBy::kPlanes;
  for (std::size_t k = 0; k < origins.size(); ++k) {
    SectionPlane plane;
    plane.origin = origins[k];
    plane.normal = normals[k].normalized();
    options.planes.push_back(plane);
  }
  return options;
}

std::string Complaint(const std::vector<Eigen::Vector3d>& points, const SkinFitOptions& options) {
  try {
    FitSkin(points, options, {});
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(SkinFit, GivenPlanes_CutTheirSections) {
  const SkinFit fit = FitSkin(
      Cylinder(),
      Planes({{0, 0, 1}, {0, 0, 2}, {0, 0, 3}, {0, 0, 4}}, {{0, 0, 1}, {0, 0.2, -1}, {0.2, 0, 1}, {0, 0, 1}}),
      {});
  ASSERT_EQ(fit.sections.size(), 4U);
  EXPECT_GT(fit.planes[1].normal.z(), 0);  // turned over to the way along
  for (int k = 0; k < 50; ++k) {
    const Eigen::Vector3d p = fit.sections[2].Evaluate(k / 50.0);
    EXPECT_NEAR(p.head<2>().norm(), 1, 2e-3);
    EXPECT_NEAR(0.2 * p.x() + p.z(), 3, 1e-9);
  }
  EXPECT_LT(fit.twist_max_degrees, 0.5);
}

TEST(SkinFit, PlaneThatMissesTheCloud_IsNamed) {
  const auto up = Eigen::Vector3d::UnitZ();
  const std::string said =
      Complaint(Cylinder(), Planes({{0, 0, 1}, {0, 0, 2}, {0, 0, 3}, {0, 0, 40}}, {up, up, up, up}));
  EXPECT_NE(said.find("the plane of section 4 misses the cloud"), std::string::npos) << said;
}

TEST(SkinFit, SectionWithTooFewPoints_IsNamedWithTheirCount) {
  std::vector<Eigen::Vector3d> points = Cylinder();
  std::erase_if(points,
                [](const auto& p) { return p.z() > 1.55 && p.z() < 2.45 && (p.x() < 0.99 || p.z() > 2.05); });
  const auto up = Eigen::Vector3d::UnitZ();
  SkinFitOptions options = Planes({{0, 0, 1}, {0, 0, 2}, {0, 0, 3}, {0, 0, 4}}, {up, up, up, up});
  options.tolerance = 0.06;
  const std::string said = Complaint(points, options);
  EXPECT_NE(said.find("section 2 has "), std::string::npos) << said;
  EXPECT_NE(said.find("points within 0.06 of its plane; a curve of degree 3 needs 4"), std::string::npos)
      << said;
}

TEST(SkinFit, PlanesThatCrossInsideTheObject_AreNamed) {
  const auto up = Eigen::Vector3d::UnitZ();
  const std::string said = Complaint(Cylinder(), Planes({{0, 0, 1}, {0, 0, 2}, {0, 0, 2.3}, {0, 0, 4}},
                                                        {up, up, Eigen::Vector3d(0.6, 0, 1), up}));
  EXPECT_NE(said.find("sections 2 and 3 cross each other inside the object"), std::string::npos) << said;
}

TEST(SkinFit, PlanesThatShareTheirPoint_AreNamed) {
  const auto up = Eigen::Vector3d::UnitZ();
  for (const double last : {1.0, 4.0}) {
    const std::string said =
        Complaint(Cylinder(), Planes({{0, 0, 1}, {0, 0, 2}, {0, 0, last}, {0, 0, 1}}, {up, up, up, up}));
    EXPECT_NE(said.find(last == 1 ? "planes 1 and 3 " : "planes 1 and 4 "), std::string::npos) << said;
  }
}

TEST(SkinFit, TooFewSections_AreCounted) {
  const auto up = Eigen::Vector3d::UnitZ();
  const std::string said = Complaint(Cylinder(), Planes({{0, 0, 1}, {0, 0, 2}, {0, 0, 3}}, {up, up, up}));
  EXPECT_EQ(said, "degree 3 along v needs at least 4 sections, not 3");
}

TEST(TwistDegrees, TurnedSection_IsMeasured) {
  const auto ring = [](double turned) {
    std::vector<Eigen::Vector3d> points;
    std::vector<double> parameters;
    for (int k = 0; k < 60; ++k) {
      const double u = k / 60.0, angle = 2 * std::numbers::pi * u + turned;
      points.emplace_back(2 * std::cos(angle), std::sin(angle), 0);
      parameters.push_back(u);
    }
    return FitSectionCurve(points, parameters, 3, 20);
  };
  EXPECT_NEAR(TwistDegrees(ring(0), {}, ring(0), {}), 0, 1e-9);
  EXPECT_NEAR(TwistDegrees(ring(0), {}, ring(0.05), {}), 0.05 * 180 / std::numbers::pi, 0.1);
}

}  // namespace
}  // namespace frond
