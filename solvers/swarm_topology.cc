// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/swarm_topology.h"

#include <algorithm>
#include <numeric>

namespace frond {

std::vector<std::vector<int>> Informants(SwarmTopology topology, int swarm_size) {
  std::vector<std::vector<int>> informants(swarm_size);
  for (int i = 0; i < swarm_size; ++i) {
    std::vector<int>& mine = informants[i];
    switch (topology) {
      case SwarmTopology::kGlobal:
        mine.resize(swarm_size);
        std::iota(mine.begin(), mine.end(), 0);
        break;
      case SwarmTopology::kRing:
        mine = {(i + swarm_size - 1) % swarm_size, i, (i + 1) % swarm_size};
        std::sort(mine.begin(), mine.end());
        mine.erase(std::unique(mine.begin(), mine.end()), mine.end());
        break;
    }
  }
  return informants;
}

int BestInformant(std::span<const int> informants, std::span<const double> best_objectives) {
  return *std::min_element(informants.begin(), informants.end(),
                           [&](int a, int b) { return best_objectives[a] < best_objectives[b]; });
}

}  // namespace frond
