// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace frond {

// P(Q ≤ q) for the range Q of k independent standard normals, the studentised range at infinite degrees of
// freedom (Tukey 1953):  k ∫ φ(z) (Φ(z) − Φ(z − q))^(k − 1) dz,  to about 1e-14. Throws std::invalid_argument
// for k < 2 or a q that is negative or NaN.
double StudentizedRangeCdf(double q, int k);

// Its inverse, to about 1e-13 in q and in p. Throws std::invalid_argument for k < 2 or p outside (0, 1).
double StudentizedRangeQuantile(double p, int k);

}  // namespace frond
