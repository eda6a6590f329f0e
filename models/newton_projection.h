// SPDX-License-Identifier: BSD-3-Clause
// The foot point of Wu et al. 2021, eqs (7) and (8) and appendix A, as printed (save S_v, which stands for
// ∂S/∂v there too). It is a local method with a poor start on bent surfaces: it may end at a wrong foot. The
// robust one is in models/foot_point_search.h.
#pragma once

#include <Eigen/Core>

#include "models/nurbs_surface.h"

namespace frond {

struct NewtonProjectionOptions {
  double length_tolerance = 1e-10;  // ε1, in the unit of the surface (the paper's is mm)
  double cosine_tolerance = 1e-10;  // ε2
  int max_iterations = 100;         // not in the paper, which does not say what to do without convergence
};

// Which of the appendix's three criteria ended the iteration, or why it ended without.
enum class NewtonCriterion {
  kCoincidence = 1,    // (1) the point lies on the surface
  kOrthogonality = 2,  // (2) r is orthogonal to S_u and S_v
  kStep = 3,           // (3) the step, after it was held in the domain, is negligible
  kIterationLimit,
  kSingular,  // eq. (A3) has no solution
};

struct NewtonProjection {
  Eigen::Vector2d parameters;  // (u, v) in the domain
  Eigen::Vector3d foot;
  double distance;
  int iterations;  // Newton steps taken
  NewtonCriterion criterion;
};

// Eqs (7) and (8): ratios of distances to the middles of the domain's edges; [0, 1] is mapped to the domain.
Eigen::Vector2d DistanceRatioStart(const NurbsSurface& surface, const Eigen::Vector3d& point);

// Newton's iteration (A1)–(A3) from DistanceRatioStart, or from (u, v) = `start`. Parameters that leave the
// domain are set to its nearest end (The NURBS Book, section 6.1), or wrapped where it is periodic.
NewtonProjection ProjectByNewton(const NurbsSurface& surface, const Eigen::Vector3d& point,
                                 const NewtonProjectionOptions& options = {});
NewtonProjection ProjectByNewton(const NurbsSurface& surface, const Eigen::Vector3d& point,
                                 const Eigen::Vector2d& start, const NewtonProjectionOptions& options = {});

}  // namespace frond
