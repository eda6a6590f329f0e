// SPDX-License-Identifier: BSD-3-Clause
// Two photographs of the synthetic pear, 4 degrees apart, matched to the silhouette, against the exact
// disparities (the pear of MATH.md §3; bench/bench_turntable_accuracy.cc has the whole table).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

#include "problems/stereo/stereo_matcher.h"
#include "problems/turntable/synthetic_turntable.h"
#include "problems/turntable/view_images.h"

namespace frond {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kPhi = 4;
constexpr double kGross = 1;  // pixels

struct PearPair {
  NormalPair pair;
  Image truth;  // disparities of the pixels that both cameras see, else NaN
};

PearPair MakePearPair(double contrast, std::uint64_t seed) {
  SyntheticTurntableOptions options;
  options.seed = seed;
  options.tilt = options.offset = 0;
  options.contrast = contrast;
  const SyntheticTurntable session(options);
  const auto view = [&](std::size_t index) {
    SyntheticView photograph = session.View(index, 2);
    return TurntableView{.angle = session.views()[index].angle,
                         .image = std::move(photograph.image),
                         .mask = std::move(photograph.mask)};
  };
  const double base = session.scene().pear_origin.z();
  PearPair result;
  result.pair = RectifyViews(view(0), view(1), session.rig(),
                             {.radius = 38, .bottom = base, .top = base + options.pear.height}, 2);
  const Rectification& normal = result.pair.normal;
  result.truth = Image(normal.width, normal.height, std::numeric_limits<float>::quiet_NaN());
  for (int y = 0; y < normal.height; ++y) {
    for (int x = 0; x < normal.width; ++x) {
      const auto match =
          FindTrueMatch(session.scene(), normal, kPhi / 2 * kDegree, -kPhi / 2 * kDegree, x, y);
      if (match && match->seen) result.truth(x, y) = static_cast<float>(match->disparity);
    }
  }
  return result;
}

StereoMatches Matches(const PearPair& pear) {
  return MatchStereo(pear.pair.left, pear.pair.right, pear.pair.left_mask, pear.pair.right_mask, {}, 2);
}

struct AcceptedErrors {
  std::size_t count = 0, gross = 0, within = 0;
  double squares = 0;  // without the gross ones
};

AcceptedErrors ErrorsOf(const PearPair& pear, const StereoMatches& matches) {
  AcceptedErrors errors;
  for (const MatchedWindow& window : matches.windows) {
    const float truth = pear.truth(window.x, window.y);
    if (window.status != WindowStatus::kAccepted || std::isnan(truth)) continue;
    const double error = std::abs(window.match.warp[0] - truth);
    ++errors.count;
    if (error > kGross) {
      ++errors.gross;
    } else {
      errors.squares += error * error;
    }
    if (error <= window.match.sigma) ++errors.within;
  }
  return errors;
}

double Percent(std::size_t part, std::size_t whole) {
  return 100 * static_cast<double>(part) / static_cast<double>(whole);
}

TEST(PearMatching, DisparitiesReachTheSilhouette) {
  const PearPair pear = MakePearPair(SyntheticTurntableOptions().contrast, 1);
  const StereoMatches matches = Matches(pear);
  std::size_t seen = 0, found = 0, gross = 0;
  for (std::size_t i = 0; i < pear.truth.values.size(); ++i) {
    if (std::isnan(pear.truth.values[i])) continue;
    ++seen;
    if (std::isnan(matches.disparity.values[i])) continue;
    ++found;
    if (std::abs(matches.disparity.values[i] - pear.truth.values[i]) > kGross) ++gross;
  }
  std::printf("of %zu pixels that both views see %.2f %% have a disparity, %.3f %% of them off by a pixel\n",
              seen, Percent(found, seen), Percent(gross, found));
  EXPECT_GE(Percent(found, seen), 97);
  EXPECT_LE(Percent(gross, found), 0.5);
  const AcceptedErrors errors = ErrorsOf(pear, matches);
  std::printf("%zu windows: RMSE %.4f px, %zu gross, %.1f %% within sigma\n", errors.count,
              std::sqrt(errors.squares / static_cast<double>(errors.count - errors.gross)), errors.gross,
              Percent(errors.within, errors.count));
  EXPECT_NEAR(Percent(errors.within, errors.count), 68, 8);
}

TEST(PearMatching, OfWeakTexture_PredictsItsErrors) {
  const PearPair pear = MakePearPair(SyntheticTurntableOptions().contrast / 4, 2);
  const StereoMatches matches = Matches(pear);
  const AcceptedErrors errors = ErrorsOf(pear, matches);
  std::printf("%zu of %zu windows: RMSE %.4f px, %zu gross, %.1f %% within sigma\n", errors.count,
              matches.windows.size(),
              std::sqrt(errors.squares / static_cast<double>(errors.count - errors.gross)), errors.gross,
              Percent(errors.within, errors.count));
  ASSERT_GT(errors.count, 1000U);
  EXPECT_NEAR(Percent(errors.within, errors.count), 68, 8);
  EXPECT_LE(Percent(errors.gross, errors.count), 0.5);
}

}  // namespace
}  // namespace frond
