// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "models/foot_point_search.h"
#include "models/nurbs_surface.h"
#include "problems/leaf/leaf_metrics.h"
#include "solvers/fit_problem.h"

namespace frond {

// How F(X) projects its points.
enum class WeightProjection {
  kTracked,  // safeguarded Newton from the point's foot on the start surface; global where weights differ
  kPaper,    // eqs (7), (8) and appendix A as printed: lands on wrong feet of bent leaves, and is slower
};

struct LeafWeightsOptions {
  LeafObjective objective;         // α₁, α₂
  double lower = 0.1, upper = 10;  // bounds of every weight; 0 < lower ≤ 1 ≤ upper
  WeightProjection projection = WeightProjection::kTracked;
  bool sum_of_squares = false;  // the objective is ½ Σ d² in place of F: what least-squares solvers minimise
};

// The weights X of a fitted B-spline surface as the unknowns, its control points and knots held (Wu et al.
// 2021, eq. (11)): minimise F(X) = α₁·RMSE + α₂·MV of the orthogonal distances of some points. One parameter
// block, "weights", count_u × count_v values, u-major; solvers that draw their starts draw them in
// [0.9, 1.1], beyond which a small swarm makes F worse (MATH.md §2).
//
// F is no sum of squares. Least-squares solvers get Σ d² of the same points instead: by the envelope theorem
// (MATH.md §1) the rows of a point are differentiated at its fixed foot (LeafWeightResidual), and the feet
// are brought up to date before each evaluation. The common scale of the weights changes nothing; the bounds
// and the trust region hold it.
class LeafWeightsFit final : public FitProblem {
 public:
  // Throws ConfigError on options out of range and InputError where there are no points.
  LeafWeightsFit(NurbsSurface surface, std::vector<Eigen::Vector3d> points,
                 const LeafWeightsOptions& options);

  const std::vector<ParameterBlock>& parameters() const override { return parameters_; }
  std::shared_ptr<ceres::EvaluationCallback> CreateState(const std::vector<double*>& blocks,
                                                         int threads) const override;
  void AddResiduals(const std::vector<double*>& blocks, ceres::EvaluationCallback* state,
                    ceres::Problem* problem) const override;
  // F(x); +∞ where a weight is not positive. About 20 µs for 90 points and 5×5 weights near 1. Re-entrant.
  double Objective(std::span<const double> x) const override;
  bool ObjectiveIsLeastSquares() const override { return options_.sum_of_squares; }
  // rmse, max and objective by a finer global search.
  std::map<std::string, double> Metrics(std::span<const double> x) const override;

  NurbsSurface SurfaceAt(std::span<const double> x) const;
  const NurbsSurface& surface() const { return surface_; }
  const std::vector<Eigen::Vector3d>& points() const { return points_; }

  // The feet of all points on the surface with weights x: from those on the start where the weights are near
  // each other (within 40 %); from the nearest of 14 × 22 samples, where that is nearer, up to a ratio of 3;
  // by a thorough global search beyond (for 90 points 23 µs, 50 µs and 1 ms).
  void FindFeet(std::span<const double> x, SurfaceCells* cells, std::vector<FootPoint>* feet,
                int threads) const;
  const SurfaceCells& start_cells() const { return start_cells_; }

 private:
  NurbsSurface surface_;
  std::vector<Eigen::Vector3d> points_;
  LeafWeightsOptions options_;
  std::vector<ParameterBlock> parameters_;
  SurfaceCells start_cells_;
  FootPointOptions foot_options_;
  std::vector<FootPoint> start_feet_;
};

// One point's rows at a fixed foot (u, v):
//
//   residual = R (S(u, v; w) − Q),   S = Σ_k N_k w_k P_k / Σ_k N_k w_k over the active control points k,
//
// with R (3×3) the unit normal and two zero rows for a foot inside the domain; two directions ⟂ the edge's
// tangent and a zero row for one on an edge; the identity for one in a corner or where the normal vanishes.
// Parameter block: all weights (count_u × count_v).
struct LeafWeightResidual {
  Eigen::Vector3d point;
  Eigen::Matrix3d rows;
  std::vector<int> active;               // control points with N_k ≠ 0
  std::vector<double> values;            // N_k(u, v)
  std::vector<Eigen::Vector3d> control;  // P_k

  template <typename T>
  void Evaluate(const T* weights, T* residual) const {
    Eigen::Matrix<T, 3, 1> sum = Eigen::Matrix<T, 3, 1>::Zero();
    T denominator(0.0);
    for (std::size_t a = 0; a < active.size(); ++a) {
      const T nw = weights[active[a]] * values[a];
      denominator += nw;
      sum += control[a].template cast<T>() * nw;
    }
    Eigen::Map<Eigen::Matrix<T, 3, 1>> out(residual);
    out = rows.template cast<T>() * (sum / denominator - point.template cast<T>());
  }
};

}  // namespace frond
