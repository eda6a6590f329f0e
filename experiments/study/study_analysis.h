// SPDX-License-Identifier: BSD-3-Clause
// From the results of a study to its statistics: all numbers that the tables, plots and texts show.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/study/job_result.h"
#include "experiments/study/study_plan.h"
#include "solvers/comparison/interval.h"

namespace frond {

// A curve of steps or line segments; x may be on a logarithmic axis.
struct Curve {
  std::vector<double> x, y;
};

// Of one run, as runs.csv has it.
struct RunRow {
  std::size_t problem = 0, contender = 0;
  int repetition = 0;
  bool success = false;
  double run_length = 0;  // evaluations until success; infinite without
  double run_seconds = 0;
  double gap = 0;  // (f − f_L) / (f₀ − f_L), at least 0; infinite without a finite objective
};

// Contender c on problem p, over the repetitions.
struct ProblemCell {
  int runs = 0, failed = 0, successes = 0;
  double expected_running_time = 0;  // evaluations per success; infinite without any
  double median_run_length = 0;      // infinite where most runs fail
  double median_objective = 0, best_objective = 0;
  std::optional<double> median_digits;  // where the fit measures them
};

struct ProblemSummary {
  std::string name;
  double least = 0;                // f_L
  bool least_is_known = false;     // published, else the best of the study
  std::vector<ProblemCell> cells;  // by contender
  // Best objective so far against evaluations and seconds, by contender: quartiles over the repetitions.
  struct Band {
    Curve lower, median, upper;
  };
  std::vector<Band> by_evaluations, by_seconds;
};

struct ContenderSummary {
  std::string name;
  int runs = 0, failed = 0, successes = 0;
  Interval success_interval;                         // Wilson, 95 %
  double expected_running_time = 0;                  // over all runs
  Interval expected_running_time_interval = {0, 0};  // bootstrap over the runs, 95 %
  double median_run_length = 0, median_seconds = 0;  // until success; infinite without
  double mean_rank = 0;                              // successes by run length, then the others by gap
  Curve run_lengths;  // ECDF over all (run, τ): share reached within x evaluations
  Curve
      data_profile;  // Moré and Wild: share of problem runs solved within x (n + 1) evaluations, τ the target
  Curve performance_evaluations, performance_seconds;    // Dolan and Moré
  std::optional<std::vector<int>> digits_at_least = {};  // runs with ≥ 4, ≥ 6, ≥ 9 digits
  int digit_runs = 0;                                    // runs of problems that measure digits
  bool repeats_itself = false;  // every repetition gave the same run: one case, whatever intervals say
};

// Two contenders, paired by problem and repetition.
struct PairComparison {
  std::size_t first = 0, second = 0;
  int first_better = 0, second_better = 0;  // by final objective
  double gap_p = 1, gap_p_holm = 1;         // Wilcoxon, of the gaps
  double length_p = 1, length_p_holm = 1;   // of the run lengths
};

// (Where runs end on the target, what the reference reached is the target, or its best where it fell short.)
// How much sooner `solver` reaches what `reference` reached at its end: evaluations of the reference until
// its best, over those of the solver until as good; 0 where it never is.
struct SpeedUp {
  std::size_t solver = 0, reference = 0;
  int pairs = 0, reached = 0;
  double median = 0;
  Interval interval = {0, 0};                            // bootstrap of the median, 95 %
  std::vector<std::pair<std::size_t, int>> missed = {};  // problems, with the runs that never reached it
};

struct StudyAnalysis {
  std::vector<RunRow> runs;  // in the order of the plan
  std::vector<ProblemSummary> problems;
  std::vector<ContenderSummary> contenders;
  std::vector<PairComparison> pairs;
  std::vector<SpeedUp> speed_ups;  // every ordered pair
  std::string rank_blocks;         // what ranks are averaged over: "problems" or "problems × repetitions"
  int rank_block_count = 0;
  double friedman_p = 1;
  double critical_difference = 0;                      // Nemenyi, 0.05
  std::vector<std::vector<std::size_t>> equal_groups;  // contenders that ranks cannot tell apart
  std::vector<std::string> digit_misses;               // "nist.boxbod_1 lm: 0.3 digits": runs below 6
};

StudyAnalysis AnalyseStudy(const StudyPlan& plan, const std::vector<JobResult>& results);

}  // namespace frond
