// SPDX-License-Identifier: BSD-3-Clause
#include "problems/leaf/leaf_frame.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "base/errors.h"
#include "base/random.h"
#include "problems/surface/outliers.h"
#include "tests/problems/leaf/scanned_leaves.h"

namespace frond {
namespace {

Eigen::Isometry3d AnyPose(Random* random) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::Quaterniond(random->Normal(), random->Normal(), random->Normal(), random->Normal())
                      .normalized()
                      .toRotationMatrix();
  pose.translation() << random->Uniform(-500, 500), random->Uniform(-500, 500), random->Uniform(-500, 500);
  return pose;
}

TEST(LeafFrame, OfAnyPoseUnitAndOrder_IsTheSameOnTheLeaf) {
  Random random(5);
  for (int seed = 1; seed <= kLeaves; ++seed) {
    const LeafScan& scan = ScannedLeaf(seed);
    const LeafFrame plain = FindLeafFrame(scan.points);
    const std::vector<Eigen::Vector3d> expected = PointsInFrame(scan.points, plain);
    for (const double unit : {1.0, 0.001}) {
      const Eigen::Isometry3d pose = AnyPose(&random);
      std::vector<std::size_t> order(scan.points.size());
      for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
      for (std::size_t i = order.size(); i-- > 1;) std::swap(order[i], order[random.Below(i + 1)]);
      std::vector<Eigen::Vector3d> moved;
      for (const std::size_t i : order) moved.push_back(unit * (pose * scan.points[i]));
      const LeafFrame frame = FindLeafFrame(moved);
      EXPECT_NEAR(frame.axes.determinant(), 1, 1e-12);
      EXPECT_NEAR(frame.length, plain.length * unit, 1e-6 * plain.length * unit);
      EXPECT_EQ(frame.strays.size(), plain.strays.size());
      double largest = 0;
      for (std::size_t k = 0; k < order.size(); ++k) {
        const Eigen::Vector3d back = frame.FromInput(moved[k]) / unit;
        largest = std::max(largest, (back - plain.FromInput(scan.points[order[k]])).norm());
      }
      EXPECT_LT(largest, 1e-6 * plain.length) << "leaf " << seed << ", unit " << unit;
    }
  }
}

TEST(LeafFrame, X_RunsFromBaseToTip) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    LeafScanOptions options;
    options.seed = seed;
    options.dense_points = 0;
    options.points = 20000;
    const LeafFrame frame = FindLeafFrame(ScanLeaf(RandomLeaf(seed), options).points);
    EXPECT_GT(frame.axes(0, 0), 0.9) << "leaf " << seed;
    options.petiole_length = 9;
    EXPECT_GT(FindLeafFrame(ScanLeaf(RandomLeaf(seed), options).points).axes(0, 0), 0.9)
        << "leaf " << seed << " with a petiole";
  }
}

TEST(LeafFrame, Z_RunsToTheSideOfTheBulge) {
  for (const double slope : {-0.3, 0.3}) {
    LeafShape shape = RandomLeaf(1);
    shape.fold_slope = slope;
    shape.curl_angle = 0;
    LeafScanOptions options;
    options.dense_points = 0;
    const LeafFrame frame = FindLeafFrame(ScanLeaf(shape, options).points);
    EXPECT_GT(frame.axes(2, 2) * slope, 0.2);
    EXPECT_NEAR(frame.FromInput(frame.ToInput({1, 2, 3})).z(), 3, 1e-12);
  }
}

TEST(LeafFrame, Outliers_DoNotMoveIt) {
  for (int seed = 1; seed <= kLeaves; ++seed) {
    const LeafFrame clean = FindLeafFrame(ScannedLeaf(seed).points);
    LeafScanOptions options;
    options.seed = static_cast<std::uint64_t>(seed);
    options.dense_points = 0;
    options.outlier_share = 0.05;
    const LeafScan scan = ScanLeaf(RandomLeaf(options.seed), options);
    const LeafFrame frame = FindLeafFrame(scan.points);
    EXPECT_GT((clean.axes.transpose() * frame.axes).diagonal().minCoeff(), 0.9999) << "leaf " << seed;
    EXPECT_LT((clean.origin - frame.origin).norm(), 0.1);
    EXPECT_NEAR(frame.length, clean.length, 0.01 * clean.length);
    int outliers = 0;
    for (const std::size_t i : frame.strays) outliers += scan.kinds[i] == ScanPointKind::kOutlier ? 1 : 0;
    EXPECT_GT(outliers, 1700) << "of 2000";
    EXPECT_LT(static_cast<int>(frame.strays.size()) - outliers, 10);
  }
}

TEST(LeafFrame, Extremes_NeedTheStraysLeftOut) {
  std::vector<Eigen::Vector3d> points = ScannedLeaf(1).points;
  points.emplace_back(500, 0, 0);
  EXPECT_GT(FindLeafFrame(points, {.leave_out_strays = false}).length, 400);
  const LeafFrame frame = FindLeafFrame(points);
  EXPECT_LT(frame.length, 70);
  EXPECT_EQ(frame.strays.back(), points.size() - 1);
}

TEST(LeafFrame, UnusableClouds_AreRefused) {
  std::vector<Eigen::Vector3d> line, spot(20, Eigen::Vector3d(1, 2, 3));
  for (int i = 0; i < 50; ++i) line.push_back(Eigen::Vector3d(1, 2, 3) * i);
  EXPECT_THROW(FindLeafFrame(std::vector<Eigen::Vector3d>{}), InputError);
  EXPECT_THROW(FindLeafFrame(std::vector<Eigen::Vector3d>(1, Eigen::Vector3d(1, 2, 3))), InputError);
  EXPECT_THROW(FindLeafFrame(line), InputError);
  EXPECT_THROW(FindLeafFrame(spot), InputError);
}

TEST(StrayPoints, OfACleanLeaf_AreNextToNone) {
  for (int seed = 1; seed <= kLeaves; ++seed) {
    const auto stray = StrayPoints(ScannedLeaf(seed).points);
    EXPECT_LE(std::count(stray.begin(), stray.end(), 1), 2) << "leaf " << seed;
  }
}

}  // namespace
}  // namespace frond
