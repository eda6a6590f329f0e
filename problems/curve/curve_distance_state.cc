// SPDX-License-Identifier: BSD-3-Clause
#include "problems/curve/curve_distance_state.h"

#include <ceres/dynamic_autodiff_cost_function.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "problems/curve/curve_residual.h"

namespace frond {
namespace {

constexpr std::size_t kPointChunk = 1024;

}  // namespace

CurveDistanceState::CurveDistanceState(const CurveDistanceFit::Shared& shared, std::vector<double*> blocks,
                                       int threads)
    : shared_(shared),
      blocks_(std::move(blocks)),
      threads_(threads),
      spans_(shared.spans),
      accepted_(shared.parameters),
      feet_(shared.points.size()),
      span_blocks_(shared.gram.size()) {}

void CurveDistanceState::PrepareForEvaluation(bool evaluate_jacobians, bool new_evaluation_point) {
  if (new_evaluation_point) {
    shared_.Read(blocks_, &control_points_, &weights_);
    spans_.Update(control_points_, weights_);
    FindFeet();
  }
  if (evaluate_jacobians) {
    for (std::size_t i = 0; i < feet_.size(); ++i) accepted_[i] = feet_[i].t;
    GroupBySpan();
    CompressSpans();
  } else if (new_evaluation_point) {
    for (std::size_t s = 0; s < span_blocks_.size(); ++s) {
      SetCostOnly(RegularisationCost(s) + (s == 0 ? squared_sum_ : 0), &span_blocks_[s]);
    }
  }
}

void CurveDistanceState::FindFeet() {
  const std::size_t n = feet_.size();
  struct Sums {
    double squared = 0, max = 0;
  };
  std::vector<Sums> chunks((n + kPointChunk - 1) / kPointChunk);
  ParallelFor(n, kPointChunk, threads_, [&](std::size_t begin, std::size_t end) {
    Sums sums;
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3d& point = shared_.points[i];
      if (shared_.options.distance == CurveDistance::kOrthogonal) {
        feet_[i] = RefineCurveFoot(spans_, point, accepted_[i], shared_.foot_options);
      } else {
        feet_[i].t = accepted_[i];
        feet_[i].squared_distance = (spans_.Evaluate(accepted_[i]) - point).squaredNorm();
      }
      sums.squared += feet_[i].squared_distance;
      sums.max = std::max(sums.max, feet_[i].squared_distance);
    }
    chunks[begin / kPointChunk] = sums;
  });
  squared_sum_ = squared_max_ = 0;
  for (const Sums& sums : chunks) {
    squared_sum_ += sums.squared;
    squared_max_ = std::max(squared_max_, sums.max);
  }
}

void CurveDistanceState::GroupBySpan() {
  const auto span_of = [&](std::size_t i) {
    return static_cast<std::size_t>(spans_.polynomials().SpanOf(feet_[i].t));
  };
  span_begin_.assign(span_blocks_.size() + 1, 0);
  for (std::size_t i = 0; i < feet_.size(); ++i) ++span_begin_[span_of(i) + 1];
  for (std::size_t s = 1; s < span_begin_.size(); ++s) span_begin_[s] += span_begin_[s - 1];
  std::vector<std::size_t> next(span_begin_.begin(), span_begin_.end() - 1);
  order_.resize(feet_.size());
  for (std::size_t i = 0; i < feet_.size(); ++i) order_[next[span_of(i)]++] = static_cast<std::uint32_t>(i);
}

void CurveDistanceState::CompressSpans() {
  const int parameters = (spans_.basis().degree() + 1) * shared_.block_size();
  ParallelFor(span_blocks_.size(), 1, threads_, [&](std::size_t span, std::size_t) {
    CompressedRows rows(parameters);
    if (shared_.options.derivatives == CurveDerivatives::kAutodiff) {
      AddAutodiffRows(span, &rows);
    } else {
      AddRows(span, &rows);
    }
    AddRegularisation(span, &rows);
    rows.Compress(&span_blocks_[span]);
  });
}

// Two rows square to the tangent; three for given parameters, at the ends of an open curve, and while the
// foot is not square to the curve (or LM takes false progress for true; corners of the curve are such places
// too).
CurveDistanceState::Directions CurveDistanceState::DirectionsOf(const CurveFoot& foot, const CurvePoint& c,
                                                                const Eigen::Vector3d& residual) const {
  const double speed = c.d1.norm();
  if (shared_.options.distance == CurveDistance::kParametric || foot.at_end || !(speed > 0)) {
    return Eigen::Matrix3d::Identity();
  }
  const Eigen::Vector3d tangent = c.d1 / speed;
  const double along = residual.dot(tangent), tiny = shared_.foot_options.step_tolerance * 1e-3;
  if (along * along > 1e-6 * foot.squared_distance + tiny * tiny) return Eigen::Matrix3d::Identity();
  Eigen::Index least = 0;  // the axis farthest from the tangent: z in a plane curve, which so stays one
  tangent.cwiseAbs().minCoeff(&least);
  Directions directions(2, 3);
  const Eigen::Vector3d first = tangent.cross(Eigen::Vector3d::Unit(least)).normalized();
  directions.row(0) = first.transpose();
  directions.row(1) = tangent.cross(first).transpose();
  return directions;
}

// ∂C/∂P_a = R_a, ∂C/∂ω_a = R_a (P_a − C), R_a = N_a w_a / Σ N w.
void CurveDistanceState::AddRows(std::size_t span, CompressedRows* rows) const {
  const SpanPolynomials& polynomials = spans_.polynomials();
  const int k = static_cast<int>(span), first = polynomials.first(k), n = polynomials.degree() + 1;
  const int size = shared_.block_size();
  double basis[kMaxDegree + 1];
  std::vector<double> row(static_cast<std::size_t>(rows->num_parameters()));
  for (std::size_t o = span_begin_[span]; o < span_begin_[span + 1]; ++o) {
    const std::size_t i = order_[o];
    const CurvePoint c = spans_.EvaluateWithDerivatives(feet_[i].t);
    const Eigen::Vector3d residual = c.position - shared_.points[i];
    const Directions directions = DirectionsOf(feet_[i], c, residual);
    polynomials.Evaluate(k, feet_[i].t, 0, basis);
    double denominator = 0;
    for (int a = 0; a < n; ++a) denominator += basis[a] *= weights_[static_cast<std::size_t>(first + a)];
    for (Eigen::Index d = 0; d < directions.rows(); ++d) {
      const Eigen::Vector3d direction = directions.row(d).transpose();
      double* entry = row.data();
      for (int a = 0; a < n; ++a) {
        const double ratio = basis[a] / denominator;
        if (size >= 3) {
          for (int x = 0; x < 3; ++x) *entry++ = ratio * direction[x];
        }
        if (size != 3) {
          *entry++ = ratio * direction.dot(control_points_[static_cast<std::size_t>(first + a)] - c.position);
        }
      }
      rows->AddWeightedRow(row, direction.dot(residual), 1, d == 0 ? feet_[i].squared_distance : 0);
    }
  }
}

void CurveDistanceState::AddAutodiffRows(std::size_t span, CompressedRows* rows) const {
  const SpanPolynomials& polynomials = spans_.polynomials();
  const int k = static_cast<int>(span), first = polynomials.first(k), size = shared_.block_size();
  const std::size_t n = static_cast<std::size_t>(polynomials.degree()) + 1;
  std::vector<const double*> parameters;
  for (std::size_t a = 0; a < n; ++a) {
    parameters.push_back(blocks_[static_cast<std::size_t>(shared_.block_of(first + static_cast<int>(a)))]);
  }
  double basis[kMaxDegree + 1];
  std::vector<double> row(static_cast<std::size_t>(rows->num_parameters()));
  for (std::size_t o = span_begin_[span]; o < span_begin_[span + 1]; ++o) {
    const std::size_t i = order_[o];
    const CurvePoint c = spans_.EvaluateWithDerivatives(feet_[i].t);
    polynomials.Evaluate(k, feet_[i].t, 0, basis);
    const Directions directions = DirectionsOf(feet_[i], c, c.position - shared_.points[i]);
    const auto offset = static_cast<std::size_t>(first);
    ceres::DynamicAutoDiffCostFunction<CurveResidual> cost(
        new CurveResidual{{basis, n},
                          shared_.options.unknowns,
                          std::span(control_points_).subspan(offset, n),
                          std::span(weights_).subspan(offset, n),
                          shared_.points[i],
                          directions});
    for (std::size_t a = 0; a < n; ++a) cost.AddParameterBlock(size);
    cost.SetNumResiduals(static_cast<int>(directions.rows()));
    Eigen::VectorXd residuals(directions.rows());
    std::vector<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> jacobians(
        n, Eigen::MatrixXd(directions.rows(), size));
    std::vector<double*> pointers;
    for (auto& jacobian : jacobians) pointers.push_back(jacobian.data());
    cost.Evaluate(parameters.data(), residuals.data(), pointers.data());
    for (Eigen::Index d = 0; d < directions.rows(); ++d) {
      std::size_t entry = 0;
      for (const auto& jacobian : jacobians) {
        for (int x = 0; x < size; ++x) row[entry++] = jacobian(d, x);
      }
      rows->AddWeightedRow(row, residuals[d], 1, d == 0 ? feet_[i].squared_distance : 0);
    }
  }
}

Eigen::MatrixXd CurveDistanceState::LocalControlPoints(std::size_t span) const {
  const Eigen::Index n = spans_.basis().degree() + 1;
  const int first = spans_.polynomials().first(static_cast<int>(span));
  Eigen::MatrixXd local(n, 3);
  for (Eigen::Index a = 0; a < n; ++a) {
    local.row(a) = control_points_[static_cast<std::size_t>(first + a)].transpose();
  }
  return local;
}

void CurveDistanceState::AddRegularisation(std::size_t span, CompressedRows* rows) const {
  const Eigen::Index size = shared_.block_size();
  if (size >= 3 && shared_.options.fairness > 0) {
    const double scale = shared_.options.fairness * static_cast<double>(shared_.points.size());
    const Eigen::MatrixXd points = LocalControlPoints(span), gradient = scale * shared_.gram[span] * points;
    for (Eigen::Index a = 0; a < points.rows(); ++a) {
      rows->g().segment<3>(a * size) += gradient.row(a).transpose();
      for (Eigen::Index b = a; b < points.rows(); ++b) {
        rows->H().block<3, 3>(a * size, b * size).diagonal().array() += scale * shared_.gram[span](a, b);
      }
    }
    rows->squared_norm() += gradient.cwiseProduct(points).sum();
  }
  const double ridge = shared_.options.weight_ridge;
  const int first = spans_.polynomials().first(static_cast<int>(span));
  for (const int a : shared_.ridge_of[span]) {
    const Eigen::Index k = a * size + size - 1;
    const double omega = std::log(weights_[static_cast<std::size_t>(first + a)]);
    rows->H()(k, k) += ridge;
    rows->g()[k] += ridge * omega;
    rows->squared_norm() += ridge * omega * omega;
  }
}

double CurveDistanceState::RegularisationCost(std::size_t span) const {
  double cost = 0;
  if (shared_.block_size() >= 3 && shared_.options.fairness > 0) {
    const Eigen::MatrixXd points = LocalControlPoints(span);
    cost += shared_.options.fairness * static_cast<double>(shared_.points.size()) *
            (shared_.gram[span] * points).cwiseProduct(points).sum();
  }
  const int first = spans_.polynomials().first(static_cast<int>(span));
  for (const int a : shared_.ridge_of[span]) {
    const double omega = std::log(weights_[static_cast<std::size_t>(first + a)]);
    cost += shared_.options.weight_ridge * omega * omega;
  }
  return cost;
}

}  // namespace frond
