// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/evaluation_callback.h>

#include <Eigen/Core>
#include <span>
#include <vector>

#include "models/curve_foot_point.h"
#include "problems/curve/curve_distance_fit.h"
#include "solvers/compressed_rows.h"

namespace frond {

// What stays the same during a solve.
struct CurveDistanceFit::Shared {
  Shared(std::span<const Eigen::Vector3d> points, std::vector<double> parameters, const NurbsCurve& start,
         const CurveDistanceOptions& options);

  int block_size() const;
  int block_of(int control_point) const {
    return control_point % start.basis().num_distinct_control_points();
  }
  // Control points and weights (of all, the repeated ones too) at the blocks' values.
  void Read(const std::vector<double*>& blocks, std::vector<Eigen::Vector3d>* control_points,
            std::vector<double>* weights) const;

  std::span<const Eigen::Vector3d> points;
  std::vector<double> parameters;
  NurbsCurve start;
  CurveDistanceOptions options;
  CurveSpans spans;                        // of the start
  std::vector<Eigen::MatrixXd> gram;       // bending, a span
  std::vector<std::vector<int>> ridge_of;  // the control points (by place) whose ridge a span carries
  CurveFootOptions foot_options;
};

// The foot points, and from them one compressed block a knot span.
class CurveDistanceState : public ceres::EvaluationCallback {
 public:
  CurveDistanceState(const CurveDistanceFit::Shared& shared, std::vector<double*> blocks, int threads);

  // Feet are found anew at a new point, and regrouped and compressed when Jacobians are wanted. For the cost
  // alone no grouping is needed: the first span's block then carries the cost of all points.
  void PrepareForEvaluation(bool evaluate_jacobians, bool new_evaluation_point) override;

  const std::vector<CompressedBlock>& span_blocks() const { return span_blocks_; }
  // Distances at the last evaluation.
  double squared_sum() const { return squared_sum_; }
  double squared_max() const { return squared_max_; }

 private:
  using Directions = Eigen::Matrix<double, Eigen::Dynamic, 3, 0, 3>;

  void FindFeet();
  void GroupBySpan();
  void CompressSpans();
  Directions DirectionsOf(const CurveFoot& foot, const CurvePoint& c, const Eigen::Vector3d& residual) const;
  void AddRows(std::size_t span, CompressedRows* rows) const;
  void AddAutodiffRows(std::size_t span, CompressedRows* rows) const;
  void AddRegularisation(std::size_t span, CompressedRows* rows) const;
  double RegularisationCost(std::size_t span) const;
  Eigen::MatrixXd LocalControlPoints(std::size_t span) const;

  const CurveDistanceFit::Shared& shared_;
  std::vector<double*> blocks_;
  int threads_;
  CurveSpans spans_;
  std::vector<Eigen::Vector3d> control_points_;
  std::vector<double> weights_;
  std::vector<double> accepted_;      // parameters at the last accepted iterate
  std::vector<CurveFoot> feet_;       // at the present one
  std::vector<std::uint32_t> order_;  // points, span by span
  std::vector<std::size_t> span_begin_;
  std::vector<CompressedBlock> span_blocks_;
  double squared_sum_ = 0, squared_max_ = 0;
};

}  // namespace frond
