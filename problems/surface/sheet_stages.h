// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "problems/surface/sheet_fit.h"

namespace frond {

// The staged distance fit of one net to points in a sheet's frame and in spatial order (MATH.md §1): a subset
// first, fairness falling, then all points. Options, scan, solver, budget and context must outlive it.
class SheetStages {
 public:
  SheetStages(const SheetFitOptions& options, std::array<int, 2> net, const ScanResolution& scan,
              const Solver& solver, const Budget& budget, const SolveContext& context);

  MarginMode margin() const { return margin_; }
  const SolverReport& report() const { return report_; }  // of all stages together

  // `remove_outliers` is told the distances of all points before the last stage; it takes the outliers out of
  // `points` itself and says whether there were any. A stage without budget leaves the surface as it is.
  NurbsSurface Fit(const std::vector<Eigen::Vector3d>* points, const std::optional<NurbsSurface>& start,
                   const std::function<bool(const PointDistances&)>& remove_outliers);

 private:
  using Points = std::vector<Eigen::Vector3d>;

  double Fairness(std::size_t points) const;
  void Prepare(const Points& points);
  std::vector<NurbsSurface> Starts(const Points& points, const std::optional<NurbsSurface>& start) const;
  BSplineBasis Basis(std::size_t direction) const;
  DistanceFitOptions StageOptions(const Points& points, const NurbsSurface& start, double fairness) const;
  NurbsSurface RunStage(const Points& points, const NurbsSurface& start, const NurbsSurface& reference,
                        double fairness, std::vector<Eigen::Vector2d> feet, std::size_t last_points);

  const SheetFitOptions& options_;
  std::array<int, 2> net_;
  const ScanResolution& scan_;
  MarginMode margin_;
  const Solver& solver_;
  const Budget& budget_;
  const SolveContext& context_;
  double length_scale_ = 1;
  Points ring_;
  std::vector<std::vector<int>> tied_;
  SolverReport report_;
};

}  // namespace frond
