// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/sheet_boundary.h"

#include <cmath>

#include "models/surface_cells.h"
#include "problems/surface/boundary_ring.h"
#include "problems/surface/spatial_order.h"

namespace frond {
namespace {

constexpr double kRadius = 5;  // in spacings
constexpr std::size_t kPoints = 100000;

std::vector<std::uint32_t> RingOf(const std::vector<Eigen::Vector2d>& plane, std::size_t all,
                                  double spacing) {
  const double thinning = std::sqrt(static_cast<double>(all) / static_cast<double>(plane.size()));
  return BoundaryRing(plane, kRadius * spacing * thinning);
}

}  // namespace

std::vector<Eigen::Vector3d> BoundaryOfSheet(const std::vector<Eigen::Vector3d>& points, double spacing) {
  const std::vector<Eigen::Vector3d> some = Thinned(points, kPoints);
  std::vector<Eigen::Vector2d> plane;
  plane.reserve(some.size());
  for (const auto& point : some) plane.emplace_back(point.head<2>());
  std::vector<Eigen::Vector3d> ring;
  for (const auto i : RingOf(plane, points.size(), spacing)) ring.push_back(some[i]);
  return ring;
}

TrimLoop BoundaryOfFeet(const std::vector<Eigen::Vector2d>& feet, const NurbsSurface& surface,
                        double spacing) {
  const std::vector<Eigen::Vector2d> some = Thinned(feet, kPoints), few = Thinned(some, 1000);
  const SurfaceCells cells(surface);
  Eigen::Vector2d lengths = Eigen::Vector2d::Zero();
  for (const auto& uv : few) {
    const SurfaceCells::Jet1 jet = cells.Evaluate1(uv[0], uv[1]);
    lengths += Eigen::Vector2d(jet.du.norm(), jet.dv.norm()) / static_cast<double>(few.size());
  }
  std::vector<Eigen::Vector2d> plane;
  plane.reserve(some.size());
  for (const auto& uv : some) plane.emplace_back(uv.cwiseProduct(lengths));
  TrimLoop loop;
  for (const auto i : RingOf(plane, feet.size(), spacing)) loop.push_back(some[i]);
  return loop;
}

}  // namespace frond
