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

std::vector<double> SearchBox::StartPoint() const {
  std::vector<double> point;
  for (const std::size_t k : index) point.push_back(x[k]);
  return point;
}

std::vector<double> SearchBox::RandomPoint(Random* random) const {
  std::vector<double> point(size());
  for (std::size_t d = 0; d < size(); ++d) point[d] = random->Uniform(start_lower[d], start_upper[d]);
  return point;
}

OptionSpec StartBoxSpec() {
  return {
      .name = "start_box",
      .type = OptionType::kNumbers,
      .default_value = std::string("fit"),
      .help =
          "[lower, upper] of the first points, for every parameter (weights: [0.9, 1.1]); fit: the box that "
          "the fit gives, else its bounds",
      .words = {"fit"},
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
                        "', which lives on a manifold: use lm, dogleg, bfgs or lbfgs");
    }
    for (std::size_t i = 0; !block.constant && i < block.start.size(); ++i) {
      box.index.push_back(offset + i);
      box.lower.push_back(block.lower.empty() ? -kInfinity : block.lower[i]);
      box.upper.push_back(block.upper.empty() ? kInfinity : block.upper[i]);
      const bool own = !block.start_lower.empty();
      const double lower = given != nullptr ? (*given)[0] : own ? block.start_lower[i] : box.lower.back();
      const double upper = given != nullptr ? (*given)[1] : own ? block.start_upper[i] : box.upper.back();
      box.start_lower.push_back(std::max(box.lower.back(), lower));
      box.start_upper.push_back(std::min(box.upper.back(), upper));
      CheckLastValue(box, NameOf(block, i), start_box, solver_name);
    }
    offset += block.start.size();
  }
  return box;
}

}  // namespace frond
