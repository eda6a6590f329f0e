// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "base/random.h"

namespace frond {

// Who informs whom in a particle swarm.
enum class SwarmTopology {
  kGlobal,      // everyone informs everyone: G_best of the paper
  kRing,        // each particle is informed by itself and its two neighbours
  kVonNeumann,  // by itself and its four neighbours on a torus of rows × columns
  kRandom,  // each particle informs itself and K others, drawn anew when an iteration found no better best
};

// For each particle, the particles that inform it, itself among them, in ascending order. Not for kRandom.
// Throws std::invalid_argument for a von Neumann swarm of TorusRows 1.
std::vector<std::vector<int>> Informants(SwarmTopology topology, int swarm_size);

// The rows of the most nearly square torus of swarm_size particles; 1 for primes.
int TorusRows(int swarm_size);

// Every particle informs itself and `informed` others drawn with replacement (Clerc 2012: 3).
std::vector<std::vector<int>> RandomInformants(int swarm_size, int informed, Random* random);

// The informant with the least best objective; the first one of equals.
int BestInformant(std::span<const int> informants, std::span<const double> best_objectives);

}  // namespace frond
