// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "base/options.h"
#include "base/random.h"
#include "solvers/fit_problem.h"

namespace frond {

// What a derivative-free solver searches: the free values of a fit's flat vector x, their bounds, and the box
// where its first points are drawn. The box decides the results of such solvers (MATH.md §7): it is the fit's
// own (ParameterBlock::start_lower, start_upper; where it has none its bounds), or what the option
// `start_box` says, never a guess.
struct SearchBox {
  std::vector<double> x;                         // the fit's start, whole
  std::vector<std::size_t> index;                // of each searched value in x
  std::vector<double> lower, upper;              // bounds of each, ± infinity where there is none
  std::vector<double> start_lower, start_upper;  // finite, within the bounds

  std::size_t size() const { return index.size(); }

  // The whole x with the searched values replaced.
  std::vector<double> FullVector(const double* searched) const;

  // The searched values of the fit's start.
  std::vector<double> StartPoint() const;

  // A point uniform in the start box.
  std::vector<double> RandomPoint(Random* random) const;
};

// `start_box: [lower, upper]` for all searched values, or `fit`.
OptionSpec StartBoxSpec();

// `start_box` is the value of that option. Throws ConfigError naming the parameter and the option to set
// where there is no box, where they do not overlap, and for a free block on a manifold,
// whose values cannot be moved one by one; FitError as CheckParameters does.
SearchBox MakeSearchBox(const FitProblem& fit, const OptionValue& start_box, const std::string& solver_name);

}  // namespace frond
