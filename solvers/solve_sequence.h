// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "solvers/solver.h"
#include "solvers/stopwatch.h"

namespace frond {

// Solves of one fit that run one after the other on one budget: counts add up, traces are joined, the best is
// kept. Time is the wall's since the sequence was made, what passes between the solves included.
class SolveSequence {
 public:
  explicit SolveSequence(const Budget& budget) : budget_(budget) {}

  // The budget of the solve that begins now: what those so far have left.
  Budget Begin();

  // Why no other solve may begin, if so. Progress is dated by the evaluation that brought it, inside its
  // solve.
  std::optional<Termination> Cause() const;

  // Takes the report of the solve begun last, with the objective of its x.
  void Add(const SolverReport& part, double objective);

  // An evaluation made between solves, to compare.
  void CountEvaluation() { ++report_.evaluations, ++report_.residual_evaluations; }

  bool empty() const { return !any_; }
  const SolverReport& report() const { return report_; }
  SolverReport Finish(Termination termination, std::string message);

 private:
  Budget budget_;
  Stopwatch stopwatch_;
  double began_ = 0;  // seconds, the solve begun last
  SolverReport report_;
  bool any_ = false;
  std::int64_t improved_at_ = 0;  // evaluations
};

}  // namespace frond
