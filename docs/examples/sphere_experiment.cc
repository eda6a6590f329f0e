// SPDX-License-Identifier: BSD-3-Clause
// The example of docs/add_a_fit.md, which shows parts of this file.
#include "docs/examples/sphere_experiment.h"

#include "base/errors.h"
#include "base/option_specs.h"
#include "docs/examples/sphere_fit.h"

namespace frond {
namespace {

FitOutcome Run(const RunInput& input, const Options& problem, const Solver& solver, const Budget& budget,
               const SolveContext& context) {
  if (input.cloud.points.size() < 4) throw InputError("a sphere needs at least 4 points");
  const SphereFit fit(input.cloud.points, problem.Number("start_radius"));
  FitOutcome outcome;
  outcome.report = solver.Solve(fit, budget, context);
  if (outcome.report->termination == Termination::kFailed) throw FitError(outcome.report->message);
  const std::vector<double>& x = outcome.report->x;
  for (const auto& [name, value] : fit.Metrics(x)) outcome.metrics.Set(name, value);
  for (const Eigen::Vector3d& point : input.cloud.points) {
    outcome.signed_distances.push_back((point - Eigen::Vector3d(x[0], x[1], x[2])).norm() - x[3]);
  }
  return outcome;
}

}  // namespace

FitType SphereFitType() {
  return {.name = "sphere",
          .help = "A sphere by least orthogonal distances",
          .options = {NumberSpec("start_radius", 1, 1e-6, 1e6, "Of the start, in the input's unit")},
          .solver_defaults = [](const Options&, const std::string&) { return OptionDefaults(); },
          .check = [](const Options&) {},
          .run = Run};
}

}  // namespace frond
