// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/turned_surface.h"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "base/errors.h"
#include "models/nurbs_operations.h"
#include "problems/surface/closed_start.h"
#include "problems/turntable/unseen_poles.h"

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

constexpr double kDegrees = 180 / std::numbers::pi;

// The caps' points are none of the scan's.
void JudgeWithoutCaps(const std::vector<Eigen::Vector3d>& points, bool distance_fit, int threads,
                      SurfaceFit* fit) {
  fit->outlier.resize(points.size());
  FitJudgement judgement = JudgeFit(points, fit->outlier, fit->surface, threads);
  fit->quality = judgement.quality;
  fit->errors = judgement.errors;
  if (distance_fit) {  // its parameters are the feet
    fit->errors.parametric_total = fit->errors.perpendicular_total;
    fit->errors.parametric_mean = fit->errors.perpendicular_mean;
  }
  fit->distances = std::move(judgement.distances);
}

void AddWarnings(const std::array<PoleCap, 2>& caps, SurfaceFit* fit) {
  constexpr std::array<const char*, 2> kEnds{"bottom", "top"};
  for (std::size_t k = 0; k < 2; ++k) {
    const std::string end = std::string("the object's ") + kEnds[k];
    if (!caps[k].closable) {
      fit->warnings.push_back(
          end + " is not seen and its rim does not tell its shape; the surface there is a guess");
    } else if (!caps[k].points.empty()) {
      fit->warnings.push_back(
          end + " is not seen within " +
          std::to_string(static_cast<int>(std::ceil(caps[k].opening * kDegrees))) +
          " degrees of the axis; the surface there " +
          (caps[k].silhouettes ? "follows the silhouettes" : "continues the ring around it"));
    }
  }
}

}  // namespace

TurnedSurfaceFit FitTurnedSurface(std::span<const Eigen::Vector3d> points,
                                  std::span<const TangentPlane> silhouettes, SurfaceFitOptions options,
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
  std::vector<TangentPlane> planes;
  planes.reserve(silhouettes.size());
  for (const TangentPlane& plane : silhouettes) {
    planes.push_back(
        {from_disk.linear() * plane.normal, plane.offset - plane.normal.dot(to_disk.translation())});
  }
  std::array<PoleCap, 2> caps{CloseUnseenPole(local, planes, -1), CloseUnseenPole(local, planes, 1)};
  std::vector<Eigen::Vector3d> closed = local;
  for (const PoleCap& cap : caps) closed.insert(closed.end(), cap.points.begin(), cap.points.end());
  SurfaceFit fit = FitSurface(closed, {}, std::nullopt, options, solver, budget, context);
  if (closed.size() > local.size())
    JudgeWithoutCaps(local, options.method == SurfaceMethod::kDistance, context.threads, &fit);
  AddWarnings(caps, &fit);
  TrimmedSurface surface{Transformed(fit.surface.surface, to_disk), fit.surface.trim};
  return {.fit = std::move(fit),
          .to_disk = to_disk,
          .unseen = {caps[0].opening * kDegrees, caps[1].opening * kDegrees},
          .surface = std::move(surface)};
}

}  // namespace frond
