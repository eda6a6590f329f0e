// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/parametric_fit.h"

#include "models/surface_cells.h"
#include "problems/surface/linear_start.h"
#include "problems/surface/ma_fit.h"
#include "problems/surface/sheet_start.h"

namespace frond {
namespace {

double SquaredSum(std::span<const Eigen::Vector3d> points, const std::vector<Eigen::Vector2d>& parameters,
                  const NurbsSurface& surface) {
  const SurfaceCells cells(surface);
  const BSplineBasis &u = surface.u(), &v = surface.v();
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d position = cells.Evaluate(u.begin() + parameters[i][0] * (u.end() - u.begin()),
                                                    v.begin() + parameters[i][1] * (v.end() - v.begin()));
    sum += (points[i] - position).squaredNorm();
  }
  return sum;
}

}  // namespace

ParametricFit FitAtFixedParameters(std::span<const Eigen::Vector3d> points,
                                   std::vector<Eigen::Vector2d> parameters, const BSplineBasis& u,
                                   const BSplineBasis& v, const ParametricFitOptions& options, int threads) {
  constexpr double kLeastGain = 0.01;
  const auto fit_at = [&](const std::vector<Eigen::Vector2d>& at) {
    return options.free_weights ? FitRationalAtParameters(points, at, u, v, options.fairness)
                                : FitAtParameters(points, at, u, v, options.fairness, options.poles);
  };
  NurbsSurface first = fit_at(parameters);
  ParametricFit best{.surface = first, .base = first, .parameters = std::move(parameters)};
  best.squared_sum = SquaredSum(points, best.parameters, best.surface);
  best.history = {best.squared_sum};
  for (int repetition = 0; repetition < options.repetitions; ++repetition) {
    ParametricFit next{.surface = best.surface, .base = best.surface};
    next.parameters = FootParameters(points, best.surface, threads);
    next.surface = fit_at(next.parameters);
    next.squared_sum = SquaredSum(points, next.parameters, next.surface);
    next.history = best.history;
    next.history.push_back(next.squared_sum);
    const double before = best.squared_sum;
    if (next.squared_sum < before) {
      best = std::move(next);
    } else {
      best.history = std::move(next.history);
    }
    if (!(best.squared_sum < (1 - kLeastGain) * before)) break;
  }
  return best;
}

}  // namespace frond
