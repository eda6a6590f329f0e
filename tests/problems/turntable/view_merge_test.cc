// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/view_merge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/errors.h"
#include "models/kd_tree.h"
#include "tests/problems/turntable/pear_scan.h"

namespace frond {
namespace {

using Views = std::vector<std::vector<ScanPoint>>;
constexpr double kSigma = 0.2, kSpacing = 1.5;

Views Turn(int count, std::uint64_t seed) {
  Random random(seed);
  Views views;
  for (int k = 0; k < count; ++k) {
    views.push_back(PearView({}, 2 * std::numbers::pi * k / count, kSpacing, kSigma, k, &random));
  }
  return views;
}

struct CloudErrors {
  double rmse = 0, max = 0, relative = 0, within_one = 0;
};

CloudErrors ErrorsOf(const MergedCloud& cloud) {
  CloudErrors errors;
  for (const MergedPoint& p : cloud.points) {
    const double d = std::abs(LobedPear{}.SignedDistance(p.position));
    errors.rmse += d * d;
    errors.max = std::max(errors.max, d);
    errors.relative += d * d / (p.sigma * p.sigma);
    errors.within_one += d < p.sigma ? 1 : 0;
  }
  const auto n = static_cast<double>(cloud.points.size());
  errors.rmse = std::sqrt(errors.rmse / n);
  errors.relative = std::sqrt(errors.relative / n);
  errors.within_one /= n;
  return errors;
}

TEST(ViewMerge, WholeTurn_IsOneSurfaceNearTheTruth) {
  const MergedCloud cloud = MergeViews(Turn(12, 1), {}, 2);
  const CloudErrors errors = ErrorsOf(cloud);
  printf("n %zu of %zu spacing %g rmse %g max %g rel %g within %g thick %g rel %g isolated %zu contra %zu\n",
         cloud.points.size(), cloud.points_in, cloud.spacing, errors.rmse, errors.max, errors.relative,
         errors.within_one, cloud.thickness, cloud.relative_thickness, cloud.isolated, cloud.contradicted);
  EXPECT_LT(errors.rmse, 0.5 * kSigma);
  EXPECT_LT(errors.max, 5 * kSigma);
}

}  // namespace
}  // namespace frond
