// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "base/errors.h"
#include "base/option_specs.h"
#include "problems/skinning/skin_fit.h"

namespace frond {
namespace {

const std::vector<std::string> kBy = {"axis", "planes", "centre_line"};
const std::vector<std::string> kEnds = {"auto", "plane", "rim", "pole"};
const std::vector<std::string> kSectionParameters = {"base_curve", "chord", "centripetal"};
const std::vector<std::string> kParameters = {"uniform", "chord", "centripetal"};

template <typename Enum>
Enum ChoiceOf(const Options& options, const std::string& name, const std::vector<std::string>& words) {
  return static_cast<Enum>(std::find(words.begin(), words.end(), options.Text(name)) - words.begin());
}

}  // namespace

std::vector<OptionSpec> SkinFitSpecs() {
  OptionSpec tolerance = NumberSpec("sections.tolerance", 0, 1e-12, 1e12,
                                    "Half the thickness of a section; auto: the points' spacing");
  tolerance.default_value = std::string("auto");
  tolerance.words = {"auto"};
  return {
      ChoiceSpec("sections.by", kBy,
                 "What the planes stand across: an axis, nothing (given), or a centre line"),
      IntegerSpec("sections.count", 12, 2, 1000, "Planes along the axis or centre line"),
      tolerance,
      {.name = "sections.planes",
       .type = OptionType::kRows,
       .default_value = OptionRows{},
       .help = "Of sections.by: planes, in order; each [x, y, z, nx, ny, nz]: a point inside the object, the "
               "normal",
       .minimum = -1e12,
       .maximum = 1e12,
       .min_size = 0,
       .max_size = 1000,
       .row_size = 6},
      {.name = "sections.axis",
       .type = OptionType::kNumbers,
       .default_value = std::string("auto"),
       .help = "Direction of sections.by: axis; auto: the longest principal axis",
       .minimum = -1e12,
       .maximum = 1e12,
       .words = {"auto"},
       .min_size = 3,
       .max_size = 3},
      ChoiceSpec("sections.first", kEnds,
                 "How the surface begins; auto: pole or rim as the points show (planes: plane)"),
      ChoiceSpec("sections.last", kEnds, "How the surface ends, likewise"),
      IntegerSpec("curve.degree", 3, 1, kMaxDegree, "Of the closed section curves"),
      IntegerSpec("curve.control_points", 20, 3, 1000, "Distinct ones of every section curve"),
      ChoiceSpec("curve.parametrisation", kSectionParameters,
                 "Of a section's points: the angle on a circle, or cumulative chords"),
      IntegerSpec("surface.degree_v", 3, 1, kMaxDegree, "Degree along the object"),
      AutoIntegerSpec("surface.control_points_v", 2, 1000,
                      "Along the object, two for a pole; auto: as many as interpolate the sections"),
      ChoiceSpec("surface.parametrisation_v", {"chord", "centripetal", "uniform"},
                 "Of the sections, averaged over the columns of control points"),
  };
}

SkinFitOptions SkinFitOptionsFrom(const Options& problem) {
  SkinFitOptions options;
  options.by = ChoiceOf<SectionsBy>(problem, "sections.by", kBy);
  options.count = problem.Integer("sections.count");
  options.tolerance = problem.HoldsWord("sections.tolerance") ? 0 : problem.Number("sections.tolerance");
  for (const std::vector<double>& row : problem.Rows("sections.planes")) {
    SectionPlane plane;
    plane.origin = {row[0], row[1], row[2]};
    plane.normal = Eigen::Vector3d(row[3], row[4], row[5]).stableNormalized();
    options.planes.push_back(plane);
  }
  if (!problem.HoldsWord("sections.axis")) {
    const std::vector<double>& axis = problem.Numbers("sections.axis");
    options.axis = Eigen::Vector3d(axis[0], axis[1], axis[2]);
  }
  options.first = ChoiceOf<SectionEnd>(problem, "sections.first", kEnds);
  options.last = ChoiceOf<SectionEnd>(problem, "sections.last", kEnds);
  options.degree_u = problem.Integer("curve.degree");
  options.control_points_u = problem.Integer("curve.control_points");
  options.parametrisation =
      ChoiceOf<SectionParametrisation>(problem, "curve.parametrisation", kSectionParameters);
  options.skin.degree = problem.Integer("surface.degree_v");
  options.skin.control_points =
      problem.HoldsWord("surface.control_points_v") ? 0 : problem.Integer("surface.control_points_v");
  options.skin.parametrisation = ChoiceOf<Parametrisation>(problem, "surface.parametrisation_v", kParameters);
  return options;
}

void CheckSkinOptions(const Options& problem) {
  const SkinFitOptions options = SkinFitOptionsFrom(problem);
  const bool given = options.by == SectionsBy::kPlanes;
  if (given && options.planes.empty()) {
    throw ConfigError(
        "'sections.by' is planes, but 'sections.planes' has none; each is [x, y, z, nx, ny, nz]");
  }
  if (!given && !options.planes.empty()) {
    throw ConfigError("'sections.planes' are given, but 'sections.by' is " + problem.Text("sections.by") +
                      "; set it to planes");
  }
  for (std::size_t k = 0; k < options.planes.size(); ++k) {
    if (options.planes[k].normal.norm() > 0.5) continue;
    throw ConfigError("plane " + std::to_string(k + 1) + " of 'sections.planes' has a normal of length 0");
  }
  if (options.axis && options.axis->norm() == 0) throw ConfigError("'sections.axis' has length 0");
  const int sections = given ? static_cast<int>(options.planes.size()) : options.count;
  if (options.control_points_u < options.degree_u + 1) {
    throw ConfigError("'curve.control_points' is " + std::to_string(options.control_points_u) +
                      "; a closed curve of degree " + std::to_string(options.degree_u) + " needs at least " +
                      std::to_string(options.degree_u + 1));
  }
  const int rows = options.skin.control_points;
  if (rows != 0 && rows < options.skin.degree + 1) {
    throw ConfigError("'surface.control_points_v' is " + std::to_string(rows) + "; degree " +
                      std::to_string(options.skin.degree) + " along v needs at least " +
                      std::to_string(options.skin.degree + 1));
  }
  const int poles = (options.first == SectionEnd::kPole) + (options.last == SectionEnd::kPole);
  if (poles > 0 && options.skin.degree < 2) {
    throw ConfigError(
        "'surface.degree_v' is 1; a pole ('sections.first', 'sections.last') needs degree 2 or more");
  }
  if (rows != 0 && rows < 2 + poles) {
    throw ConfigError("'surface.control_points_v' is " + std::to_string(rows) + "; the ends take " +
                      std::to_string(2 + poles) + ", two for a pole and one for another end");
  }
  if (sections + 4 < options.skin.degree + 1) {  // SkinCurves tells the rest, when the ends are known
    throw ConfigError(std::to_string(sections) + " sections are too few for 'surface.degree_v' " +
                      std::to_string(options.skin.degree));
  }
}

}  // namespace frond
