// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/voxel_grid.h"

#include <gtest/gtest.h>

#include "base/errors.h"
#include "tests/problems/leaf/scanned_leaves.h"

namespace frond {
namespace {

TEST(VoxelGrid, Means_AreThoseOfTheCubesPoints) {
  const std::vector<Eigen::Vector3d> points = {{0.1, 0, 0}, {0.9, 0, 0.5}, {1.1, 0, 0}, {-0.1, 0.2, 0.2}};
  const auto means = VoxelGridMeans(points, 1, Eigen::Vector3d::Zero());
  ASSERT_EQ(means.size(), 3u);
  EXPECT_LT((means[0] - Eigen::Vector3d(-0.1, 0.2, 0.2)).norm(), 1e-15);
  EXPECT_LT((means[1] - Eigen::Vector3d(0.5, 0, 0.25)).norm(), 1e-15);
  EXPECT_LT((means[2] - Eigen::Vector3d(1.1, 0, 0)).norm(), 1e-15);
}

TEST(VoxelGrid, Downsampling_ComesNearTheCountAskedFor) {
  for (const std::size_t count : {300u, 1000u, 8000u, 32000u}) {
    const auto few = DownsampleByVoxelGrid(ScannedLeaf(1).points, count, 3);
    EXPECT_NEAR(static_cast<double>(few.size()), static_cast<double>(count),
                0.03 * static_cast<double>(count));
  }
}

TEST(VoxelGrid, Repetitions_DifferByTheGridsPlace) {
  const auto& points = ScannedLeaf(1).points;
  EXPECT_EQ(DownsampleByVoxelGrid(points, 500, 1), DownsampleByVoxelGrid(points, 500, 1));
  EXPECT_NE(DownsampleByVoxelGrid(points, 500, 1), DownsampleByVoxelGrid(points, 500, 2));
}

TEST(VoxelGrid, EdgesAndCounts_AreChecked) {
  const auto& points = ScannedLeaf(1).points;
  EXPECT_THROW(VoxelGridMeans(points, 0, Eigen::Vector3d::Zero()), ConfigError);
  EXPECT_THROW(VoxelGridMeans(points, 1e-9, Eigen::Vector3d::Zero()), InputError);
  EXPECT_THROW(DownsampleByVoxelGrid(points, 0, 1), ConfigError);
  EXPECT_EQ(DownsampleByVoxelGrid(points, 100000, 1), points);
}

}  // namespace
}  // namespace frond
