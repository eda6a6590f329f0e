// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/distance_fit.h"

#include <ceres/problem.h>

#include <cmath>

#include "problems/surface/distance_state.h"
#include "solvers/compressed_cost_function.h"

namespace frond {

SurfaceDistanceFit::SurfaceDistanceFit(std::span<const Eigen::Vector3d> points, const NurbsSurface& start,
                                       const NurbsSurface& reference, DistanceFitOptions options, int threads,
                                       std::vector<Eigen::Vector2d> feet)
    : shared_(std::make_unique<const Shared>(points, start, reference, std::move(options), threads,
                                             std::move(feet))) {
  parameters_ = shared_->net.ParameterBlocks();
}

SurfaceDistanceFit::~SurfaceDistanceFit() = default;

std::shared_ptr<ceres::EvaluationCallback> SurfaceDistanceFit::CreateState(const std::vector<double*>& blocks,
                                                                           int threads) const {
  return std::make_shared<DistanceState>(*shared_, blocks, threads);
}

void SurfaceDistanceFit::AddResiduals(const std::vector<double*>& blocks, ceres::EvaluationCallback* state,
                                      ceres::Problem* problem) const {
  const auto* distance_state = static_cast<const DistanceState*>(state);
  for (std::size_t c = 0; c < shared_->layout.size(); ++c) {
    const CellBlocks& cell = shared_->layout[c];
    std::vector<double*> pointers;
    for (const int block : cell.blocks) pointers.push_back(blocks[static_cast<std::size_t>(block)]);
    const std::vector<int> sizes(cell.blocks.size(), shared_->net.block_size());
    problem->AddResidualBlock(new CompressedCostFunction(&distance_state->cell_blocks()[c], sizes), nullptr,
                              pointers);
  }
}

std::map<std::string, double> SurfaceDistanceFit::Metrics(std::span<const double> x) const {
  std::vector<double> values(x.begin(), x.end());
  std::vector<double*> blocks;
  for (std::size_t k = 0; k < values.size(); k += static_cast<std::size_t>(shared_->net.block_size())) {
    blocks.push_back(&values[k]);
  }
  DistanceState state(*shared_, blocks, 1);
  state.PrepareForEvaluation(false, true);
  return {{"rmse", std::sqrt(state.squared_sum() / static_cast<double>(shared_->points.size()))},
          {"max", std::sqrt(state.squared_max())}};
}

const ControlNet& SurfaceDistanceFit::net() const { return shared_->net; }

NurbsSurface SurfaceDistanceFit::SurfaceAt(std::span<const double> x) const {
  std::vector<double> values(x.begin(), x.end());
  std::vector<double*> blocks;
  for (std::size_t k = 0; k < values.size(); k += static_cast<std::size_t>(shared_->net.block_size())) {
    blocks.push_back(&values[k]);
  }
  std::vector<Eigen::Vector3d> control_points;
  std::vector<double> weights;
  shared_->net.Read(blocks, &control_points, &weights);
  return NurbsSurface(shared_->start.u(), shared_->start.v(), std::move(control_points), std::move(weights));
}

}  // namespace frond
