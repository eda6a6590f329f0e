// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/particle_swarm.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace frond {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kConstrictionWeight = 0.7298;  // Clerc and Kennedy 2002, with c₁ = c₂ = 1.49618
constexpr double kFirstWeight = 0.9;            // θ_max and θ_min of eq. (14)
constexpr double kLastWeight = 0.4;
const double kStandardWeight = 1 / (2 * std::numbers::ln2);  // SPSO-2011
const double kStandardPull = 0.5 + std::numbers::ln2;

}  // namespace

double InertiaWeight(ParticleSwarmSettings::Inertia inertia, int iteration, int max_iterations) {
  if (inertia == ParticleSwarmSettings::Inertia::kConstriction) return kConstrictionWeight;
  return kFirstWeight - (kFirstWeight - kLastWeight) * std::min(iteration, max_iterations) / max_iterations;
}

ParticleSwarm::ParticleSwarm(const SearchBox& box, const ParticleSwarmSettings& settings, Random* random)
    : box_(box),
      settings_(settings),
      random_(random),
      dimensions_(box.size()),
      position_(dimensions_ * settings.swarm_size),
      velocity_(position_.size()),
      best_objectives_(settings.swarm_size, kInfinity),
      best_objective_(kInfinity),
      ball_(dimensions_) {
  if (settings.topology != SwarmTopology::kRandom) {
    informants_ = Informants(settings.topology, settings.swarm_size);
  }
  for (int i = 0; i < settings_.swarm_size; ++i) Place(i);
  best_ = position_;
}

void ParticleSwarm::Place(int particle) {
  const bool standard = settings_.method == ParticleSwarmSettings::Method::kStandard2011;
  const bool at_start = settings_.start_at_guess && particle == 0;
  const std::vector<double> start = at_start ? box_.StartPoint() : std::vector<double>();
  const std::size_t guess =
      static_cast<std::size_t>(particle - (settings_.start_at_guess ? 1 : 0)) * dimensions_;
  const bool at_guess = !at_start && guess < settings_.guesses.size();
  for (std::size_t d = 0; d < dimensions_; ++d) {
    const double lower = box_.start_lower[d], upper = box_.start_upper[d];
    double x = random_->Uniform(lower, upper);
    if (at_start) x = start[d];
    if (at_guess) x = settings_.guesses[guess + d];
    position_[particle * dimensions_ + d] = x;
    const double step = random_->Uniform(lower, upper) - x;
    const double limit = settings_.velocity_limit * (upper - lower);
    velocity_[particle * dimensions_ + d] = standard ? step : std::clamp(step / 2, -limit, limit);
  }
}

bool ParticleSwarm::Learn(int particle, double objective) {
  if (!(objective < best_objectives_[particle])) return false;
  best_objectives_[particle] = objective;
  std::copy_n(Position(particle), dimensions_,
              best_.begin() + static_cast<std::ptrdiff_t>(particle * dimensions_));
  if (!(objective < best_objective_)) return false;
  best_objective_ = objective;
  best_particle_ = particle;
  improved_ = true;
  return true;
}

void ParticleSwarm::Move(double inertia_weight) {
  BeginMove();
  for (int i = 0; i < settings_.swarm_size; ++i) MoveOne(i, inertia_weight);
}

void ParticleSwarm::BeginMove() {
  if (settings_.topology == SwarmTopology::kRandom && (informants_.empty() || !improved_)) {
    informants_ = RandomInformants(settings_.swarm_size, settings_.informed, random_);
  }
  improved_ = false;
}

void ParticleSwarm::MoveOne(int particle, double inertia_weight) {
  const auto informant = [&] {
    return BestInformant(informants_[static_cast<std::size_t>(particle)], best_objectives_);
  };
  switch (settings_.method) {
    case ParticleSwarmSettings::Method::kCanonical:
      MoveParticle(particle, best_.data() + informant() * dimensions_, inertia_weight);
      break;
    case ParticleSwarmSettings::Method::kFullyInformed:
      MoveFullyInformed(particle, inertia_weight);
      break;
    case ParticleSwarmSettings::Method::kStandard2011:
      MoveStandard(particle, informant());
      break;
  }
}

void ParticleSwarm::MoveStandard(int particle, int informant) {
  double* x = position_.data() + particle * dimensions_;
  double* v = velocity_.data() + particle * dimensions_;
  const double* own = best_.data() + particle * dimensions_;
  const double* other = best_.data() + informant * dimensions_;
  const auto offset = [&](std::size_t d) {  // of the gravity centre
    return particle == informant ? kStandardPull / 2 * (own[d] - x[d])
                                 : kStandardPull / 3 * (own[d] + other[d] - 2 * x[d]);
  };
  double radius = 0, length = 0;
  for (std::size_t d = 0; d < dimensions_; ++d) {
    radius += offset(d) * offset(d);
    ball_[d] = random_->Normal();
    length += ball_[d] * ball_[d];
  }
  const double scale = random_->Uniform() * std::sqrt(radius / length);
  for (std::size_t d = 0; d < dimensions_; ++d) {
    v[d] = kStandardWeight * v[d] + offset(d) + scale * ball_[d];
    x[d] += v[d];
    const double bound = std::clamp(x[d], box_.lower[d], box_.upper[d]);
    if (x[d] == bound) continue;
    x[d] = bound;
    v[d] *= -0.5;
  }
}

void ParticleSwarm::MoveParticle(int particle, const double* informant_best, double inertia_weight) {
  for (std::size_t d = 0; d < dimensions_; ++d) {
    const std::size_t k = particle * dimensions_ + d;
    double& x = position_[k];
    double& v = velocity_[k];
    const double r1 = random_->Uniform(), r2 = random_->Uniform();
    v = inertia_weight * v + settings_.cognitive * r1 * (best_[k] - x) +
        settings_.social * r2 * (informant_best[d] - x);
    Step(d, &x, &v);
  }
}

void ParticleSwarm::MoveFullyInformed(int particle, double inertia_weight) {
  const std::vector<int>& informants = informants_[static_cast<std::size_t>(particle)];
  // One that nobody else informs goes by its own best.
  const bool alone = informants.size() == 1;
  const double count = alone ? 1 : static_cast<double>(informants.size() - 1);
  const double pull = (settings_.cognitive + settings_.social) / count;
  for (std::size_t d = 0; d < dimensions_; ++d) {
    const std::size_t k = particle * dimensions_ + d;
    double sum = 0;
    for (const int other : informants) {
      if (other == particle && !alone) continue;
      sum += random_->Uniform() * (best_[other * dimensions_ + d] - position_[k]);
    }
    velocity_[k] = inertia_weight * velocity_[k] + pull * sum;
    Step(d, &position_[k], &velocity_[k]);
  }
}

// The limit on the velocity, eq. (13), and the boundary rule.
void ParticleSwarm::Step(std::size_t d, double* x, double* v) const {
  const double limit = settings_.velocity_limit * (box_.start_upper[d] - box_.start_lower[d]);
  *v = std::clamp(*v, -limit, limit);
  *x += *v;
  const double lower = box_.lower[d], upper = box_.upper[d];
  const double bound = std::clamp(*x, lower, upper);
  if (*x == bound) return;
  switch (settings_.boundary) {
    case ParticleSwarmSettings::Boundary::kClamp:
      *x = bound;
      break;
    case ParticleSwarmSettings::Boundary::kReflect:
      *x = std::clamp(2 * bound - *x, lower, upper);
      *v = -*v;
      break;
    case ParticleSwarmSettings::Boundary::kAbsorb:
      *x = bound;
      *v = 0;
      break;
  }
}

}  // namespace frond
