// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "base/errors.h"
#include "solvers/solver.h"

namespace frond {
namespace {

TEST(SolverRegistry, Types_AreSortedUniqueAndDescribed) {
  std::string last;
  for (const SolverType& type : SolverTypes()) {
    EXPECT_LT(last, type.name);
    EXPECT_FALSE(type.help.empty()) << type.name;
    for (const OptionSpec& option : type.options) EXPECT_FALSE(option.help.empty()) << option.name;
    EXPECT_EQ(&FindSolverType(type.name), &type);
    EXPECT_NE(type.create(Options(type.options)), nullptr);
    last = type.name;
  }
}

TEST(SolverRegistry, DesignsSolvers_AreThere) {
  for (const char* name : {"lm", "dogleg", "lbfgs", "pso", "pso_lm"}) EXPECT_NO_THROW(FindSolverType(name));
}

TEST(SolverRegistry, UnknownName_ThrowsWithNearest) {
  try {
    FindSolverType("dogelg");
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(), "unknown solver 'dogelg' (did you mean 'dogleg'?)");
  }
  try {
    FindSolverType("levenberg_marquardt");
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_NE(std::string(error.what())
                  .find("expected one of bfgs, dogleg, lbfgs, lm, multistart_lm, nlopt.bobyqa"),
              std::string::npos)
        << error.what();
  }
}

TEST(TerminationName, EachCause_HasItsOwn) {
  std::set<std::string> names;
  for (int cause = 0; cause <= static_cast<int>(Termination::kFailed); ++cause) {
    names.insert(TerminationName(static_cast<Termination>(cause)));
  }
  EXPECT_EQ(names.size(), 7U);
  EXPECT_TRUE(names.contains("evaluation_budget"));
}

}  // namespace
}  // namespace frond
