// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/rig_warnings.h"

#include <gtest/gtest.h>

#include "tests/problems/turntable/board_views.h"

namespace frond {
namespace {

std::vector<double> Angles(int count) {
  std::vector<double> angles;
  for (int k = 0; k < count; ++k) angles.push_back(10 * k * kDegree);
  return angles;
}

std::vector<Estimate> Errors(const std::vector<double>& degrees) {
  std::vector<Estimate> errors;
  for (std::size_t k = 0; k < degrees.size(); ++k) {
    errors.push_back({degrees[k] * kDegree, k == 0 ? 0 : 0.003 * kDegree});
  }
  return errors;
}

TEST(RigWarningsTest, Noise_OfTheAngles_IsNoFinding) {
  const auto found = FindAngleErrors(Angles(8), Errors({0, .003, -.004, .002, .006, -.003, 0, .001}));
  EXPECT_FALSE(found.scale);
  EXPECT_FALSE(found.step);
  EXPECT_TRUE(found.suspects.empty());
}

TEST(RigWarningsTest, TwoWrongAngles_AreBothNamedWithTheirErrors) {
  const auto found = FindAngleErrors(Angles(8), Errors({0, .003, 3, .002, .006, -2, 0, .001}));
  ASSERT_EQ(found.suspects, (std::vector<std::size_t>{2, 5}));
  EXPECT_NEAR(found.suspect_errors[0], 3 * kDegree, 0.01 * kDegree);
  EXPECT_NEAR(found.suspect_errors[1], -2 * kDegree, 0.01 * kDegree);
  EXPECT_FALSE(found.step);
}

TEST(RigWarningsTest, Scale_WithAWrongAngleBeside_IsToldFromIt) {
  const auto found = FindAngleErrors(Angles(8), Errors({0, .1, .2, .3, 1.4, .5, .6, .7}));
  EXPECT_TRUE(found.scale);
  EXPECT_NEAR(found.factor, 1.01, 1e-6);
  EXPECT_EQ(found.suspects, (std::vector<std::size_t>{4}));
}

TEST(RigWarningsTest, Step_IsFoundWhereItBegins) {
  const auto found = FindAngleErrors(Angles(8), Errors({0, .003, .001, .5, .502, .499, .5, .503}));
  EXPECT_TRUE(found.step);
  EXPECT_EQ(found.step_view, 3u);
  EXPECT_NEAR(found.step_size, 0.5 * kDegree, 0.005 * kDegree);
  EXPECT_TRUE(found.suspects.empty());
}

}  // namespace
}  // namespace frond
