// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/thin_plate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "models/knot_vector.h"
#include "problems/surface/linear_start.h"
#include "tests/models/closed_surfaces.h"
#include "tests/problems/surface/wavy_sheet.h"

namespace frond {
namespace {

// Σ over cells and coordinates of Pᵀ G P.
double Energy(const NurbsSurface& surface, PoleEnds poles = {}, double membrane = 0) {
  const SurfaceCells cells(surface);
  const std::vector<Eigen::MatrixXd> grams = ThinPlateGram(cells, poles, membrane);
  const int p = surface.u().degree(), q = surface.v().degree();
  double energy = 0;
  for (int ku = 0; ku < cells.u().count(); ++ku) {
    for (int kv = 0; kv < cells.v().count(); ++kv) {
      Eigen::MatrixXd local((p + 1) * (q + 1), 3);
      for (int k = 0; k < local.rows(); ++k) {
        local.row(k) =
            surface.control_point(cells.u().first(ku) + k / (q + 1), cells.v().first(kv) + k % (q + 1))
                .transpose();
      }
      const Eigen::MatrixXd& gram = grams[static_cast<std::size_t>(ku * cells.v().count() + kv)];
      energy += (gram * local).cwiseProduct(local).sum();
    }
  }
  return energy;
}

// What the square of S_uu counts at the angle from the pole that v stands for; of S_uv its root.
double WeightAt(double v, PoleEnds poles) {
  if (!poles.any()) return 1;
  const double angle = poles.begin && poles.end ? M_PI * v : M_PI / 2 * (poles.begin ? v : 1 - v);
  return std::pow(std::max(0.08, std::sin(angle)), -2);
}

// The same by 8 Gauss points a cell and direction, from the surface's own derivatives.
double EnergyByQuadrature(const NurbsSurface& surface, PoleEnds poles = {}, double membrane = 0) {
  constexpr double kNode[] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
  constexpr double kWeight[] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                0.1012285362903763};
  const SurfaceCells cells(surface);
  const double du = surface.u().end() - surface.u().begin(), dv = surface.v().end() - surface.v().begin();
  double energy = 0;
  for (int ku = 0; ku < cells.u().count(); ++ku) {
    for (int kv = 0; kv < cells.v().count(); ++kv) {
      const double along_u =
          WeightAt((cells.v().begin(kv) + cells.v().length(kv) / 2 - surface.v().begin()) / dv, poles);
      for (int g = 0; g < 64; ++g) {
        const int i = g / 8, j = g % 8;
        const double s = (1 + (i % 2 == 0 ? 1 : -1) * kNode[i / 2]) / 2;
        const double t = (1 + (j % 2 == 0 ? 1 : -1) * kNode[j / 2]) / 2;
        const double weight =
            kWeight[i / 2] * kWeight[j / 2] / 4 * cells.u().length(ku) * cells.v().length(kv) / (du * dv);
        const SurfacePoint at = surface.EvaluateWithDerivatives(
            cells.u().begin(ku) + s * cells.u().length(ku), cells.v().begin(kv) + t * cells.v().length(kv));
        energy += weight * (along_u * (at.duu * du * du).squaredNorm() +
                            2 * std::sqrt(along_u) * (at.duv * du * dv).squaredNorm() +
                            (at.dvv * dv * dv).squaredNorm() +
                            membrane * ((at.du * du).squaredNorm() + (at.dv * dv).squaredNorm()));
      }
    }
  }
  return energy;
}

TEST(ThinPlate, RandomSurfaces_MatchQuadratureOfTheirSecondDerivatives) {
  for (const auto& [p, q] : std::vector<std::pair<int, int>>{{3, 3}, {2, 4}, {1, 3}, {5, 2}, {1, 1}}) {
    const NurbsSurface surface =
        MakeSurface({.degree_u = p, .degree_v = q, .count_u = p + 3, .count_v = q + 4, .uneven_knots = true});
    const double expected = EnergyByQuadrature(surface);
    EXPECT_NEAR(Energy(surface), expected, 1e-10 * expected) << p << " x " << q;
  }
}

TEST(ThinPlate, SurfacesWithPoles_WeighWhatRunsRoundThem) {
  for (const PoleEnds poles : {PoleEnds{true, false}, PoleEnds{false, true}, PoleEnds{true, true}}) {
    const NurbsSurface egg = Egg(poles);
    const double expected = EnergyByQuadrature(egg, poles);
    EXPECT_NEAR(Energy(egg, poles), expected, 1e-10 * expected);
    EXPECT_GT(expected, 1.1 * Energy(egg));
  }
}

TEST(ThinPlate, Membrane_AddsTheFirstDerivatives) {
  const NurbsSurface sheet = MakeSurface({.uneven_knots = true});
  const double expected = EnergyByQuadrature(sheet, {}, 30);
  EXPECT_NEAR(Energy(sheet, {}, 30), expected, 1e-10 * expected);
  EXPECT_GT(expected, 1.1 * Energy(sheet));
}

TEST(ThinPlate, PolynomialSurface_HasItsKnownEnergy) {
  // With s, t in [0, 1]: x = s² t, y = s t, z = t³: E = ∫∫ 4t² + 2·4s² + 2·1 + 36t² = 4/3 + 8/3 + 2 + 12.
  const auto position = [](double s, double t) { return Eigen::Vector3d(s * s * t, s * t, t * t * t); };
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector2d> parameters;
  for (int i = 0; i <= 40; ++i) {
    for (int j = 0; j <= 40; ++j) {
      points.push_back(position(i / 40.0, j / 40.0));
      parameters.emplace_back(0.5 + 1.5 * i / 40.0, -1 + 1.7 * j / 40.0);
    }
  }
  const NurbsSurface surface =
      FitAtParameters(points, parameters, UnevenBasis(3, 7, 0.5, 2), UnevenBasis(3, 6, -1, 0.7), 0);
  EXPECT_NEAR(Energy(surface), 18, 1e-8);
}

TEST(ThinPlate, Plane_HasNoEnergy) {
  const BSplineBasis u = UnevenBasis(3, 8, 0.5, 2), v = UnevenBasis(2, 6, -1, 0.7);
  const auto greville = [](const BSplineBasis& basis, int i) {
    const auto first = basis.knots().begin() + i + 1;
    return std::accumulate(first, first + basis.degree(), 0.0) / basis.degree();
  };
  std::vector<Eigen::Vector3d> control_points;
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < 6; ++j) {
      const double s = greville(u, i), t = greville(v, j);
      control_points.emplace_back(3 * s + t - 7, 2 * t, 5 * s - 4 * t + 1);
    }
  }
  EXPECT_NEAR(Energy(NurbsSurface(u, v, control_points)), 0, 1e-9);
}

}  // namespace
}  // namespace frond
