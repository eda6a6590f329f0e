// SPDX-License-Identifier: BSD-3-Clause
#include "problems/skinning/skin.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/errors.h"
#include "models/nurbs_operations.h"

namespace frond {
namespace {

// A wavy ring at height z, periodic, of `distinct` control points.
NurbsCurve Ring(double z, double radius, int distinct = 8, int degree = 3, bool rational = false) {
  const BSplineBasis basis = PeriodicUniformBasis(degree, distinct);
  std::vector<Eigen::Vector3d> points;
  std::vector<double> weights;
  for (int i = 0; i < basis.num_control_points(); ++i) {
    const double angle = 2 * std::numbers::pi * (i % distinct) / distinct;
    const double r = radius * (1 + 0.1 * std::cos(2 * angle + z));
    points.emplace_back(r * std::cos(angle), r * std::sin(angle), z + 0.1 * std::sin(angle) * z);
    weights.push_back(rational ? 1 + 0.3 * std::cos(angle + z) : 1);
  }
  return NurbsCurve(basis, points, weights);
}

double LargestGap(const Skin& skin, const std::vector<NurbsCurve>& sections) {
  double gap = 0;
  for (std::size_t l = 0; l < sections.size(); ++l) {
    const BSplineBasis& basis = sections[l].basis();
    for (int k = 0; k <= 50; ++k) {
      const double u = k / 50.0;
      const double t = basis.begin() + u * (basis.end() - basis.begin());
      gap = std::max(gap, (skin.surface.Evaluate(u, skin.v[l]) - sections[l].Evaluate(t)).norm());
    }
  }
  return gap;
}

TEST(Skin, AllControlPoints_InterpolateEverySection) {
  std::vector<NurbsCurve> sections;
  for (int l = 0; l < 7; ++l) sections.push_back(Ring(0.7 * l, 1 + 0.2 * std::sin(l)));
  const Skin skin = SkinCurves(sections, {});
  EXPECT_EQ(skin.surface.count_v(), 7);
  EXPECT_TRUE(skin.surface.u().periodic());
  EXPECT_LT(LargestGap(skin, sections), 1e-10);
}

TEST(Skin, RationalSections_AreInterpolatedByEqs32And33) {
  std::vector<NurbsCurve> sections;
  for (int l = 0; l < 6; ++l) sections.push_back(Ring(0.7 * l, 1, 8, 3, true));
  const Skin skin = SkinCurves(sections, {});
  EXPECT_TRUE(skin.surface.IsRational());
  EXPECT_LT(LargestGap(skin, sections), 1e-10);
}

TEST(Skin, SectionsOfDifferentDegreeAndKnots_AreInterpolated) {
  const std::vector<NurbsCurve> sections = {Ring(0, 1, 8, 3), Ring(1, 1.1, 9, 2), Ring(2, 1.2, 12, 3),
                                            InsertKnots(Ring(3, 1.2), std::vector<double>{0.3, 0.3, 0.71})};
  const Skin skin = SkinCurves(sections, {});
  EXPECT_EQ(skin.surface.u().degree(), 3);
  EXPECT_LT(LargestGap(skin, sections), 1e-10);
}

TEST(Skin, OpenSections_AreInterpolated) {
  std::vector<NurbsCurve> sections;
  for (int l = 0; l < 5; ++l) sections.push_back(Part(Ring(l, 1), 0.1, 0.6 + 0.05 * l));
  const Skin skin = SkinCurves(sections, {.degree = 2});
  EXPECT_FALSE(skin.surface.u().periodic());
  EXPECT_LT(LargestGap(skin, sections), 1e-10);
}

TEST(Skin, Poles_KeepTheSectionsAndHaveOneTangentPlane) {
  std::vector<NurbsCurve> sections;  // of a sphere
  for (int l = 1; l < 12; ++l) {
    const double polar = std::numbers::pi * l / 12;
    const BSplineBasis basis = PeriodicUniformBasis(3, 16);
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < basis.num_control_points(); ++i) {
      const double angle = 2 * std::numbers::pi * i / 16;
      points.emplace_back(std::sin(polar) * std::cos(angle), std::sin(polar) * std::sin(angle),
                          -std::cos(polar));
    }
    sections.emplace_back(basis, points);
  }
  for (const int rows : {0, 9}) {
    const Skin skin = SkinCurves(sections, {.control_points = rows,
                                            .first_pole = Eigen::Vector3d(0, 0, -1),
                                            .last_pole = Eigen::Vector3d(0, 0, 1)});
    if (rows == 0) {
      EXPECT_LT(LargestGap(skin, sections), 1e-10);
    } else {
      EXPECT_EQ(skin.surface.count_v(), rows);
    }
    for (int k = 0; k < 20; ++k) {
      const double u = k / 20.0;
      EXPECT_LT((skin.surface.Evaluate(u, 0) - Eigen::Vector3d(0, 0, -1)).norm(), 1e-14);
      EXPECT_LT(std::abs(skin.surface.EvaluateWithDerivatives(u, 0).dv.normalized().z()), 1e-9);
      for (int j = 0; j <= 40; ++j) {  // cubic sections of a circle are .3 % off
        EXPECT_NEAR(skin.surface.Evaluate(u, j / 40.0).norm(), 1, rows == 0 ? 0.03 : 0.04) << j;
      }
    }
  }
}

TEST(Skin, FewerControlPoints_KeepFirstAndLastSection) {
  std::vector<NurbsCurve> sections;
  for (int l = 0; l < 12; ++l) sections.push_back(Ring(0.3 * l, 1 + 0.2 * std::sin(0.3 * l)));
  const Skin skin = SkinCurves(sections, {.control_points = 6});
  EXPECT_EQ(skin.surface.count_v(), 6);
  EXPECT_LT(LargestGap({skin.surface, {0, 1}}, {sections.front(), sections.back()}), 1e-12);
  EXPECT_LT(LargestGap(skin, sections), 0.02);
}

TEST(Skin, CountsThatCannotWork_AreRefused) {
  const std::vector<NurbsCurve> three = {Ring(0, 1), Ring(1, 1), Ring(2, 1)};
  EXPECT_THROW(SkinCurves(three, {}), InputError);
  EXPECT_THROW(SkinCurves(three, {.degree = 2, .control_points = 4}), InputError);
  EXPECT_THROW(SkinCurves(std::vector<NurbsCurve>{Ring(0, 1), Ring(1, 1), Ring(1, 1), Ring(2, 1)}, {}),
               InputError);
  const auto poles = [](int degree, int control_points, bool last) {
    return SkinOptions{.degree = degree,
                       .control_points = control_points,
                       .first_pole = Eigen::Vector3d(0, 0, -1),
                       .last_pole = last ? std::optional(Eigen::Vector3d(0, 0, 3)) : std::nullopt};
  };
  EXPECT_THROW(SkinCurves(three, poles(1, 0, false)), InputError);
  EXPECT_THROW(SkinCurves(three, poles(1, 2, true)), InputError);
  EXPECT_THROW(SkinCurves(three, poles(2, 2, true)), InputError);
  EXPECT_THROW(SkinCurves(three, poles(2, 3, true)), InputError);
}

// All control points belong to the ends: nothing is left to solve for.
TEST(Skin, WithoutFreeRows_KeepsItsEnds) {
  const std::vector<NurbsCurve> two = {Ring(0, 1), Ring(2, 1)}, three = {Ring(0, 1), Ring(1, 2), Ring(2, 1)};
  for (const Skin& ruled :
       {SkinCurves(two, {.degree = 1}), SkinCurves(three, {.degree = 1, .control_points = 2})}) {
    EXPECT_LT(LargestGap({ruled.surface, {0, 1}}, two), 1e-12);
    const Eigen::Vector3d middle = (ruled.surface.Evaluate(0.3, 0) + ruled.surface.Evaluate(0.3, 1)) / 2;
    EXPECT_NEAR((ruled.surface.Evaluate(0.3, 0.5) - middle).norm(), 0, 1e-12);
  }
  const Eigen::Vector3d bottom(0, 0, -1), top(0, 0, 3);
  const NurbsSurface pair =
      SkinCurves(three, {.degree = 3, .control_points = 4, .first_pole = bottom, .last_pole = top}).surface;
  EXPECT_NEAR((pair.Evaluate(0.3, 0) - bottom).norm(), 0, 1e-12);
  EXPECT_NEAR((pair.Evaluate(0.3, 1) - top).norm(), 0, 1e-12);
  EXPECT_GT(pair.Evaluate(0.3, 0.5).head<2>().norm(), 0.5);
  const NurbsSurface cup =
      SkinCurves(three, {.degree = 2, .control_points = 3, .first_pole = bottom}).surface;
  EXPECT_NEAR((cup.Evaluate(0.3, 1) - three[2].Evaluate(0.3)).norm(), 0, 1e-12);
}

}  // namespace
}  // namespace frond
