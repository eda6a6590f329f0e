// SPDX-License-Identifier: BSD-3-Clause
// Curves and surfaces with known truth for the tests: exact circles and surfaces of revolution, and random
// ones.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "base/random.h"
#include "models/knot_vector.h"
#include "models/nurbs_curve.h"
#include "models/nurbs_surface.h"

namespace frond {

inline constexpr double kHalfRoot = 0.70710678118654752440;

// The full circle's basis: quadratic, four quarters.
inline BSplineBasis CircleBasis() {
  return BSplineBasis(2, {0, 0, 0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1, 1, 1});
}

// Corners of the square around the unit circle and its tangent points, from (1, 0) counter-clockwise.
inline std::vector<Eigen::Vector2d> CirclePoints() {
  return {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {1, 0}};
}

inline double CircleWeight(std::size_t i) { return i % 2 == 0 ? 1 : kHalfRoot; }

inline NurbsCurve ExactCircle(double radius) {
  std::vector<Eigen::Vector3d> points;
  std::vector<double> weights;
  for (const Eigen::Vector2d& p : CirclePoints()) {
    weights.push_back(CircleWeight(points.size()));
    points.emplace_back(radius * p.x(), radius * p.y(), 0);
  }
  return NurbsCurve(CircleBasis(), points, weights);
}

// A profile of points (radius, z) turned about the z axis; u is the angle.
inline NurbsSurface Revolve(const BSplineBasis& basis_v, const std::vector<Eigen::Vector2d>& profile,
                            const std::vector<double>& profile_weights) {
  std::vector<Eigen::Vector3d> points;
  std::vector<double> weights;
  const auto circle = CirclePoints();
  for (std::size_t i = 0; i < circle.size(); ++i) {
    for (std::size_t j = 0; j < profile.size(); ++j) {
      points.emplace_back(profile[j].x() * circle[i].x(), profile[j].x() * circle[i].y(), profile[j].y());
      weights.push_back(CircleWeight(i) * profile_weights[j]);
    }
  }
  return NurbsSurface(CircleBasis(), basis_v, points, weights);
}

// Normals of all of these point outwards.
inline NurbsSurface ExactCylinder(double radius, double height) {
  return Revolve(UniformBasis(1, 2), {{radius, 0}, {radius, height}}, {1, 1});
}

// v from the south pole to the north pole, both collapsed edges.
inline NurbsSurface ExactSphere(double r) {
  return Revolve(BSplineBasis(2, {0, 0, 0, 0.5, 0.5, 1, 1, 1}), {{0, -r}, {r, -r}, {r, 0}, {r, r}, {0, r}},
                 {1, kHalfRoot, 1, kHalfRoot, 1});
}

// v = 0 on the outer equator.
inline NurbsSurface ExactTorus(double large, double small) {
  std::vector<Eigen::Vector2d> profile;
  std::vector<double> weights;
  for (const Eigen::Vector2d& p : CirclePoints()) {
    weights.push_back(CircleWeight(profile.size()));
    profile.emplace_back(large + small * p.x(), small * p.y());
  }
  return Revolve(CircleBasis(), profile, weights);
}

// Clamped knots on [begin, end] with random inner ones, some of them repeated up to the degree.
inline BSplineBasis RandomBasis(int degree, int count, Random& random, double begin = 0, double end = 1) {
  std::vector<double> inner;
  while (static_cast<int>(inner.size()) < count - degree - 1) {
    const double knot = random.Uniform(begin, end);
    const auto times = 1 + random.Below(static_cast<std::uint64_t>(degree));
    for (std::uint64_t k = 0; k < times && static_cast<int>(inner.size()) < count - degree - 1; ++k) {
      inner.push_back(knot);
    }
  }
  std::sort(inner.begin(), inner.end());
  std::vector<double> knots(static_cast<std::size_t>(degree) + 1, begin);
  knots.insert(knots.end(), inner.begin(), inner.end());
  knots.insert(knots.end(), static_cast<std::size_t>(degree) + 1, end);
  return BSplineBasis(degree, knots);
}

inline Eigen::Vector3d RandomVector(Random& random) {
  return {random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1)};
}

// Random rational curve; the control points of a periodic basis repeat.
inline NurbsCurve RandomCurve(const BSplineBasis& basis, Random& random) {
  std::vector<Eigen::Vector3d> points;
  std::vector<double> weights;
  const auto distinct = static_cast<std::size_t>(basis.num_distinct_control_points());
  for (std::size_t i = 0; i < static_cast<std::size_t>(basis.num_control_points()); ++i) {
    points.push_back(i < distinct ? RandomVector(random) : points[i - distinct]);
    weights.push_back(i < distinct ? random.Uniform(0.5, 2) : weights[i - distinct]);
  }
  return NurbsCurve(basis, points, weights);
}

// A random rational surface over the unit square (roughness < 0.2), closed up where a basis is periodic.
inline NurbsSurface RandomSurface(const BSplineBasis& u, const BSplineBasis& v, Random& random,
                                  double roughness = 0.1) {
  const auto nu = static_cast<std::size_t>(u.num_control_points()),
             nv = static_cast<std::size_t>(v.num_control_points());
  const auto du = static_cast<std::size_t>(u.num_distinct_control_points());
  const auto dv = static_cast<std::size_t>(v.num_distinct_control_points());
  std::vector<Eigen::Vector3d> points(nu * nv);
  std::vector<double> weights(nu * nv);
  for (std::size_t i = 0; i < nu; ++i) {
    for (std::size_t j = 0; j < nv; ++j) {
      const std::size_t k = i * nv + j;
      if (i < du && j < dv) {
        points[k] = Eigen::Vector3d(static_cast<double>(i) / static_cast<double>(nu),
                                    static_cast<double>(j) / static_cast<double>(nv), 0) +
                    roughness * RandomVector(random);
        weights[k] = random.Uniform(1 - 5 * roughness, 1 + 5 * roughness);
      } else {
        points[k] = points[(i % du) * nv + j % dv];
        weights[k] = weights[(i % du) * nv + j % dv];
      }
    }
  }
  return NurbsSurface(u, v, points, weights);
}

// The plane z = 0 over [0, width] × [0, height] as a surface of the given net, S(u, v) = (width u, height v,
// 0).
inline NurbsSurface PlaneSurface(int degree, int count, double width = 1, double height = 1) {
  const BSplineBasis basis = UniformBasis(degree, count);
  const auto greville = [&](int i) {
    double sum = 0;
    for (int k = 1; k <= degree; ++k) sum += basis.knots()[static_cast<std::size_t>(i + k)];
    return sum / degree;
  };
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < count; ++j) points.emplace_back(width * greville(i), height * greville(j), 0);
  }
  return NurbsSurface(basis, basis, points);
}

// A regular polygon in (u, v); counter-clockwise.
inline TrimLoop RegularLoop(Eigen::Vector2d centre, double radius, int corners) {
  TrimLoop loop;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * std::numbers::pi * k / corners;
    loop.push_back(centre + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return loop;
}

// A star-shaped, toothed loop about `centre`, as a leaf's margin in (u, v).
inline TrimLoop ToothedLoop(Eigen::Vector2d centre, double radius, int corners, Random& random) {
  TrimLoop loop;
  const double phase = random.Uniform(0, 6);
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * std::numbers::pi * k / corners;
    const double r = radius * (0.8 + 0.12 * std::sin(5 * angle + phase) + 0.07 * random.Uniform(-1, 1));
    loop.push_back(centre + r * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return loop;
}

// Runs `body`, which must throw Error, and gives its message.
template <typename Error, typename Body>
std::string MessageOf(Body body) {
  try {
    body();
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing was thrown";
}

}  // namespace frond
