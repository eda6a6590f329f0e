// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "base/options.h"
#include "base/random.h"
#include "solvers/search_box.h"
#include "solvers/solver.h"
#include "solvers/swarm_topology.h"

namespace frond {

// Particle swarm optimisation, eqs. (12)–(14) of Wu et al. 2021 (Sensors 21, 1304), after Kennedy and
// Eberhart 1995:
//
//   V ← θ V + c₁ r₁ (P_best − X) + c₂ r₂ (G_best − X)                                              (12)
//   X ← X + V                                                                                      (13)
//   θ = θ_max − (θ_max − θ_min) j / j_max                                                           (14)
//
// r₁ and r₂ are drawn anew in [0, 1) for each particle and dimension. All particles move, then all are
// evaluated (in parallel), then bests are updated: the result does not depend on the number of threads.
//
// Method kFullyInformed (Mendes, Kennedy and Neves 2004) lets all n informants but the particle itself pull,
// each by its own best P_k (their "U" topologies, the better ones):
//
//   V ← θ V + Σ_k (c₁ + c₂)/n r_k (P_k − X);
//
// by default on a ring: pulled by everyone at once, particles have little left to follow.
//
// Method kStandard2011 is SPSO-2011 (Clerc 2012; Zambrano-Bigiarini et al. 2013), which no rotation of the
// axes changes: with the gravity centre G = X + c/3 (P_best + L_best − 2X) (without the term of L_best, and
// c/2, where the particle is its own best informant), X′ drawn about G in a ball of radius |G − X|,
//
//   V ← θ V + X′ − X,   X ← X + V,   θ = 1/(2 ln 2),   c = ½ + ln 2,
//
// particles put on the bound they crossed, their velocity there times −½; random informants by default.
struct ParticleSwarmSettings {
  enum class Method { kCanonical, kFullyInformed, kStandard2011 };
  // The paper's settings: swarm_size 5, iterations 10, kLinear, cognitive = social = 2.
  enum class Inertia {
    kConstriction,  // constant θ = 0.7298 with c = 1.49618 (Clerc and Kennedy 2002)
    kLinear,        // eq. (14), 0.9 → 0.4
  };
  enum class Boundary {  // what happens to a particle beyond a bound
    kClamp,              // put on the bound, its velocity kept
    kReflect,            // mirrored at the bound with its velocity (on the bound if that is outside again)
    kAbsorb,             // put on the bound, at rest in that direction
  };

  Method method = Method::kCanonical;
  int swarm_size = 40;
  // Batches after the first. None: as many as a budget of evaluations or seconds allows; 1000 without one.
  std::optional<int> iterations;
  Inertia inertia = Inertia::kConstriction;
  double cognitive = 1.49618, social = 1.49618;  // c₁, c₂
  double velocity_limit = 0.5;                   // largest |V| a step, as a share of the start box
  Boundary boundary = Boundary::kReflect;
  SwarmTopology topology = SwarmTopology::kGlobal;
  int informed = 3;  // kRandom: particles that each one informs beside itself
  bool asynchronous =
      false;  // a particle learns from those moved before it: no batches, one evaluation at a time
  bool start_at_guess = true;  // the first particle starts at the fit's start, wherever the box
  std::vector<double>
      guesses;  // further particles start here: the searched values, one guess after the other
};

// θ of iteration j = 1 …; beyond j_max as at j_max.
double InertiaWeight(ParticleSwarmSettings::Inertia inertia, int iteration, int max_iterations);

// The particles' positions, velocities and bests, over the searched values of a box. Knows no objective.
class ParticleSwarm {
 public:
  // Positions uniform in the start box, velocities half-way to another such point. All random numbers are
  // drawn here and in Move, from `random`, in a fixed order.
  ParticleSwarm(const SearchBox& box, const ParticleSwarmSettings& settings, Random* random);

  int size() const { return settings_.swarm_size; }
  const double* Position(int particle) const { return position_.data() + particle * dimensions_; }
  const double* Velocity(int particle) const { return velocity_.data() + particle * dimensions_; }

  // Takes an evaluated objective at the particle's position, +∞ where there is none. True where it is the
  // best of all so far.
  bool Learn(int particle, double objective);

  // The method's step for all particles, with its boundary rule. SPSO-2011 has an inertia weight of its own.
  void Move(double inertia_weight);

  // The same one particle at a time, where bests are to be learnt in between: BeginMove, then MoveOne for
  // each.
  void BeginMove();
  void MoveOne(int particle, double inertia_weight);

  const std::vector<double>& positions() const { return position_; }  // of all particles, one after the other
  double best_objective() const { return best_objective_; }
  const double* best_position() const { return best_.data() + best_particle_ * dimensions_; }

 private:
  void Place(int particle);
  void MoveParticle(int particle, const double* informant_best, double inertia_weight);
  void MoveFullyInformed(int particle, double inertia_weight);
  void MoveStandard(int particle, int informant);
  void Step(std::size_t d, double* x, double* v) const;

  const SearchBox& box_;
  const ParticleSwarmSettings settings_;
  Random* random_;
  std::size_t dimensions_;
  std::vector<std::vector<int>> informants_;
  bool improved_ = true;                            // the best of all, since the last Move
  std::vector<double> position_, velocity_, best_;  // swarm_size × dimensions
  std::vector<double> best_objectives_;             // of each particle
  double best_objective_;
  int best_particle_ = 0;
  std::vector<double> ball_;  // SPSO-2011's draw, dimensions
};

std::vector<OptionSpec> ParticleSwarmSpecs();

// Throws ConfigError for combinations: settings that SPSO-2011 does not have, a von Neumann swarm of a prime
// size, `informed` without random informants.
ParticleSwarmSettings ParticleSwarmSettingsFrom(const Options& options);

// `pso`. Minimises the fit's objective; NaN counts as +∞. The evaluation budget is kept exactly: the last
// batch is cut short. On the target or the time limit it stops within the batch's evaluations (the target's
// batch is finished, for the same count whatever the threads).
SolverType ParticleSwarmSolverType();

}  // namespace frond
