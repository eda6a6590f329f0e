// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/comparison/normal_distribution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace frond {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(NormalQuantile, MatchesSciPy) {
  struct Reference {
    double p, quantile;
  };
  // scipy_reference.py, SciPy 1.10.1.
  for (const Reference& r : std::vector<Reference>{{1e-300, -37.0470962993612},
                                                   {1e-20, -9.262340089798409},
                                                   {1e-5, -4.264890793922825},
                                                   {0.025, -1.9599639845400545},
                                                   {0.2, -0.8416212335729142},
                                                   {0.5, 0},
                                                   {0.6, 0.2533471031357997},
                                                   {0.975, 1.959963984540054},
                                                   {0.995, 2.5758293035489004}}) {
    EXPECT_NEAR(NormalQuantile(r.p), r.quantile, 2e-15 * std::fmax(1, std::abs(r.quantile))) << r.p;
  }
}

TEST(NormalQuantile, InvertsTheDistribution) {
  // Above 0 the rounding of Φ near 1, at most 2⁻⁵⁴, is carried back over the density.
  for (int i = -148; i <= 20; ++i) {
    const double x = i / 4.0;
    EXPECT_NEAR(NormalQuantile(NormalCdf(x)), x, x < 0 ? 2e-14 : 4e-16 * std::exp(x * x / 2)) << x;
  }
}

TEST(NormalQuantile, IsOddAboutOneHalf) {
  for (const double p : {0.125, 0.25, 0.375, 1.0 / 1024})
    EXPECT_EQ(NormalQuantile(1 - p), -NormalQuantile(p));
}

TEST(NormalQuantile, OfCertainties_IsInfinite) {
  EXPECT_EQ(NormalQuantile(0), -kInfinity);
  EXPECT_EQ(NormalQuantile(1), kInfinity);
}

TEST(NormalQuantile, OutsideUnitInterval_Throws) {
  for (const double p : {-1e-9, 1 + 1e-9, std::nan("")})
    EXPECT_THROW(NormalQuantile(p), std::invalid_argument);
}

TEST(NormalCdf, KeepsItsDigitsInTheLowerTail) {
  // Abramowitz and Stegun (1964), table 26.1, and at −10 and −37 scipy_reference.py, SciPy 1.10.1.
  EXPECT_DOUBLE_EQ(NormalCdf(0), 0.5);
  EXPECT_NEAR(NormalCdf(1), 0.841344746068543, 1e-15);
  EXPECT_NEAR(NormalCdf(-10) / 7.61985302416047e-24, 1, 1e-13);
  EXPECT_NEAR(NormalCdf(-37) / 5.7255712225239266e-300, 1, 1e-12);
  EXPECT_EQ(NormalCdf(-kInfinity), 0);
  EXPECT_EQ(NormalCdf(kInfinity), 1);
}

}  // namespace
}  // namespace frond
