// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/robust_loss.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/errors.h"

namespace frond {
namespace {

TEST(RobustLoss, EveryType_EqualsCeresLossToTheBit) {
  for (const std::string& name : RobustLossNames()) {
    for (const double scale : {1e-3, 0.05, 1.0, 7.3}) {
      const RobustLoss loss = MakeRobustLoss(name, scale);
      const auto ceres_loss = MakeCeresLoss(loss);
      ASSERT_EQ(ceres_loss == nullptr, name == "none");
      for (const double r : {0.0, 1e-9, 0.3, 0.999999, 1.0, 1.000001, 2.0, 1e3, 1e100}) {
        const double s = r * scale * (r * scale);
        double expected[3] = {s, 1, 0};
        if (ceres_loss != nullptr) ceres_loss->Evaluate(s, expected);
        const RobustLoss::Value value = loss(s);
        EXPECT_EQ(value.rho, expected[0]) << name << " scale " << scale << " s " << s;
        EXPECT_EQ(value.derivative, expected[1]) << name << " scale " << scale << " s " << s;
      }
    }
  }
}

TEST(RobustLoss, EveryType_IsConcave) {
  // What the compressed rows rely on: ρ(s) ≥ ρ′(s) s and ρ″ ≤ 0.
  for (const std::string& name : RobustLossNames()) {
    const RobustLoss loss = MakeRobustLoss(name, 0.7);
    double last = loss(0).derivative;
    EXPECT_EQ(loss(0).rho, 0);
    EXPECT_EQ(last, 1);
    for (double s = 0.01; s < 3; s += 0.01) {
      const RobustLoss::Value value = loss(s);
      EXPECT_GE(value.rho, value.derivative * s * (1 - 1e-14)) << name;
      EXPECT_LE(value.derivative, last) << name;
      last = value.derivative;
    }
  }
}

TEST(MakeRobustLoss, UnknownName_ThrowsWithNearest) {
  try {
    MakeRobustLoss("hubr", 1);
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(), "unknown robust loss 'hubr' (did you mean 'huber'?)");
  }
}

TEST(MakeRobustLoss, ScaleNotPositive_Throws) {
  for (const double scale : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    EXPECT_THROW(MakeRobustLoss("cauchy", scale), ConfigError);
  }
}

}  // namespace
}  // namespace frond
