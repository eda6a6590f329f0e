// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/outliers.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "base/median.h"

namespace frond {
namespace {

// Points by the cube of a grid that they fall into.
struct CubeGrid {
  std::unordered_map<std::uint64_t, std::uint32_t> place;
  std::vector<Eigen::Vector3i> cubes;
  std::vector<std::uint32_t> members;  // points in each
  std::vector<std::uint32_t> cube_of;  // by point

  static std::uint64_t Key(const Eigen::Vector3i& cube) {
    const auto part = [](int x) { return static_cast<std::uint64_t>(x) & 0x1fffff; };
    // Mixed, since std::hash leaves integers as they are.
    std::uint64_t key =
        (part(cube.x()) | part(cube.y()) << 21 | part(cube.z()) << 42) * 0x9e3779b97f4a7c15ULL;
    return key ^ (key >> 32);
  }
};

// A cube has the origin as its centre and the next ones stand round it, so that turning a coordinate's sign
// turns their numbers' signs.
CubeGrid FillCubes(std::span<const Eigen::Vector3d> points, double side) {
  CubeGrid grid;
  grid.place.reserve(points.size() / 4);
  grid.cube_of.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3i cube = (points[i] / side).array().round().cast<int>();
    const auto [entry, added] =
        grid.place.emplace(CubeGrid::Key(cube), static_cast<std::uint32_t>(grid.cubes.size()));
    if (added) {
      grid.cubes.push_back(cube);
      grid.members.push_back(0);
    }
    grid.cube_of[i] = entry->second;
    ++grid.members[entry->second];
  }
  return grid;
}

// The side of the cubes: 2.5 spacings, but no less than 1/150 of the longest range, or dense scans' cubes
// would be finer than their noise. Spacing: √(area / points) within a factor of two, whatever far outliers
// do; the area is that of an ellipse in the rectangle of the two longest ranges, each from the 5 % to the 95
// % quantile of a coordinate.
double CubeSide(std::span<const Eigen::Vector3d> points) {
  std::array<double, 3> range;
  std::vector<double> values(points.size());
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < points.size(); ++i) values[i] = points[i][axis];
    const auto quantile = [&](double share) {
      const auto k = static_cast<std::ptrdiff_t>(std::lround(share * static_cast<double>(values.size() - 1)));
      std::nth_element(values.begin(), values.begin() + k, values.end());
      return values[static_cast<std::size_t>(k)];
    };
    const double high = quantile(0.95), low = quantile(0.05);
    range[static_cast<std::size_t>(axis)] = (high - low) / 0.9;
  }
  std::sort(range.begin(), range.end());
  const double spacing = std::sqrt(M_PI / 4 * range[1] * range[2] / static_cast<double>(points.size()));
  return std::max(2.5 * spacing, range[2] / 150);
}

// The points in a cube and the 26 round it, counted no further than `enough`. In-plane neighbours come first,
// since sheets are wider than thick in their principal axes.
std::uint32_t PointsAround(const CubeGrid& grid, const Eigen::Vector3i& cube,
                           std::uint32_t enough = std::numeric_limits<std::uint32_t>::max()) {
  std::uint32_t sum = 0;
  for (const int z : {0, 1, -1}) {
    for (int k = 0; k < 9 && sum < enough; ++k) {
      const int beside = (k + 4) % 9;  // the cube itself first
      const auto found =
          grid.place.find(CubeGrid::Key(cube + Eigen::Vector3i(beside % 3 - 1, beside / 3 - 1, z)));
      if (found != grid.place.end()) sum += grid.members[found->second];
    }
  }
  return sum;
}

// Cubes with fewer than four points, or a tenth of what is usual, in and round them. What is usual is the
// median over some of the cubes with more than one point.
std::vector<std::uint8_t> SparseCubes(const CubeGrid& grid) {
  std::vector<std::uint32_t> usual;
  for (std::size_t c = 0; c < grid.cubes.size(); ++c) {
    const bool drawn = CubeGrid::Key(grid.cubes[c].cwiseAbs()) % 16 == 0;
    if (grid.members[c] > 1 && (drawn || grid.cubes.size() < 4000))
      usual.push_back(PointsAround(grid, grid.cubes[c]));
  }
  std::uint32_t least = 4;
  if (!usual.empty()) {
    const auto middle = usual.begin() + static_cast<std::ptrdiff_t>(usual.size() / 2);
    std::nth_element(usual.begin(), middle, usual.end());
    least = std::max(least, *middle / 10);
  }
  std::vector<std::uint8_t> sparse;
  for (std::size_t c = 0; c < grid.cubes.size(); ++c) {
    sparse.push_back(grid.members[c] < least && PointsAround(grid, grid.cubes[c], least) < least);
  }
  return sparse;
}

// The same points in cubes of twice the side, without those of sparse cubes; cube_of is by cube of `grid`.
CubeGrid Paired(const CubeGrid& grid, const std::vector<std::uint8_t>& sparse) {
  CubeGrid paired;
  paired.cube_of.resize(grid.cubes.size());
  for (std::size_t c = 0; c < grid.cubes.size(); ++c) {
    if (sparse[c]) continue;
    const Eigen::Vector3i cube = grid.cubes[c].unaryExpr([](int x) { return x / 2; });  // symmetric about 0
    const auto [entry, added] =
        paired.place.emplace(CubeGrid::Key(cube), static_cast<std::uint32_t>(paired.cubes.size()));
    if (added) {
      paired.cubes.push_back(cube);
      paired.members.push_back(0);
    }
    paired.cube_of[c] = entry->second;
    paired.members[entry->second] += grid.members[c];
  }
  return paired;
}

// The number of the connected part that each cube belongs to, and how many points each part has.
std::vector<int> ConnectedParts(const CubeGrid& grid, std::vector<std::size_t>* sizes) {
  std::vector<int> part(grid.cubes.size(), -1);
  std::vector<std::uint32_t> stack;
  for (std::size_t seed = 0; seed < part.size(); ++seed) {
    if (part[seed] >= 0) continue;
    const int number = static_cast<int>(sizes->size());
    sizes->push_back(0);
    part[seed] = number;
    stack.assign(1, static_cast<std::uint32_t>(seed));
    while (!stack.empty()) {
      const std::uint32_t c = stack.back();
      stack.pop_back();
      sizes->back() += grid.members[c];
      for (int k = 0; k < 27; ++k) {
        const Eigen::Vector3i beside = grid.cubes[c] + Eigen::Vector3i(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
        const auto found = grid.place.find(CubeGrid::Key(beside));
        if (found == grid.place.end() || part[found->second] >= 0) continue;
        part[found->second] = number;
        stack.push_back(found->second);
      }
    }
  }
  return part;
}

// The length of o_i less the median, by coordinates, over the 12 nearest other points.
double StandsOutBy(std::size_t i, std::span<const Eigen::Vector3d> points,
                   std::span<const Eigen::Vector3d> offsets, const KdTree& tree) {
  std::array<KdTree::Neighbour, 13> neighbours;
  const std::size_t found = tree.Nearest(points[i], neighbours);
  Eigen::Vector3d median = Eigen::Vector3d::Zero();
  std::array<double, 13> others;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    std::size_t count = 0;
    for (std::size_t k = 0; k < found; ++k) {
      if (neighbours[k].index != i) others[count++] = offsets[neighbours[k].index][axis];
    }
    if (count == 0) continue;
    const auto middle = others.begin() + static_cast<std::ptrdiff_t>(count / 2);
    std::nth_element(others.begin(), middle, others.begin() + static_cast<std::ptrdiff_t>(count));
    median[axis] = *middle;
  }
  return (offsets[i] - median).norm();
}

}  // namespace

double PointSpacing(std::span<const Eigen::Vector3d> points, const KdTree& tree) {
  const std::size_t stride = std::max<std::size_t>(1, points.size() / 2000);
  std::vector<double> radii;
  std::array<KdTree::Neighbour, 9> neighbours;
  for (std::size_t i = 0; i < points.size(); i += stride) {
    const std::size_t found = tree.Nearest(points[i], neighbours);
    radii.push_back(std::sqrt(neighbours[found - 1].squared_distance));
  }
  return Median(std::move(radii)) * std::sqrt(M_PI / 8);
}

std::vector<std::uint8_t> StrayPoints(std::span<const Eigen::Vector3d> points) {
  std::vector<std::uint8_t> stray(points.size(), 0);
  Eigen::AlignedBox3d box;
  for (const auto& point : points) box.extend(point);
  const double extent = points.empty() ? 0 : box.sizes().maxCoeff();
  if (points.size() < 10 || !(extent > 0)) return stray;
  double farthest = 0;
  for (const auto& point : points) farthest = std::max(farthest, point.cwiseAbs().maxCoeff());
  const double side = std::max(CubeSide(points), farthest / 0x1p19);  // 21 bits hold a cube's number
  const CubeGrid dense = FillCubes(points, side);
  const std::vector<std::uint8_t> sparse = SparseCubes(dense);
  const CubeGrid pairs = Paired(dense, sparse);
  std::vector<std::size_t> sizes;
  const std::vector<int> part = ConnectedParts(pairs, &sizes);
  const auto main_part = std::max_element(sizes.begin(), sizes.end());
  if (main_part == sizes.end() || 2 * *main_part < points.size()) return stray;
  const int largest = static_cast<int>(main_part - sizes.begin());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::uint32_t cube = dense.cube_of[i];
    stray[i] = sparse[cube] || part[pairs.cube_of[cube]] != largest;
  }
  return stray;
}

namespace {

// Whether a point that stands out in its offset does so in the cloud as well: from the plane through its
// twelve nearest, or from the nearest that is no candidate itself.
bool StandsApart(std::size_t i, std::span<const Eigen::Vector3d> points,
                 const std::vector<std::uint8_t>& candidate, const KdTree& tree, double height, double gap) {
  constexpr std::size_t kPlane = 12;
  std::array<KdTree::Neighbour, 48> neighbours;
  const std::size_t found = tree.Nearest(points[i], neighbours);
  const auto none = std::find_if(neighbours.begin(), neighbours.begin() + static_cast<std::ptrdiff_t>(found),
                                 [&](const auto& n) { return candidate[n.index] == 0; });
  if (none == neighbours.begin() + static_cast<std::ptrdiff_t>(found) || none->squared_distance > gap * gap) {
    return true;
  }
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  double count = 0;
  for (std::size_t k = 0; k < std::min(found, kPlane + 1); ++k) {
    if (neighbours[k].index == i) continue;
    const Eigen::Vector3d d = points[neighbours[k].index] - points[i];
    mean += d;
    spread += d * d.transpose();
    ++count;
  }
  mean /= count;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread / count - mean * mean.transpose());
  return std::abs(axes.eigenvectors().col(0).dot(mean)) > height;
}

}  // namespace

std::vector<std::uint8_t> OutlyingPoints(std::span<const Eigen::Vector3d> points,
                                         std::span<const Eigen::Vector3d> offsets, const KdTree& tree,
                                         double threshold) {
  constexpr double kLeastLimit = 0.5;  // of a spacing: less does not show in a surface through the others
  const std::size_t stride = std::max<std::size_t>(1, points.size() / 4000);
  std::vector<double> sample;
  for (std::size_t i = 0; i < points.size(); i += stride) {
    sample.push_back(StandsOutBy(i, points, offsets, tree));
  }
  const double spacing = PointSpacing(points, tree);
  const double limit = std::max(threshold * 1.4826 * Median(std::move(sample)), kLeastLimit * spacing);
  std::vector<std::uint8_t> candidate(points.size(), 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    // Half the limit is a cheap sieve: a point that near would need a neighbourhood as far off on the other
    // side.
    candidate[i] = offsets[i].norm() > 0.5 * limit && StandsOutBy(i, points, offsets, tree) > limit;
  }
  // Where the surface's own error turns within a neighbourhood, a point stands out in its offset alone.
  std::vector<std::uint8_t> outlying = candidate;
  const double gap = std::max(0.5 * limit, 3 * spacing);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (candidate[i]) outlying[i] = StandsApart(i, points, candidate, tree, 0.5 * limit, gap);
  }
  return outlying;
}

}  // namespace frond
