// SPDX-License-Identifier: BSD-3-Clause
#include "problems/leaf/leaf_surface.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/errors.h"

namespace frond {
namespace {

constexpr Parametrisation kAll[] = {Parametrisation::kUniform, Parametrisation::kChord,
                                    Parametrisation::kCentripetal};

// 7 rows of 9 points on f(s, t), s across in [−1, 1] from left, t along in [0, 1]; a base edge and a tip
// point.
template <typename F>
PointSet SetOn(const F& f, bool with_tip = true) {
  PointSet set;
  set.kind = PointSetKind::kOrdered;
  for (int j = 0; j < 7; ++j) {
    std::vector<Eigen::Vector3d> row;
    const double t = j / 6.0, half = with_tip ? 0.2 + 4 * t * (1 - t) - 0.2 * t : 1;
    for (int i = 0; i < 9; ++i) row.push_back(f(half * (1 - i / 4.0), t));
    set.rows.push_back(row);
  }
  return set;
}

TEST(FitRow, OfPointsOnAParabola_IsThatParabola) {
  std::vector<Eigen::Vector3d> points;
  std::vector<double> parameters;
  for (int i = 0; i <= 20; ++i) {
    const double t = std::pow(i / 20.0, 1.3);
    parameters.push_back(t);
    points.emplace_back(t, 3 * t * t - t, 1 - t);
  }
  const BSplineBasis basis = ApproximationBasis(2, 6, parameters);
  const std::vector<Eigen::Vector3d> control = FitRow(points, parameters, basis);
  ASSERT_EQ(control.size(), 6u);
  for (double t = 0; t <= 1; t += 0.05) {
    const int span = basis.FindSpan(t);
    double values[3];
    basis.Evaluate(span, t, 0, values);
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    for (int a = 0; a < 3; ++a) p += values[a] * control[static_cast<std::size_t>(span - 2 + a)];
    EXPECT_LT((p - Eigen::Vector3d(t, 3 * t * t - t, 1 - t)).norm(), 1e-12);
  }
}

TEST(FitRow, WithTooFewPoints_IsRefused) {
  const std::vector<Eigen::Vector3d> points = {{0, 0, 0}, {1, 0, 0}, {2, 1, 0}};
  const std::vector<double> parameters = {0, 0.5, 1};
  EXPECT_THROW(FitRow(points, parameters, UniformBasis(2, 5)), InputError);
}

TEST(LeafSurface, OfAPlane_IsThePlaneForEveryAlgorithm) {
  const PointSet set = SetOn([](double s, double t) { return Eigen::Vector3d(10 * t, 3 * s, t + s); });
  for (const auto algorithm : {LeafSurfaceAlgorithm::kAlgorithm1, LeafSurfaceAlgorithm::kApproximation,
                               LeafSurfaceAlgorithm::kInterpolation}) {
    for (const Parametrisation parametrisation : kAll) {
      const NurbsSurface s =
          FitLeafSurface(set, {.algorithm = algorithm, .parametrisation = parametrisation});
      EXPECT_FALSE(s.IsRational());
      for (double u = 0; u <= 1; u += 0.125) {
        for (double v = 0; v <= 1; v += 0.125) {
          const Eigen::Vector3d p = s.Evaluate(u, v);
          EXPECT_NEAR(p.z(), p.x() / 10 + p.y() / 3, 1e-12);
        }
      }
      EXPECT_LT((s.Evaluate(0, 0) - set.rows[0].front()).norm(), 1e-12) << "u = 0 is the left margin";
      EXPECT_LT((s.Evaluate(1, 0) - set.rows[0].back()).norm(), 1e-12);
      for (double u = 0; u <= 1; u += 0.25) EXPECT_LT((s.Evaluate(u, 1) - set.rows[6][0]).norm(), 1e-12);
    }
  }
}

TEST(LeafSurface, Interpolation_PassesThroughAllPoints) {
  const auto dome = [](double s, double t) {
    return Eigen::Vector3d(10 * t, 3 * s, std::cos(1.5 * s) + std::sin(2 * t));
  };
  const PointSet set = SetOn(dome);
  const NurbsSurface s = FitLeafSurface(
      set, {.algorithm = LeafSurfaceAlgorithm::kInterpolation, .parametrisation = Parametrisation::kUniform});
  EXPECT_EQ(s.count_u(), 9);
  EXPECT_EQ(s.count_v(), 7);
  for (std::size_t j = 0; j < 7; ++j) {
    for (std::size_t i = 0; i < 9; ++i) {
      const Eigen::Vector3d p = s.Evaluate(static_cast<double>(i) / 8, static_cast<double>(j) / 6);
      EXPECT_LT((p - set.rows[j][i]).norm(), 1e-11) << i << ", " << j;
    }
  }
}

TEST(LeafSurface, WhereAllRowsAreAlike_Algorithm1IsAlgorithmA1) {
  // A cylinder over a strip: all rows have the same parameters, so have the columns.
  const PointSet set =
      SetOn([](double s, double t) { return Eigen::Vector3d(10 * t, 3 * s, std::cos(1.5 * s)); }, false);
  for (const Parametrisation parametrisation : kAll) {
    const NurbsSurface one = FitLeafSurface(set, {.parametrisation = parametrisation});
    const NurbsSurface a1 = FitLeafSurface(
        set, {.algorithm = LeafSurfaceAlgorithm::kApproximation, .parametrisation = parametrisation});
    for (std::size_t k = 0; k < one.control_points().size(); ++k) {
      EXPECT_LT((one.control_points()[k] - a1.control_points()[k]).norm(), 1e-11);
    }
  }
}

TEST(LeafSurface, UnorderedRows_NeedAlgorithm1) {
  PointSet set = SetOn([](double s, double t) { return Eigen::Vector3d(t, s, 0); });
  set.kind = PointSetKind::kUnordered;
  set.rows[3].insert(set.rows[3].begin() + 4, 0.5 * (set.rows[3][3] + set.rows[3][4]));
  EXPECT_NO_THROW(FitLeafSurface(set, {}));
  EXPECT_THROW(FitLeafSurface(set, {.algorithm = LeafSurfaceAlgorithm::kApproximation}), ConfigError);
}

TEST(LeafSurface, CountsThatDoNotFitTheSet_AreRefused) {
  const PointSet set = SetOn([](double s, double t) { return Eigen::Vector3d(t, s, 0); });
  EXPECT_THROW(FitLeafSurface(set, {.count_v = 8}), ConfigError);
  EXPECT_THROW(FitLeafSurface(set, {.count_u = 10}), ConfigError);
  EXPECT_THROW(FitLeafSurface(set, {.degree_u = 5}), ConfigError);
  EXPECT_NO_THROW(FitLeafSurface(set, {.count_u = 9, .count_v = 7}));
}

}  // namespace
}  // namespace frond
