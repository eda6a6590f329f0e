// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/study_analysis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "base/random.h"
#include "experiments/study/convergence_bands.h"
#include "io/number_text.h"
#include "solvers/comparison/bootstrap.h"
#include "solvers/comparison/critical_difference.h"
#include "solvers/comparison/expected_running_time.h"
#include "solvers/comparison/friedman_test.h"
#include "solvers/comparison/multiple_comparisons.h"
#include "solvers/comparison/profiles.h"
#include "solvers/comparison/quantile.h"
#include "solvers/comparison/rank_table.h"
#include "solvers/comparison/run_length_distribution.h"
#include "solvers/comparison/signed_rank_test.h"
#include "solvers/comparison/success_rate.h"

namespace frond {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kEnoughProblems = 10;  // to rank over problems rather than over their repetitions
constexpr std::array<double, 3> kDigitSteps = {4, 6, 9};

Curve ToCurve(const StepCurve& steps) {
  Curve curve;
  for (const StepPoint& point : steps) {
    curve.x.push_back(point.x);
    curve.y.push_back(point.share);
  }
  return curve;
}

// The best objective of a run's trace.
double BestSeen(const JobResult& result) {
  return result.report.trace.empty() ? kInfinity : result.report.trace.back().best_objective;
}

// The best objective that a run saw or ended with.
double BestOf(const JobResult& result) {
  double best = result.ok() && std::isfinite(result.report.objective) ? result.report.objective : kInfinity;
  return std::fmin(best, BestSeen(result));
}

// Where a run's best objective first is at most `target`; nothing where it never is.
const TracePoint* FirstReach(const JobResult& result, double target) {
  for (const TracePoint& point : result.report.trace) {
    if (point.best_objective <= target) return &point;
  }
  return nullptr;
}

class Analyst {
 public:
  Analyst(const StudyPlan& plan, const std::vector<JobResult>& results) : plan_(plan), results_(results) {}

  StudyAnalysis Analyse() {
    FindLeast();
    ScoreRuns();
    for (std::size_t p = 0; p < plan_.problems.size(); ++p) SummariseProblem(p);
    for (std::size_t c = 0; c < plan_.contenders.size(); ++c) SummariseContender(c);
    AddProfiles();
    Rank();
    ComparePairs();
    AddSpeedUps();
    FindDigitMisses();
    return std::move(analysis_);
  }

 private:
  // Jobs stand problem by problem, then repetition, then contender.
  std::size_t JobIndex(std::size_t problem, int repetition, std::size_t contender) const {
    const auto repetitions = static_cast<std::size_t>(plan_.settings.repetitions);
    return (problem * repetitions + static_cast<std::size_t>(repetition)) * plan_.contenders.size() +
           contender;
  }

  template <typename Visit>
  void ForRuns(std::size_t problem, std::size_t contender, const Visit& visit) const {
    for (int r = 0; r < plan_.settings.repetitions; ++r) visit(JobIndex(problem, r, contender));
  }

  void FindLeast() {
    measures_digits_.assign(plan_.problems.size(), false);
    for (std::size_t k = 0; k < results_.size(); ++k) {
      if (results_[k].metrics.Find("digits") != nullptr) measures_digits_[plan_.jobs[k].problem] = true;
    }
    for (const StudyProblem& problem : plan_.problems) {
      ProblemSummary summary;
      summary.name = problem.name;
      summary.least = problem.problem.best_objective.value_or(kInfinity);
      summary.least_is_known = problem.problem.best_objective.has_value();
      analysis_.problems.push_back(std::move(summary));
    }
    for (std::size_t k = 0; k < results_.size(); ++k) {
      ProblemSummary& problem = analysis_.problems[plan_.jobs[k].problem];
      if (!problem.least_is_known) problem.least = std::min(problem.least, BestOf(results_[k]));
    }
  }

  double Target(std::size_t k, double tau) const {
    const std::size_t p = plan_.jobs[k].problem;
    return TargetObjective(plan_.settings.scale, tau, analysis_.problems[p].least,
                           results_[k].start_objective, plan_.problems[p].problem.resolution);
  }

  void ScoreRuns() {
    for (std::size_t k = 0; k < results_.size(); ++k) {
      const StudyJob& job = plan_.jobs[k];
      const JobResult& result = results_[k];
      const TracePoint* reach = result.ok() ? FirstReach(result, Target(k, plan_.settings.target)) : nullptr;
      RunRow row{.problem = job.problem, .contender = job.contender, .repetition = job.repetition};
      row.success = reach != nullptr;
      row.run_length = row.success ? static_cast<double>(reach->evaluations) : kInfinity;
      row.run_seconds = row.success ? reach->seconds : kInfinity;
      row.gap = Gap(result, analysis_.problems[job.problem].least);
      // How far below the target a run that ends there comes is chance.
      if (row.success && StopsEarly(job.problem)) row.gap = 0;
      analysis_.runs.push_back(row);
    }
  }

  static double Gap(const JobResult& result, double least) {
    if (!result.ok() || !std::isfinite(result.report.objective)) return kInfinity;
    const double above = std::max(0.0, result.report.objective - least);
    const double start = result.start_objective - least;
    return std::isfinite(start) && start > 0 ? above / start : above;
  }

  void SummariseProblem(std::size_t p) {
    ProblemSummary& summary = analysis_.problems[p];
    for (std::size_t c = 0; c < plan_.contenders.size(); ++c) {
      ProblemCell cell;
      std::vector<RunLength> lengths;
      std::vector<double> reached, objectives, digits;
      std::vector<const JobResult*> runs;
      ForRuns(p, c, [&](std::size_t k) {
        const JobResult& result = results_[k];
        runs.push_back(&result);
        ++cell.runs;
        cell.failed += result.ok() ? 0 : 1;
        cell.successes += analysis_.runs[k].success ? 1 : 0;
        lengths.push_back(Length(k));
        reached.push_back(analysis_.runs[k].run_length);
        objectives.push_back(result.ok() ? result.report.objective : kInfinity);
        if (TellsDigits(p)) digits.push_back(DigitsOf(result));
      });
      cell.expected_running_time = ExpectedRunningTime(lengths);
      cell.median_run_length = SampleMedian(reached);
      cell.median_objective = SampleMedian(objectives);
      cell.best_objective = *std::min_element(objectives.begin(), objectives.end());
      if (!digits.empty()) cell.median_digits = SampleMedian(digits);
      summary.cells.push_back(cell);
      summary.by_evaluations.push_back(ConvergenceBand(runs, EvaluationsOf));
      summary.by_seconds.push_back(ConvergenceBand(runs, SecondsOf));
    }
  }

  // Whether runs of a problem end on the target.
  bool StopsEarly(std::size_t p) const {
    return plan_.settings.stop_at_target && plan_.problems[p].problem.best_objective.has_value();
  }

  RunLength Length(std::size_t k) const {
    const RunRow& run = analysis_.runs[k];
    if (run.success) return {run.run_length, true};
    // A job that threw, crashed or ran out of time could not say what it spent: it is charged all that it
    // had.
    // (Without a limit on evaluations: the most that any run of the problem spent.)
    const Budget& budget = plan_.contenders[run.contender].budget;
    std::int64_t evaluations = results_[k].report.evaluations;
    if (evaluations == 0 && budget.LimitsEvaluations()) evaluations = budget.max_evaluations;
    for (std::size_t c = 0; evaluations == 0 && c < plan_.contenders.size(); ++c) {
      ForRuns(run.problem, c, [&](std::size_t other) {
        evaluations = std::max(evaluations, results_[other].report.evaluations);
      });
    }
    return {static_cast<double>(evaluations), false};
  }

  void SummariseContender(std::size_t c) {
    ContenderSummary summary;
    summary.name = plan_.contenders[c].name;
    std::vector<RunLength> lengths;
    std::vector<double> reached, seconds, all_targets;
    for (std::size_t p = 0; p < plan_.problems.size(); ++p) {
      ForRuns(p, c, [&](std::size_t k) {
        ++summary.runs;
        summary.failed += results_[k].ok() ? 0 : 1;
        summary.successes += analysis_.runs[k].success ? 1 : 0;
        lengths.push_back(Length(k));
        reached.push_back(analysis_.runs[k].run_length);
        seconds.push_back(analysis_.runs[k].run_seconds);
        for (const double tau : plan_.settings.profile_targets) {
          const TracePoint* reach = FirstReach(results_[k], Target(k, tau));
          all_targets.push_back(reach == nullptr ? kInfinity : static_cast<double>(reach->evaluations));
        }
        if (TellsDigits(p)) CountDigits(results_[k], &summary);
      });
    }
    summary.repeats_itself = plan_.settings.repetitions > 1 && RepeatsItself(c);
    // The same resamples for every contender, whatever the others.
    Random random = Random::ForKey(plan_.seed, "expected running time");
    summary.success_interval = WilsonInterval(summary.successes, summary.runs);
    summary.expected_running_time = ExpectedRunningTime(lengths);
    summary.expected_running_time_interval = ExpectedRunningTimeInterval(lengths, &random);
    summary.median_run_length = SampleMedian(reached);
    summary.median_seconds = SampleMedian(seconds);
    summary.run_lengths = ToCurve(RunLengthDistribution(all_targets));
    analysis_.contenders.push_back(std::move(summary));
  }

  // Whether all repetitions of every problem gave the same.
  bool RepeatsItself(std::size_t c) const {
    for (std::size_t p = 0; p < plan_.problems.size(); ++p) {
      const SolverReport& first = results_[JobIndex(p, 0, c)].report;
      bool same = true;
      ForRuns(p, c, [&](std::size_t k) {
        const SolverReport& report = results_[k].report;
        same = same && report.evaluations == first.evaluations && std::equal_to<>()(report.x, first.x);
      });
      if (!same) return false;
    }
    return true;
  }

  // Of a run of a problem that measures digits: 0 where the run failed.
  static double DigitsOf(const JobResult& result) {
    return result.metrics.Find("digits") == nullptr ? 0 : result.metrics.Number("digits");
  }

  static void CountDigits(const JobResult& result, ContenderSummary* summary) {
    if (!summary->digits_at_least) summary->digits_at_least = std::vector<int>(kDigitSteps.size(), 0);
    ++summary->digit_runs;
    for (std::size_t k = 0; k < kDigitSteps.size(); ++k) {
      (*summary->digits_at_least)[k] += DigitsOf(result) >= kDigitSteps[k] ? 1 : 0;
    }
  }

  // Contenders' values on every problem and repetition, a row each.
  template <typename Value>
  CostTable Table(const Value& value) const {
    CostTable table;
    for (std::size_t p = 0; p < plan_.problems.size(); ++p) {
      for (int r = 0; r < plan_.settings.repetitions; ++r) {
        table.emplace_back();
        for (std::size_t c = 0; c < plan_.contenders.size(); ++c) {
          table.back().push_back(value(JobIndex(p, r, c)));
        }
      }
    }
    return table;
  }

  void AddProfiles() {
    const CostTable lengths = Table([&](std::size_t k) { return analysis_.runs[k].run_length; });
    const CostTable seconds =
        Table([&](std::size_t k) { return std::max(analysis_.runs[k].run_seconds, 1e-9); });
    std::vector<std::int64_t> parameters;
    for (std::size_t p = 0; p < plan_.problems.size(); ++p) {
      std::int64_t n = 1;  // where no run came so far as to tell
      for (std::size_t c = 0; c < plan_.contenders.size(); ++c) {
        ForRuns(p, c, [&](std::size_t k) { n = std::max<std::int64_t>(n, results_[k].free_parameters); });
      }
      parameters.insert(parameters.end(), static_cast<std::size_t>(plan_.settings.repetitions), n);
    }
    const auto by_evaluations = PerformanceProfiles(lengths), by_seconds = PerformanceProfiles(seconds);
    const auto data = DataProfiles(lengths, parameters);
    for (std::size_t c = 0; c < plan_.contenders.size(); ++c) {
      analysis_.contenders[c].performance_evaluations = ToCurve(by_evaluations[c]);
      analysis_.contenders[c].performance_seconds = ToCurve(by_seconds[c]);
      analysis_.contenders[c].data_profile = ToCurve(data[c]);
    }
  }

  // Successful runs by evaluations, behind them the others by gap.
  double RankCost(std::size_t k) const {
    constexpr double kBehind = 1e18;
    const RunRow& run = analysis_.runs[k];
    if (run.success) return run.run_length;
    return std::isfinite(run.gap) ? kBehind * (1 + run.gap / (1 + run.gap)) : kInfinity;
  }

  void Rank() {
    CostTable blocks = Table([&](std::size_t k) { return RankCost(k); });
    const bool by_problem = plan_.problems.size() >= kEnoughProblems;
    if (by_problem) {
      CostTable medians;
      const auto repetitions = static_cast<std::size_t>(plan_.settings.repetitions);
      for (std::size_t p = 0; p < plan_.problems.size(); ++p) {
        medians.emplace_back();
        for (std::size_t c = 0; c < plan_.contenders.size(); ++c) {
          std::vector<double> costs;
          for (std::size_t r = 0; r < repetitions; ++r) costs.push_back(blocks[p * repetitions + r][c]);
          medians.back().push_back(SampleMedian(costs));
        }
      }
      blocks = std::move(medians);
    }
    analysis_.rank_blocks = by_problem ? "problems" : "problems × repetitions";
    analysis_.rank_block_count = static_cast<int>(blocks.size());
    if (plan_.contenders.size() < 2) {
      analysis_.contenders[0].mean_rank = 1;
      return;
    }
    const RankTable ranks = RankSolvers(blocks);
    for (std::size_t c = 0; c < ranks.average_ranks.size(); ++c) {
      analysis_.contenders[c].mean_rank = ranks.average_ranks[c];
    }
    if (blocks.size() >= 2) analysis_.friedman_p = Friedman(ranks).p_value;
    analysis_.critical_difference = NemenyiCriticalDifference(plan_.contenders.size(), blocks.size());
    analysis_.equal_groups = IndistinguishableGroups(ranks.average_ranks, analysis_.critical_difference);
  }

  void ComparePairs() {
    std::vector<double> gap_p, length_p;
    for (std::size_t a = 0; a < plan_.contenders.size(); ++a) {
      for (std::size_t b = a + 1; b < plan_.contenders.size(); ++b) {
        PairComparison pair{.first = a, .second = b};
        std::vector<double> gaps[2], lengths[2];
        for (std::size_t k = 0; k < results_.size(); k += plan_.contenders.size()) {
          const RunRow &first = analysis_.runs[k + a], &second = analysis_.runs[k + b];
          gaps[0].push_back(first.gap);
          gaps[1].push_back(second.gap);
          lengths[0].push_back(first.run_length);
          lengths[1].push_back(second.run_length);
          pair.first_better += first.gap < second.gap ? 1 : 0;
          pair.second_better += second.gap < first.gap ? 1 : 0;
        }
        pair.gap_p = WilcoxonSignedRank(gaps[0], gaps[1]).p_value;
        pair.length_p = WilcoxonSignedRank(lengths[0], lengths[1]).p_value;
        gap_p.push_back(pair.gap_p);
        length_p.push_back(pair.length_p);
        analysis_.pairs.push_back(pair);
      }
    }
    if (gap_p.empty()) return;
    const std::vector<double> gap_holm = HolmAdjusted(gap_p), length_holm = HolmAdjusted(length_p);
    for (std::size_t k = 0; k < analysis_.pairs.size(); ++k) {
      analysis_.pairs[k].gap_p_holm = gap_holm[k];
      analysis_.pairs[k].length_p_holm = length_holm[k];
    }
  }

  void AddSpeedUps() {
    for (std::size_t a = 0; a < plan_.contenders.size(); ++a) {
      for (std::size_t b = 0; b < plan_.contenders.size(); ++b) {
        if (a != b) analysis_.speed_ups.push_back(SpeedUpOf(a, b));
      }
    }
  }

  SpeedUp SpeedUpOf(std::size_t solver, std::size_t reference) const {
    SpeedUp speed_up;
    speed_up.solver = solver;
    speed_up.reference = reference;
    std::vector<double> factors;
    std::map<std::size_t, int> missed;
    for (std::size_t k = 0; k < results_.size(); k += plan_.contenders.size()) {
      const std::size_t p = plan_.jobs[k].problem;
      const double best = BestSeen(results_[k + reference]);
      if (!std::isfinite(best)) continue;
      // As good is within the rounding; where runs end on the target, whatever is within the target.
      double level = best + plan_.problems[p].problem.resolution;
      if (StopsEarly(p)) level = std::max(level, Target(k + reference, plan_.settings.target));
      const TracePoint* there = FirstReach(results_[k + reference], level);
      const TracePoint* here = FirstReach(results_[k + solver], level);
      factors.push_back(here == nullptr
                            ? 0
                            : static_cast<double>(there->evaluations) /
                                  static_cast<double>(std::max<std::int64_t>(1, here->evaluations)));
      speed_up.reached += here == nullptr ? 0 : 1;
      if (here == nullptr) ++missed[plan_.jobs[k].problem];
    }
    speed_up.pairs = static_cast<int>(factors.size());
    speed_up.missed.assign(missed.begin(), missed.end());
    if (factors.empty()) return speed_up;
    Random random = Random::ForKey(plan_.seed, "speed up");
    speed_up.median = SampleMedian(factors);
    speed_up.interval = BootstrapInterval(
        factors.size(),
        [&](std::span<const std::size_t> indices) {
          std::vector<double> drawn;
          drawn.reserve(indices.size());
          for (const std::size_t i : indices) drawn.push_back(factors[i]);
          return SampleMedian(drawn);
        },
        &random);
    return speed_up;
  }

  // Runs that end on the target say nothing of the digits that a solver could find.
  bool TellsDigits(std::size_t p) const { return measures_digits_[p] && !StopsEarly(p); }

  void FindDigitMisses() {
    for (std::size_t p = 0; p < plan_.problems.size(); ++p) {
      if (!TellsDigits(p)) continue;
      for (std::size_t c = 0; c < plan_.contenders.size(); ++c) {
        int missed = 0, runs = 0;
        double least = kInfinity;
        ForRuns(p, c, [&](std::size_t k) {
          ++runs;
          const double digits = DigitsOf(results_[k]);
          missed += digits < 6 ? 1 : 0;
          least = std::min(least, digits);
        });
        if (missed == 0) continue;
        analysis_.digit_misses.push_back(
            plan_.problems[p].name + ", " + plan_.contenders[c].name + ": " +
            (runs == 1 ? FormatNumber(std::floor(least * 10) / 10) + " correct digits"
                       : std::to_string(missed) + " of " + std::to_string(runs) + " runs below 6 digits"));
      }
    }
  }

  const StudyPlan& plan_;
  const std::vector<JobResult>& results_;
  std::vector<bool> measures_digits_;  // by problem
  StudyAnalysis analysis_;
};

}  // namespace

StudyAnalysis AnalyseStudy(const StudyPlan& plan, const std::vector<JobResult>& results) {
  return Analyst(plan, results).Analyse();
}

}  // namespace frond
