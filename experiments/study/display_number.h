// SPDX-License-Identifier: BSD-3-Clause
// Numbers for people, independent of the locale: three significant digits, and words where there is no
// number.
#pragma once

#include <cstdint>
#include <string>

#include "solvers/comparison/interval.h"

namespace frond {

// "12.3", "7" (whole numbers below 1000 as they are), "12300", "1.23e-7", "∞"; "—" for NaN.
std::string ThreeDigits(double value);

// A setting, with the digits that it has: "0.1", "1e-5".
std::string InFull(double value);

// Evaluations or seconds until something happens: as ThreeDigits, "never" where infinite.
std::string UntilText(double value);

std::string Percent(double share);                      // "93.3 %"
std::string Significance(double p);                     // "0.034", "< 0.001"
std::string CountOf(int count, int all);                // "28/30"
std::string UntilText(const Interval& interval);        // "10.1–15", "1200–never"
std::string PercentInterval(const Interval& interval);  // "78.7–98.2 %"
std::string WholeNumber(std::int64_t value);            // "12,500"

}  // namespace frond
