// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/compressed_cost_function.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace frond {

bool WriteCompressedBlock(const CompressedBlock& block, const std::vector<int>& sizes, double* residuals,
                          double** jacobians) {
  const int num_parameters = std::accumulate(sizes.begin(), sizes.end(), 0);
  if (jacobians == nullptr) {
    if (!std::isfinite(block.squared_norm)) return false;
    std::fill_n(residuals, num_parameters, 0.0);
    residuals[num_parameters] = std::sqrt(std::max(0.0, block.squared_norm));
    return true;
  }
  if (!block.factored || block.jacobian.cols() != num_parameters) return false;
  Eigen::VectorXd::Map(residuals, num_parameters + 1) = block.residual;
  Eigen::Index offset = 0;
  for (std::size_t b = 0; b < sizes.size(); offset += sizes[b++]) {
    if (jacobians[b] == nullptr) continue;  // a constant parameter block
    double* row = jacobians[b];
    for (int i = 0; i < num_parameters; ++i, row += sizes[b]) {
      std::copy_n(block.jacobian.row(i).data() + offset, sizes[b], row);
    }
    std::fill_n(row, sizes[b], 0.0);
  }
  return true;
}

CompressedCostFunction::CompressedCostFunction(const CompressedBlock* block,
                                               const std::vector<int>& parameter_block_sizes)
    : block_(block), sizes_(parameter_block_sizes) {
  *mutable_parameter_block_sizes() = parameter_block_sizes;
  set_num_residuals(std::accumulate(sizes_.begin(), sizes_.end(), 0) + 1);
}

bool CompressedCostFunction::Evaluate(double const* const* /*parameters*/, double* residuals,
                                      double** jacobians) const {
  return WriteCompressedBlock(*block_, sizes_, residuals, jacobians);
}

}  // namespace frond
