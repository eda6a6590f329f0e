// SPDX-License-Identifier: BSD-3-Clause
#include <utility>

#include "base/errors.h"
#include "base/option_specs.h"
#include "experiments/study/set_scans.h"
#include "experiments/study/study_sets.h"
#include "io/length_unit.h"
#include "problems/leaf/leaf_options.h"
#include "problems/leaf/leaf_paper_fit.h"

namespace frond {
namespace {

constexpr std::uint64_t kGridSeed = 1;  // of a thinning voxel grid: every repetition has the same points

// Those of the paper's method; which method it is and that the weights are free goes without saying here.
std::vector<OptionSpec> Specs() {
  std::vector<OptionSpec> specs = SetScanSpecs(0);
  specs.push_back(ChoiceSpec("objective", {"paper", "sum_of_squares"},
                             "F = alpha[0] RMSE + alpha[1] max, or half the sum of squared distances"));
  for (OptionSpec& spec : LeafSpecs()) {
    if (spec.name != "method" && spec.name != "paper.weights") specs.push_back(std::move(spec));
  }
  return specs;
}

// All options of LeafSpecs, with those that are set here.
Options LeafOptionsFrom(const Options& set) {
  Options options(LeafSpecs());
  for (const OptionSpec& spec : options.specs()) {
    if (spec.name != "method" && spec.name != "paper.weights" && set.IsSet(spec.name)) {
      options.Set(spec.name, set.Value(spec.name));
    }
  }
  return options;
}

std::shared_ptr<const FitProblem> Make(const InputSource& source, const LeafPaperOptions& options) {
  const RunInput input = LoadInput(source, kGridSeed);
  LeafPaperFit fit = FitLeafAsInPaper(input.cloud.points, options);
  return std::make_shared<LeafWeightsFit>(std::move(fit.surface), std::move(fit.test_points),
                                          options.weights);
}

std::vector<TestProblem> Problems(const Options& options) {
  std::vector<TestProblem> problems;
  for (const SetScan& scan : SetScansFrom(options)) {
    LeafPaperOptions leaf = LeafPaperOptionsFrom(LeafOptionsFrom(options), {2, 2}, {5, 5},
                                                 1000 * MetresPerUnit(scan.source.unit));
    leaf.free_weights = false;
    leaf.weights.sum_of_squares = options.Text("objective") == "sum_of_squares";
    problems.push_back({.name = scan.name, .make = [=] { return Make(scan.source, leaf); }});
  }
  return problems;
}

}  // namespace

ProblemSetType LeafWeightsSetType() {
  return {.name = "leaf_weights",
          .help = "The weights of the leaf paper's 5 x 5 surface over its 90 test points",
          .options = Specs(),
          .problems = Problems};
}

}  // namespace frond
