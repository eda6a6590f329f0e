// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace frond {

// A confidence interval. An end may be infinite, never NaN.
struct Interval {
  double lower, upper;
};

}  // namespace frond
