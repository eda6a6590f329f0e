// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "problems/surface/surface_fit.h"

namespace frond {

// The staged distance fit of one net to points in a sheet's frame and in spatial order (MATH.md §1): a subset
// first, fairness falling, then all points. Options, scan, solver, budget and context must outlive it.
class SurfaceFitStages {
 public:
  SurfaceFitStages(const SurfaceFitOptions& options, std::array<int, 2> net, const ScanResolution& scan,
                   const Solver& solver, const Budget& budget, const SolveContext& context);

  MarginMode margin() const { return margin_; }
  // Of any points, in the surface's domain: those that a fit at fixed parameters used last, or a distance fit
  // started from.
  std::vector<Eigen::Vector2d> Parameters(std::span<const Eigen::Vector3d> points) const;
  const SolverReport& report() const { return report_; }                    // of all stages together
  const DistanceFitOptions& last_options() const { return last_options_; }  // of the last solve

  // `remove_outliers` is told the distances of all points before the last stage; it takes the outliers out of
  // `points` itself and says whether there were any. A stage without budget leaves the surface as it is.
  NurbsSurface Fit(const std::vector<Eigen::Vector3d>* points, const std::optional<NurbsSurface>& start,
                   const std::function<bool(const PointDistances&)>& remove_outliers);

 private:
  using Points = std::vector<Eigen::Vector3d>;

  NurbsSurface FitDistances(const std::vector<Eigen::Vector3d>* points,
                            const std::optional<NurbsSurface>& start,
                            const std::function<bool(const PointDistances&)>& remove_outliers);
  NurbsSurface FitParametric(const std::vector<Eigen::Vector3d>* points,
                             const std::function<bool(const PointDistances&)>& remove_outliers);
  std::optional<NurbsSurface> FitExactly(const Points& points, const std::optional<NurbsSurface>& start);
  double Fairness(std::size_t points) const;
  void Prepare(const Points& points, const std::optional<NurbsSurface>& start);
  std::vector<Eigen::Vector2d> CloudParameters(std::span<const Eigen::Vector3d> points) const;
  std::vector<NurbsSurface> Starts(const Points& points, const std::optional<NurbsSurface>& start) const;
  BSplineBasis Basis(std::size_t direction) const;
  void PrepareRims(const Points& points);
  DistanceFitOptions StageOptions(const Points& points, const NurbsSurface& start, double fairness) const;
  NurbsSurface RunStage(const Points& points, const NurbsSurface& start, const NurbsSurface& reference,
                        const DistanceFitOptions& options, std::vector<Eigen::Vector2d> feet,
                        std::size_t last_points);

  const SurfaceFitOptions& options_;
  std::array<int, 2> net_;
  const ScanResolution& scan_;
  MarginMode margin_;
  const Solver& solver_;
  const Budget& budget_;
  const SolveContext& context_;
  double length_scale_ = 1;
  std::vector<Ring> rings_;                // the cloud's boundary
  std::array<Eigen::Vector3d, 2> extent_;  // opposite corners of the points' bounding box
  std::optional<NurbsSurface> base_;       // whose feet give the parameters; none: the cloud's own
  std::vector<std::vector<int>> tied_;
  DistanceFitOptions last_options_;
  SolverReport report_;
};

}  // namespace frond
