// SPDX-License-Identifier: BSD-3-Clause
#include "problems/curve/curve_distance_fit.h"

#include <ceres/manifold.h>
#include <ceres/problem.h>

#include <algorithm>
#include <cmath>

#include "problems/curve/curve_distance_state.h"
#include "solvers/compressed_cost_function.h"

namespace frond {
namespace {

// Half-widths of the start box: of a coordinate as a share of the control points' extent, and of a
// log-weight.
constexpr double kReach = 0.02, kWeightReach = 0.1;
constexpr double kFootTolerance = 1e-7;  // of the same extent

double Extent(const NurbsCurve& curve) {
  double extent = 0;
  for (const Eigen::Vector3d& point : curve.control_points()) {
    extent = std::max(extent, (point - curve.control_points().front()).norm());
  }
  return extent;
}

std::vector<double*> BlockPointers(std::vector<double>* values, int size) {
  std::vector<double*> blocks;
  for (std::size_t k = 0; k < values->size(); k += static_cast<std::size_t>(size)) {
    blocks.push_back(&(*values)[k]);
  }
  return blocks;
}

std::vector<ParameterBlock> ParameterBlocksOf(const NurbsCurve& start, CurveUnknowns unknowns) {
  const double reach = kReach * Extent(start);
  std::vector<ParameterBlock> blocks;
  for (int k = 0; k < start.basis().num_distinct_control_points(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    ParameterBlock block{.name = "control_point_" + std::to_string(k), .start = {}};
    const auto add = [&block](double value, double half) {
      block.start.push_back(value);
      block.start_lower.push_back(value - half);
      block.start_upper.push_back(value + half);
    };
    if (unknowns != CurveUnknowns::kWeights) {
      for (const double value : start.control_points()[i]) add(value, reach);
    }
    if (unknowns != CurveUnknowns::kControlPoints) {
      add(std::log(start.weights()[i] / start.weights()[0]), kWeightReach);
    }
    blocks.push_back(std::move(block));
  }
  if (unknowns == CurveUnknowns::kWeights) blocks[0].constant = true;
  if (unknowns == CurveUnknowns::kBoth) {
    blocks[0].manifold = std::make_shared<ceres::SubsetManifold>(4, std::vector<int>{3});
  }
  return blocks;
}

}  // namespace

std::vector<Eigen::MatrixXd> BendingGram(const SpanPolynomials& spans, double domain) {
  const Eigen::Index n = spans.degree() + 1;
  std::vector<Eigen::MatrixXd> grams;
  for (int k = 0; k < spans.count(); ++k) {
    const double length = spans.length(k) / domain;
    Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index i = 2; i < n; ++i) {
      for (Eigen::Index j = 2; j < n; ++j) {
        const double factor = static_cast<double>(i * (i - 1) * j * (j - 1)) /
                              (static_cast<double>(i + j - 3) * length * length * length);
        gram += factor * spans.coefficients(k).col(i) * spans.coefficients(k).col(j).transpose();
      }
    }
    grams.push_back(std::move(gram));
  }
  return grams;
}

CurveDistanceFit::Shared::Shared(std::span<const Eigen::Vector3d> points_in,
                                 std::vector<double> parameters_in, const NurbsCurve& start_in,
                                 const CurveDistanceOptions& options_in)
    : points(points_in),
      parameters(std::move(parameters_in)),
      start(start_in),
      options(options_in),
      spans(start),
      gram(BendingGram(spans.polynomials(), start.basis().end() - start.basis().begin())),
      ridge_of(gram.size()) {
  foot_options.step_tolerance = kFootTolerance * Extent(start);
  for (double& t : parameters) t = start.basis().IntoDomain(t);
  if (options.unknowns == CurveUnknowns::kControlPoints) return;
  std::vector<bool> carried(static_cast<std::size_t>(start.basis().num_distinct_control_points()), false);
  for (std::size_t s = 0; s < ridge_of.size(); ++s) {
    for (int a = 0; a <= start.basis().degree(); ++a) {
      const auto block =
          static_cast<std::size_t>(block_of(spans.polynomials().first(static_cast<int>(s)) + a));
      if (!carried[block]) ridge_of[s].push_back(a);
      carried[block] = true;
    }
  }
}

int CurveDistanceFit::Shared::block_size() const {
  if (options.unknowns == CurveUnknowns::kWeights) return 1;
  return options.unknowns == CurveUnknowns::kBoth ? 4 : 3;
}

void CurveDistanceFit::Shared::Read(const std::vector<double*>& blocks,
                                    std::vector<Eigen::Vector3d>* control_points,
                                    std::vector<double>* weights) const {
  *control_points = start.control_points();
  *weights = start.weights();
  for (std::size_t k = 0; k < weights->size(); ++k) {
    const double* block = blocks[static_cast<std::size_t>(block_of(static_cast<int>(k)))];
    if (options.unknowns != CurveUnknowns::kWeights) (*control_points)[k] = Eigen::Vector3d(block);
    if (options.unknowns != CurveUnknowns::kControlPoints) (*weights)[k] = std::exp(block[block_size() - 1]);
  }
}

CurveDistanceFit::CurveDistanceFit(std::span<const Eigen::Vector3d> points, std::vector<double> parameters,
                                   const NurbsCurve& start, const CurveDistanceOptions& options)
    : parameters_(ParameterBlocksOf(start, options.unknowns)),
      shared_(std::make_unique<const Shared>(points, std::move(parameters), start, options)) {}

CurveDistanceFit::~CurveDistanceFit() = default;

std::shared_ptr<ceres::EvaluationCallback> CurveDistanceFit::CreateState(const std::vector<double*>& blocks,
                                                                         int threads) const {
  return std::make_shared<CurveDistanceState>(*shared_, blocks, threads);
}

void CurveDistanceFit::AddResiduals(const std::vector<double*>& blocks, ceres::EvaluationCallback* state,
                                    ceres::Problem* problem) const {
  const auto* curve_state = static_cast<const CurveDistanceState*>(state);
  const int p = shared_->start.basis().degree();
  const std::vector<int> sizes(static_cast<std::size_t>(p) + 1, shared_->block_size());
  for (int s = 0; s < shared_->spans.count(); ++s) {
    std::vector<double*> pointers;
    for (int a = 0; a <= p; ++a) {
      const int block = shared_->block_of(shared_->spans.polynomials().first(s) + a);
      pointers.push_back(blocks[static_cast<std::size_t>(block)]);
    }
    problem->AddResidualBlock(
        new CompressedCostFunction(&curve_state->span_blocks()[static_cast<std::size_t>(s)], sizes), nullptr,
        pointers);
  }
}

std::map<std::string, double> CurveDistanceFit::Metrics(std::span<const double> x) const {
  std::vector<double> values(x.begin(), x.end());
  CurveDistanceState state(*shared_, BlockPointers(&values, shared_->block_size()), 1);
  state.PrepareForEvaluation(false, true);
  return {{"rmse", std::sqrt(state.squared_sum() / static_cast<double>(shared_->points.size()))},
          {"max", std::sqrt(state.squared_max())}};
}

NurbsCurve CurveDistanceFit::CurveAt(std::span<const double> x) const {
  std::vector<double> values(x.begin(), x.end());
  std::vector<Eigen::Vector3d> control_points;
  std::vector<double> weights;
  shared_->Read(BlockPointers(&values, shared_->block_size()), &control_points, &weights);
  return NurbsCurve(shared_->start.basis(), std::move(control_points), std::move(weights));
}

}  // namespace frond
