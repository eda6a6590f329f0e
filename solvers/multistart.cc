// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/multistart.h"

#include <limits>
#include <utility>

#include "base/option_specs.h"
#include "solvers/budget_watch.h"
#include "solvers/ceres_solvers.h"
#include "solvers/fit_from.h"
#include "solvers/option_prefix.h"
#include "solvers/search_box.h"
#include "solvers/solve_sequence.h"

namespace frond {
namespace {

constexpr int kDefaultStarts = 20;
constexpr int kMostFailures = 100;  // where no start succeeds

struct MultistartSettings {
  std::optional<int> starts;  // none: as many as a budget allows, kDefaultStarts without one
  bool start_at_guess = true;
  OptionValue start_box;
};

class MultistartLmSolver final : public Solver {
 public:
  MultistartLmSolver(std::unique_ptr<Solver> lm, MultistartSettings settings)
      : lm_(std::move(lm)), settings_(std::move(settings)) {}

  void Check(const FitProblem& fit) const override {
    lm_->Check(fit);
    MakeSearchBox(fit, settings_.start_box, "multistart_lm");
  }

  SolverReport Solve(const FitProblem& fit, const Budget& budget,
                     const SolveContext& context) const override {
    lm_->Check(fit);
    SolveSequence sequence(budget);
    const SearchBox box = MakeSearchBox(fit, settings_.start_box, "multistart_lm");
    int starts =
        settings_.starts.value_or(budget.IsLimited() ? std::numeric_limits<int>::max() : kDefaultStarts);
    if (box.size() == 0) starts = 1;
    Random random(context.seed);
    int run = 0, failed = 0;
    std::optional<Termination> cause;
    for (; run < starts && !cause; ++run) {
      const std::vector<double> start =
          run == 0 && settings_.start_at_guess ? box.x : box.FullVector(box.RandomPoint(&random).data());
      const SolverReport part = lm_->Solve(FitFrom(fit, start), sequence.Begin(), context);
      sequence.Add(part, part.objective);
      failed += part.termination == Termination::kFailed ? 1 : 0;
      cause = sequence.Cause();
      if (!cause && run + 1 >= kMostFailures && failed == run + 1) break;
    }
    return sequence.Finish(cause.value_or(Termination::kIterationLimit),
                           std::to_string(run) + " starts, " + std::to_string(failed) + " of them failed" +
                               (cause ? "; " + StopMessage(*cause) : std::string()));
  }

 private:
  std::unique_ptr<Solver> lm_;
  MultistartSettings settings_;
};

}  // namespace

SolverType MultistartLmSolverType() {
  const OptionSpec starts =
      AutoIntegerSpec("starts", 1, 1e9, "Descents; auto: all that a budget allows, 20 without one");
  std::vector<OptionSpec> specs = {starts, StartBoxSpec(),
                                   FlagSpec("start_at_guess", true, "Descend from the fit's start first")};
  const SolverType lm = LmSolverType();
  for (OptionSpec& spec : WithPrefix("lm", lm.options)) specs.push_back(std::move(spec));
  return {"multistart_lm", "Levenberg-Marquardt from many starts, the best of all", std::move(specs),
          [lm](const Options& options) -> std::unique_ptr<Solver> {
            MultistartSettings settings;
            if (!options.HoldsWord("starts")) settings.starts = options.Integer("starts");
            settings.start_at_guess = options.Flag("start_at_guess");
            settings.start_box = options.Value("start_box");
            return std::make_unique<MultistartLmSolver>(lm.create(WithoutPrefix("lm", lm.options, options)),
                                                        std::move(settings));
          }};
}

}  // namespace frond
