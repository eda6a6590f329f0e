// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/voxel_topology.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "models/parity_sets.h"

namespace frond {
namespace {

// Cubes in a row along x with the same value, [begin, end), by rows: those of row y + z · size.y() are
// [first[row], first[row + 1]).
struct Runs {
  struct Run {
    int begin = 0, end = 0;
  };
  std::vector<std::size_t> first;
  std::vector<Run> runs;
  std::vector<int> part;  // by run: the lowest run of its connected part
};

Runs FindRuns(const VoxelSet& voxels, std::uint8_t value) {
  Runs result;
  const std::size_t rows =
      static_cast<std::size_t>(voxels.size.y()) * static_cast<std::size_t>(voxels.size.z());
  const int width = voxels.size.x();
  for (std::size_t row = 0; row < rows; ++row) {
    result.first.push_back(result.runs.size());
    const std::uint8_t* const begin = voxels.filled.data() + row * static_cast<std::size_t>(width);
    const std::uint8_t* const end = begin + width;
    for (const std::uint8_t* at = std::find(begin, end, value); at != end; at = std::find(at, end, value)) {
      const std::uint8_t* const stop = std::find(at, end, static_cast<std::uint8_t>(1 - value));
      result.runs.push_back({static_cast<int>(at - begin), static_cast<int>(stop - begin)});
      at = stop;
    }
  }
  result.first.push_back(result.runs.size());
  return result;
}

// Joins runs of two rows that overlap, or, with `reach` 1, touch at a corner.
void JoinRows(const Runs& runs, std::size_t row, std::size_t other, int reach, ParitySets* sets) {
  std::size_t i = runs.first[row], j = runs.first[other];
  while (i < runs.first[row + 1] && j < runs.first[other + 1]) {
    const Runs::Run &a = runs.runs[i], &b = runs.runs[j];
    if (a.begin < b.end + reach && b.begin < a.end + reach) {
      sets->Join(static_cast<int>(i), static_cast<int>(j));
    }
    a.end < b.end ? ++i : ++j;
  }
}

// The parts of the cubes with that value, connected over faces, edges and corners (26) or faces alone (6).
Runs ConnectedRuns(const VoxelSet& voxels, std::uint8_t value, bool by_corners) {
  Runs runs = FindRuns(voxels, value);
  ParitySets sets(runs.runs.size());
  const int height = voxels.size.y(), depth = voxels.size.z();
  const auto row = [&](int y, int z) { return static_cast<std::size_t>(y + height * z); };
  const int reach = by_corners ? 1 : 0;
  for (int z = 0; z < depth; ++z) {
    for (int y = 0; y < height; ++y) {
      if (y > 0) JoinRows(runs, row(y, z), row(y - 1, z), reach, &sets);
      if (z > 0) JoinRows(runs, row(y, z), row(y, z - 1), reach, &sets);
      if (!by_corners || z == 0) continue;
      if (y > 0) JoinRows(runs, row(y, z), row(y - 1, z - 1), reach, &sets);
      if (y + 1 < height) JoinRows(runs, row(y, z), row(y + 1, z - 1), reach, &sets);
    }
  }
  runs.part.resize(runs.runs.size());
  for (std::size_t k = 0; k < runs.part.size(); ++k) runs.part[k] = sets.Find(static_cast<int>(k));
  return runs;
}

void SetParts(const Runs& runs, const std::vector<std::uint8_t>& chosen, std::uint8_t value,
              VoxelSet* voxels) {
  for (std::size_t row = 0; row + 1 < runs.first.size(); ++row) {
    for (std::size_t k = runs.first[row]; k < runs.first[row + 1]; ++k) {
      if (!chosen[static_cast<std::size_t>(runs.part[k])]) continue;
      std::fill_n(voxels->filled.begin() +
                      static_cast<std::ptrdiff_t>(row * static_cast<std::size_t>(voxels->size.x())) +
                      runs.runs[k].begin,
                  runs.runs[k].end - runs.runs[k].begin, value);
    }
  }
}

int CountParts(const Runs& runs) {
  int count = 0;
  for (std::size_t k = 0; k < runs.part.size(); ++k) count += runs.part[k] == static_cast<int>(k);
  return count;
}

// What the corner in the middle of 2 × 2 × 2 cubes (bit dx + 2 dy + 4 dz) gives to χ, with the edges, faces
// and the cube that run from it to +x, +y, +z: each belongs to the set where any cube at it does.
std::array<std::int8_t, 256> EulerTable() {
  std::array<std::int8_t, 256> table{};
  for (unsigned set = 1; set < 256; ++set) {
    int sum = 1;                                                             // the corner
    for (const unsigned at : {0xaau, 0xccu, 0xf0u}) sum -= (set & at) != 0;  // edges
    for (const unsigned at : {0xaau & 0xccu, 0xccu & 0xf0u, 0xf0u & 0xaau}) sum += (set & at) != 0;  // faces
    sum -= (set & 0x80u) != 0;  // the cube
    table[set] = static_cast<std::int8_t>(sum);
  }
  return table;
}

long EulerCharacteristic(const VoxelSet& voxels) {
  static const std::array<std::int8_t, 256> table = EulerTable();
  long sum = 0;
  for (int z = 0; z + 1 < voxels.size.z(); ++z) {
    for (int y = 0; y + 1 < voxels.size.y(); ++y) {
      const std::uint8_t* const rows[] = {voxels.filled.data() + voxels.Index(0, y, z),
                                          voxels.filled.data() + voxels.Index(0, y + 1, z),
                                          voxels.filled.data() + voxels.Index(0, y, z + 1),
                                          voxels.filled.data() + voxels.Index(0, y + 1, z + 1)};
      unsigned set = 0;
      for (int x = 0; x < voxels.size.x(); ++x) {
        set = (set >> 1) & 0x55u;
        set |= static_cast<unsigned>(rows[0][x] << 1 | rows[1][x] << 3 | rows[2][x] << 5 | rows[3][x] << 7);
        sum += table[set];
      }
    }
  }
  return sum;
}

}  // namespace

VoxelSet UnionOfBalls(std::span<const Eigen::Vector3d> points, double radius) {
  constexpr int kMargin = 4;  // of the box, in cubes: two for the ball, one empty, one for rounding
  Eigen::AlignedBox3d box;
  for (const auto& point : points) box.extend(point);
  VoxelSet voxels;
  voxels.side = radius / 2;
  voxels.size = (box.sizes() / voxels.side).array().ceil().cast<int>() + 2 * kMargin;
  voxels.corner = box.min() - Eigen::Vector3d::Constant(kMargin * voxels.side);
  voxels.filled.assign(voxels.Index(0, 0, voxels.size.z()), 0);
  for (const auto& point : points) {
    const Eigen::Array3d place = (point - voxels.corner).array() / voxels.side - 0.5;  // in centres of cubes
    const int y0 = static_cast<int>(std::ceil(place.y() - 2)),
              z0 = static_cast<int>(std::ceil(place.z() - 2));
    for (int z = z0; z <= place.z() + 2; ++z) {
      for (int y = y0; y <= place.y() + 2; ++y) {
        const double left = 4 - (z - place.z()) * (z - place.z()) - (y - place.y()) * (y - place.y());
        if (left < 0) continue;
        const double half = std::sqrt(left);
        const int begin = static_cast<int>(std::ceil(place.x() - half));
        const int end = static_cast<int>(std::floor(place.x() + half));
        for (int x = begin; x <= end; ++x) voxels.filled[voxels.Index(x, y, z)] = 1;
      }
    }
  }
  return voxels;
}

std::size_t DropSmallComponents(std::span<const Eigen::Vector3d> points, double share, VoxelSet* voxels) {
  const Runs runs = ConnectedRuns(*voxels, 1, true);
  std::vector<std::size_t> members(runs.runs.size(), 0);
  for (const auto& point : points) {
    const Eigen::Vector3i cube = ((point - voxels->corner) / voxels->side).array().floor().cast<int>();
    const auto row = static_cast<std::size_t>(cube.y() + voxels->size.y() * cube.z());
    const auto begin = runs.runs.begin() + static_cast<std::ptrdiff_t>(runs.first[row]);
    const auto end = runs.runs.begin() + static_cast<std::ptrdiff_t>(runs.first[row + 1]);
    const auto run = std::find_if(begin, end, [&](const auto& r) { return cube.x() < r.end; });
    ++members[static_cast<std::size_t>(runs.part[static_cast<std::size_t>(run - runs.runs.begin())])];
  }
  std::vector<std::uint8_t> drop(members.size(), 0);
  std::size_t kept = 0;
  for (std::size_t k = 0; k < members.size(); ++k) {
    drop[k] = static_cast<double>(members[k]) < share * static_cast<double>(points.size());
    if (!drop[k]) kept += members[k];
  }
  SetParts(runs, drop, 0, voxels);
  return kept;
}

BettiNumbers FindBettiNumbers(VoxelSet* voxels, std::size_t least) {
  BettiNumbers numbers;
  numbers.components = CountParts(ConnectedRuns(*voxels, 1, true));
  const Runs empty = ConnectedRuns(*voxels, 0, false);  // run 0 is outside
  std::vector<std::size_t> cubes(empty.runs.size(), 0);
  for (std::size_t k = 0; k < cubes.size(); ++k) {
    cubes[static_cast<std::size_t>(empty.part[k])] +=
        static_cast<std::size_t>(empty.runs[k].end - empty.runs[k].begin);
  }
  std::vector<std::uint8_t> fill(cubes.size(), 0);
  for (std::size_t k = 1; k < cubes.size(); ++k) {
    if (empty.part[k] != static_cast<int>(k)) continue;
    fill[k] = cubes[k] < least;
    numbers.cavities += !fill[k];
  }
  SetParts(empty, fill, 1, voxels);
  numbers.loops = numbers.components + numbers.cavities - static_cast<int>(EulerCharacteristic(*voxels));
  return numbers;
}

double DeepShare(const VoxelSet& voxels, int layers) {
  const std::size_t size = voxels.filled.size(), y = voxels.Index(0, 1, 0), z = voxels.Index(0, 0, 1);
  std::vector<std::uint8_t> deep = voxels.filled, next(size, 0);
  for (int layer = 0; layer < layers; ++layer) {
    for (std::size_t k = z; k + z < size; ++k) {  // the margin is empty
      next[k] = deep[k] & deep[k - 1] & deep[k + 1] & deep[k - y] & deep[k + y] & deep[k - z] & deep[k + z];
    }
    deep.swap(next);
  }
  const auto count = [](const std::vector<std::uint8_t>& cubes) {
    return static_cast<double>(std::count(cubes.begin(), cubes.end(), 1));
  };
  const double filled = count(voxels.filled);
  return filled > 0 ? count(deep) / filled : 0;
}

}  // namespace frond
