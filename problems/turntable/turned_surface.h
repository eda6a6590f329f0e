// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <span>

#include "models/nurbs_surface.h"
#include "problems/surface/surface_fit.h"
#include "problems/turntable/silhouette_planes.h"

namespace frond {

struct TurnedSurfaceFit {
  SurfaceFit fit;                                             // in the fit's frame
  Eigen::Isometry3d to_disk = Eigen::Isometry3d::Identity();  // the fit's frame to the disk's
  std::array<double, 2> unseen{0, 0};  // degrees about the bottom and the top that no point covers
  TrimmedSurface surface;              // in the disk's frame
};

// The closed NURBS surface of an object on a turning disk, from points in the disk's frame: poles along the
// axis, where a camera at the side sees neither the top nor what the object stands on. Holes there are closed
// by CloseUnseenPole's points, of which fit.warnings tells; the fit's quality, errors and distances are those
// of the points given alone. `silhouettes`: planes that touch the object, in the disk's frame; may be empty.
// FitSurface's frame is the disk's with x up and the origin inside the object. options.topology is set to
// kSphere. Throws as FitSurface.
TurnedSurfaceFit FitTurnedSurface(std::span<const Eigen::Vector3d> points,
                                  std::span<const TangentPlane> silhouettes, SurfaceFitOptions options,
                                  const Solver& solver, const Budget& budget, const SolveContext& context);

}  // namespace frond
