// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/active_bounds.h"

#include <algorithm>

namespace frond {
namespace {

bool AtLower(const ParameterBlock& block, const double* values, std::size_t i) {
  return !block.lower.empty() && values[i] <= block.lower[i];
}

bool AtUpper(const ParameterBlock& block, const double* values, std::size_t i) {
  return !block.upper.empty() && values[i] >= block.upper[i];
}

}  // namespace

ActiveBounds::ActiveBounds(const FitProblem& fit, LeastSquares* least_squares)
    : least_squares_(least_squares) {
  double* values = least_squares->x().data();
  for (const ParameterBlock& block : fit.parameters()) {
    if (!block.constant && block.manifold == nullptr && !(block.lower.empty() && block.upper.empty())) {
      blocks_.push_back({values, &block, {}});
    }
    values += block.start.size();
  }
}

bool ActiveBounds::Update() {
  bool any_held = false, any_at_bound = false;
  ceres::Problem::EvaluateOptions options;
  for (const Block& block : blocks_) {
    options.parameter_blocks.push_back(block.values);
    any_held = any_held || !block.held.empty();
    for (std::size_t i = 0; i < block.parameters->start.size(); ++i) {
      any_at_bound = any_at_bound || AtLower(*block.parameters, block.values, i) ||
                     AtUpper(*block.parameters, block.values, i);
    }
  }
  if (!any_held && !any_at_bound) return false;

  std::vector<std::vector<int>> held_before;
  for (Block& block : blocks_) {
    held_before.push_back(block.held);
    Hold({}, &block);  // the gradient of held values is wanted too
  }
  std::vector<double> gradient;
  if (!least_squares_->problem().Evaluate(options, nullptr, nullptr, &gradient, nullptr)) return false;

  bool changed = false;
  std::size_t offset = 0;
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    Block& block = blocks_[b];
    std::vector<int> active;
    for (std::size_t i = 0; i < block.parameters->start.size(); ++i, ++offset) {
      if ((AtLower(*block.parameters, block.values, i) && gradient[offset] > 0) ||
          (AtUpper(*block.parameters, block.values, i) && gradient[offset] < 0)) {
        active.push_back(static_cast<int>(i));
      }
    }
    Hold(active, &block);
    changed = changed || active != held_before[b];
  }
  return changed;
}

void ActiveBounds::Hold(const std::vector<int>& indices, Block* block) {
  ceres::Problem& problem = least_squares_->problem();
  const int size = static_cast<int>(block->parameters->start.size());
  problem.SetParameterBlockVariable(block->values);
  problem.SetManifold(block->values, nullptr);
  if (static_cast<int>(indices.size()) == size) {
    problem.SetParameterBlockConstant(block->values);
  } else if (!indices.empty()) {
    manifolds_.push_back(std::make_unique<ceres::SubsetManifold>(size, indices));
    problem.SetManifold(block->values, manifolds_.back().get());
  }
  block->held = indices;
}

}  // namespace frond
