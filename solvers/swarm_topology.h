// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

namespace frond {

// Who informs whom in a particle swarm.
enum class SwarmTopology {
  kGlobal,  // everyone informs everyone: G_best of the paper
  kRing,    // each particle is informed by itself and its two neighbours
};

// For each particle, the particles that inform it, itself among them, in ascending order.
std::vector<std::vector<int>> Informants(SwarmTopology topology, int swarm_size);

// The informant with the least best objective; the first one of equals.
int BestInformant(std::span<const int> informants, std::span<const double> best_objectives);

}  // namespace frond
