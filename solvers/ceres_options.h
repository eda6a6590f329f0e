// SPDX-License-Identifier: BSD-3-Clause
// Ceres's minimisers as options of a config, for the registered solvers and for fits that run stages of their
// own.
#pragma once

#include <ceres/solver.h>

#include <vector>

#include "base/options.h"

namespace frond {

enum class CeresMethod { kLevenbergMarquardt, kDogleg, kBfgs, kLbfgs };

// Whether it searches along lines, which cannot hold bounds.
inline bool IsLineSearch(CeresMethod method) {
  return method == CeresMethod::kBfgs || method == CeresMethod::kLbfgs;
}

// The options of `method`, named as in ceres::Solver::Options: max_iterations, function_tolerance, … A fit
// may change default values before it offers them as its own.
std::vector<OptionSpec> CeresOptionSpecs(CeresMethod method);

// Ceres's options from `options`, built from (at least) the specs of `method`. Nothing is logged; no
// callbacks; state is updated every iteration. Ceres adds up costs and gradients thread by thread: the last
// bits, and with them the iterates, depend on `threads`. Where results must not, give 1 here, and the threads
// to the fit's state.
ceres::Solver::Options CeresOptionsFrom(const Options& options, int threads,
                                        CeresMethod method = CeresMethod::kLevenbergMarquardt);

}  // namespace frond
