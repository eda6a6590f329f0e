// SPDX-License-Identifier: BSD-3-Clause
#include <map>

#include "base/errors.h"
#include "base/option_specs.h"
#include "problems/curve/curve_fit.h"
#include "problems/curve/curve_knots.h"

namespace frond {
namespace {

constexpr int kMostControlPoints = 1000;

const std::map<std::string, CurveParametrisation> kParametrisations = {
    {"auto", CurveParametrisation::kAuto},
    {"uniform", CurveParametrisation::kUniform},
    {"chord", CurveParametrisation::kChord},
    {"centripetal", CurveParametrisation::kCentripetal},
    {"base_curve", CurveParametrisation::kBaseCurve}};
const std::map<std::string, BaseCurve> kBases = {
    {"fitted", BaseCurve::kFitted}, {"line", BaseCurve::kLine}, {"circle", BaseCurve::kCircle}};
const std::map<std::string, CurveKnots> kKnots = {{"averaging", CurveKnots::kAveraging},
                                                  {"uniform", CurveKnots::kUniform},
                                                  {"ma", CurveKnots::kMa},
                                                  {"refine", CurveKnots::kRefine}};
const std::map<std::string, CurveUnknowns> kUnknowns = {{"control_points", CurveUnknowns::kControlPoints},
                                                        {"weights", CurveUnknowns::kWeights},
                                                        {"both", CurveUnknowns::kBoth}};

}  // namespace

std::vector<OptionSpec> CurveFitSpecs() {
  OptionSpec control_points =
      IntegerSpec("curve.control_points", 20, 2, kMostControlPoints,
                  "Distinct control points; auto: the fewest within 2 % of the least held-out error");
  control_points.words = {"auto"};
  OptionSpec fairness = NumberSpec("fit.fairness", 0, 0, 1,
                                   "Weight of the bending energy, as a share of the points, parameter over "
                                   "[0, 1]; auto: by the distances left (none for parametric ones)");
  fairness.default_value = std::string("auto");
  fairness.words = {"auto"};
  return {
      IntegerSpec("curve.degree", 3, 1, kMaxDegree, "Degree"),
      control_points,
      ChoiceSpec("curve.closed", {"auto", "true", "false"},
                 "Whether the curve closes (a periodic basis); auto: by the gap between its ends"),
      ChoiceSpec("curve.order", {"given", "find"},
                 "given: the points follow the curve; find: they come in any order"),
      ChoiceSpec("curve.parametrisation", {"auto", "uniform", "chord", "centripetal", "base_curve"},
                 "Location parameters; auto: chord for a given order, base_curve for a found one"),
      ChoiceSpec("curve.base", {"fitted", "line", "circle"},
                 "First base curve of base_curve; fitted: a coarse curve along the points"),
      IntegerSpec("curve.base_repeats", 3, 0, 100,
                  "Times that a curve fitted with the parameters so far becomes the next base curve"),
      ChoiceSpec("curve.knots", {"averaging", "uniform", "ma", "refine"},
                 "averaging: every span holds a parameter; ma: averages of all parameters; refine: one by "
                 "one, where the error is largest"),
      AutoIntegerSpec("curve.knot_multiplicity", 1, kMaxDegree,
                      "Of the inner knots; auto: 2 for degree 2 with free weights and an even number of "
                      "control points if "
                      "closed, an odd one if open (pieces of conics), else 1"),
      NumberSpec("curve.tolerance", 0, 0, 1e300,
                 "Of knots refine: largest distance at which no more knots are added, in the input's unit"),
      ChoiceSpec("fit.unknowns", {"control_points", "weights", "both"}, "What the solver moves"),
      ChoiceSpec("fit.distance", {"orthogonal", "parametric"},
                 "orthogonal: to the foot points; parametric: to the points at the location parameters"),
      ChoiceSpec("fit.derivatives", {"structured", "autodiff"},
                 "structured: rows written by hand; autodiff: the same by Ceres's auto-diff, slow"),
      fairness,
  };
}

CurveFitOptions CurveFitOptionsFrom(const Options& options) {
  CurveFitOptions fit;
  fit.degree = options.Integer("curve.degree");
  fit.control_points =
      options.HoldsWord("curve.control_points") ? 0 : options.Integer("curve.control_points");
  const std::string& closed = options.Text("curve.closed");
  fit.closed = closed == "auto" ? std::nullopt : std::optional<bool>(closed == "true");
  fit.order = options.Text("curve.order") == "find" ? CurveOrder::kFind : CurveOrder::kGiven;
  fit.parametrisation = kParametrisations.at(options.Text("curve.parametrisation"));
  fit.base = kBases.at(options.Text("curve.base"));
  fit.base_repeats = options.Integer("curve.base_repeats");
  fit.knots = kKnots.at(options.Text("curve.knots"));
  fit.knot_multiplicity =
      options.HoldsWord("curve.knot_multiplicity") ? 0 : options.Integer("curve.knot_multiplicity");
  fit.tolerance = options.Number("curve.tolerance");
  fit.unknowns = kUnknowns.at(options.Text("fit.unknowns"));
  fit.distance =
      options.Text("fit.distance") == "parametric" ? CurveDistance::kParametric : CurveDistance::kOrthogonal;
  fit.derivatives = options.Text("fit.derivatives") == "autodiff" ? CurveDerivatives::kAutodiff
                                                                  : CurveDerivatives::kStructured;
  if (!options.HoldsWord("fit.fairness")) fit.fairness = options.Number("fit.fairness");
  return fit;
}

void CheckCurveOptions(const Options& options) {
  const CurveFitOptions fit = CurveFitOptionsFrom(options);
  if (fit.knot_multiplicity > fit.degree) {
    throw ConfigError("option 'curve.knot_multiplicity' is " + std::to_string(fit.knot_multiplicity) +
                      ", at most the degree " + std::to_string(fit.degree) + " is possible");
  }
  if (fit.base == BaseCurve::kLine && fit.closed.value_or(false)) {
    throw ConfigError("option 'curve.base: line' is no base of a closed curve; take circle or fitted");
  }
  if (fit.control_points == 0 || (!fit.closed && fit.control_points > fit.degree)) return;
  const std::string fault = KnotCountFault(fit, fit.control_points, fit.closed.value_or(false));
  if (!fault.empty()) throw ConfigError("option " + fault);
}

std::vector<std::pair<std::string, OptionValue>> CurveFitSolverDefaults(const std::string& solver) {
  const std::string prefix = solver == "pso_lm" ? "lm." : "";
  if (solver != "lm" && solver != "dogleg" && solver != "pso_lm") return {};
  return {{prefix + "max_iterations", std::int64_t{50}},  // of each stage
          {prefix + "initial_trust_region_radius", 1.0},
          {prefix + "linear_solver", std::string("sparse_normal_cholesky")},
          {prefix + "function_tolerance", 1e-7},
          {prefix + "gradient_tolerance", 0.0},
          {prefix + "parameter_tolerance", 1e-14}};
}

}  // namespace frond
