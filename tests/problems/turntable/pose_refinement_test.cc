// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/pose_refinement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/errors.h"
#include "problems/turntable/view_merge.h"
#include "tests/problems/turntable/pear_scan.h"

namespace frond {
namespace {

using Views = std::vector<std::vector<ScanPoint>>;
constexpr double kRadians = std::numbers::pi / 180;
constexpr double kSigma = 0.1;
constexpr int kViews = 12;

Views Turn(std::uint64_t seed, double lobes = 0.04) {
  Random random(seed);
  Views views;
  for (int k = 0; k < kViews; ++k) {
    views.push_back(PearView({lobes}, 2 * std::numbers::pi * k / kViews, 2, kSigma, k, &random));
  }
  return views;
}

void MoveView(const Eigen::Isometry3d& motion, std::vector<ScanPoint>* view) {
  for (ScanPoint& p : *view) {
    p.position = motion * p.position;
    p.normal = motion.linear() * p.normal;
    p.to_camera = motion.linear() * p.to_camera;
  }
}

double RmsToPear(const Views& views) {
  double sum = 0, count = 0;
  for (const auto& view : views) {
    for (const ScanPoint& p : view) {
      sum += std::pow(LobedPear{}.SignedDistance(p.position), 2);
      ++count;
    }
  }
  return std::sqrt(sum / count);
}

TEST(PoseRefinement, ViewsThatFit_StayWhereTheyAre) {
  Views views = Turn(1);
  const double before = RmsToPear(views);
  const PoseRefinement refinement = RefinePoses(views, {}, 2);
  for (const double angle : refinement.angle) EXPECT_LT(std::abs(angle), 0.3);  // a lobed body of revolution
  ApplyCorrections(refinement, &views);
  EXPECT_LT(RmsToPear(views), 1.02 * before);
  EXPECT_NEAR(refinement.before.normalised, 1, 0.3);
  EXPECT_TRUE(refinement.warnings.empty());
}

TEST(PoseRefinement, DisplacedViews_AreBroughtTogether) {
  Views views = Turn(2);
  Random random(3);
  for (auto& view : views) {
    Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
    motion.linear() =
        Eigen::AngleAxisd(0.15 * kRadians * random.Normal(), Eigen::Vector3d::UnitZ()).toRotationMatrix();
    motion.translation() = 0.3 * Eigen::Vector3d(random.Normal(), random.Normal(), random.Normal());
    MoveView(motion, &view);
  }
  const double before = RmsToPear(views);
  const PoseRefinement refinement = RefinePoses(views, {}, 2);
  ApplyCorrections(refinement, &views);
  EXPECT_LT(refinement.after.rms, 0.7 * refinement.before.rms);
  EXPECT_LT(RmsToPear(views), 0.8 * before);
  EXPECT_NEAR(refinement.after.normalised, 1, 0.3);
}

TEST(PoseRefinement, WrongAnglesOfTheDisk_AreFound) {
  Views views = Turn(4, 0.2);
  Random random(5);
  std::vector<double> errors;
  for (auto& view : views) {
    errors.push_back(0.3 * random.Normal());
    MoveView(Eigen::Isometry3d(Eigen::AngleAxisd(errors.back() * kRadians, Eigen::Vector3d::UnitZ())), &view);
  }
  const PoseRefinement refinement =
      RefinePoses(views, {.freedom = PoseFreedom::kAngle, .angle_deviation = 0.5}, 2);
  double mean = 0;
  for (std::size_t v = 0; v < views.size(); ++v) mean += (errors[v] + refinement.angle[v]) / kViews;
  for (std::size_t v = 0; v < views.size(); ++v) EXPECT_NEAR(refinement.angle[v] + errors[v], mean, 0.1);
}

TEST(PoseRefinement, AnyNumberOfThreads_GivesTheSameBits) {
  const Views views = Turn(6);
  const PoseRefinement one = RefinePoses(views, {}, 1), two = RefinePoses(views, {}, 2);
  for (std::size_t v = 0; v < views.size(); ++v) {
    EXPECT_EQ(one.correction[v].matrix(), two.correction[v].matrix());
  }
}

TEST(PoseRefinement, WrongPhi_IsWarnedOf) {
  Views views = Turn(7);
  // Relief that is a fifth too deep, as φ too small makes it.
  for (auto& view : views) {
    for (ScanPoint& p : view) p.position += 0.2 * p.to_camera.dot(p.position) * p.to_camera;
  }
  EXPECT_TRUE(OverlapWarning(MeasureOverlaps(views, {}, 2)).has_value());
  EXPECT_FALSE(OverlapWarning(MeasureOverlaps(Turn(7), {}, 2)).has_value());
}

TEST(PoseRefinement, WrongSignOfTheAngles_IsAnError) {
  Views views = Turn(8);
  EXPECT_NO_THROW(CheckTurningSense(views));
  // The depth about the axis is mirrored.
  for (auto& view : views) {
    Eigen::Vector3d camera = Eigen::Vector3d::Zero();
    for (const ScanPoint& p : view) camera += p.to_camera;
    camera.z() = 0;
    camera.normalize();
    for (ScanPoint& p : view) {
      p.position -= 2 * camera.dot(p.position) * camera;
      p.normal = -(p.normal - 2 * camera.dot(p.normal) * camera);
    }
  }
  EXPECT_THROW(CheckTurningSense(views), InputError);
}

}  // namespace
}  // namespace frond
