// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/comparison/log_relative_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace frond {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(LogRelativeError, CountsCorrectDigits) {
  // NIST BoxBOD: b1 = 213.80940889 certified.
  EXPECT_NEAR(LogRelativeError(213.80940889 * (1 + 1e-6), 213.80940889), 6, 1e-8);
  EXPECT_NEAR(LogRelativeError(-99, -100), 2, 1e-12);
  EXPECT_NEAR(LogRelativeError(1.5, 1), -std::log10(0.5), 1e-12);
}

TEST(LogRelativeError, OfCertifiedZero_IsTheLogarithmOfTheError) {
  EXPECT_NEAR(LogRelativeError(-1e-4, 0), 4, 1e-12);
  EXPECT_EQ(LogRelativeError(0, 0), 11);
}

TEST(LogRelativeError, StaysBetweenZeroAndEleven) {
  EXPECT_EQ(LogRelativeError(5, 5), 11);
  EXPECT_EQ(LogRelativeError(1 + 1e-14, 1), 11);
  EXPECT_EQ(LogRelativeError(-1, 1), 0);
  EXPECT_EQ(LogRelativeError(3, 1), 0);
  EXPECT_EQ(LogRelativeError(1e300, -1e300), 0);
  EXPECT_EQ(LogRelativeError(-1.7e308, 1.7e308), 0);
  EXPECT_EQ(LogRelativeError(1, 1e-310), 0);
}

TEST(LogRelativeError, OfNaNOrInfinity_IsZero) {
  for (const double computed : {std::nan(""), kInfinity, -kInfinity}) {
    EXPECT_EQ(LogRelativeError(computed, 1), 0);
    EXPECT_EQ(LogRelativeError(computed, 0), 0);
  }
}

TEST(LogRelativeError, DoesNotDependOnSignOrUnit) {
  for (const double scale : {-1.0, 1024.0, 0x1p-40}) {
    EXPECT_EQ(LogRelativeError(scale * 2.7001, scale * 2.7), LogRelativeError(2.7001, 2.7));
  }
}

TEST(LogRelativeError, WithoutFiniteCertifiedValue_Throws) {
  EXPECT_THROW(LogRelativeError(1, kInfinity), std::invalid_argument);
  EXPECT_THROW(LogRelativeError(1, std::nan("")), std::invalid_argument);
}

}  // namespace
}  // namespace frond
