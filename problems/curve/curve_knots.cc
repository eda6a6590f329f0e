// SPDX-License-Identifier: BSD-3-Clause
#include "problems/curve/curve_knots.h"

#include <algorithm>
#include <numeric>

#include "base/errors.h"
#include "models/curve_foot_point.h"
#include "models/knot_vector.h"
#include "problems/curve/parametric_start.h"

namespace frond {
namespace {

constexpr double kSameParameter = 1e-9;
constexpr double kRefineFairness = 1e-9;
constexpr std::size_t kLeastToCut = 4;  // points of a span: two for each half

using Values = std::vector<double>;

// Knots from their distinct places, each `multiplicity` times: the inner ones of an open curve, all of a
// closed one.
BSplineBasis BasisOn(int degree, const Values& places, int multiplicity, bool closed) {
  const auto times = static_cast<std::size_t>(multiplicity), ends = static_cast<std::size_t>(degree) + 1;
  Values knots;
  for (const double place : places) knots.insert(knots.end(), times, place);
  if (closed) return PeriodicBasis(degree, knots);
  knots.insert(knots.begin(), ends, 0.0);
  knots.insert(knots.end(), ends, 1.0);
  return BSplineBasis(degree, std::move(knots));
}

Values InnerKnots(const BSplineBasis& basis) {
  const auto ends = static_cast<std::ptrdiff_t>(basis.degree()) + 1;
  return {basis.knots().begin() + ends, basis.knots().end() - ends};
}

// `count` groups of equal numbers (to one) and their averages.
Values GroupAverages(const Values& parameters, std::size_t count) {
  Values averages;
  for (std::size_t g = 0; g < count; ++g) {
    const auto first = parameters.begin() + static_cast<std::ptrdiff_t>(g * parameters.size() / count);
    const auto last = parameters.begin() + static_cast<std::ptrdiff_t>((g + 1) * parameters.size() / count);
    averages.push_back(std::accumulate(first, last, 0.0) / static_cast<double>(last - first));
  }
  return averages;
}

// (A7) around a closed curve: averages of `degree` neighbours, which lie about their middle.
Values ClosedAverages(const Values& parameters, int degree) {
  const auto n = static_cast<int>(parameters.size());
  Values places;
  for (int j = 0; j < n; ++j) {
    double sum = 0;
    for (int i = j - (degree - 1) / 2; i <= j + degree / 2; ++i) {
      const int turns = i < 0 ? -1 : i / n;
      sum += parameters[static_cast<std::size_t>(i - turns * n)] + turns;
    }
    places.push_back(sum / degree);
  }
  return places;
}

// (A8) around a closed curve: every span holds the same number of parameters, to a fraction.
Values ClosedShares(const Values& parameters, std::size_t count) {
  Values places;
  for (std::size_t j = 0; j < count; ++j) {
    const std::size_t i = j * parameters.size() / count;
    const double alpha = static_cast<double>(j * parameters.size() % count) / static_cast<double>(count);
    const double next = i + 1 < parameters.size() ? parameters[i + 1] : parameters[0] + 1;
    places.push_back((1 - alpha) * parameters[i] + alpha * next);
  }
  return places;
}

Values ClosedPlaces(const Values& parameters, std::size_t count, const CurveFitOptions& options) {
  if (options.knots == CurveKnots::kUniform) {
    Values places;
    for (std::size_t j = 0; j < count; ++j) {
      places.push_back(static_cast<double>(j) / static_cast<double>(count));
    }
    return places;
  }
  if (options.knots == CurveKnots::kMa) {
    return ClosedAverages(GroupAverages(parameters, count), options.degree);
  }
  return count == parameters.size() ? ClosedAverages(parameters, options.degree)
                                    : ClosedShares(parameters, count);
}

Values OpenPlaces(const Values& parameters, std::size_t count, const CurveFitOptions& options) {
  const int control_points = static_cast<int>(count) + options.degree + 1;
  if (options.knots == CurveKnots::kUniform) return InnerKnots(UniformBasis(options.degree, control_points));
  if (options.knots == CurveKnots::kMa) {
    return InnerKnots(InterpolationBasis(
        options.degree, GroupAverages(parameters, static_cast<std::size_t>(control_points))));
  }
  return InnerKnots(static_cast<std::size_t>(control_points) == parameters.size()
                        ? InterpolationBasis(options.degree, parameters)
                        : ApproximationBasis(options.degree, control_points, parameters));
}

// Where a span with the largest distance is to be cut: the median of its parameters, or its middle where that
// is no place inside; nothing where its points cannot carry two spans.
std::optional<double> CutOfWorstSpan(std::span<const Eigen::Vector3d> points,
                                     std::span<const double> parameters, const NurbsCurve& curve,
                                     double tolerance) {
  const CurveSpans spans(curve);
  const BSplineBasis& basis = curve.basis();
  struct Span {
    double worst = 0;
    Values parameters;
  };
  std::vector<Span> all(static_cast<std::size_t>(spans.count()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double t = basis.IntoDomain(parameters[i]);
    Span& span = all[static_cast<std::size_t>(spans.polynomials().SpanOf(t))];
    span.worst = std::max(span.worst, RefineCurveFoot(spans, points[i], t, {}).squared_distance);
    span.parameters.push_back(t);
  }
  const Span* chosen = nullptr;
  std::optional<double> cut;
  for (std::size_t k = 0; k < all.size(); ++k) {
    Span& span = all[k];
    if (span.parameters.size() < kLeastToCut || span.worst <= tolerance * tolerance) continue;
    if (chosen != nullptr && span.worst <= chosen->worst) continue;
    std::sort(span.parameters.begin(), span.parameters.end());
    const double begin = spans.polynomials().begin(static_cast<int>(k));
    const double length = spans.polynomials().length(static_cast<int>(k));
    const std::size_t middle = span.parameters.size() / 2;
    const double place = 0.5 * (span.parameters[middle - 1] + span.parameters[middle]);
    chosen = &span;
    cut = std::clamp(place, begin + 0.1 * length, begin + 0.9 * length);
  }
  return cut;
}

BSplineBasis RefineKnots(std::span<const Eigen::Vector3d> points, std::span<const double> parameters,
                         bool closed, int multiplicity, const CurveFitOptions& options) {
  Values places;
  if (closed) {
    const int spans = (options.degree + multiplicity) / multiplicity;  // degree + 1 control points
    for (int j = 0; j < spans; ++j) places.push_back(static_cast<double>(j) / spans);
  }
  while (true) {
    const BSplineBasis basis = BasisOn(options.degree, places, multiplicity, closed);
    if (basis.num_distinct_control_points() + multiplicity > options.control_points) return basis;
    const NurbsCurve curve = FitCurveAtParameters(points, parameters, basis,
                                                  std::max(options.fairness.value_or(0), kRefineFairness));
    const std::optional<double> cut = CutOfWorstSpan(points, parameters, curve, options.tolerance);
    if (!cut) return basis;
    places.insert(std::upper_bound(places.begin(), places.end(), *cut), *cut);
  }
}

}  // namespace

int KnotMultiplicity(const CurveFitOptions& options, int control_points, bool closed) {
  if (options.knot_multiplicity > 0) return options.knot_multiplicity;
  if (options.degree != 2 || options.unknowns != CurveUnknowns::kBoth) return 1;
  const int n = control_points;
  const bool conic = closed ? n >= 6 && n % 2 == 0 : n >= 5 && n % 2 == 1;
  return conic ? 2 : 1;
}

std::string KnotCountFault(const CurveFitOptions& options, int control_points, bool closed) {
  const int p = options.degree, m = KnotMultiplicity(options, control_points, closed);
  const std::string name = "'curve.control_points' is " + std::to_string(control_points);
  if (control_points <= p) {
    return name + ", degree " + std::to_string(p) + " needs at least " + std::to_string(p + 1);
  }
  const int knots = closed ? control_points : control_points - p - 1;
  if (knots % m == 0) return "";
  return name + ", which knots of multiplicity " + std::to_string(m) + " do not come to: take " +
         std::to_string(control_points + m - knots % m) + " ('curve.knot_multiplicity')";
}

BSplineBasis PlaceKnots(std::span<const Eigen::Vector3d> points, std::span<const double> parameters,
                        bool closed, const CurveFitOptions& options) {
  const int multiplicity = KnotMultiplicity(options, options.control_points, closed);
  Values different;
  for (const double t : parameters) {
    if (different.empty() || t > different.back() + kSameParameter) different.push_back(t);
  }
  if (closed && different.size() > 1 && different.back() > different.front() + 1 - kSameParameter) {
    different.pop_back();
  }
  if (different.size() < static_cast<std::size_t>(options.control_points)) {
    throw InputError("the points have " + std::to_string(different.size()) +
                     " different places along the curve, fewer than the " +
                     std::to_string(options.control_points) + " control points; take fewer");
  }
  if (options.knots == CurveKnots::kRefine) {
    return RefineKnots(points, parameters, closed, multiplicity, options);
  }
  const int knots = closed ? options.control_points : options.control_points - options.degree - 1;
  const auto count = static_cast<std::size_t>(knots / multiplicity);
  return BasisOn(options.degree,
                 closed ? ClosedPlaces(different, count, options) : OpenPlaces(different, count, options),
                 multiplicity, closed);
}

}  // namespace frond
