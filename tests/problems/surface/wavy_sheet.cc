// SPDX-License-Identifier: BSD-3-Clause
#include "tests/problems/surface/wavy_sheet.h"

#include "base/random.h"
#include "models/knot_vector.h"

namespace frond {

BSplineBasis UnevenBasis(int degree, int count, double begin, double end) {
  std::vector<double> knots(static_cast<std::size_t>(degree) + 1, begin);
  const int spans = count - degree;
  for (int k = 1; k < spans; ++k) {
    const double t = static_cast<double>(k) / spans;
    knots.push_back(begin + (end - begin) * t * (0.6 + 0.4 * t));
  }
  knots.insert(knots.end(), static_cast<std::size_t>(degree) + 1, end);
  return BSplineBasis(degree, std::move(knots));
}

NurbsSurface MakeSurface(const WavySheet& sheet) {
  Random random(sheet.seed);
  const BSplineBasis u = sheet.uneven_knots ? UnevenBasis(sheet.degree_u, sheet.count_u, 0.5, 2)
                                            : UniformBasis(sheet.degree_u, sheet.count_u);
  const BSplineBasis v = sheet.uneven_knots ? UnevenBasis(sheet.degree_v, sheet.count_v, -1, 0.7)
                                            : UniformBasis(sheet.degree_v, sheet.count_v);
  const double step_u = sheet.length_u / (sheet.count_u - 1), step_v = sheet.length_v / (sheet.count_v - 1);
  std::vector<Eigen::Vector3d> control_points;
  std::vector<double> weights;
  const auto jitter = [&] { return sheet.roughness * random.Uniform(-1, 1); };
  for (int i = 0; i < sheet.count_u; ++i) {
    for (int j = 0; j < sheet.count_v; ++j) {
      const double x = step_v * (j + jitter()), y = step_u * (i + jitter());
      control_points.emplace_back(x, y, std::min(step_u, step_v) * jitter());
      weights.push_back(sheet.rational ? random.Uniform(0.6, 1.6) : 1.0);
    }
  }
  return NurbsSurface(u, v, std::move(control_points), std::move(weights));
}

std::vector<Eigen::Vector3d> PointsAround(const NurbsSurface& surface, int count, double noise, int beyond,
                                          std::uint64_t seed) {
  Random random(seed);
  std::vector<Eigen::Vector3d> points;
  const BSplineBasis &bu = surface.u(), &bv = surface.v();
  for (int i = 0; i < count; ++i) {
    double s = random.Uniform(), t = random.Uniform();
    const bool off = i >= count - beyond;
    if (off && i % 3 != 0) s = i % 2;
    if (off && i % 3 != 1) t = i / 2 % 2;
    const double u = bu.begin() + s * (bu.end() - bu.begin()), v = bv.begin() + t * (bv.end() - bv.begin());
    const SurfacePoint at = surface.EvaluateWithDerivatives(u, v);
    Eigen::Vector3d point = at.position;
    if (off) {
      const double out = 0.05 * surface.Size() * random.Uniform(0.2, 1);
      if (s == 0 || s == 1) point += (s > 0.5 ? out : -out) * at.du.normalized();
      if (t == 0 || t == 1) point += (t > 0.5 ? out : -out) * at.dv.normalized();
    }
    points.push_back(point + noise * Eigen::Vector3d(random.Normal(), random.Normal(), random.Normal()));
  }
  return points;
}

std::vector<Eigen::Vector2d> JitteredSquare(int side, std::uint64_t seed) {
  Random random(seed);
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      points.emplace_back((i + 0.5 + random.Uniform(-0.3, 0.3)) / side,
                          (j + 0.5 + random.Uniform(-0.3, 0.3)) / side);
    }
  }
  return points;
}

}  // namespace frond
