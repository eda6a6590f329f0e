// SPDX-License-Identifier: BSD-3-Clause
#include "models/knot_vector.h"

#include <cmath>
#include <numeric>

#include "base/errors.h"

namespace frond {
namespace {

// degree + 1 times the first value, the inner knots, degree + 1 times the last value.
BSplineBasis ClampedBasis(int degree, double begin, const std::vector<double>& inner, double end) {
  const auto ends = static_cast<std::size_t>(degree) + 1;
  std::vector<double> knots(ends, begin);
  knots.insert(knots.end(), inner.begin(), inner.end());
  knots.insert(knots.end(), ends, end);
  return BSplineBasis(degree, std::move(knots));
}

void CheckCounts(int degree, int count, const std::string& what) {
  if (degree < 1 || degree > kMaxDegree) {
    throw InputError("degree " + std::to_string(degree) + " is outside [1, " + std::to_string(kMaxDegree) +
                     "]");
  }
  if (count <= degree) {
    throw InputError("degree " + std::to_string(degree) + " needs at least " + std::to_string(degree + 1) +
                     " " + what + ", not " + std::to_string(count));
  }
}

void CheckParameters(std::span<const double> parameters) {
  for (std::size_t i = 1; i < parameters.size(); ++i) {
    if (!(parameters[i] >= parameters[i - 1])) {
      throw InputError("parameter " + std::to_string(i) + " decreases or is not a number");
    }
  }
}

}  // namespace

BSplineBasis UniformBasis(int degree, int count, double begin, double end) {
  CheckCounts(degree, count, "control points");
  const int spans = count - degree;
  std::vector<double> inner;
  for (int i = 1; i < spans; ++i) inner.push_back(begin + (end - begin) * i / spans);
  return ClampedBasis(degree, begin, inner, end);
}

BSplineBasis PeriodicUniformBasis(int degree, int distinct, double begin, double end) {
  CheckCounts(degree, distinct, "distinct control points in a periodic direction");
  std::vector<double> knots;
  for (int i = -degree; i <= distinct + degree; ++i) {
    knots.push_back(i == distinct ? end : begin + (end - begin) * i / distinct);
  }
  return BSplineBasis(degree, std::move(knots), true);
}

BSplineBasis PeriodicBasis(int degree, std::span<const double> knots, double period) {
  const auto distinct = static_cast<int>(knots.size());
  CheckCounts(degree, distinct, "distinct control points in a periodic direction");
  std::vector<double> all;
  for (int i = -degree; i <= distinct + degree; ++i) {
    const int turns = i < 0 ? -((-i + distinct - 1) / distinct) : i / distinct;
    all.push_back(knots[static_cast<std::size_t>(i - turns * distinct)] + turns * period);
  }
  return BSplineBasis(degree, std::move(all), true);
}

std::vector<double> Parametrise(std::span<const Eigen::Vector3d> points, Parametrisation method) {
  const std::size_t count = points.size();
  if (count < 2)
    throw InputError("a row of " + std::to_string(count) + " points has no parameters; 2 are needed");
  std::vector<double> parameters(count, 0.0);
  for (std::size_t k = 1; k < count; ++k) {
    const double chord = (points[k] - points[k - 1]).norm();
    double step = 1;
    if (method == Parametrisation::kChord) step = chord;
    if (method == Parametrisation::kCentripetal) step = std::sqrt(chord);
    parameters[k] = parameters[k - 1] + step;
  }
  const double total = parameters.back();
  if (!(total > 0) || !std::isfinite(total)) {
    throw InputError("a row of points without length has no chord or centripetal parameters");
  }
  for (double& parameter : parameters) parameter /= total;
  return parameters;
}

std::vector<double> ParametriseClosed(std::span<const Eigen::Vector3d> points, Parametrisation method) {
  std::vector<Eigen::Vector3d> around(points.begin(), points.end());
  if (!around.empty()) around.push_back(around.front());
  std::vector<double> parameters = Parametrise(around, method);
  parameters.pop_back();
  return parameters;
}

// Eq. (A7) is eq. (9.8) of The NURBS Book; as many control points as parameters.
BSplineBasis InterpolationBasis(int degree, std::span<const double> parameters) {
  const int count = static_cast<int>(parameters.size());
  CheckCounts(degree, count, "points to interpolate");
  CheckParameters(parameters);
  std::vector<double> inner;
  for (int j = 1; j < count - degree; ++j) {
    const auto first = parameters.begin() + j;
    inner.push_back(std::accumulate(first, first + degree, 0.0) / degree);
  }
  return ClampedBasis(degree, parameters.front(), inner, parameters.back());
}

// Eq. (A8) is eqs (9.68) and (9.69) of The NURBS Book with n + 1 = count control points and m + 1 parameters.
// jd is formed from whole numbers, so that its integer part is not at the mercy of rounding.
BSplineBasis ApproximationBasis(int degree, int count, std::span<const double> parameters) {
  CheckCounts(degree, count, "control points");
  const auto num_parameters = static_cast<long>(parameters.size());
  if (num_parameters < count) {
    throw InputError(std::to_string(count) + " control points are more than the " +
                     std::to_string(num_parameters) + " points to approximate");
  }
  CheckParameters(parameters);
  const long spans = count - degree;
  std::vector<double> inner;
  for (long j = 1; j < spans; ++j) {
    const auto i = static_cast<std::size_t>(j * num_parameters / spans);
    const double alpha = static_cast<double>(j * num_parameters % spans) / static_cast<double>(spans);
    inner.push_back((1 - alpha) * parameters[i - 1] + alpha * parameters[i]);
  }
  return ClampedBasis(degree, parameters.front(), inner, parameters.back());
}

}  // namespace frond
