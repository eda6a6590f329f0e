// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace frond {

// P(X ≥ x) for X chi-square with degrees_of_freedom = ν: the regularised incomplete gamma function Q(ν/2,
// x/2), a finite sum for whole ν (Abramowitz and Stegun 1964, 26.4.4 and 26.4.5). Throws
// std::invalid_argument for ν < 1 or x negative or NaN.
double ChiSquareUpperTail(double x, int degrees_of_freedom);

}  // namespace frond
