// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/search_box.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/errors.h"

namespace frond {
namespace {

std::string NameOf(const ParameterBlock& block, std::size_t i) {
  return "parameter '" + block.name + "'[" + std::to_string(i) + "]";
}

// The value added last to `box`: can points be drawn for it?
void CheckLastValue(const SearchBox& box, const std::string& name, const OptionValue& start_box,
                    const std::string& solver_name) {
  if (!std::isfinite(box.start_lower.back()) || !std::isfinite(box.start_upper.back())) {
    throw ConfigError(name + " has no finite bounds for solver '" + solver_name +
                      "' to start in: set its option 'start_box' to [lower, upper]");
  }
  if (box.start_lower.back() > box.start_upper.back()) {
    throw ConfigError("option 'start_box' is " + FormatValue(start_box) + ", outside of the bounds " +
                      FormatValue(std::vector<double>{box.lower.back(), box.upper.back()}) + " of " + name);
  }
}

}  // namespace

std::vector<double> SearchBox::FullVector(const double* searched) const {
  std::vector<double> full = x;
  for (std::size_t d = 0; d < index.size(); ++d) full[index[d]] = searched[d];
  return full;
}

OptionSpec StartBoxSpec() {
  return {.name = "start_box",
          .type = OptionType::kNumbers,
          .default_value = std::string("bounds"),
          .help =
              "[lower, upper] of the first points, for every parameter (weights: [0.9, 1.1]); bounds: the "
              "fit's own",
          .words = {"bounds"},
          .min_size = 2,
          .max_size = 2};
}

SearchBox MakeSearchBox(const FitProblem& fit, const OptionValue& start_box, const std::string& solver_name) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  CheckParameters(fit);
  const auto* given = std::get_if<std::vector<double>>(&start_box);
  if (given != nullptr && !((*given)[0] < (*given)[1] && std::isfinite((*given)[1] - (*given)[0]))) {
    throw ConfigError("option 'start_box' is " + FormatValue(start_box) +
                      ", expected [lower, upper] with "
                      "lower < upper");
  }
  SearchBox box;
  box.x = fit.StartVector();
  std::size_t offset = 0;
  for (const ParameterBlock& block : fit.parameters()) {
    if (!block.constant && block.manifold != nullptr) {
      throw ConfigError("solver '" + solver_name + "' cannot search parameter '" + block.name +
                        "', which lives on a manifold: use lm, dogleg or lbfgs");
    }
    for (std::size_t i = 0; !block.constant && i < block.start.size(); ++i) {
      box.index.push_back(offset + i);
      box.lower.push_back(block.lower.empty() ? -kInfinity : block.lower[i]);
      box.upper.push_back(block.upper.empty() ? kInfinity : block.upper[i]);
      box.start_lower.push_back(given == nullptr ? box.lower.back()
                                                 : std::max(box.lower.back(), (*given)[0]));
      box.start_upper.push_back(given == nullptr ? box.upper.back()
                                                 : std::min(box.upper.back(), (*given)[1]));
      CheckLastValue(box, NameOf(block, i), start_box, solver_name);
    }
    offset += block.start.size();
  }
  return box;
}

}  // namespace frond
