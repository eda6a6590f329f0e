// SPDX-License-Identifier: BSD-3-Clause
// NURBS curves to points in the plane (z = 0) or in space. Equation numbers are those of Moustakides et al.,
// section 3.2.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/options.h"
#include "base/stage_clock.h"
#include "models/nurbs_curve.h"
#include "solvers/solver.h"

namespace frond {

// kGiven: the points follow the curve. kFind: in any order; found by curve_order.h.
enum class CurveOrder { kGiven, kFind };

// Eqs (15), (17), (19) and the base curve of Ma (curve_parameters.h). kAuto: kChord for a given order,
// kBaseCurve for a found one, whose neighbours zigzag across the noise.
enum class CurveParametrisation { kAuto, kUniform, kChord, kCentripetal, kBaseCurve };

// What the points are projected on first. kFitted: a coarse curve through them in their order.
enum class BaseCurve { kFitted, kLine, kCircle };

// kUniform: eq. (20). kAveraging: (A8), every span holds a parameter, or (A7) where there are as many control
// points as points. kMa: averages of all parameters. kRefine: from few spans, a knot more in the span of the
// largest error.
enum class CurveKnots { kUniform, kAveraging, kMa, kRefine };

enum class CurveUnknowns { kControlPoints, kWeights, kBoth };

// kParametric: eq. (22), at fixed location parameters. kOrthogonal: eq. (37), to the foot points.
enum class CurveDistance { kParametric, kOrthogonal };

// kStructured: rows written by hand. kAutodiff: every row from CurveResidual, the definition; equal, and
// slow.
enum class CurveDerivatives { kStructured, kAutodiff };

struct CurveFitOptions {
  int degree = 3;
  int control_points = 20;             // distinct ones; 0: chosen by held-out error
  std::optional<bool> closed = false;  // a periodic basis; nullopt: by the gap between the ends
  CurveOrder order = CurveOrder::kGiven;
  CurveParametrisation parametrisation = CurveParametrisation::kAuto;
  BaseCurve base = BaseCurve::kFitted;  // of kBaseCurve
  int base_repeats = 3;                 // times that a better base curve takes the place of the last
  CurveKnots knots = CurveKnots::kAveraging;
  // Of the inner knots (closed: of all), up to the degree; their number has to be a multiple of it. 0: 2 for
  // curves of degree 2 with free weights and an even number (at least 6) of control points if closed, an odd
  // one (at least 5) if open: pieces of conics, which can be a whole circle or ellipse exactly (docs:
  // mathematics). Else 1.
  int knot_multiplicity = 0;
  double tolerance =
      0;  // of kRefine: no more knots once the largest distance is below; 0: all control points
  CurveUnknowns unknowns = CurveUnknowns::kControlPoints;
  CurveDistance distance = CurveDistance::kOrthogonal;
  CurveDerivatives derivatives = CurveDerivatives::kStructured;
  // λ of λ N ∫|C″|² dt (control points alone), t over [0, 1]. nullopt: none for parametric distances; for
  // orthogonal ones, which do not forbid a curve that waves through the noise, by the noise (curve_stages.h).
  std::optional<double> fairness;
};

// The options of a curve fit in a config, with the sections `curve` and `fit`, and their reading.
std::vector<OptionSpec> CurveFitSpecs();
CurveFitOptions CurveFitOptionsFrom(const Options& options);

// Checks what single options cannot tell (degree, control points and multiplicities); throws ConfigError.
void CheckCurveOptions(const Options& options);

// Solver options that suit the fit, to be used as defaults: name and value.
std::vector<std::pair<std::string, OptionValue>> CurveFitSolverDefaults(const std::string& solver);

struct CurveFit {
  NurbsCurve curve;  // over [0, 1]
  // All by input point, in the input's order.
  std::vector<double> location_parameters;  // s_i of the parametrisation: of eqs (22) and (34)
  std::vector<double> parameters;           // of the foot points
  std::vector<double> distances;            // to the foot points, ≥ 0
  std::vector<std::size_t> order;           // the points along the curve, as indices of the input
  SolverReport report;                      // of all stages together; the objective is the last one's
  std::vector<StageTime> stages;
  std::vector<std::string> warnings;

  bool closed() const { return curve.basis().periodic(); }
};

// order → location parameters → knots → linear start (with free weights also Ma's two steps, eqs (25) and
// (26)) → stages of the fit by `solver`, the ridge on free weights falling → global foot points.
//
// Throws InputError if there are fewer points than control points, the points coincide, or the degree asks
// for more control points; FitError if a stage fails.
CurveFit FitCurve(std::span<const Eigen::Vector3d> points, const CurveFitOptions& options,
                  const Solver& solver, const Budget& budget, const SolveContext& context);

}  // namespace frond
