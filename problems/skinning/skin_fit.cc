// SPDX-License-Identifier: BSD-3-Clause
#include "problems/skinning/skin_fit.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "base/errors.h"
#include "base/parallel.h"
#include "problems/skinning/centre_line.h"
#include "problems/skinning/section_layout.h"
#include "problems/skinning/section_points.h"
#include "problems/skinning/skin_refit.h"
#include "problems/surface/local_noise.h"
#include "problems/surface/outliers.h"
#include "problems/surface/principal_axes.h"

namespace frond {
namespace {

constexpr double kGap = 4;  // spacings that still hang together

std::string NumberText(double x) {
  std::ostringstream text;
  text.precision(3);
  text << x;
  return text.str();
}

void CheckOrigins(const std::vector<SectionPlane>& planes, double spacing) {
  constexpr double kSame = 1e-6;  // spacings
  for (std::size_t k = 0; k < planes.size(); ++k) {
    for (std::size_t j = 0; j < k; ++j) {
      if ((planes[k].origin - planes[j].origin).norm() > kSame * spacing) continue;
      throw InputError("planes " + std::to_string(j + 1) + " and " + std::to_string(k + 1) +
                       " of 'sections.planes' share their point: give each a point of its own, inside the "
                       "object, in the order of the planes");
    }
  }
}

struct Layout {
  std::vector<SectionPlane> planes;
  CloudEnd first, last;
};

Layout LayOut(std::span<const Eigen::Vector3d> points, const KdTree& tree, double spacing,
              const SkinFitOptions& options) {
  Layout layout;
  if (options.by == SectionsBy::kPlanes) {
    CheckOrigins(options.planes, spacing);
    layout.planes = options.planes;
    OrientNormals(layout.planes);
  }
  const PrincipalAxes axes = FindPrincipalAxes(points, std::vector<std::uint8_t>(points.size(), 0));
  std::optional<CentreLine> line;
  if (options.by == SectionsBy::kCentreLine) {
    line = FindCentreLine(points);
  } else if (options.by == SectionsBy::kAxis) {
    line = StraightLine(points, options.axis.value_or(axes.axes.col(0)));
  } else if (layout.planes.size() > 1) {
    std::vector<Eigen::Vector3d> origins;
    for (const SectionPlane& plane : layout.planes) origins.push_back(plane.origin);
    line = CentreLine(origins);
  }
  if (line) {
    std::vector<double> positions;
    for (const auto& point : points) positions.push_back(line->Locate(point));
    const auto wanted = [&](SectionEnd end) {
      return end == SectionEnd::kAuto && options.by == SectionsBy::kPlanes ? SectionEnd::kPlane : end;
    };
    layout.first = FindEnd(points, tree, spacing, *line, positions, true, wanted(options.first));
    layout.last = FindEnd(points, tree, spacing, *line, positions, false, wanted(options.last));
    if (options.by != SectionsBy::kPlanes) {
      layout.planes =
          PlanesAlong(*line, points, positions, layout.first, layout.last, options.count, spacing);
    }
  }
  return layout;
}

// Every point of a section must lie on its own side of the neighbours' planes.
void CheckCrossing(const std::vector<SectionPlane>& planes,
                   const std::vector<std::vector<Eigen::Vector3d>>& points) {
  const auto crosses = [&](std::size_t section, std::size_t plane, double side) {
    return std::any_of(points[section].begin(), points[section].end(),
                       [&](const auto& point) { return side * planes[plane].Height(point) <= 0; });
  };
  for (std::size_t k = 0; k + 1 < planes.size(); ++k) {
    if (crosses(k, k + 1, -1) || crosses(k + 1, k, 1)) {
      throw InputError("the planes of sections " + std::to_string(k + 1) + " and " + std::to_string(k + 2) +
                       " cross each other inside the object: turn them or set them farther apart");
    }
  }
}

NurbsCurve FitRim(const std::vector<Eigen::Vector3d>& rim, const SectionPlane& beside,
                  const SkinFitOptions& options, SectionPlane* plane) {
  *plane = beside;
  plane->origin = SectionCentroid(rim, beside);
  return FitSectionCurve(rim, SectionParameters(rim, *plane, options.parametrisation), options.degree_u,
                         options.control_points_u);
}

}  // namespace

SkinFit FitSkin(std::span<const Eigen::Vector3d> points, const SkinFitOptions& options,
                const SolveContext& context) {
  StageClock clock;
  if (points.size() < 10) {
    throw InputError("a skin needs at least 10 points, not " + std::to_string(points.size()));
  }
  const KdTree tree(points);
  const double spacing = PointSpacing(points, tree);
  const double tolerance = options.tolerance > 0 ? options.tolerance : spacing;
  Layout layout = LayOut(points, tree, spacing, options);
  clock.End("planes");
  std::vector<SectionPlane>& planes = layout.planes;
  std::vector<std::vector<Eigen::Vector3d>> section_points(planes.size());
  ParallelFor(planes.size(), 1, context.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      section_points[k] =
          SectionPoints(points, tree, planes[k], tolerance, kGap * std::max(spacing, tolerance));
    }
  });
  for (std::size_t k = 0; k < planes.size(); ++k) {
    const std::string name = "section " + std::to_string(k + 1);
    const std::size_t count = section_points[k].size();
    if (count == 0) {
      throw InputError("the plane of " + name + " misses the cloud: no point within " +
                       NumberText(tolerance));
    }
    if (count < static_cast<std::size_t>(options.degree_u) + 1) {
      throw InputError(name + " has " + std::to_string(count) + " points within " + NumberText(tolerance) +
                       " of its plane; a curve of degree " + std::to_string(options.degree_u) + " needs " +
                       std::to_string(options.degree_u + 1) + ": raise sections.tolerance");
    }
    planes[k].origin = SectionCentroid(section_points[k], planes[k]);
  }
  CheckCrossing(planes, section_points);
  const PrincipalAxes axes = FindPrincipalAxes(points, std::vector<std::uint8_t>(points.size(), 0));
  AlignStarts(axes.axes.col(2), planes);
  clock.End("sections");
  std::vector<NurbsCurve> curves;
  std::vector<SectionPlane> curve_planes = planes;
  for (std::size_t k = 0; k < planes.size(); ++k) {
    curves.push_back(FitSectionCurve(section_points[k],
                                     SectionParameters(section_points[k], planes[k], options.parametrisation),
                                     options.degree_u, options.control_points_u));
  }
  SectionPlane rim_plane;
  if (layout.first.kind == SectionEnd::kRim) {
    curves.insert(curves.begin(), FitRim(layout.first.rim, planes.front(), options, &rim_plane));
    curve_planes.insert(curve_planes.begin(), rim_plane);
  }
  if (layout.last.kind == SectionEnd::kRim) {
    curves.push_back(FitRim(layout.last.rim, planes.back(), options, &rim_plane));
    curve_planes.push_back(rim_plane);
  }
  clock.End("curves");
  SkinOptions skin_options = options.skin;
  if (layout.first.kind == SectionEnd::kPole) skin_options.first_pole = layout.first.pole;
  if (layout.last.kind == SectionEnd::kPole) skin_options.last_pole = layout.last.pole;
  Skin skin = SkinCurves(curves, skin_options);
  const int most = static_cast<int>(curves.size()) +
                   2 * (skin_options.first_pole.has_value() + skin_options.last_pole.has_value());
  if (skin.surface.count_v() < most) skin.surface = RefitToSections(skin, curves, skin_options);
  clock.End("skin");
  PointDistances distances = MeasureDistances(points, skin.surface, context.threads);
  const SurfaceQuality quality = JudgeSurface(points, {}, distances, {skin.surface, {}},
                                              {spacing, LocalNoise(points, {}, tree)}, tree, context.threads);
  const SurfaceErrors errors =
      MeasureSurfaceErrors(points, {}, distances, {skin.surface, {}}, spacing, context.threads);
  double twist_max = 0;
  for (std::size_t k = 0; k + 1 < curves.size(); ++k) {
    const double twist = TwistDegrees(curves[k], curve_planes[k], curves[k + 1], curve_planes[k + 1]);
    twist_max = std::max(twist_max, std::abs(twist));
  }
  clock.End("judge");
  return {.surface = std::move(skin.surface),
          .planes = std::move(planes),
          .sections = std::move(curves),
          .v = std::move(skin.v),
          .tolerance = tolerance,
          .distances = std::move(distances),
          .quality = quality,
          .errors = errors,
          .twist_max_degrees = twist_max,
          .stages = clock.stages()};
}

}  // namespace frond
