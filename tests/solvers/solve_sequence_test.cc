// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/solve_sequence.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace frond {
namespace {

SolverReport Part(double objective, std::int64_t found_at, std::int64_t evaluations) {
  SolverReport part;
  part.x = {objective};
  part.objective = objective;
  part.evaluations = evaluations;
  part.trace = {{1, 0, 100}, {found_at, 0, objective}, {evaluations, 0, objective}};
  return part;
}

TEST(SolveSequence, Progress_IsDatedByTheEvaluationThatBroughtIt) {
  SolveSequence sequence({.stall_evaluations = 50});
  sequence.Begin();
  sequence.Add(Part(3, 10, 40), 3);
  EXPECT_FALSE(sequence.Cause());
  sequence.Begin();
  sequence.Add(Part(2, 15, 60), 2);  // at 55 of 100
  EXPECT_FALSE(sequence.Cause());
  sequence.Begin();
  sequence.Add(Part(9, 2, 5), 9);  // 105
  EXPECT_EQ(sequence.Cause(), Termination::kStalled);
  EXPECT_EQ(sequence.report().x, std::vector<double>{2});
}

TEST(SolveSequence, Time_IncludesWhatPassesBetweenSolves) {
  SolveSequence sequence({.max_seconds = 0.03});
  sequence.Begin();
  sequence.Add(Part(3, 10, 40), 3);
  EXPECT_FALSE(sequence.Cause());
  std::this_thread::sleep_for(std::chrono::milliseconds(40));
  EXPECT_EQ(sequence.Cause(), Termination::kTimeBudget);
  EXPECT_LE(sequence.Begin().max_seconds, 0);
  sequence.Add(Part(3, 10, 40), 3);
  EXPECT_GE(sequence.report().trace.back().seconds, 0.04);
  EXPECT_GE(sequence.Finish(Termination::kTimeBudget, "").seconds, 0.04);
}

}  // namespace
}  // namespace frond
