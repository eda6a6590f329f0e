// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/turned_surface.h"

#include <vector>

#include "base/errors.h"
#include "models/nurbs_operations.h"
#include "problems/surface/closed_start.h"

namespace frond {
namespace {

// FitSurface's frame of a sphere: x along the disk's axis, the origin half-way up, at the middle of what the
// points surround there.
Eigen::Isometry3d FrameOf(std::span<const Eigen::Vector3d> points) {
  Eigen::AlignedBox3d box;
  for (const auto& point : points) box.extend(point);
  Eigen::Isometry3d to_disk = Eigen::Isometry3d::Identity();
  to_disk.linear().col(0) = Eigen::Vector3d::UnitZ();
  to_disk.linear().col(1) = Eigen::Vector3d::UnitX();
  to_disk.linear().col(2) = Eigen::Vector3d::UnitY();
  to_disk.translation() = box.center();
  return to_disk;
}

}  // namespace

TurnedSurfaceFit FitTurnedSurface(std::span<const Eigen::Vector3d> points, SurfaceFitOptions options,
                                  const Solver& solver, const Budget& budget, const SolveContext& context) {
  if (points.empty()) throw InputError("the cloud of the turn has no points to fit a surface to");
  options.topology = SurfaceTopology::kSphere;
  const Eigen::Isometry3d to_disk = FrameOf(points);
  const Eigen::Isometry3d from_disk = to_disk.inverse();
  std::vector<Eigen::Vector3d> local;
  local.reserve(points.size());
  for (const auto& point : points) local.push_back(from_disk * point);
  // Distances along the cloud end at the rims of what was seen, which are not poles.
  if (options.base == BaseSurface::kAuto) {
    options.base = IsStarShaped(local) ? BaseSurface::kSphere : BaseSurface::kCylinder;
  }
  SurfaceFit fit = FitSurface(local, {}, std::nullopt, options, solver, budget, context);
  TrimmedSurface surface{Transformed(fit.surface.surface, to_disk), fit.surface.trim};
  return {.fit = std::move(fit), .to_disk = to_disk, .surface = std::move(surface)};
}

}  // namespace frond
