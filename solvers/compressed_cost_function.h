// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/cost_function.h>
#include <ceres/jet.h>

#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "solvers/compressed_rows.h"

namespace frond {

// Copies `block` to Ceres: D + 1 residuals over parameter blocks of `sizes` (their sum is D). Without
// Jacobians the residuals are [0 … 0; √(rᵀr)], of the same norm, and no factor is needed. False where
// Jacobians are wanted of a block that was not factored, or the cost is not finite.
bool WriteCompressedBlock(const CompressedBlock& block, const std::vector<int>& sizes, double* residuals,
                          double** jacobians);

// The residual block of a CompressedBlock that lives in the fit's state, where its EvaluationCallback brings
// it up to date before each evaluation: factored if Jacobians are asked for, else by SetCostOnly. The
// parameters themselves are not looked at here. Add it with a null loss: a robust loss belongs to the rows,
// inside.
class CompressedCostFunction final : public ceres::CostFunction {
 public:
  // `block` must outlive this and stay at its address.
  CompressedCostFunction(const CompressedBlock* block, const std::vector<int>& parameter_block_sizes);

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override;

 private:
  const CompressedBlock* block_;
  std::vector<int> sizes_;
};

// Many rows of one auto-diff functor over the same parameter blocks, compressed by the cost function itself,
// for fits without shared state (the 441 pixels of a stereo window). The functor evaluates group i of kGroup
// residuals (1: a row; 3: a vector in space) over parameter blocks of sizes Ns:
//
//   struct PixelResidual {
//     template <typename T>
//     bool operator()(int i, const T* warp, const T* radiometry, T* residual) const;
//   };
//   problem->AddResidualBlock(new CompressedAutoDiffCostFunction<PixelResidual, 1, 3, 2>(functor, 441, loss),
//                             nullptr, warp, radiometry);
//
// A robust loss applies to the squared norm of each group, as Ceres applies it to a residual block.
template <typename Functor, int kGroup, int... Ns>
class CompressedAutoDiffCostFunction final : public ceres::CostFunction {
 public:
  static constexpr int kParameters = (Ns + ...);
  using Jet = ceres::Jet<double, kParameters>;

  CompressedAutoDiffCostFunction(Functor functor, int num_groups, RobustLoss loss = {})
      : functor_(std::move(functor)), num_groups_(num_groups), loss_(loss), sizes_{Ns...} {
    *mutable_parameter_block_sizes() = {Ns...};
    set_num_residuals(kParameters + 1);
  }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    constexpr auto kBlocks = std::make_index_sequence<sizeof...(Ns)>();
    CompressedBlock block;
    const bool evaluated = jacobians == nullptr ? EvaluateCost(parameters, &block, kBlocks)
                                                : EvaluateRows(parameters, &block, kBlocks);
    return evaluated && WriteCompressedBlock(block, sizes_, residuals, jacobians);
  }

 private:
  template <std::size_t... Is>
  bool EvaluateCost(double const* const* parameters, CompressedBlock* block,
                    std::index_sequence<Is...> /*blocks*/) const {
    double cost = 0;
    std::array<double, kGroup> r;
    for (int i = 0; i < num_groups_; ++i) {
      if (!functor_(i, parameters[Is]..., r.data())) return false;
      cost += loss_(SquaredNorm(r)).rho;
    }
    SetCostOnly(cost, block);
    return true;
  }

  template <std::size_t... Is>
  bool EvaluateRows(double const* const* parameters, CompressedBlock* block,
                    std::index_sequence<Is...> /*blocks*/) const {
    std::array<Jet, kParameters> x;
    std::array<const Jet*, sizeof...(Ns)> x_blocks;
    for (int b = 0, offset = 0; b < static_cast<int>(sizeof...(Ns)); offset += sizes_[b++]) {
      for (int k = 0; k < sizes_[b]; ++k) x[offset + k] = Jet(parameters[b][k], offset + k);
      x_blocks[b] = &x[offset];
    }
    CompressedRows rows(kParameters);
    std::array<Jet, kGroup> r;
    for (int i = 0; i < num_groups_; ++i) {
      if (!functor_(i, x_blocks[Is]..., r.data())) return false;
      std::array<double, kGroup> value;
      for (int k = 0; k < kGroup; ++k) value[k] = r[k].a;
      const RobustLoss::Value loss = loss_(SquaredNorm(value));
      for (int k = 0; k < kGroup; ++k) {
        rows.AddWeightedRow({r[k].v.data(), kParameters}, r[k].a, loss.derivative, k == 0 ? loss.rho : 0);
      }
    }
    return rows.Compress(block);
  }

  static double SquaredNorm(const std::array<double, kGroup>& r) {
    double sum = 0;
    for (const double value : r) sum += value * value;
    return sum;
  }

  Functor functor_;
  int num_groups_;
  RobustLoss loss_;
  std::vector<int> sizes_;
};

}  // namespace frond
