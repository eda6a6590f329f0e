// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/options.h"
#include "base/stage_clock.h"
#include "problems/skinning/section_curve.h"
#include "problems/skinning/section_ends.h"
#include "problems/skinning/section_planes.h"
#include "problems/skinning/skin.h"
#include "problems/skinning/skin_quality.h"
#include "problems/surface/surface_errors.h"
#include "problems/surface/surface_quality.h"
#include "solvers/solver.h"

namespace frond {

enum class SectionsBy { kAxis, kPlanes, kCentreLine };

struct SkinFitOptions {
  SectionsBy by = SectionsBy::kAxis;
  int count = 12;                            // planes along an axis or centre line
  double tolerance = 0;                      // half the thickness of a section; 0: one spacing of the points
  std::vector<SectionPlane> planes = {};     // kPlanes, in order; starts are found
  std::optional<Eigen::Vector3d> axis = {};  // kAxis; none: the principal one
  SectionEnd first = SectionEnd::kAuto, last = SectionEnd::kAuto;  // kAuto is kPlane with kPlanes
  int degree_u = 3, control_points_u = 20;                         // of every section, the distinct ones
  SectionParametrisation parametrisation = SectionParametrisation::kBaseCurve;
  SkinOptions skin = {};  // degree and control points along v; poles are found
};

// The options of `problem` for a skin: sections.…, curve.…, surface.….
std::vector<OptionSpec> SkinFitSpecs();
SkinFitOptions SkinFitOptionsFrom(const Options& problem);
// Throws ConfigError for combinations that cannot work.
void CheckSkinOptions(const Options& problem);

struct SkinFit {
  NurbsSurface surface;
  std::vector<SectionPlane> planes = {};
  std::vector<NurbsCurve> sections;  // rims included
  std::vector<double> v;             // of the sections
  double tolerance = 0;
  PointDistances distances;
  SurfaceQuality quality;
  SurfaceErrors errors;
  double twist_max_degrees = 0;  // Twist of neighbouring sections, the largest
  std::vector<StageTime> stages;
};

// A surface through plane sections of a cloud (acquisition paper, section 3.3): planes placed, their points
// moved into them, closed curves fitted, skinned. u runs round the object, v along it, and the normals point
// outwards. Throws InputError naming the section where a plane misses the cloud, holds too few points or
// crosses its neighbour inside the object, where two given planes share their point, and as SkinCurves and
// FindEnd do.
SkinFit FitSkin(std::span<const Eigen::Vector3d> points, const SkinFitOptions& options,
                const SolveContext& context);

}  // namespace frond
