// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/particle_swarm.h"

#include <ceres/sphere_manifold.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "base/errors.h"
#include "tests/solvers/test_fits.h"

namespace frond {
namespace {

using Values = std::vector<double>;
using Settings = ParticleSwarmSettings;
using NamedOptions = std::vector<std::pair<std::string, OptionValue>>;

SolverReport Solve(const FitProblem& fit, const NamedOptions& options, const Budget& budget = {},
                   std::uint64_t seed = 1) {
  return MakeSolver("pso", options)->Solve(fit, budget, {.threads = 1, .seed = seed});
}

std::string MessageOfSolve(const FitProblem& fit, const NamedOptions& options) {
  try {
    Solve(fit, options);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

RosenbrockFit BoxedRosenbrock() {
  RosenbrockFit fit;
  SetBox(-5, 5, &fit);
  return fit;
}

SearchBox UnitBox(std::size_t dimensions, double bound) {
  SearchBox box;
  box.x.assign(dimensions, 0.25);
  for (std::size_t d = 0; d < dimensions; ++d) box.index.push_back(d);
  box.lower.assign(dimensions, -bound);
  box.upper.assign(dimensions, bound);
  box.start_lower.assign(dimensions, 0);
  box.start_upper.assign(dimensions, 1);
  return box;
}

TEST(InertiaWeight, Linear_FollowsEquation14) {
  EXPECT_DOUBLE_EQ(InertiaWeight(Settings::Inertia::kLinear, 1, 10), 0.85);
  EXPECT_DOUBLE_EQ(InertiaWeight(Settings::Inertia::kLinear, 5, 10), 0.65);
  EXPECT_DOUBLE_EQ(InertiaWeight(Settings::Inertia::kLinear, 10, 10), 0.4);
  EXPECT_DOUBLE_EQ(InertiaWeight(Settings::Inertia::kConstriction, 3, 10), 0.7298);
}

TEST(ParticleSwarm, Move_FollowsEquations12And13) {
  // The random numbers are drawn again beside the swarm, in its order: two a value at the start (position,
  // velocity), then r₁, r₂ a value.
  constexpr std::size_t kDimensions = 3;
  const SearchBox box = UnitBox(kDimensions, 1e9);
  Settings settings;
  settings.swarm_size = 2;
  settings.cognitive = 1.3;
  settings.social = 1.7;
  settings.velocity_limit = 1e9;
  settings.start_at_guess = false;
  Random random(4), again(4);
  ParticleSwarm swarm(box, settings, &random);

  std::array<std::array<double, kDimensions>, 2> x, v;
  for (int i = 0; i < 2; ++i) {
    for (std::size_t d = 0; d < kDimensions; ++d) {
      x[i][d] = again.Uniform();
      v[i][d] = (again.Uniform() - x[i][d]) / 2;
      EXPECT_DOUBLE_EQ(swarm.Position(i)[d], x[i][d]);
      EXPECT_DOUBLE_EQ(swarm.Velocity(i)[d], v[i][d]);
    }
  }
  const auto own_best = x;
  EXPECT_TRUE(swarm.Learn(0, 2.0));
  EXPECT_TRUE(swarm.Learn(1, 1.0));
  for (const bool second : {false, true}) {
    swarm.Move(0.6);
    for (int i = 0; i < 2; ++i) {
      for (std::size_t d = 0; d < kDimensions; ++d) {
        const double r1 = again.Uniform(), r2 = again.Uniform();
        v[i][d] =
            0.6 * v[i][d] + 1.3 * r1 * (own_best[i][d] - x[i][d]) + 1.7 * r2 * (own_best[1][d] - x[i][d]);
        x[i][d] += v[i][d];
        EXPECT_NEAR(swarm.Position(i)[d], x[i][d], 1e-15);
      }
    }
    if (!second) {
      EXPECT_FALSE(swarm.Learn(0, 3.0));  // worse than its own best: nothing is learnt
      EXPECT_FALSE(swarm.Learn(1, std::numeric_limits<double>::infinity()));
    }
  }
  EXPECT_EQ(swarm.best_objective(), 1.0);
  EXPECT_EQ(swarm.best_position()[0], own_best[1][0]);
}

TEST(ParticleSwarm, StartAtGuess_PutsTheFirstParticleThere) {
  const SearchBox box = UnitBox(2, 10);
  Random random(1);
  const ParticleSwarm swarm(box, Settings(), &random);
  EXPECT_EQ(swarm.Position(0)[0], 0.25);
  EXPECT_EQ(swarm.Position(0)[1], 0.25);
  EXPECT_NE(swarm.Position(1)[0], 0.25);
}

TEST(ParticleSwarm, VelocityLimit_IsAShareOfTheStartBox) {
  SearchBox box = UnitBox(2, 1e9);
  box.start_upper = {1, 100};
  Settings settings;
  settings.velocity_limit = 0.1;
  settings.cognitive = settings.social = 4;
  Random random(2);
  ParticleSwarm swarm(box, settings, &random);
  for (int step = 0; step < 20; ++step) {
    for (int i = 0; i < swarm.size(); ++i) {
      EXPECT_LE(std::abs(swarm.Velocity(i)[0]), 0.1);
      EXPECT_LE(std::abs(swarm.Velocity(i)[1]), 10);
      swarm.Learn(i, std::abs(swarm.Position(i)[0] - 50));
    }
    swarm.Move(0.9);
  }
}

TEST(ParticleSwarm, EachBoundary_KeepsParticlesInsideInItsOwnWay) {
  for (const auto boundary :
       {Settings::Boundary::kClamp, Settings::Boundary::kReflect, Settings::Boundary::kAbsorb}) {
    const SearchBox box = UnitBox(1, 1.0);
    Settings settings;
    settings.boundary = boundary;
    settings.velocity_limit = 5;
    settings.start_at_guess = false;
    settings.cognitive = settings.social = 0;
    Random random(3);
    ParticleSwarm swarm(box, settings, &random);
    int met = 0;
    for (int step = 0; step < 8; ++step) {
      for (int i = 0; i < swarm.size(); ++i) swarm.Learn(i, 0);
      Values x, v;
      for (int i = 0; i < swarm.size(); ++i) {
        x.push_back(*swarm.Position(i));
        v.push_back(*swarm.Velocity(i));
      }
      swarm.Move(1.5);  // no pull: V ← 1.5 V
      for (int i = 0; i < swarm.size(); ++i) {
        const double now = *swarm.Position(i), velocity = *swarm.Velocity(i);
        ASSERT_GE(now, -1);
        ASSERT_LE(now, 1);
        const double step_v = std::clamp(1.5 * v[i], -5.0, 5.0);
        const double free = x[i] + step_v;
        if (std::abs(free) <= 1) continue;
        ++met;
        const double bound = free > 0 ? 1 : -1;
        if (boundary == Settings::Boundary::kClamp) {
          EXPECT_EQ(now, bound);
          EXPECT_EQ(velocity, step_v);
        } else if (boundary == Settings::Boundary::kAbsorb) {
          EXPECT_EQ(now, bound);
          EXPECT_EQ(velocity, 0);
        } else {
          EXPECT_DOUBLE_EQ(now, std::clamp(2 * bound - free, -1.0, 1.0));
          EXPECT_EQ(velocity, -step_v);
        }
      }
    }
    EXPECT_GT(met, 10);
  }
}

TEST(SwarmTopology, Ring_HasThreeInformants) {
  const auto ring = Informants(SwarmTopology::kRing, 5);
  EXPECT_EQ(ring[0], (std::vector<int>{0, 1, 4}));
  EXPECT_EQ(ring[2], (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(Informants(SwarmTopology::kRing, 1)[0], (std::vector<int>{0}));
  EXPECT_EQ(Informants(SwarmTopology::kRing, 2)[1], (std::vector<int>{0, 1}));
  EXPECT_EQ(Informants(SwarmTopology::kGlobal, 3)[1], (std::vector<int>{0, 1, 2}));
  const Values best = {3, 1, 2, 1, 0};
  EXPECT_EQ(BestInformant(ring[2], best), 1) << "the first of equals";
  EXPECT_EQ(BestInformant(ring[0], best), 4);
}

TEST(SwarmTopology, VonNeumann_HasFourNeighboursOnATorus) {
  EXPECT_EQ(TorusRows(40), 5);
  EXPECT_EQ(TorusRows(20), 4);
  EXPECT_EQ(TorusRows(7), 1);
  const auto torus = Informants(SwarmTopology::kVonNeumann, 12);  // 3 rows of 4
  EXPECT_EQ(torus[5], (std::vector<int>{1, 4, 5, 6, 9}));
  EXPECT_EQ(torus[0], (std::vector<int>{0, 1, 3, 4, 8}));
  EXPECT_THROW(Informants(SwarmTopology::kVonNeumann, 5), std::invalid_argument);
}

TEST(SwarmTopology, Random_EachInformsItselfAndKDrawn) {
  Random random(5);
  double links = 0;
  constexpr int kDraws = 2000, kSize = 20;
  for (int draw = 0; draw < kDraws; ++draw) {
    const auto informants = RandomInformants(kSize, 3, &random);
    for (int i = 0; i < kSize; ++i) {
      EXPECT_TRUE(std::find(informants[i].begin(), informants[i].end(), i) != informants[i].end());
      EXPECT_TRUE(std::is_sorted(informants[i].begin(), informants[i].end()));
      links += static_cast<double>(informants[i].size());
    }
  }
  // Each ordered pair of others is linked with probability 1 − (1 − 1/20)³.
  const double expected = 1 + (kSize - 1) * (1 - std::pow(1 - 1.0 / kSize, 3));
  EXPECT_NEAR(links / (kDraws * kSize), expected, 0.02);
}

TEST(Spso2011, Step_LiesInTheBallAboutTheGravityCentre) {
  // Two particles in the plane, the second one's best the better: G₀ = x + c/3 (p₀ + p₁ − 2x), G₁ = x + c/2
  // (p₁ − x).
  const double weight = 1 / (2 * std::log(2.0)), c = 0.5 + std::log(2.0);
  const SearchBox box = UnitBox(2, 1e9);
  Settings settings;
  settings.method = Settings::Method::kStandard2011;
  settings.swarm_size = 2;
  settings.start_at_guess = false;
  double farthest = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Random random(seed);
    ParticleSwarm swarm(box, settings, &random);
    const std::vector<double> best = swarm.positions();
    swarm.Learn(0, 2);
    swarm.Learn(1, 1);
    swarm.Move(0);
    for (int i = 0; i < 2; ++i) swarm.Learn(i, 10);
    const std::vector<double> x = swarm.positions();
    std::vector<double> v = {swarm.Velocity(0)[0], swarm.Velocity(0)[1]};
    swarm.Move(0);
    double radius = 0, distance = 0;
    for (int d = 0; d < 2; ++d) {
      const double centre = c / 3 * (best[d] + best[2 + d] - 2 * x[d]);
      radius += centre * centre;
      distance += std::pow(swarm.Position(0)[d] - x[d] - weight * v[d] - centre, 2);
    }
    EXPECT_LE(std::sqrt(distance), std::sqrt(radius) * (1 + 1e-12));
    farthest = std::max(farthest, std::sqrt(distance / radius));
  }
  EXPECT_GT(farthest, 0.95);
}

TEST(Pso, EveryVariant_ReachesTheMinimumOfBoxedRosenbrock) {
  for (const char* topology : {"gbest", "ring", "von_neumann", "random"}) {
    for (const char* method : {"canonical", "spso2011"}) {
      const SolverReport report =
          Solve(BoxedRosenbrock(),
                {{"topology", std::string(topology)}, {"method", std::string(method)}, {"iterations", 400}});
      EXPECT_LT(report.objective, 1e-5) << topology << ", " << method;
    }
  }
}

TEST(Pso, OnBoxedRosenbrock_ReachesMinimum) {
  for (const char* topology : {"gbest", "ring"}) {
    for (const char* boundary : {"clamp", "reflect", "absorb"}) {
      const SolverReport report = Solve(
          BoxedRosenbrock(),
          {{"topology", std::string(topology)}, {"boundary", std::string(boundary)}, {"iterations", 400}});
      EXPECT_LT(report.objective, 1e-6) << topology << ", " << boundary;
      EXPECT_EQ(report.termination, Termination::kIterationLimit);
      EXPECT_EQ(report.iterations, 400);
      EXPECT_EQ(report.evaluations, 40 * 401);
    }
  }
}

TEST(Pso, PapersSettings_NeverWorsenTheGuess) {
  // Five particles, ten iterations, around weights of 1 (MATH.md §2).
  LineFit fit;
  fit.blocks[0].start = {1, 1};
  const double start = fit.Objective(fit.StartVector());
  int improved = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const SolverReport report = Solve(fit,
                                      {{"swarm_size", 5},
                                       {"iterations", 10},
                                       {"inertia", std::string("linear")},
                                       {"cognitive", 2},
                                       {"social", 2},
                                       {"start_box", Values{0.9, 1.1}}},
                                      {}, seed);
    EXPECT_EQ(report.evaluations, 55);
    EXPECT_LE(report.objective, start);
    improved += report.objective < start ? 1 : 0;
  }
  EXPECT_EQ(improved, 10);
}

TEST(Pso, UnboundedFitWithoutStartBox_NamesTheOption) {
  EXPECT_EQ(
      MessageOfSolve(RosenbrockFit(), {}),
      "parameter 'x'[0] has no finite bounds for solver 'pso' to start in: set its option 'start_box' to "
      "[lower, upper]");
  EXPECT_EQ(MessageOfSolve(RosenbrockFit(), {{"start_box", Values{-2, 2}}, {"iterations", 1}}), "accepted");
}

TEST(Pso, HalfBoundedFitWithoutStartBox_NamesTheValue) {
  RosenbrockFit fit = BoxedRosenbrock();
  fit.blocks[0].upper[1] = HUGE_VAL;
  EXPECT_EQ(MessageOfSolve(fit, {}).substr(0, 16), "parameter 'x'[1]");
}

TEST(Pso, StartBox_MustBeAnIntervalThatMeetsTheBounds) {
  EXPECT_EQ(MessageOfSolve(RosenbrockFit(), {{"start_box", Values{2, 2}}}),
            "option 'start_box' is [2, 2], expected [lower, upper] with lower < upper");
  EXPECT_EQ(MessageOfSolve(RosenbrockFit(), {{"start_box", Values{-HUGE_VAL, 2}}}),
            "option 'start_box' is [-inf, 2], expected [lower, upper] with lower < upper");
  EXPECT_EQ(MessageOfSolve(BoxedRosenbrock(), {{"start_box", Values{6, 7}}}),
            "option 'start_box' is [6, 7], outside of the bounds [-5, 5] of parameter 'x'[0]");
}

TEST(Pso, ParameterOnAManifold_IsRefusedByName) {
  RosenbrockFit fit = BoxedRosenbrock();
  fit.blocks[0].manifold = std::make_shared<ceres::SphereManifold<ceres::DYNAMIC>>(2);
  EXPECT_EQ(MessageOfSolve(fit, {}),
            "solver 'pso' cannot search parameter 'x', which lives on a manifold: use lm, dogleg, bfgs or "
            "lbfgs");
}

TEST(Pso, ConstantBlock_IsNotSearched) {
  Misra1aFit fit;
  fit.blocks[0].constant = true;
  fit.blocks[1].lower = {1e-5};
  fit.blocks[1].upper = {1e-2};
  const SolverReport report = Solve(fit, {{"iterations", 50}});
  EXPECT_EQ(report.x[0], 250);
  fit.blocks[1].constant = true;
  const SolverReport start = Solve(fit, {});
  EXPECT_EQ(start.evaluations, 1);
  EXPECT_EQ(start.x, fit.StartVector());
  EXPECT_DOUBLE_EQ(start.objective, fit.Objective(start.x));
}

TEST(Pso, LastBatch_IsCutToTheBudget) {
  for (const int budget : {1, 39, 40, 41, 100}) {
    const RosenbrockFit fit = BoxedRosenbrock();
    const SolverReport report = Solve(fit, {}, {.max_evaluations = budget});
    EXPECT_EQ(report.evaluations, budget);
    EXPECT_EQ(fit.calls->residual, budget);
    EXPECT_EQ(report.termination, Termination::kEvaluationBudget);
  }
}

TEST(Pso, LinearInertia_RunsItsCourseWithinTheBudget) {
  // 100 evaluations are 9 moves of 10 particles: the same run as one of 9 iterations.
  const NamedOptions linear = {{"inertia", std::string("linear")}, {"swarm_size", 10}};
  NamedOptions nine = linear;
  nine.emplace_back("iterations", 9);
  EXPECT_EQ(Solve(BoxedRosenbrock(), linear, {.max_evaluations = 100}).x, Solve(BoxedRosenbrock(), nine).x);
}

TEST(Pso, NanIsAsBadAsInfinity) {
  PartlyNanFit fit(-5, 0);
  SetBox(-10, 10, &fit);
  const SolverReport report = Solve(fit, {{"iterations", 100}});  // its guess is NaN
  EXPECT_NEAR(report.x[0], 1, 1e-6);
  EXPECT_TRUE(std::isfinite(report.trace.front().best_objective));
}

TEST(Pso, NoFiniteStart_FailsAtOnce) {
  PartlyNanFit fit(-5, 100);
  SetBox(-10, 10, &fit);
  const SolverReport report = Solve(fit, {});
  EXPECT_EQ(report.termination, Termination::kFailed);
  EXPECT_EQ(report.message,
            "no finite objective at any of the 40 points evaluated; set 'start_box' to where the fit can be "
            "evaluated");
  EXPECT_EQ(report.x, fit.StartVector());
}

TEST(Pso, Guesses_AreWhereFurtherParticlesStart) {
  RosenbrockFit fit = BoxedRosenbrock();
  const SolverReport report =
      Solve(fit, {{"guesses", Values{3, 3, 1, 1}}, {"iterations", 0}, {"swarm_size", 4}});
  EXPECT_EQ(report.x, (Values{1, 1}));
  EXPECT_EQ(report.trace.back().evaluations, 3);
}

TEST(Pso, InvalidCombinations_AreRefusedByName) {
  const auto message = [](const NamedOptions& options) { return MessageOfSolve(BoxedRosenbrock(), options); };
  EXPECT_EQ(message({{"method", std::string("spso2011")}, {"inertia", std::string("linear")}}),
            "option 'inertia' does not apply to 'method: spso2011'");
  EXPECT_EQ(
      message({{"topology", std::string("von_neumann")}, {"swarm_size", 7}}),
      "option 'swarm_size' is 7, which makes no torus for 'topology: von_neumann': take a product, such as "
      "4 * 5");
  EXPECT_EQ(message({{"informed", 4}}), "option 'informed' does not apply to 'topology: auto'");
  EXPECT_EQ(message({{"guesses", Values{1, 2, 3}}}),
            "option 'guesses' of solver 'pso' has 3 values, expected a multiple of the 2 free parameters");
  EXPECT_EQ(message({{"guesses", Values{1, 6}}}),
            "option 'guesses' of solver 'pso': value 2, 6, is outside of the fit's bounds [-5, 5]");
  EXPECT_EQ(message({{"guesses", Values{1, 1, 2, 2}}, {"swarm_size", 2}}),
            "option 'guesses' of solver 'pso' holds 2 guesses, more than 'swarm_size' 2 has particles for");
}

TEST(Pso, FipsWithoutTopology_IsARing) {
  const NamedOptions fips = {{"method", std::string("fips")}, {"iterations", 20}};
  NamedOptions ring = fips;
  ring.emplace_back("topology", std::string("ring"));
  EXPECT_EQ(Solve(BoxedRosenbrock(), fips).x, Solve(BoxedRosenbrock(), ring).x);
}

TEST(Pso, FitsOwnStartBox_IsWhereItStarts) {
  RosenbrockFit fit;
  fit.blocks[0].start_lower = {0.9, 0.9};
  fit.blocks[0].start_upper = {1.1, 1.1};
  const SolverReport report = Solve(fit, {{"start_at_guess", false}, {"iterations", 0}});
  for (const double x : report.x) EXPECT_NEAR(x, 1, 0.1);
}

TEST(Pso, OtherObjective_IsWhatItMinimises) {
  MinimaxFit fit(0, /*agree=*/false);
  SetBox(-10, 10, &fit);
  const SolverReport report = Solve(fit, {{"iterations", 100}});
  EXPECT_NEAR(report.x[0], 1, 1e-6);
  EXPECT_DOUBLE_EQ(report.objective, fit.Objective(report.x));
}

TEST(Pso, OptionsOutOfRange_AreRefused) {
  Options options(ParticleSwarmSpecs());
  EXPECT_THROW(options.Set("swarm_size", 0), ConfigError);
  EXPECT_THROW(options.Set("velocity_limit", 0), ConfigError);
  EXPECT_THROW(options.Set("inertia", std::string("quadratic")), ConfigError);
  EXPECT_THROW(options.Set("cognitive", -1), ConfigError);
}

}  // namespace
}  // namespace frond
