// SPDX-License-Identifier: BSD-3-Clause
#include "problems/skinning/basis_matrix.h"

#include <array>

namespace frond {

Eigen::MatrixXd BasisMatrix(const BSplineBasis& basis, std::span<const double> parameters) {
  Eigen::MatrixXd matrix =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(parameters.size()), basis.num_control_points());
  std::array<double, kMaxDegree + 1> values;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const int span = basis.FindSpan(parameters[k]);
    basis.Evaluate(span, parameters[k], 0, values.data());
    for (int a = 0; a <= basis.degree(); ++a) {
      matrix(static_cast<Eigen::Index>(k), span - basis.degree() + a) = values[static_cast<std::size_t>(a)];
    }
  }
  return matrix;
}

}  // namespace frond
