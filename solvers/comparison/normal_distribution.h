// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace frond {

// Φ(x) = erfc(−x/√2)/2, to a relative error of about x² 1e-16 in the lower tail as well.
double NormalCdf(double x);

// Φ⁻¹(p) to about 1e-15 of max(1, |Φ⁻¹(p)|), for p down to 1e-300: the rational start of Abramowitz and
// Stegun (1964) 26.2.23, polished by Halley's iteration on Φ. −∞ at 0 and +∞ at 1. Throws
// std::invalid_argument for p outside [0, 1].
double NormalQuantile(double p);

}  // namespace frond
