// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/synthetic_pear.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "base/errors.h"
#include "base/random.h"
#include "models/mesh_topology.h"

namespace frond {
namespace {

constexpr double kPi = std::numbers::pi;

Eigen::Vector3d RandomDirection(Random& random) {
  return Eigen::Vector3d(random.Normal(), random.Normal(), random.Normal()).normalized();
}

Eigen::Vector3d RandomSurfacePoint(const SyntheticPear& pear, Random& random) {
  return pear.Position(random.Uniform(0.05, kPi - 0.05), random.Uniform(0, 2 * kPi));
}

TEST(SyntheticPear, Gradient_AndHessian_MatchDifferences) {
  const SyntheticPear pear(PearShape{});
  Random random(1);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector3d p = RandomSurfacePoint(pear, random) + 3 * RandomDirection(random);
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d step = 1e-4 * Eigen::Vector3d::Unit(k);
      EXPECT_NEAR(pear.Gradient(p)[k], (pear.Value(p + step) - pear.Value(p - step)) / 2e-4, 1e-6);
      EXPECT_LT((pear.Hessian(p).col(k) - (pear.Gradient(p + step) - pear.Gradient(p - step)) / 2e-4).norm(),
                1e-6);
    }
  }
}

TEST(SyntheticPear, CastRay_FromAllSides_FindsTheFirstPointOfThePolynomial) {
  const SyntheticPear pear(PearShape{});
  Random random(2);
  int hits = 0;
  for (int i = 0; i < 4000; ++i) {
    const Eigen::Vector3d origin = Eigen::Vector3d(0, 0, 50) + 300 * RandomDirection(random);
    const Eigen::Vector3d target(random.Uniform(-36, 36), random.Uniform(-36, 36), random.Uniform(-5, 105));
    const Eigen::Vector3d direction = target - origin;
    const auto t = pear.CastRay(origin, direction);
    // F is only the pear's between its ends.
    const auto inside = [&](double at) {
      const Eigen::Vector3d p = origin + at * direction;
      return p.z() > 0 && p.z() < 100 && p.head<2>().norm() < 40 && pear.Value(p) < 0;
    };
    constexpr int kSteps = 2000;
    for (int k = 0; k < kSteps; ++k) {
      const double at = 2.0 * k / kSteps;
      if (t && at >= *t) break;
      ASSERT_FALSE(inside(at)) << "ray " << i << " passes the pear at " << at;
    }
    if (!t) continue;
    ++hits;
    const Eigen::Vector3d p = origin + *t * direction;
    EXPECT_LT(std::abs(pear.Value(p)) / pear.Gradient(p).norm(), 1e-9);
    EXPECT_LT(pear.Normal(p).dot(direction), 0);
  }
  EXPECT_GT(hits, 1500);
}

TEST(SyntheticPear, CastRay_JustInsideTheSilhouette_Hits) {
  const SyntheticPear pear(PearShape{});
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d p = RandomSurfacePoint(pear, random), normal = pear.Normal(p);
    const Eigen::Vector3d tangent = normal.cross(RandomDirection(random)).normalized();
    const Eigen::Vector3d origin = p - 1e-6 * normal - 400 * tangent;
    // Where the surface curves away from the ray, it grazes; in the waist it passes through elsewhere anyway.
    const auto t = pear.CastRay(origin, tangent);
    ASSERT_TRUE(t.has_value()) << i;
    EXPECT_LE(*t, 400 + 1e-9);
  }
}

TEST(SyntheticPear, SignedDistance_OfAPointOnANormal_IsItsHeight) {
  const SyntheticPear pear(PearShape{});
  Random random(4);
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3d p = RandomSurfacePoint(pear, random);
    const double height = random.Uniform(-3, 8);
    EXPECT_NEAR(pear.SignedDistance(p + height * pear.Normal(p)), height, 1e-9) << i;
  }
}

TEST(SyntheticPear, Volume_IsThatOfThePolynomial) {
  // Without lobes a section is an ellipse of half-axes ρ/√(1 ± flattening): ∫ρ² is a sum of Beta functions.
  // Bending shifts sections sideways only.
  const PearShape shape{.height = 80, .bend = 0.1, .flattening = 0.1, .lobes = 0};
  constexpr double kProfile[5] = {0.58, 0.68, 0.60, -0.25, 0.40};
  constexpr double kBinomial[5] = {1, 4, 6, 4, 1};
  constexpr double kFactorial[6] = {1, 1, 2, 6, 24, 120};
  double integral = 0;
  for (int i = 0; i < 5; ++i) integral += kProfile[i] * kBinomial[i] * kFactorial[i + 1] * kFactorial[5 - i];
  const double exact = kPi * std::pow(80, 3) * integral / 5040 / std::sqrt(1 - 0.1 * 0.1);
  EXPECT_NEAR(SyntheticPear(shape).Volume(), exact, 1e-9 * exact);
}

TEST(SyntheticPear, Mesh_IsClosedAndTendsToTheExactMeasures) {
  const SyntheticPear pear(PearShape{});
  const SurfaceMesh mesh = pear.Mesh(300, 300);
  const MeshTopology topology = FindMeshTopology(mesh);
  EXPECT_TRUE(topology.closed && topology.manifold && topology.oriented);
  EXPECT_EQ(topology.genus, 0);
  EXPECT_NEAR(MeshArea(mesh), pear.Area(), 2e-4 * pear.Area());
  EXPECT_NEAR(MeshVolume(mesh), pear.Volume(), 2e-4 * pear.Volume());
  for (std::size_t i = 0; i < mesh.vertices.size(); i += 97) {
    EXPECT_LT(std::abs(pear.Value(mesh.vertices[i])), 1e-9);
  }
}

TEST(SyntheticPear, Shape_OutOfRange_IsRefusedByName) {
  try {
    SyntheticPear(PearShape{.lobes = 0.5});
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_NE(std::string(error.what()).find("'lobes'"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace frond
