// SPDX-License-Identifier: BSD-3-Clause
#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <array>

#include "models/radiometry.h"
#include "models/window_warp.h"

namespace frond {
namespace {

TEST(WindowWarp, EveryKind_FollowsItsFormula) {
  const std::array<double, 6> w = {3, 0.1, -0.2, 0.01, 0.02, -0.03};
  EXPECT_DOUBLE_EQ((WarpDisparity<WarpKind::kShift>(w.data(), 2, 5)), 3);
  EXPECT_DOUBLE_EQ((WarpDisparity<WarpKind::kLinear>(w.data(), 2, 5)), 3 + 0.2 - 1);
  EXPECT_DOUBLE_EQ((WarpDisparity<WarpKind::kQuadratic>(w.data(), 2, 5)), 2.2 + 0.04 + 0.2 - 0.75);
  EXPECT_DOUBLE_EQ((WarpDisparity<WarpKind::kAffine>(w.data(), 2, 5)), 2.2);
  EXPECT_DOUBLE_EQ(WarpVerticalShift(w.data(), 2, 5), 0.01 + 0.04 - 0.15);
}

TEST(WindowWarp, OfJets_HasItsTermsAsDerivatives) {
  using Jet = ceres::Jet<double, 6>;
  std::array<Jet, 6> w;
  for (int j = 0; j < 6; ++j) w[static_cast<std::size_t>(j)] = Jet(0.1 * j, j);
  const Jet u = WarpDisparity<WarpKind::kQuadratic>(w.data(), 2, 5);
  EXPECT_EQ(u.v, (Eigen::Vector<double, 6>() << 1, 2, 5, 4, 10, 25).finished());
}

TEST(Radiometry, EveryKind_FollowsItsFormula) {
  const std::array<double, 4> r = {0.8, 15, 0.01, -0.02};
  EXPECT_DOUBLE_EQ((ApplyRadiometry<RadiometryKind::kNone>(r.data(), 100, 2, 5)), 100);
  EXPECT_DOUBLE_EQ((ApplyRadiometry<RadiometryKind::kGainOffset>(r.data(), 100, 2, 5)), 95);
  EXPECT_DOUBLE_EQ((ApplyRadiometry<RadiometryKind::kPlanarGain>(r.data(), 100, 2, 5)),
                   (0.8 + 0.02 - 0.1) * 100 + 15);
}

}  // namespace
}  // namespace frond
