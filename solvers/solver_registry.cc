// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <utility>

#include "base/errors.h"
#include "solvers/ceres_solvers.h"
#include "solvers/hybrid.h"
#include "solvers/multistart.h"
#include "solvers/nlopt_solvers.h"
#include "solvers/pagmo_solvers.h"
#include "solvers/particle_swarm.h"
#include "solvers/solver.h"

namespace frond {

const char* TerminationName(Termination termination) {
  switch (termination) {
    case Termination::kConverged:
      return "converged";
    case Termination::kTarget:
      return "target";
    case Termination::kEvaluationBudget:
      return "evaluation_budget";
    case Termination::kTimeBudget:
      return "time_budget";
    case Termination::kIterationLimit:
      return "iteration_limit";
    case Termination::kStalled:
      return "stalled";
    case Termination::kFailed:
      return "failed";
  }
  return "failed";
}

const std::vector<SolverType>& SolverTypes() {
  static const std::vector<SolverType> types = [] {
    std::vector<SolverType> list = {
        LmSolverType(),           DoglegSolverType(),        BfgsSolverType(),
        LbfgsSolverType(),        ParticleSwarmSolverType(), PsoLmSolverType(),
        MultistartLmSolverType(),
    };
    for (SolverType& type : PagmoSolverTypes()) list.push_back(std::move(type));
    for (SolverType& type : NloptSolverTypes()) list.push_back(std::move(type));
    std::sort(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
    return list;
  }();
  return types;
}

const SolverType& FindSolverType(const std::string& name) {
  std::vector<std::string> names;
  std::string all;
  for (const SolverType& type : SolverTypes()) {
    if (type.name == name) return type;
    names.push_back(type.name);
    all += (all.empty() ? "" : ", ") + type.name;
  }
  const std::string nearest = NearestWord(name, names);
  throw ConfigError("unknown solver '" + name + "'" +
                    (nearest.empty() ? ", expected one of " + all : " (did you mean '" + nearest + "'?)"));
}

}  // namespace frond
