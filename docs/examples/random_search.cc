// SPDX-License-Identifier: BSD-3-Clause
// The example of docs/add_a_solver.md, which shows parts of this file.
#include "docs/examples/random_search.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "base/option_specs.h"
#include "solvers/quiet_ceres_log.h"
#include "solvers/searched_objective.h"

namespace frond {
namespace {

constexpr int kBatch = 64;  // points evaluated at once, by all threads

class RandomSearch final : public Solver {
 public:
  RandomSearch(OptionValue start_box, int samples) : start_box_(std::move(start_box)), samples_(samples) {}

  SolverReport Solve(const FitProblem& fit, const Budget& budget,
                     const SolveContext& context) const override {
    const QuietCeresLog quiet;  // points that cannot be evaluated are no news here
    const SearchBox box = MakeSearchBox(fit, start_box_, "random_search");
    Random random(context.seed);
    SolverReport report;
    SearchedObjective objective(fit, box, budget, context.threads, &report);
    int drawn = 0, batches = 0;
    do {
      const int size = std::min(kBatch, samples_ - drawn);
      std::vector<double> points, objectives(static_cast<std::size_t>(size));
      for (int i = 0; i < size; ++i) {
        const std::vector<double> point = drawn + i == 0 ? StartPoint(box) : box.RandomPoint(&random);
        points.insert(points.end(), point.begin(), point.end());
      }
      objective.Evaluate(points, objectives);
      drawn += size;
      ++batches;
    } while (drawn < samples_ && !objective.Cause());
    const Termination cause = objective.Cause().value_or(Termination::kIterationLimit);
    objective.Finish(cause, StopMessage(cause), batches);
    return report;
  }

 private:
  static std::vector<double> StartPoint(const SearchBox& box) {
    std::vector<double> point;
    for (const std::size_t k : box.index) point.push_back(box.x[k]);
    return point;
  }

  OptionValue start_box_;
  int samples_;
};

}  // namespace

SolverType RandomSearchSolverType() {
  return {.name = "random_search",
          .help = "The best of many random points",
          .options = {IntegerSpec("samples", 1000, 1, 1e9, "Points tried, the fit's start among them"),
                      StartBoxSpec()},
          .create = [](const Options& options) -> std::unique_ptr<Solver> {
            return std::make_unique<RandomSearch>(options.Value("start_box"), options.Integer("samples"));
          }};
}

}  // namespace frond
