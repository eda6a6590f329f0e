// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace frond {

// The number of correct significant digits (McCullough 1998): −log₁₀(|c − q|/|c|) for the computed q and the
// certified c, or −log₁₀|q| where c is 0; never below 0 nor above 11, the digits to which NIST certifies its
// nonlinear problems. A computed NaN or infinity has 0 digits. Throws std::invalid_argument where the
// certified value is not finite.
double LogRelativeError(double computed, double certified);

}  // namespace frond
