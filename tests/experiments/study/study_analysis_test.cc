// SPDX-License-Identifier: BSD-3-Clause
// Every figure of a study of eight runs, worked by hand.
#include "experiments/study/study_analysis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "experiments/study/convergence_bands.h"

namespace frond {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kA = 0, kB = 1;

struct Study {
  StudyPlan plan;
  std::vector<JobResult> results;

  StudyAnalysis Analysis() const { return AnalyseStudy(plan, results); }
};

StudyPlan PlanFor(const std::vector<std::string>& contenders, int problems, int repetitions) {
  StudyPlan plan;
  plan.name = "by_hand";
  plan.settings.repetitions = repetitions;
  plan.settings.target = 0.1;
  plan.settings.stop_at_target = false;
  plan.settings.profile_targets = {0.5, 0.1};
  for (int p = 0; p < problems; ++p) {
    const std::string name = "p" + std::to_string(p);
    plan.problems.push_back({name, "set", Options({}), {name, {}}});
  }
  for (std::size_t c = 0; c < contenders.size(); ++c) {
    plan.solvers.push_back({contenders[c], "lm", Options({})});
    plan.contenders.push_back({contenders[c], c, {}});
  }
  for (std::size_t p = 0; p < plan.problems.size(); ++p) {
    for (int r = 0; r < repetitions; ++r) {
      for (std::size_t c = 0; c < contenders.size(); ++c) plan.jobs.push_back({p, c, r, "key"});
    }
  }
  return plan;
}

// A run that spent `evaluations` in all; a point of its trace is an evaluation count and the best so far, a
// tenth of a second an evaluation.
JobResult MadeRun(std::int64_t parameters, std::int64_t evaluations,
                  const std::vector<std::pair<int, double>>& trace) {
  JobResult result;
  result.start_objective = trace.front().second;
  result.free_parameters = parameters;
  result.report.termination = Termination::kConverged;
  result.report.evaluations = evaluations;
  result.report.seconds = static_cast<double>(evaluations) / 10;
  result.report.objective = trace.back().second;
  for (const auto& [at, best] : trace) result.report.trace.push_back({at, at / 10.0, best});
  return result;
}

JobResult FailedRun() {
  JobResult result;
  result.status = "failed";
  result.start_objective = kNone;
  return result;
}

// p0's least is published, 0; p1's is the best of its runs, 2.
Study MadeByHand() {
  Study study{PlanFor({"a", "b"}, 2, 2), {}};
  study.plan.problems[0].problem.best_objective = 0;
  study.results = {
      MadeRun(2, 24, {{1, 10}, {5, 4}, {10, 1}, {20, 0.5}}),  // p0, first repetition, a
      MadeRun(2, 50, {{1, 10}, {8, 6}, {40, 2}}),             // b
      MadeRun(2, 12, {{1, 10}, {6, 0.5}}),                    // second repetition, a
      MadeRun(2, 30, {{1, 10}, {30, 0.25}}),                  // b
      MadeRun(4, 16, {{1, 12}, {4, 5}, {16, 3}}),             // p1, first repetition, a
      MadeRun(4, 9, {{1, 12}, {9, 2}}),                       // b
      FailedRun(),                                            // second repetition, a
      MadeRun(4, 25, {{1, 22}, {25, 4}}),                     // b
  };
  return study;
}

std::vector<double> RunLengths(const StudyAnalysis& analysis) {
  std::vector<double> lengths;
  for (const RunRow& run : analysis.runs) lengths.push_back(run.run_length);
  return lengths;
}

// The share of a curve of steps at x: that of the last point at or before it.
double ShareOf(const Curve& curve, double x) {
  double share = 0;
  for (std::size_t k = 0; k < curve.x.size() && curve.x[k] <= x; ++k) share = curve.y[k];
  return share;
}

TEST(StudyAnalysis, LeastObjective_IsThePublishedOneOrTheBestOfTheStudy) {
  const StudyAnalysis analysis = MadeByHand().Analysis();
  EXPECT_TRUE(analysis.problems[0].least_is_known);
  EXPECT_EQ(analysis.problems[0].least, 0);
  EXPECT_FALSE(analysis.problems[1].least_is_known);
  EXPECT_EQ(analysis.problems[1].least, 2);
}

TEST(StudyAnalysis, RunLengths_AreTheEvaluationsUntilTheTargetOfEachScale) {
  Study study = MadeByHand();
  // f₀ scaled: targets 1, 1; 1, 1; 3, 3; -, 4.
  const std::vector<double> by_start = {10, kInfinity, 6, 30, 16, 9, kInfinity, 25};
  EXPECT_EQ(RunLengths(study.Analysis()), by_start);
  EXPECT_EQ(study.Analysis().runs[0].run_seconds, 1.0);
  EXPECT_EQ(study.Analysis().runs[1].run_seconds, kInfinity);
  study.plan.settings.scale = TargetScale::kRelative;  // 0; 4
  study.plan.settings.target = 1;
  EXPECT_EQ(RunLengths(study.Analysis()),
            (std::vector<double>{kInfinity, kInfinity, kInfinity, kInfinity, 16, 9, kInfinity, 25}));
  study.plan.settings.scale = TargetScale::kAbsolute;  // 0.5; 2.5
  study.plan.settings.target = 0.5;
  EXPECT_EQ(RunLengths(study.Analysis()),
            (std::vector<double>{20, kInfinity, 6, 30, kInfinity, 9, kInfinity, kInfinity}));
  study.plan.problems[0].problem.resolution = 2;  // differences below are none
  EXPECT_EQ(RunLengths(study.Analysis()),
            (std::vector<double>{10, 40, 6, 30, kInfinity, 9, kInfinity, kInfinity}));
}

TEST(StudyAnalysis, Gap_IsTheShareOfTheWayThatIsLeft) {
  const double expected[] = {0.05, 0.2, 0.05, 0.025, 0.1, 0, kInfinity, 0.1};
  const StudyAnalysis analysis = MadeByHand().Analysis();
  for (std::size_t k = 0; k < 8; ++k) EXPECT_DOUBLE_EQ(analysis.runs[k].gap, expected[k]) << k;
  Study below = MadeByHand();
  below.plan.problems[0].problem.best_objective = 1;  // runs that get below what was published are done
  EXPECT_EQ(below.Analysis().runs[0].gap, 0);
}

TEST(StudyAnalysis, Cells_HaveTheFiguresOfTheirRuns) {
  const StudyAnalysis analysis = MadeByHand().Analysis();
  struct Expected {
    int failed, successes;
    double running_time, run_length, median, best;
  };
  const Expected expected[2][2] = {{{0, 2, 8, 8, 0.5, 0.5}, {0, 1, 80, kInfinity, 1.125, 0.25}},
                                   {{1, 1, 16 + 16, kInfinity, kInfinity, 3}, {0, 2, 17, 17, 3, 2}}};
  // (The job that failed could not say what it spent: it is charged the 16 that another run of its problem
  // did.)
  for (std::size_t p = 0; p < 2; ++p) {
    for (std::size_t c = 0; c < 2; ++c) {
      const ProblemCell& cell = analysis.problems[p].cells[c];
      const Expected& want = expected[p][c];
      EXPECT_EQ(cell.runs, 2);
      EXPECT_EQ(cell.failed, want.failed);
      EXPECT_EQ(cell.successes, want.successes);
      EXPECT_DOUBLE_EQ(cell.expected_running_time, want.running_time);
      EXPECT_DOUBLE_EQ(cell.median_run_length, want.run_length);
      EXPECT_DOUBLE_EQ(cell.median_objective, want.median);
      EXPECT_DOUBLE_EQ(cell.best_objective, want.best);
      EXPECT_FALSE(cell.median_digits.has_value());
    }
  }
}

TEST(StudyAnalysis, OfRunsThatEndOnTheTarget_IsNotTheirOvershoot) {
  Study study{PlanFor({"a", "b"}, 1, 1), {}};
  study.plan.problems[0].problem.best_objective = 0;
  study.plan.settings.stop_at_target = true;
  study.plan.settings.scale = TargetScale::kAbsolute;
  study.plan.settings.target = 1;
  study.results = {MadeRun(1, 5, {{1, 10}, {5, 0.9}}), MadeRun(1, 50, {{1, 10}, {50, 0.1}})};
  const StudyAnalysis analysis = study.Analysis();
  EXPECT_EQ(analysis.runs[0].gap, 0);
  EXPECT_EQ(analysis.pairs[0].second_better, 0);
  const SpeedUp& a = analysis.speed_ups[0];  // of a over b
  EXPECT_EQ(a.reached, 1);
  EXPECT_DOUBLE_EQ(a.median, 50 / 5);
}

TEST(StudyAnalysis, SpeedUps_CountEveryRunWithAResult) {
  // As a hybrid's: its last look gives a rounding less than its trace.
  Study study{PlanFor({"a", "b"}, 1, 1), {}};
  study.results = {MadeRun(1, 5, {{1, 10}, {5, 1}}), MadeRun(1, 50, {{1, 10}, {50, 1}})};
  study.results[1].report.objective = 1 - 1e-15;
  EXPECT_EQ(study.Analysis().speed_ups[0].pairs, 1);
  EXPECT_EQ(study.Analysis().speed_ups[0].reached, 1);
}

TEST(StudyAnalysis, Contenders_HaveTheFiguresOfAllTheirRuns) {
  const StudyAnalysis analysis = MadeByHand().Analysis();
  const ContenderSummary &a = analysis.contenders[kA], &b = analysis.contenders[kB];
  EXPECT_EQ(a.name, "a");
  EXPECT_EQ(a.runs, 4);
  EXPECT_EQ(a.failed, 1);
  EXPECT_EQ(b.failed, 0);
  EXPECT_EQ(a.successes, 3);
  EXPECT_EQ(b.successes, 3);
  EXPECT_DOUBLE_EQ(a.expected_running_time, (10 + 6 + 16 + 16) / 3.0);
  EXPECT_DOUBLE_EQ(b.expected_running_time, (50 + 30 + 9 + 25) / 3.0);
  EXPECT_DOUBLE_EQ(a.median_run_length, (10 + 16) / 2.0);
  EXPECT_DOUBLE_EQ(b.median_run_length, (25 + 30) / 2.0);
  EXPECT_DOUBLE_EQ(b.median_seconds, (2.5 + 3.0) / 2);
  // Wilson's interval of 3 of 4 (Wilson 1927): (0.75 + z²/8 ± z √(0.1875/4 + z²/64)) / (1 + z²/4).
  EXPECT_NEAR(a.success_interval.lower, 0.300642, 1e-6);
  EXPECT_NEAR(a.success_interval.upper, 0.954413, 1e-6);
  EXPECT_LE(a.expected_running_time_interval.lower, a.expected_running_time);
  EXPECT_GE(a.expected_running_time_interval.upper, a.expected_running_time);
}

TEST(StudyAnalysis, RunLengthDistribution_IsOverAllRunsAndTargets) {
  const StudyAnalysis analysis = MadeByHand().Analysis();
  // a: 5, 6, 4, - for τ = 0.5 and 10, 6, 16, - for 0.1; b: 40, 30, 9, 25 and -, 30, 9, 25.
  const std::pair<double, double> a[] = {{3.9, 0}, {4, 1},  {5, 2},  {6, 4},
                                         {9.9, 4}, {10, 5}, {16, 6}, {1e9, 6}};
  for (const auto& [x, count] : a) EXPECT_EQ(ShareOf(analysis.contenders[kA].run_lengths, x), count / 8) << x;
  const std::pair<double, double> b[] = {{8.9, 0}, {9, 2}, {25, 4}, {30, 6}, {40, 7}, {1e9, 7}};
  for (const auto& [x, count] : b) EXPECT_EQ(ShareOf(analysis.contenders[kB].run_lengths, x), count / 8) << x;
}

TEST(StudyAnalysis, Profiles_HaveTheSharesOfMoreAndWildAndDolanAndMore) {
  const StudyAnalysis analysis = MadeByHand().Analysis();
  // Data profile: run lengths over n + 1 = 3, 3, 5, 5. a: 10/3, 2, 3.2, -; b: -, 10, 1.8, 5.
  const Curve &data_a = analysis.contenders[kA].data_profile, &data_b = analysis.contenders[kB].data_profile;
  const std::pair<double, double> a[] = {{1.99, 0}, {2, 0.25}, {3.21, 0.5}, {3.34, 0.75}, {1e9, 0.75}};
  for (const auto& [x, share] : a) EXPECT_EQ(ShareOf(data_a, x), share) << x;
  const std::pair<double, double> b[] = {{1.79, 0}, {1.81, 0.25}, {5, 0.5}, {10, 0.75}, {1e9, 0.75}};
  for (const auto& [x, share] : b) EXPECT_EQ(ShareOf(data_b, x), share) << x;
  // Performance profile: over the better of the two. a: 1, 1, 16/9, -; b: -, 5, 1, 1.
  for (const bool by_evaluations : {true, false}) {
    const auto curve = [&](std::size_t c) {
      const ContenderSummary& contender = analysis.contenders[c];
      return by_evaluations ? contender.performance_evaluations : contender.performance_seconds;
    };
    EXPECT_EQ(ShareOf(curve(kA), 1), 0.5);
    EXPECT_EQ(ShareOf(curve(kA), 1.77), 0.5);
    EXPECT_EQ(ShareOf(curve(kA), 1.78), 0.75);
    EXPECT_EQ(ShareOf(curve(kB), 1), 0.5);
    EXPECT_EQ(ShareOf(curve(kB), 4.99), 0.5);
    EXPECT_EQ(ShareOf(curve(kB), 5.01), 0.75);
    EXPECT_EQ(ShareOf(curve(kB), 1e9), 0.75);
  }
}

TEST(StudyAnalysis, Pairs_AreComparedRunByRun) {
  const StudyAnalysis analysis = MadeByHand().Analysis();
  ASSERT_EQ(analysis.pairs.size(), 1U);
  const PairComparison& pair = analysis.pairs[0];
  EXPECT_EQ(pair.first, kA);
  EXPECT_EQ(pair.second, kB);
  EXPECT_EQ(pair.first_better, 1);
  EXPECT_EQ(pair.second_better, 3);
  // Gaps differ by −0.15, 0.025, 0.1, ∞: ranks 3 | 1, 2, 4; 5 of 16 sums are at most 3.
  EXPECT_DOUBLE_EQ(pair.gap_p, 2 * 5.0 / 16);
  EXPECT_DOUBLE_EQ(pair.gap_p_holm, pair.gap_p);
  // Lengths by −∞, −24, 7, ∞: ranks 3.5, 2 | 1, 3.5; half of the sums are at most 4.5.
  EXPECT_DOUBLE_EQ(pair.length_p, 1);
}

TEST(StudyAnalysis, SpeedUps_CountNeverAsNothingAndLeaveOutWhatHasNoResult) {
  const StudyAnalysis analysis = MadeByHand().Analysis();
  ASSERT_EQ(analysis.speed_ups.size(), 2U);
  const SpeedUp &a_over_b = analysis.speed_ups[0], &b_over_a = analysis.speed_ups[1];
  // b ends at 2, 0.25, 2, 4 after 40, 30, 9, 25; a is there after 10, never, never, never.
  EXPECT_EQ(a_over_b.solver, kA);
  EXPECT_EQ(a_over_b.reference, kB);
  EXPECT_EQ(a_over_b.pairs, 4);
  EXPECT_EQ(a_over_b.reached, 1);
  EXPECT_EQ(a_over_b.median, 0);
  EXPECT_EQ(a_over_b.interval.lower, 0);
  EXPECT_LE(a_over_b.interval.upper, 4);
  // a ends at 0.5, 0.5, 3, - after 20, 6, 16; b is there never, after 30, after 9.
  EXPECT_EQ(b_over_a.pairs, 3);
  EXPECT_EQ(b_over_a.reached, 2);
  EXPECT_DOUBLE_EQ(b_over_a.median, 0.2);
}

TEST(StudyAnalysis, ConvergenceBand_HasTheQuartilesOfTheBestSoFar) {
  const StudyAnalysis analysis = MadeByHand().Analysis();
  const ProblemSummary::Band& band = analysis.problems[0].by_evaluations[kA];
  const std::vector<double>& places = band.median.x;
  ASSERT_EQ(places.size(), 64U);
  EXPECT_EQ(places.front(), 1);
  EXPECT_EQ(places.back(), 20);
  EXPECT_NEAR(places[21], std::cbrt(20), 1e-12);  // a third of the logarithmic way
  for (std::size_t k = 0; k < places.size(); ++k) {
    // The two runs' best so far; type 7 puts the quartiles a quarter of the way in.
    const double x = places[k], first = x < 5 ? 10 : x < 10 ? 4 : x < 20 ? 1 : 0.5, second = x < 6 ? 10 : 0.5;
    const double low = std::min(first, second), high = std::max(first, second);
    EXPECT_DOUBLE_EQ(band.lower.y[k], 0.75 * low + 0.25 * high) << x;
    EXPECT_DOUBLE_EQ(band.median.y[k], (low + high) / 2) << x;
    EXPECT_DOUBLE_EQ(band.upper.y[k], 0.25 * low + 0.75 * high) << x;
  }
  EXPECT_DOUBLE_EQ(analysis.problems[0].by_seconds[kA].median.x.back(), 2);
}

TEST(StudyAnalysis, ConvergenceBand_CountsARunWithoutResultAsInfinite) {
  const ProblemSummary::Band band = MadeByHand().Analysis().problems[1].by_evaluations[kA];
  ASSERT_FALSE(band.median.y.empty());
  for (const double value : band.upper.y) EXPECT_EQ(value, kInfinity);
  const JobResult failed = FailedRun();
  const JobResult* const runs[] = {&failed, &failed};
  EXPECT_TRUE(ConvergenceBand(runs, EvaluationsOf).median.x.empty());
}

TEST(StudyAnalysis, Ranks_AreByRunLengthAndBehindThemByGap) {
  Study study{PlanFor({"slow", "near", "nearer", "failed", "fast"}, 1, 1), {}};
  study.plan.problems[0].problem.best_objective = 0;
  study.results = {MadeRun(2, 90, {{1, 10}, {90, 0.5}}), MadeRun(2, 9, {{1, 10}, {9, 6}}),
                   MadeRun(2, 9, {{1, 10}, {9, 3}}), FailedRun(), MadeRun(2, 9, {{1, 10}, {9, 0.9}})};
  const StudyAnalysis analysis = study.Analysis();
  const double expected[] = {2, 4, 3, 5, 1};
  for (std::size_t c = 0; c < 5; ++c) EXPECT_EQ(analysis.contenders[c].mean_rank, expected[c]) << c;
  EXPECT_EQ(analysis.rank_blocks, "problems × repetitions");
  EXPECT_EQ(analysis.rank_block_count, 1);
  EXPECT_EQ(MadeByHand().Analysis().contenders[kA].mean_rank, 1.5);
  EXPECT_EQ(MadeByHand().Analysis().rank_block_count, 4);
}

TEST(StudyAnalysis, Ranks_OverTenProblemsOrMore_AreByTheirMedians) {
  Study study{PlanFor({"a", "b"}, 10, 3), {}};
  for (StudyProblem& problem : study.plan.problems) problem.problem.best_objective = 0;
  for (int p = 0; p < 10; ++p) {
    for (int r = 0; r < 3; ++r) {  // a is the better one but for each first repetition
      study.results.push_back(MadeRun(2, 20, {{1, 10}, {r == 0 ? 20 : 5, 0}}));
      study.results.push_back(MadeRun(2, 20, {{1, 10}, {10, 0}}));
    }
  }
  const StudyAnalysis analysis = study.Analysis();
  EXPECT_EQ(analysis.rank_blocks, "problems");
  EXPECT_EQ(analysis.rank_block_count, 10);
  EXPECT_EQ(analysis.contenders[kA].mean_rank, 1);
  EXPECT_EQ(analysis.contenders[kB].mean_rank, 2);
  // Nemenyi for 2 and 10: 1.960 √(2 · 3 / 60).
  EXPECT_NEAR(analysis.critical_difference, 1.960 * std::sqrt(0.1), 1e-3);
  EXPECT_TRUE(analysis.equal_groups.empty());
}

TEST(StudyAnalysis, Digits_AreCountedWhereTheFitMeasuresThem) {
  Study study = MadeByHand();
  const double digits[] = {7, 3, 9.5, 6};
  for (std::size_t k = 0; k < 4; ++k) study.results[k].metrics.Set("digits", digits[k]);
  StudyAnalysis analysis = study.Analysis();
  EXPECT_EQ(analysis.contenders[kA].digits_at_least, (std::vector<int>{2, 2, 1}));
  EXPECT_EQ(analysis.contenders[kB].digits_at_least, (std::vector<int>{1, 1, 0}));
  EXPECT_DOUBLE_EQ(analysis.problems[0].cells[kB].median_digits.value_or(-1), 4.5);
  EXPECT_FALSE(analysis.problems[1].cells[kB].median_digits.has_value());
  // p1 measures none: it misses none.
  EXPECT_EQ(analysis.digit_misses, std::vector<std::string>{"p0, b: 1 of 2 runs below 6 digits"});
  study.results[0] = FailedRun();  // and a run without result misses all
  EXPECT_EQ(study.Analysis().digit_misses, (std::vector<std::string>{"p0, a: 1 of 2 runs below 6 digits",
                                                                     "p0, b: 1 of 2 runs below 6 digits"}));
  study.plan.settings.stop_at_target = true;  // p0's runs then end at the target
  EXPECT_FALSE(study.Analysis().contenders[kA].digits_at_least.has_value());
}

TEST(StudyAnalysis, OfOneContenderOrFailuresAlone_IsWhole) {
  Study one{PlanFor({"a"}, 1, 1), {MadeRun(2, 5, {{1, 10}, {5, 1}})}};
  const StudyAnalysis lone = one.Analysis();
  EXPECT_EQ(lone.contenders[0].mean_rank, 1);
  EXPECT_TRUE(lone.pairs.empty());
  EXPECT_TRUE(lone.speed_ups.empty());
  EXPECT_EQ(lone.problems[0].least, 1);
  Study failures{PlanFor({"a", "b"}, 2, 2), std::vector<JobResult>(8, FailedRun())};
  const StudyAnalysis none = failures.Analysis();
  EXPECT_EQ(none.contenders[kA].failed, 4);
  EXPECT_EQ(none.contenders[kA].successes, 0);
  EXPECT_EQ(none.contenders[kA].expected_running_time, kInfinity);
  EXPECT_EQ(none.speed_ups[0].pairs, 0);
  EXPECT_EQ(none.pairs[0].gap_p, 1);
  EXPECT_EQ(none.contenders[kA].mean_rank, 1.5);
}

}  // namespace
}  // namespace frond
