// SPDX-License-Identifier: BSD-3-Clause
// The fit, the run and the problem set of docs/add_a_fit.md.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/errors.h"
#include "docs/examples/sphere_experiment.h"
#include "docs/examples/sphere_fit.h"
#include "docs/examples/sphere_set.h"

namespace frond {
namespace {

// 60 points of the sphere about (10, -20, 5) with radius 7, by the golden angle.
std::vector<Eigen::Vector3d> KnownSphere() {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 60; ++i) {
    const double z = -1 + (2 * i + 1) / 60.0, phi = 2.399963 * i, r = std::sqrt(1 - z * z);
    points.emplace_back(10 + 7 * r * std::cos(phi), -20 + 7 * r * std::sin(phi), 5 + 7 * z);
  }
  return points;
}

SolverReport Solve(const FitProblem& fit, const std::string& solver, const Budget& budget) {
  const SolverType& type = FindSolverType(solver);
  return type.create(Options(type.options))->Solve(fit, budget, {.threads = 1, .seed = 3});
}

void ExpectKnownSphere(const std::vector<double>& x, double tolerance) {
  ASSERT_EQ(x.size(), 4U);
  EXPECT_NEAR(x[0], 10, tolerance);
  EXPECT_NEAR(x[1], -20, tolerance);
  EXPECT_NEAR(x[2], 5, tolerance);
  EXPECT_NEAR(x[3], 7, tolerance);
}

TEST(SphereExample, OfAKnownSphere_FindsCentreAndRadiusByLm) {
  const SphereFit fit(KnownSphere(), 2);
  const SolverReport report = Solve(fit, "lm", {});
  ExpectKnownSphere(report.x, 1e-9);
  EXPECT_NEAR(fit.Metrics(report.x).at("radius"), 7, 1e-9);
  EXPECT_NEAR(fit.Metrics(report.x).at("rmse"), 0, 1e-9);
}

TEST(SphereExample, OfAKnownSphere_FindsCentreAndRadiusByPsoInItsStartBox) {
  ExpectKnownSphere(Solve(SphereFit(KnownSphere(), 2), "pso", {.max_evaluations = 20000}).x, 1e-5);
}

TEST(SphereExample, RunOfAConfig_MeasuresRadiusAndDistances) {
  const FitType type = SphereFitType();
  Options problem(type.options);
  problem.Set("start_radius", 2.0);
  RunInput input;
  input.cloud.points = KnownSphere();
  input.cloud.points.emplace_back(10, -20, 5 + 7.5);  // half a unit outside
  const SolverType& lm = FindSolverType("lm");
  const FitOutcome outcome = type.run(input, problem, *lm.create(Options(lm.options)), {}, {});
  EXPECT_NEAR(outcome.metrics.Number("radius"), 7, 0.05);
  ASSERT_EQ(outcome.signed_distances.size(), 61U);
  EXPECT_NEAR(outcome.signed_distances.back(), 0.5, 0.1);
  input.cloud.points.resize(3);
  EXPECT_THROW(type.run(input, problem, *lm.create(Options(lm.options)), {}, {}), InputError);
}

TEST(SphereSetExample, EveryProblem_HasItsKnownMinimum) {
  const ProblemSetType set = SphereCapSetType();
  const std::vector<TestProblem> problems = set.problems(Options(set.options));
  ASSERT_EQ(problems.size(), 3U);
  EXPECT_EQ(problems[1].name, "cap_60");
  for (const TestProblem& problem : problems) {
    const auto fit = problem.make();
    EXPECT_LE(fit->Objective(problem.best_x), problem.best_objective.value() + problem.resolution);
    EXPECT_EQ(fit->Objective(problem.best_x), problem.make()->Objective(problem.best_x));  // deterministic
    const SolverReport report = Solve(*fit, "lm", {.max_evaluations = 10000});
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(report.x[k], problem.best_x[k], 1e-6) << problem.name;
  }
}

TEST(SphereSetExample, WithNoise_DoesNotClaimToKnowTheMinimum) {
  const ProblemSetType set = SphereCapSetType();
  Options options(set.options);
  options.Set("noise", 0.01);
  options.Set("degrees", std::int64_t{30});
  const std::vector<TestProblem> problems = set.problems(options);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_FALSE(problems[0].best_objective.has_value());
  EXPECT_NEAR(Solve(*problems[0].make(), "lm", {}).x[3], 1, 0.1);
}

}  // namespace
}  // namespace frond
