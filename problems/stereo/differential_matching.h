// SPDX-License-Identifier: BSD-3-Clause
// The differential matching technique (DMT) of Moustakides et al. 2000 in its classical and modified form.
// With R₀ the right window at the start and R₀ₓ its slope:
//
//   classical  L = R₀ − δ R₀ₓ + β            the gain taken as 1: a gain α biases δ by (α − 1)δ and more
//   modified   R₀ = a L + b + δ R₀ₓ          linear in all unknowns, no nominal radiometry (MATH.md §3)
//
// δ = δ0 + δ1 ξ + δ2 η after the window's warp. One linear least-squares problem; iterated, each solution is
// the start of the next.
#pragma once

#include "problems/stereo/window_model.h"

namespace frond {

enum class DifferentialMethod { kClassical, kModified };

struct DifferentialOptions {
  DifferentialMethod method = DifferentialMethod::kModified;
  int iterations = 1;       // at most
  double tolerance = 1e-4;  // px: a smaller last step has converged
};

// The radiometry of `model` is the modified method's; the classical one has the offset alone. A match of one
// iteration counts as converged where the step stays within the window. The images are those of a
// WindowImages::Check and the model of a CheckWindowModel that passed.
WindowMatch MatchDifferentially(const WindowImages& images, const WindowModel& model, int x, int y,
                                const WarpValues& start, const DifferentialOptions& options);

}  // namespace frond
