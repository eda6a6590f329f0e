// SPDX-License-Identifier: BSD-3-Clause
#include "tests/problems/curve/curve_cases.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/random.h"

namespace frond {

Points EllipsePoints(int count, double a, double b, double begin, double turn) {
  const int steps = turn < 2 * std::numbers::pi - 1e-9 ? count - 1 : count;
  Points points;
  for (int i = 0; i < count; ++i) {
    const double angle = begin + turn * i / steps;
    points.emplace_back(3 + a * std::cos(angle), -2 + b * std::sin(angle), 0);
  }
  return points;
}

Points OutlinePoints(int count, double height) {
  Points points;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    const double radius = 10 + 2 * std::cos(3 * angle) + std::sin(5 * angle);
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), height * std::sin(2 * angle));
  }
  return points;
}

Points HelixPoints(int count, double turns) {
  Points points;
  for (int i = 0; i < count; ++i) {
    const double s = static_cast<double>(i) / (count - 1), angle = 2 * std::numbers::pi * turns * s;
    points.emplace_back(5 * std::cos(angle), 5 * std::sin(angle), 10 * s);
  }
  return points;
}

Points WithNoise(Points points, double deviation, std::uint64_t seed, bool plane) {
  Random random(seed);
  for (Eigen::Vector3d& point : points) {
    for (Eigen::Index x = 0; x < (plane ? 2 : 3); ++x) point[x] += deviation * random.Normal();
  }
  return points;
}

Points Shuffled(Points points, std::uint64_t seed) {
  Random random(seed);
  for (std::size_t i = points.size(); i > 1; --i) std::swap(points[i - 1], points[random.Below(i)]);
  return points;
}

CurveFit Fitted(const Points& points, const CurveFitOptions& options, int threads, const Budget& budget) {
  const SolverType& type = FindSolverType("lm");
  Options solver(type.options);
  for (const auto& [name, value] : CurveFitSolverDefaults("lm")) solver.Set(name, value);
  return FitCurve(points, options, *type.create(solver), budget, {.threads = threads, .seed = 1});
}

double Largest(const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); }

double RootMeanSquare(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

}  // namespace frond
