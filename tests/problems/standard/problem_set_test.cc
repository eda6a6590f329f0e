// SPDX-License-Identifier: BSD-3-Clause
#include "problems/standard/problem_set.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/errors.h"
#include "tests/problems/standard/fit_checks.h"

namespace frond {
namespace {

std::string MessageOf(const std::function<void()>& act) {
  try {
    act();
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "no ConfigError";
}

TEST(ProblemSetRegistry, Types_AreSortedAndFoundByName) {
  const std::vector<ProblemSetType>& types = StandardSetTypes();
  EXPECT_TRUE(std::is_sorted(types.begin(), types.end(), [](auto& a, auto& b) { return a.name < b.name; }));
  for (const ProblemSetType& type : types)
    EXPECT_EQ(&FindProblemSetType(StandardSetTypes(), type.name), &type);
  EXPECT_EQ(Problems("functions").size(), 6u);
  EXPECT_EQ(Problems("more_wild").size(), 53u);
  EXPECT_EQ(Problems("nist").size(), 54u);
}

TEST(ProblemSetRegistry, UnknownType_IsRefusedWithTheNearest) {
  EXPECT_EQ(MessageOf([] { FindProblemSetType(StandardSetTypes(), "nits"); }),
            "unknown problem set 'nits' (did you mean 'nist'?)");
  EXPECT_NE(MessageOf([] {
              FindProblemSetType(StandardSetTypes(), "xxxxxxxx");
            }).find("functions, more_wild, nist"),
            std::string::npos);
}

TEST(ProblemSets, EveryProblem_HasAUniqueNameAndAUsableFit) {
  for (const ProblemSetType& type : StandardSetTypes()) {
    std::set<std::string> names;
    for (const TestProblem& problem : Problems(type.name)) {
      SCOPED_TRACE(problem.name);
      EXPECT_TRUE(names.insert(problem.name).second);
      EXPECT_EQ(problem.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_"), std::string::npos);
      EXPECT_GT(problem.resolution, 0);
      const auto fit = problem.make();
      EXPECT_NO_THROW(CheckParameters(*fit));
      const std::vector<double> start = fit->StartVector();
      EXPECT_TRUE(std::isfinite(fit->Objective(start)));
      EXPECT_EQ(fit->Objective(start), problem.make()->Objective(start));
      EXPECT_TRUE(problem.best_x.empty() || problem.best_x.size() == start.size());
      const ParameterBlock& block = fit->parameters().at(0);
      const bool boxed = !block.start_lower.empty();
      const std::vector<double>&lower = boxed ? block.start_lower : block.lower,
            &upper = boxed ? block.start_upper : block.upper;
      ASSERT_EQ(lower.size(), start.size());
      ASSERT_EQ(upper.size(), start.size());
      for (std::size_t j = 0; j < start.size(); ++j) {
        EXPECT_TRUE(std::isfinite(lower[j]) && std::isfinite(upper[j]));
        EXPECT_TRUE(lower[j] < upper[j] && lower[j] <= start[j] && start[j] <= upper[j]);
      }
    }
  }
}

TEST(NistSet, Start_ChoosesOneBothOrTheBox) {
  const OptionValue misra = std::string("misra1a");
  const auto names = [&](const std::string& start) {
    std::vector<std::string> list;
    for (const TestProblem& problem : Problems("nist", {{"problem", misra}, {"start", start}})) {
      list.push_back(problem.name);
    }
    return list;
  };
  EXPECT_EQ(names("both"), (std::vector<std::string>{"misra1a_1", "misra1a_2"}));
  EXPECT_EQ(names("1"), (std::vector<std::string>{"misra1a_1"}));
  EXPECT_EQ(names("2"), (std::vector<std::string>{"misra1a_2"}));
  EXPECT_EQ(names("box"), (std::vector<std::string>{"misra1a"}));
  const TestProblem box = Problems("nist", {{"problem", misra}, {"start", std::string("box")}}).at(0);
  EXPECT_EQ(box.make()->StartVector(), (std::vector<double>{250, 0.0005}));
  EXPECT_EQ(box.best_objective, 1.2455138894E-01 / 2);
  EXPECT_EQ(Problems("nist", {{"start", std::string("box")}}).size(), 27u);
}

TEST(NistSet, Problem_IsFoundInEitherCaseAndRefusedWithTheNearest) {
  EXPECT_EQ(Problems("nist", {{"problem", std::string("ENSO")}}).at(0).name, "enso_1");
  EXPECT_EQ(MessageOf([] {
              Problems("nist", {{"problem", std::string("Misra1x")}});
            }),
            "unknown problem 'Misra1x' (did you mean 'misra1a'?)");
}

TEST(FunctionSet, Names_TellThePlacement) {
  EXPECT_EQ(Problems("functions", {{"function", std::string("ackley")}}).at(0).name, "ackley_10");
  EXPECT_EQ(Problems("functions", {{"function", std::string("sphere")},
                                   {"dimension", std::int64_t{3}},
                                   {"shift", true},
                                   {"rotate", true},
                                   {"instance", std::int64_t{5}}})
                .at(0)
                .name,
            "sphere_3_shifted_rotated_5");
}

TEST(FunctionSet, InstanceThatChangesNothing_IsRefused) {
  EXPECT_EQ(MessageOf([] {
              Problems("functions", {{"instance", std::int64_t{2}}});
            }),
            "instance is set but has no effect without shift or rotate");
  EXPECT_EQ(
      Problems("functions", {{"function", std::string("sphere")}, {"instance", std::int64_t{1}}}).size(), 1U)
      << "the default, which configs of runs spell out";
}

}  // namespace
}  // namespace frond
