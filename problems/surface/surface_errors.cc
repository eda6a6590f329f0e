// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/surface_errors.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "base/parallel.h"
#include "models/surface_cells.h"

namespace frond {
namespace {

constexpr std::size_t kChunk = 512;

// The iso-curve's centroid by the midpoint rule in every span: of a closed smooth curve that is exact to
// rounding soon, of a span's polynomial pieces to 1e-6 at 32 samples.
Eigen::Vector3d IsoCentroid(const SurfaceCells& cells, double v) {
  constexpr int kSamples = 32;  // a span
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double length = 0;
  for (int k = 0; k < cells.u().count(); ++k) {
    for (int i = 0; i < kSamples; ++i) {
      const double u = cells.u().begin(k) + cells.u().length(k) * (i + 0.5) / kSamples;
      const SurfaceCells::Jet1 jet = cells.Evaluate1(u, v);
      const double piece = jet.du.norm() * cells.u().length(k);
      sum += piece * jet.position;
      length += piece;
    }
  }
  return length > 0 ? Eigen::Vector3d(sum / length) : cells.Evaluate(cells.basis_u().begin(), v);
}

// IsoCentroid at any v, linear between levels: to 1e-5 of the curve's size.
class CentroidLine {
 public:
  explicit CentroidLine(const SurfaceCells& cells) : begin_(cells.basis_v().begin()) {
    const double end = cells.basis_v().end();
    for (int k = 0; k <= kLevels; ++k) {
      centroid_.push_back(IsoCentroid(cells, begin_ + (end - begin_) * k / kLevels));
    }
    levels_per_unit_ = kLevels / (end - begin_);
  }

  Eigen::Vector3d At(double v) const {
    const double level = std::clamp((v - begin_) * levels_per_unit_, 0.0, static_cast<double>(kLevels));
    const auto k = std::min(static_cast<std::size_t>(level), static_cast<std::size_t>(kLevels - 1));
    const double t = level - static_cast<double>(k);
    return (1 - t) * centroid_[k] + t * centroid_[k + 1];
  }

 private:
  static constexpr int kLevels = 400;
  std::vector<Eigen::Vector3d> centroid_;
  double begin_, levels_per_unit_ = 0;
};

double ValueAt(std::vector<double>* values, double share) {
  const auto k = static_cast<std::ptrdiff_t>(share * static_cast<double>(values->size() - 1));
  std::nth_element(values->begin(), values->begin() + k, values->end());
  return (*values)[static_cast<std::size_t>(k)];
}

}  // namespace

Eigen::Vector3d IsoCurveCentroid(const NurbsSurface& surface, double v) {
  return IsoCentroid(SurfaceCells(surface), v);
}

Eigen::Vector3d AreaCentroid(const TrimmedSurface& trimmed) {
  constexpr int kSide = 200;
  const SurfaceCells cells(trimmed.surface);
  const BSplineBasis &bu = cells.basis_u(), &bv = cells.basis_v();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double area = 0;
  for (int i = 0; i < kSide; ++i) {
    const double u = bu.begin() + (bu.end() - bu.begin()) * (i + 0.5) / kSide;
    const std::vector<double> crossings = TrimCrossings(trimmed.trim, u);
    for (int j = 0; j < kSide; ++j) {
      const double v = bv.begin() + (bv.end() - bv.begin()) * (j + 0.5) / kSide;
      const auto below = std::lower_bound(crossings.begin(), crossings.end(), v) - crossings.begin();
      if (!trimmed.trim.empty() && below % 2 == 0) continue;
      const SurfaceCells::Jet1 jet = cells.Evaluate1(u, v);
      const double piece = jet.du.cross(jet.dv).norm();
      sum += piece * jet.position;
      area += piece;
    }
  }
  return area > 0 ? Eigen::Vector3d(sum / area) : cells.Evaluate(bu.begin(), bv.begin());
}

SurfaceErrors MeasureSurfaceErrors(std::span<const Eigen::Vector3d> points,
                                   std::span<const Eigen::Vector2d> parameters,
                                   const PointDistances& distances, const TrimmedSurface& trimmed,
                                   double least_radius, int threads) {
  SurfaceErrors errors;
  if (points.empty()) return errors;
  const SurfaceCells cells(trimmed.surface);
  const BSplineBasis &bu = cells.basis_u(), &bv = cells.basis_v();
  const bool closed = bu.periodic();
  const Eigen::Vector3d centroid = closed ? Eigen::Vector3d::Zero() : AreaCentroid(trimmed);
  std::optional<CentroidLine> line;
  if (closed) line.emplace(cells);
  std::vector<double> relative(points.size());
  ParallelFor(points.size(), kChunk, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3d foot = points[i] - distances.offsets[i];
      const Eigen::Vector3d middle = closed ? line->At(distances.feet[i][1]) : centroid;
      const double radius = std::max(least_radius, (foot - middle).norm());
      relative[i] = radius > 0 ? distances.offsets[i].norm() / radius : 0;
    }
  });
  std::vector<double> perpendicular;
  perpendicular.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    perpendicular.push_back(distances.offsets[i].norm());
    errors.perpendicular_total += perpendicular.back();
    errors.relative_total += relative[i];
  }
  const auto n = static_cast<double>(points.size());
  errors.perpendicular_mean = errors.perpendicular_total / n;
  errors.relative_mean = errors.relative_total / n;
  errors.p50 = ValueAt(&perpendicular, 0.5);
  errors.p90 = ValueAt(&perpendicular, 0.9);
  errors.p95 = ValueAt(&perpendicular, 0.95);
  errors.p99 = ValueAt(&perpendicular, 0.99);
  if (parameters.empty()) return errors;
  double total = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d position = cells.Evaluate(bu.begin() + parameters[i][0] * (bu.end() - bu.begin()),
                                                    bv.begin() + parameters[i][1] * (bv.end() - bv.begin()));
    total += (points[i] - position).norm();
  }
  errors.parametric_total = total;
  errors.parametric_mean = total / n;
  return errors;
}

}  // namespace frond
