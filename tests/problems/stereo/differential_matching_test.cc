// SPDX-License-Identifier: BSD-3-Clause
#include "problems/stereo/differential_matching.h"

#include <gtest/gtest.h>

#include <cmath>

#include "problems/stereo/window_matcher.h"
#include "window_case.h"

namespace frond {
namespace {

struct Errors {
  double rms = 0;
  int converged = 0, count = 0;
};

Errors Match(const WindowCase& with, const DifferentialOptions& options, double start_offset) {
  Errors errors;
  for (const WindowPlace& place : Places(with, 8)) {
    const double truth = with.Truth(place.x, place.y);
    const WindowMatch match =
        MatchDifferentially(with.images(), {}, place.x, place.y, {truth + start_offset}, options);
    ++errors.count;
    if (!match.converged) continue;
    ++errors.converged;
    errors.rms += (match.warp[0] - truth) * (match.warp[0] - truth);
  }
  errors.rms = std::sqrt(errors.rms / errors.converged);
  return errors;
}

TEST(ModifiedDifferentialMatching, UnderAnotherExposure_FindsTheDisparity) {
  const WindowCase with({.gain = 0.7, .offset = 25, .noise = 0});
  EXPECT_LT(Match(with, {}, 0.2).rms, 0.03);
  const Errors iterated = Match(with, {.iterations = 20}, 0.2);
  EXPECT_LT(iterated.rms, 1e-3);
  EXPECT_EQ(iterated.converged, iterated.count);
}

TEST(ClassicalDifferentialMatching, UnderTheSameExposure_IsAsGoodAsTheModifiedOne) {
  const WindowCase with({.gain = 1, .offset = 10, .noise = 0});
  EXPECT_LT(Match(with, {.method = DifferentialMethod::kClassical, .iterations = 20}, 0.2).rms, 1e-3);
}

TEST(ClassicalDifferentialMatching, UnderAnotherExposure_IsBiasedAndTheModifiedOneIsNot) {
  const WindowCase with({.gain = 0.7, .offset = 25, .noise = 0});
  const double classical = Match(with, {.method = DifferentialMethod::kClassical, .iterations = 20}, 0.2).rms;
  EXPECT_GT(classical, 20 * Match(with, {.iterations = 20}, 0.2).rms);
}

TEST(ModifiedDifferentialMatching, Iterated_ReachesTheMinimumOfTheWindowsCost) {
  const WindowCase with({});
  const WindowMatcher matcher(with.pair.left, with.all, with.right, with.all, {});
  for (const WindowPlace& place : Places(with, 16)) {
    const WindowMatch linear = MatchDifferentially(with.images(), {}, place.x, place.y, place.start,
                                                   {.iterations = 60, .tolerance = 1e-8});
    const WindowMatch best = matcher.Match(place.x, place.y, place.start);
    if (!linear.converged || !best.converged) continue;
    EXPECT_NEAR(linear.warp[0], best.warp[0], 1e-4);
    EXPECT_NEAR(linear.radiometry[0], best.radiometry[0], 1e-4);
  }
}

}  // namespace
}  // namespace frond
