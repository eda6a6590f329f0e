// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/view_pairs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "base/errors.h"

namespace frond {
namespace {

TurntableRig Rig() {
  return RigFromAxis({.width = 900, .height = 700, .focal = {2000, 2000, 450, 350}}, {0, 60, 600},
                     {0, -1, 0.1});
}

std::vector<std::array<double, 2>> Angles(const std::vector<double>& degrees,
                                          const ViewPairOptions& options = {}) {
  std::vector<std::array<double, 2>> angles;
  for (const ViewPair& pair : FindViewPairs(degrees, {}, Rig(), options)) {
    angles.push_back({degrees[pair.left], degrees[pair.right]});
  }
  return angles;
}

std::string ErrorOf(const std::vector<double>& degrees, const std::vector<std::string>& names = {},
                    const ViewPairOptions& options = {}) {
  try {
    FindViewPairs(degrees, names, Rig(), options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ViewPairs, LeftView_IsTheOneWhosePairRectifies) {
  for (const auto& [left, right] : Angles({0, 4, 90, 94, 180, 184, 270, 274})) {
    constexpr double kRadians = std::numbers::pi / 180;
    EXPECT_NO_THROW(Rectify(Rig().Pair(left * kRadians, right * kRadians)));
    EXPECT_EQ(left - right, 4);
  }
}

TEST(ViewPairs, OrderOfTheList_DoesNotMatter) {
  std::vector<double> degrees{0, 4, 15, 19, 30, 34};
  const auto expected = Angles(degrees);
  EXPECT_EQ(expected.size(), 3U);
  do {
    EXPECT_EQ(Angles(degrees), expected);
  } while (std::next_permutation(degrees.begin(), degrees.end()));
}

TEST(ViewPairs, RoundTheTurn_ArePairsToo) {
  const std::vector<std::array<double, 2>> across{{2, 358}};
  EXPECT_EQ(Angles({358, 2}), across);
  EXPECT_EQ(Angles({2, 358}), across);
  EXPECT_EQ(Angles({-2, 2}), (std::vector<std::array<double, 2>>{{2, -2}}));
  EXPECT_EQ(Angles({355, 359}), (std::vector<std::array<double, 2>>{{359, 355}}));
}

TEST(ViewPairs, EvenSteps_MakeAPairOfEachTwoNeighbours) {
  std::vector<double> degrees;
  for (int k = 0; k < 90; ++k) degrees.push_back(4 * k);
  EXPECT_EQ(Angles(degrees).size(), 90U);
  EXPECT_EQ(Angles(degrees, {.phi = 8}).size(), 90U);
}

TEST(ViewPairs, RoughAngles_ArePairedWithinTheTolerance) {
  EXPECT_EQ(Angles({0, 4.1, 20, 23.9}, {.phi = 4}).size(), 2U);
  EXPECT_THAT(ErrorOf({0, 4.1, 20, 23.1}, {}, {.phi = 4}), testing::HasSubstr("no partner 4 degrees"));
}

TEST(ViewPairs, MissingView_IsNamed) {
  EXPECT_THAT(ErrorOf({0, 4, 15, 30, 34}, {"a.png", "b.png", "c.png", "d.png", "e.png"}),
              testing::AllOf(testing::HasSubstr("c.png (15 degrees)"), testing::HasSubstr("missing")));
}

TEST(ViewPairs, SameAngleTwice_IsNamed) {
  EXPECT_THAT(ErrorOf({0, 4, 364, 15, 19}, {"a.png", "b.png", "c.png", "d.png", "e.png"}),
              testing::AllOf(testing::HasSubstr("b.png"), testing::HasSubstr("c.png"),
                             testing::HasSubstr("same angle")));
}

TEST(ViewPairs, TooFewViews_AreAnError) {
  EXPECT_THAT(ErrorOf({}), testing::HasSubstr("takes two views"));
  EXPECT_THAT(ErrorOf({3}), testing::HasSubstr("takes two views"));
  EXPECT_THAT(ErrorOf({3, std::numeric_limits<double>::quiet_NaN()}), testing::HasSubstr("has no angle"));
}

}  // namespace
}  // namespace frond
