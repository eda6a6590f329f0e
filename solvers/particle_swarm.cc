// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/particle_swarm.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace frond {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kConstrictionWeight = 0.7298;  // Clerc and Kennedy 2002, with c₁ = c₂ = 1.49618
constexpr double kFirstWeight = 0.9;            // θ_max and θ_min of eq. (14)
constexpr double kLastWeight = 0.4;

}  // namespace

double InertiaWeight(ParticleSwarmSettings::Inertia inertia, int iteration, int max_iterations) {
  if (inertia == ParticleSwarmSettings::Inertia::kConstriction) return kConstrictionWeight;
  return kFirstWeight - (kFirstWeight - kLastWeight) * iteration / max_iterations;
}

ParticleSwarm::ParticleSwarm(const SearchBox& box, const ParticleSwarmSettings& settings, Random* random)
    : box_(box),
      settings_(settings),
      random_(random),
      dimensions_(box.size()),
      informants_(Informants(settings.topology, settings.swarm_size)),
      position_(dimensions_ * settings.swarm_size),
      velocity_(position_.size()),
      best_objectives_(settings.swarm_size, kInfinity),
      best_objective_(kInfinity) {
  for (int i = 0; i < settings_.swarm_size; ++i) {
    for (std::size_t d = 0; d < dimensions_; ++d) {
      const double lower = box_.start_lower[d], upper = box_.start_upper[d];
      const double limit = settings_.velocity_limit * (upper - lower);
      const bool at_guess = settings_.start_at_guess && i == 0;
      const double drawn = random_->Uniform(lower, upper);
      const double x = at_guess ? box_.x[box_.index[d]] : drawn;
      position_[i * dimensions_ + d] = x;
      velocity_[i * dimensions_ + d] = std::clamp((random_->Uniform(lower, upper) - x) / 2, -limit, limit);
    }
  }
  best_ = position_;
}

bool ParticleSwarm::Learn(int particle, double objective) {
  if (!(objective < best_objectives_[particle])) return false;
  best_objectives_[particle] = objective;
  std::copy_n(Position(particle), dimensions_,
              best_.begin() + static_cast<std::ptrdiff_t>(particle * dimensions_));
  if (!(objective < best_objective_)) return false;
  best_objective_ = objective;
  best_particle_ = particle;
  return true;
}

void ParticleSwarm::Move(double inertia_weight) {
  for (int i = 0; i < settings_.swarm_size; ++i) {
    const int informant = BestInformant(informants_[i], best_objectives_);
    MoveParticle(i, best_.data() + informant * dimensions_, inertia_weight);
  }
}

void ParticleSwarm::MoveParticle(int particle, const double* informant_best, double inertia_weight) {
  for (std::size_t d = 0; d < dimensions_; ++d) {
    const std::size_t k = particle * dimensions_ + d;
    double& x = position_[k];
    double& v = velocity_[k];
    const double r1 = random_->Uniform(), r2 = random_->Uniform();
    const double limit = settings_.velocity_limit * (box_.start_upper[d] - box_.start_lower[d]);
    v = inertia_weight * v + settings_.cognitive * r1 * (best_[k] - x) +
        settings_.social * r2 * (informant_best[d] - x);
    v = std::clamp(v, -limit, limit);
    x += v;
    const double bound = std::clamp(x, box_.lower[d], box_.upper[d]);
    if (x == bound) continue;
    switch (settings_.boundary) {
      case ParticleSwarmSettings::Boundary::kClamp:
        x = bound;
        break;
      case ParticleSwarmSettings::Boundary::kReflect:
        x = std::clamp(2 * bound - x, box_.lower[d], box_.upper[d]);
        v = -v;
        break;
      case ParticleSwarmSettings::Boundary::kAbsorb:
        x = bound;
        v = 0;
        break;
    }
  }
}

}  // namespace frond
