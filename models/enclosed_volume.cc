// SPDX-License-Identifier: BSD-3-Clause
#include "models/enclosed_volume.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/errors.h"
#include "models/gauss_rule.h"
#include "models/surface_cells.h"

namespace frond {
namespace {

using Polygon = std::vector<Eigen::Vector3d>;

constexpr int kRimPoints = 2048;

// ⅓ ∫∫ (S − origin) · (S_u × S_v) du dv.
double Flux(const SurfaceCells& cells, const Eigen::Vector3d& origin) {
  // Exact for polynomial cells of degree p up to 10: (S × S_v) · S_u is of degree 3p − 1. Rational ones at
  // least 6.
  const int degree = std::max(cells.u().degree(), cells.v().degree());
  const GaussRule& rule = GaussRuleOf(std::clamp((3 * degree + 1) / 2, 6, kMaxGaussPoints));
  double sum = 0;
  for (int ku = 0; ku < cells.u().count(); ++ku) {
    for (int kv = 0; kv < cells.v().count(); ++kv) {
      double cell = 0;
      for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        for (std::size_t j = 0; j < rule.nodes.size(); ++j) {
          const auto jet = cells.Evaluate1(cells.u().begin(ku) + cells.u().length(ku) * rule.nodes[i],
                                           cells.v().begin(kv) + cells.v().length(kv) * rule.nodes[j]);
          cell += rule.weights[i] * rule.weights[j] * (jet.position - origin).dot(jet.du.cross(jet.dv));
        }
      }
      sum += cell * cells.u().length(ku) * cells.v().length(kv);
    }
  }
  return sum / 3;
}

double TriangleFlux(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  return a.dot(b.cross(c)) / 6;
}

// The rim at v's begin or end, in the sense of rising u.
Polygon Rim(const SurfaceCells& cells, bool end) {
  const BSplineBasis& bu = cells.basis_u();
  const double v = end ? cells.basis_v().end() : cells.basis_v().begin();
  Polygon rim;
  for (int k = 0; k < kRimPoints; ++k) {
    rim.push_back(cells.Evaluate(bu.begin() + (bu.end() - bu.begin()) * k / kRimPoints, v));
  }
  return rim;
}

bool HasRim(const SurfaceCells& cells, bool end) {
  return !cells.basis_v().periodic() && !(end ? cells.poles().end : cells.poles().begin);
}

Eigen::Vector3d MeanOf(const Polygon& polygon) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& p : polygon) mean += p / static_cast<double>(polygon.size());
  return mean;
}

SurfaceCells ClosedCells(const NurbsSurface& surface) {
  if (!surface.u().periodic()) throw InputError("a surface that is open along u encloses no volume");
  return SurfaceCells(surface);
}

}  // namespace

double EnclosedVolume(const NurbsSurface& surface) {
  const SurfaceCells cells = ClosedCells(surface);
  const Eigen::Vector3d origin = surface.control_points()[0];
  double volume = Flux(cells, origin);
  for (const bool end : {false, true}) {
    if (!HasRim(cells, end)) continue;
    const Polygon rim = Rim(cells, end);
    const Eigen::Vector3d apex = MeanOf(rim) - origin;
    for (std::size_t k = 0; k < rim.size(); ++k) {
      const Eigen::Vector3d a = rim[k] - origin, b = rim[(k + 1) % rim.size()] - origin;
      volume += (end ? 1 : -1) * TriangleFlux(apex, a, b);
    }
  }
  return volume;
}

double VolumeBetween(const NurbsSurface& outer, const NurbsSurface& inner) {
  const SurfaceCells out = ClosedCells(outer), in = ClosedCells(inner);
  const Eigen::Vector3d origin = outer.control_points()[0];
  const double outer_flux = Flux(out, origin), inner_flux = Flux(in, origin);
  const double outer_sign = EnclosedVolume(outer) < 0 ? -1 : 1,
               inner_sign = EnclosedVolume(inner) < 0 ? -1 : 1;
  double volume = outer_sign * outer_flux - inner_sign * inner_flux;
  std::vector<Polygon> inner_rims;
  for (const bool end : {false, true}) {
    if (HasRim(in, end)) inner_rims.push_back(Rim(in, end));
  }
  std::vector<Eigen::Vector3d> outer_means, inner_means;
  for (const bool end : {false, true}) {
    if (HasRim(out, end)) outer_means.push_back(MeanOf(Rim(out, end)));
  }
  for (const Polygon& rim : inner_rims) inner_means.push_back(MeanOf(rim));
  const bool crossed =
      outer_means.size() == 2 && inner_means.size() == 2 &&
      (outer_means[0] - inner_means[1]).norm() + (outer_means[1] - inner_means[0]).norm() <
          (outer_means[0] - inner_means[0]).norm() + (outer_means[1] - inner_means[1]).norm();
  std::size_t rims = 0;
  for (const bool end : {false, true}) {
    if (!HasRim(out, end)) continue;
    if (++rims > inner_rims.size()) throw InputError("the two walls have different numbers of rims");
    const Polygon rim = Rim(out, end);
    // Rims in the order that lets them lie nearest; from the point nearest to this one's first, in the same
    // sense.
    const Polygon& other = inner_rims[crossed ? inner_rims.size() - rims : rims - 1];
    const std::size_t n = rim.size();
    std::size_t first = 0;
    for (std::size_t k = 0; k < n; ++k) {
      if ((other[k] - rim[0]).squaredNorm() < (other[first] - rim[0]).squaredNorm()) first = k;
    }
    const auto matched = [&](std::size_t step) {
      double sum = 0;
      for (std::size_t k = 0; k < n; ++k) sum += (other[(first + step * k) % n] - rim[k]).squaredNorm();
      return sum;
    };
    const std::size_t step = matched(1) <= matched(n - 1) ? 1 : n - 1;
    double ring = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const Eigen::Vector3d a = rim[k] - origin, b = rim[(k + 1) % n] - origin;
      const Eigen::Vector3d c = other[(first + step * k) % n] - origin,
                            d = other[(first + step * (k + 1)) % n] - origin;
      ring += TriangleFlux(a, c, d) + TriangleFlux(a, d, b);
    }
    // With normals outwards the outer surface lies to the left of its end rim, run along u, and the ring to
    // its right.
    volume += outer_sign * (end ? -ring : ring);
  }
  if (rims != inner_rims.size()) throw InputError("the two walls have different numbers of rims");
  return volume;
}

}  // namespace frond
