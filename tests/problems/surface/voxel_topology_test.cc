// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/voxel_topology.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <functional>

#include "base/random.h"

namespace frond {
namespace {

VoxelSet Filled(int size, const std::function<bool(const Eigen::Vector3i&)>& inside) {
  VoxelSet voxels;
  voxels.size = Eigen::Vector3i::Constant(size);
  voxels.filled.assign(voxels.Index(0, 0, size), 0);
  for (int z = 1; z + 1 < size; ++z) {
    for (int y = 1; y + 1 < size; ++y) {
      for (int x = 1; x + 1 < size; ++x) voxels.filled[voxels.Index(x, y, z)] = inside({x, y, z});
    }
  }
  return voxels;
}

BettiNumbers Numbers(VoxelSet voxels, std::size_t least = 0) { return FindBettiNumbers(&voxels, least); }

TEST(BettiNumbers, OfBallShellTorusAndShellOfATorus_AreTheKnownOnes) {
  const auto radius = [](const Eigen::Vector3i& c) {
    return (c.cast<double>() - Eigen::Vector3d::Constant(14.5)).norm();
  };
  const auto from_ring = [](const Eigen::Vector3i& c) {
    const Eigen::Vector3d p = c.cast<double>() - Eigen::Vector3d::Constant(14.5);
    return std::hypot(p.head<2>().norm() - 8, p.z());
  };
  EXPECT_EQ(Numbers(Filled(30, [&](const auto& c) { return radius(c) < 9; })), (BettiNumbers{1, 0, 0}));
  EXPECT_EQ(Numbers(Filled(30, [&](const auto& c) { return std::abs(radius(c) - 9) < 2; })),
            (BettiNumbers{1, 0, 1}));
  EXPECT_EQ(Numbers(Filled(30, [&](const auto& c) { return from_ring(c) < 3; })), (BettiNumbers{1, 1, 0}));
  EXPECT_EQ(Numbers(Filled(30, [&](const auto& c) { return std::abs(from_ring(c) - 4) < 1; })),
            (BettiNumbers{1, 2, 1}));
}

TEST(BettiNumbers, CubesThatShareACorner_AreOneAndCloseACavity) {
  EXPECT_EQ(
      Numbers(Filled(
          6, [](const auto& c) { return c == Eigen::Vector3i(1, 1, 1) || c == Eigen::Vector3i(2, 2, 2); })),
      (BettiNumbers{1, 0, 0}));
  EXPECT_EQ(
      Numbers(Filled(
          6, [](const auto& c) { return c == Eigen::Vector3i(1, 1, 1) || c == Eigen::Vector3i(3, 1, 1); })),
      (BettiNumbers{2, 0, 0}));
  // The six neighbours of an empty cube touch along edges and shut it in; small cavities are filled if asked.
  const VoxelSet star =
      Filled(7, [](const auto& c) { return (c - Eigen::Vector3i::Constant(3)).cwiseAbs().sum() == 1; });
  EXPECT_EQ(Numbers(star), (BettiNumbers{1, 0, 1}));
  EXPECT_EQ(Numbers(star, 2), (BettiNumbers{1, 0, 0}));
}

TEST(BettiNumbers, OfRandomCubes_AddUpToTheEulerCharacteristicOfTheirCells) {
  Random random(5);
  for (int round = 0; round < 20; ++round) {
    const double density = 0.05 + 0.04 * round;
    const VoxelSet voxels = Filled(9, [&](const auto&) { return random.Uniform() < density; });
    // Cells by twice their centre: even coordinates are corners, odd ones lie inside a cube's range.
    long euler = 0;
    for (int z = 0; z <= 18; ++z) {
      for (int y = 0; y <= 18; ++y) {
        for (int x = 0; x <= 18; ++x) {
          bool any = false;
          for (int k = 0; k < 8; ++k) {
            const auto cube = [](int twice, int side) { return twice % 2 ? twice / 2 : twice / 2 - side; };
            const int i = cube(x, k & 1), j = cube(y, k >> 1 & 1), l = cube(z, k >> 2);
            if (i < 0 || j < 0 || l < 0 || i > 8 || j > 8 || l > 8) continue;
            any = any || voxels.filled[voxels.Index(i, j, l)];
          }
          if (any) euler += (x % 2 + y % 2 + z % 2) % 2 ? -1 : 1;
        }
      }
    }
    const BettiNumbers numbers = Numbers(voxels);
    EXPECT_EQ(numbers.components - numbers.loops + numbers.cavities, euler);
    EXPECT_GE(numbers.loops, 0);
  }
}

TEST(UnionOfBalls, HoldsTheCubesWithinTheRadius) {
  const std::vector<Eigen::Vector3d> points = {{0.3, -2, 7}, {1.1, -1.2, 7.3}, {5, 5, 5}};
  const VoxelSet voxels = UnionOfBalls(points, 0.9);
  EXPECT_DOUBLE_EQ(voxels.side, 0.45);
  for (int z = 0; z < voxels.size.z(); ++z) {
    for (int y = 0; y < voxels.size.y(); ++y) {
      for (int x = 0; x < voxels.size.x(); ++x) {
        const Eigen::Vector3d centre =
            voxels.corner + voxels.side * (Eigen::Vector3d(x, y, z) + Eigen::Vector3d::Constant(0.5));
        double nearest = 1e9;
        for (const auto& point : points) nearest = std::min(nearest, (point - centre).norm());
        if (std::abs(nearest - 0.9) <= 1e-9) continue;
        EXPECT_EQ(voxels.filled[voxels.Index(x, y, z)] != 0, nearest < 0.9);
      }
    }
  }
}

TEST(DropSmallComponents, KeepsThoseWithTheirShareOfThePoints) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 95; ++i) points.emplace_back(0.1 * i, 0, 0);
  for (int i = 0; i < 5; ++i) points.emplace_back(0.1 * i, 8, 3);
  VoxelSet voxels = UnionOfBalls(points, 0.5);
  EXPECT_EQ(Numbers(voxels).components, 2);
  VoxelSet same = voxels;
  EXPECT_EQ(DropSmallComponents(points, 0.05, &same), 100u);
  EXPECT_EQ(same.filled, voxels.filled);
  EXPECT_EQ(DropSmallComponents(points, 0.06, &voxels), 95u);
  EXPECT_EQ(Numbers(voxels).components, 1);
}

TEST(DeepShare, OfASlab_IsWhatLiesBeyondTheLayers) {
  const VoxelSet slab = Filled(22, [](const auto& c) { return c.z() >= 8 && c.z() < 14; });
  EXPECT_NEAR(DeepShare(slab, 2), 16 * 16 * 2 / (20 * 20 * 6.0), 1e-12);
  EXPECT_EQ(DeepShare(slab, 3), 0);
}

}  // namespace
}  // namespace frond
