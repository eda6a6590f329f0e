// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/swarm_topology.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace frond {
namespace {

void SortOnce(std::vector<int>* indices) {
  std::sort(indices->begin(), indices->end());
  indices->erase(std::unique(indices->begin(), indices->end()), indices->end());
}

}  // namespace

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
        break;
      case SwarmTopology::kVonNeumann: {
        const int rows = TorusRows(swarm_size), columns = swarm_size / rows;
        if (rows < 2) throw std::invalid_argument("no torus of so many particles");
        const int row = i / columns, column = i % columns;
        mine = {i, (row + 1) % rows * columns + column, (row + rows - 1) % rows * columns + column,
                row * columns + (column + 1) % columns, row * columns + (column + columns - 1) % columns};
        break;
      }
      case SwarmTopology::kRandom:
        throw std::invalid_argument("random informants need RandomInformants");
    }
    SortOnce(&mine);
  }
  return informants;
}

int TorusRows(int swarm_size) {
  int rows = 1;
  for (int r = 2; r * r <= swarm_size; ++r) {
    if (swarm_size % r == 0) rows = r;
  }
  return rows;
}

std::vector<std::vector<int>> RandomInformants(int swarm_size, int informed, Random* random) {
  std::vector<std::vector<int>> informants(swarm_size);
  for (int i = 0; i < swarm_size; ++i) {
    informants[i].push_back(i);
    for (int k = 0; k < informed; ++k) informants[random->Below(swarm_size)].push_back(i);
  }
  for (std::vector<int>& mine : informants) SortOnce(&mine);
  return informants;
}

int BestInformant(std::span<const int> informants, std::span<const double> best_objectives) {
  return *std::min_element(informants.begin(), informants.end(),
                           [&](int a, int b) { return best_objectives[a] < best_objectives[b]; });
}

}  // namespace frond
