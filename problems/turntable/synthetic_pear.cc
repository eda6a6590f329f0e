// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/synthetic_pear.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/errors.h"
#include "models/gauss_rule.h"

namespace frond {
namespace {

constexpr double kPi = std::numbers::pi;

// q(s), the profile, over Bernstein polynomials of degree 4: a belly of 0.347 of the height at s = 0.35 and a
// slight waist below the stalk end.
constexpr std::array<double, 5> kProfile = {0.58, 0.68, 0.60, -0.25, 0.40};
constexpr double kBellyRadius = 0.347;

// The same by powers of s.
std::array<double, 5> ProfilePowers() {
  constexpr std::array<double, 5> kBinomial = {1, 4, 6, 4, 1};
  std::array<double, 5> powers{};
  for (std::size_t i = 0; i < 5; ++i) {
    double binomial = 1;  // of 4 − i over k
    for (std::size_t k = 0; i + k < 5; ++k) {
      powers[i + k] += kProfile[i] * kBinomial[i] * binomial * (k % 2 == 0 ? 1 : -1);
      binomial *= static_cast<double>(4 - i - k) / static_cast<double>(k + 1);
    }
  }
  return powers;
}

void RequireIn(double value, double lower, double upper, const char* name) {
  if (value >= lower && value <= upper) return;
  throw ConfigError("synthetic pear: '" + std::string(name) + "' must be in [" + std::to_string(lower) +
                    ", " + std::to_string(upper) + "]");
}

}  // namespace

SyntheticPear::SyntheticPear(const PearShape& shape) : shape_(shape) {
  RequireIn(shape.height, 1e-3, 1e6, "height");
  RequireIn(shape.bend, -0.3, 0.3, "bend");
  RequireIn(shape.flattening, -0.3, 0.3, "flattening");
  RequireIn(shape.lobes, 0, 0.1, "lobes");
  const double h = shape.height;
  const std::array<double, 5> q = ProfilePowers();
  for (std::size_t k = 0; k < 5; ++k) {  // ρ² = h² (s − s²) q(s)
    square_[k + 1] += q[k] * std::pow(h, 1.0 - static_cast<double>(k));
    square_[k + 2] -= q[k] * std::pow(h, -static_cast<double>(k));
  }
  bend_x_ = shape.bend / (h * h);
  bend_y_ = 0.4 * shape.bend / h;
  lobe_ = shape.lobes / (kBellyRadius * h);
  constexpr int kRings = 48, kAround = 64;
  samples_ = Mesh(kRings, kAround).vertices;
  for (const Eigen::Vector3d& p : samples_) {
    largest_radius_ = std::max(largest_radius_, 1.02 * p.head<2>().norm());
  }
}

SyntheticPear::Section SyntheticPear::At(double z) const {
  Section at{};
  at.x = {bend_x_ * z * z * z, 3 * bend_x_ * z * z, 6 * bend_x_ * z};
  at.y = {bend_y_ * z * z, 2 * bend_y_ * z, 2 * bend_y_};
  for (std::size_t k = square_.size(); k-- > 0;) {  // Horner's rule
    at.square[2] = at.square[2] * z + 2 * at.square[1];
    at.square[1] = at.square[1] * z + at.square[0];
    at.square[0] = at.square[0] * z + square_[k];
  }
  return at;
}

double SyntheticPear::Value(const Eigen::Vector3d& point) const {
  const Section at = At(point.z());
  const double x = point.x() - at.x[0], y = point.y() - at.y[0];
  return x * x + y * y + shape_.flattening * (x * x - y * y) + lobe_ * x * (x * x - 3 * y * y) - at.square[0];
}

Eigen::Vector3d SyntheticPear::Gradient(const Eigen::Vector3d& point) const {
  const Section at = At(point.z());
  const double x = point.x() - at.x[0], y = point.y() - at.y[0];
  const double gx = 2 * x * (1 + shape_.flattening) + 3 * lobe_ * (x * x - y * y);
  const double gy = 2 * y * (1 - shape_.flattening) - 6 * lobe_ * x * y;
  return {gx, gy, -gx * at.x[1] - gy * at.y[1] - at.square[1]};
}

Eigen::Matrix3d SyntheticPear::Hessian(const Eigen::Vector3d& point) const {
  const Section at = At(point.z());
  const double x = point.x() - at.x[0], y = point.y() - at.y[0];
  const double gx = 2 * x * (1 + shape_.flattening) + 3 * lobe_ * (x * x - y * y);
  const double gy = 2 * y * (1 - shape_.flattening) - 6 * lobe_ * x * y;
  const double xx = 2 * (1 + shape_.flattening) + 6 * lobe_ * x, xy = -6 * lobe_ * y;
  const double yy = 2 * (1 - shape_.flattening) - 6 * lobe_ * x;
  const double xz = -xx * at.x[1] - xy * at.y[1], yz = -xy * at.x[1] - yy * at.y[1];
  const double zz = -xz * at.x[1] - yz * at.y[1] - gx * at.x[2] - gy * at.y[2] - at.square[2];
  Eigen::Matrix3d hessian;
  hessian << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  return hessian;
}

SyntheticPear::Spoke SyntheticPear::SpokeAt(double theta, double longitude) const {
  const double h = shape_.height, z = h * (1 + std::cos(theta)) / 2;
  const Section at = At(z);
  const double square = std::max(at.square[0], 0.0),
               square_by_theta = -at.square[1] * h * std::sin(theta) / 2;
  const double a = 1 + shape_.flattening * std::cos(2 * longitude), b = lobe_ * std::cos(3 * longitude);
  double r = std::sqrt(square / a);
  if (r == 0) return {0, 0, 0};
  for (int i = 0; i < 20; ++i) {  // a r² + b r³ = ρ²
    const double step = (r * r * (a + b * r) - square) / (r * (2 * a + 3 * b * r));
    r -= step;
    if (std::abs(step) < 1e-15 * h) break;
  }
  const double by_r = r * (2 * a + 3 * b * r);
  const double by_longitude =
      r * r * (-2 * shape_.flattening * std::sin(2 * longitude) - 3 * lobe_ * r * std::sin(3 * longitude));
  return {r, square_by_theta / by_r, -by_longitude / by_r};
}

Eigen::Vector3d SyntheticPear::Position(double theta, double longitude) const {
  const double z = shape_.height * (1 + std::cos(theta)) / 2;
  const Section at = At(z);
  const double r = SpokeAt(theta, longitude).radius;
  return {at.x[0] + r * std::cos(longitude), at.y[0] + r * std::sin(longitude), z};
}

SyntheticPear::RayPlace SyntheticPear::PlaceOn(const Eigen::Vector3d& origin,
                                               const Eigen::Vector3d& direction, double t) const {
  const Eigen::Vector3d point = origin + t * direction;
  const Section at = At(point.z());
  const double x = point.x() - at.x[0], y = point.y() - at.y[0];
  const double x2 = x * x, y2 = y * y;
  const double gx = 2 * x * (1 + shape_.flattening) + 3 * lobe_ * (x2 - y2);
  const double gy = 2 * y * (1 - shape_.flattening) - 6 * lobe_ * x * y;
  return {.t = t,
          .value = x2 + y2 + shape_.flattening * (x2 - y2) + lobe_ * x * (x2 - 3 * y2) - at.square[0],
          .slope = gx * (direction.x() - at.x[1] * direction.z()) +
                   gy * (direction.y() - at.y[1] * direction.z()) - at.square[1] * direction.z()};
}

// The root between a point outside and one inside: Newton's method, halving where it leaves the interval.
double SyntheticPear::Refine(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double outside,
                             double inside) const {
  double t = (outside + inside) / 2;
  for (int i = 0; i < 100; ++i) {
    const RayPlace place = PlaceOn(origin, direction, t);
    (place.value > 0 ? outside : inside) = t;
    double next = t - place.value / place.slope;
    if (!(next > std::min(outside, inside) && next < std::max(outside, inside))) {
      next = (outside + inside) / 2;
    }
    const double step = std::abs(next - t);
    t = next;
    if (step <= 4e-16 * std::abs(t)) break;
  }
  return t;
}

// The first root between two places of which the first is outside. Where the cubic through both, with their
// slopes, turns or nearly does, a short dip below 0 may hide, as of a ray that grazes the neck: halved then.
std::optional<double> SyntheticPear::FirstRoot(const Eigen::Vector3d& origin,
                                               const Eigen::Vector3d& direction, const RayPlace& first,
                                               const RayPlace& second, int depth) const {
  constexpr int kDeepest = 5;
  constexpr double kNearly = 0.25;  // of the larger slope
  const double h = second.t - first.t, s0 = first.slope, s1 = second.slope;
  if (depth < kDeepest && s0 * s1 > 0) {
    const double mean = (second.value - first.value) / h;
    const double curve = 3 * (s0 + s1 - 2 * mean), rise = 6 * mean - 4 * s0 - 2 * s1;
    const double at = curve != 0 ? std::clamp(-rise / (2 * curve), 0.0, 1.0) : 0.0;
    const double turn = s0 + at * (rise + at * curve);  // the cubic's slope where it is extreme
    if (turn * s0 < kNearly * s0 * std::copysign(std::max(std::abs(s0), std::abs(s1)), s0)) {
      const RayPlace middle = PlaceOn(origin, direction, first.t + h / 2);
      if (const auto root = FirstRoot(origin, direction, first, middle, depth + 1)) return root;
      return FirstRoot(origin, direction, middle, second, depth + 1);
    }
  }
  if (second.value < 0) return Refine(origin, direction, first.t, second.t);
  if (!(s0 < 0 && s1 > 0)) return std::nullopt;
  double low = first.t, high = second.t;  // about the minimum
  for (int i = 0; i < 60; ++i) {
    const RayPlace middle = PlaceOn(origin, direction, (low + high) / 2);
    if (middle.value < 0) return Refine(origin, direction, first.t, middle.t);
    if (middle.value > std::abs(middle.slope) * (high - low)) break;  // F is convex here: above 0 all through
    (middle.slope < 0 ? low : high) = middle.t;
  }
  return std::nullopt;
}

std::optional<double> SyntheticPear::CastRay(const Eigen::Vector3d& origin,
                                             const Eigen::Vector3d& direction) const {
  // Inside the cylinder that holds the pear.
  const double a = direction.head<2>().squaredNorm(), b = origin.head<2>().dot(direction.head<2>());
  const double c = origin.head<2>().squaredNorm() - largest_radius_ * largest_radius_;
  double begin = 0, end = std::numeric_limits<double>::infinity();
  if (a > 0) {
    const double discriminant = b * b - a * c;
    if (discriminant <= 0) return std::nullopt;
    begin = std::max(begin, (-b - std::sqrt(discriminant)) / a);
    end = (-b + std::sqrt(discriminant)) / a;
  } else if (c > 0) {
    return std::nullopt;
  }
  if (direction.z() != 0) {
    const double bottom = -origin.z() / direction.z(), top = (shape_.height - origin.z()) / direction.z();
    begin = std::max(begin, std::min(bottom, top));
    end = std::min(end, std::max(bottom, top));
  } else if (origin.z() < 0 || origin.z() > shape_.height) {
    return std::nullopt;
  }
  if (!(begin < end)) return std::nullopt;

  constexpr int kSteps = 8;
  RayPlace last = PlaceOn(origin, direction, begin);
  if (last.value < 0) return std::nullopt;  // not from outside
  for (int i = 1; i <= kSteps; ++i) {
    const RayPlace next = PlaceOn(origin, direction, begin + (end - begin) * i / kSteps);
    if (const auto root = FirstRoot(origin, direction, last, next, 0)) return root;
    last = next;
  }
  return std::nullopt;
}

Eigen::Vector3d SyntheticPear::Foot(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d* nearest = &samples_[0];
  for (const Eigen::Vector3d& sample : samples_) {
    if ((sample - point).squaredNorm() < (*nearest - point).squaredNorm()) nearest = &sample;
  }
  // The stationary point of |p − point|²/2 + m F(p) over p and m.
  Eigen::Vector3d p = *nearest;
  Eigen::Vector3d gradient = Gradient(p);
  double m = (point - p).dot(gradient) / gradient.squaredNorm();
  for (int i = 0; i < 50; ++i) {
    Eigen::Matrix4d matrix;
    matrix.topLeftCorner<3, 3>() = Eigen::Matrix3d::Identity() + m * Hessian(p);
    matrix.topRightCorner<3, 1>() = gradient;
    matrix.bottomLeftCorner<1, 3>() = gradient.transpose();
    matrix(3, 3) = 0;
    Eigen::Vector4d right;
    right << point - p - m * gradient, -Value(p);
    const Eigen::Vector4d step = matrix.partialPivLu().solve(right);
    // A long step would leave the part of the surface that the start is on.
    const double share = std::min(1.0, 0.05 * shape_.height / step.head<3>().norm());
    p += share * step.head<3>();
    m += share * step(3);
    gradient = Gradient(p);
    if (step.head<3>().norm() < 1e-13 * shape_.height) break;
  }
  return p;
}

double SyntheticPear::SignedDistance(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d foot = Foot(point);
  return (point - foot).norm() * ((point - foot).dot(Gradient(foot)) < 0 ? -1 : 1);
}

namespace {

// The integral of f(theta, longitude) over the sphere of angles: Gauss's rule in panels along theta, equal
// steps round, where f is periodic.
template <typename Function>
double IntegrateOverAngles(const Function& f) {
  constexpr int kPanels = 8, kAround = 128;
  const GaussRule& rule = GaussRuleOf(12);
  double sum = 0;
  for (int panel = 0; panel < kPanels; ++panel) {
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double theta = kPi * (panel + rule.nodes[i]) / kPanels;
      for (int j = 0; j < kAround; ++j) sum += rule.weights[i] * f(theta, 2 * kPi * j / kAround);
    }
  }
  return sum * kPi / kPanels * 2 * kPi / kAround;
}

}  // namespace

double SyntheticPear::Area() const {
  return IntegrateOverAngles([&](double theta, double longitude) {
    const Section at = At(shape_.height * (1 + std::cos(theta)) / 2);
    const double z_by_theta = -shape_.height * std::sin(theta) / 2;
    const double c = std::cos(longitude), s = std::sin(longitude);
    const Spoke spoke = SpokeAt(theta, longitude);
    const Eigen::Vector3d along(at.x[1] * z_by_theta + spoke.by_theta * c,
                                at.y[1] * z_by_theta + spoke.by_theta * s, z_by_theta);
    const Eigen::Vector3d around(spoke.by_longitude * c - spoke.radius * s,
                                 spoke.by_longitude * s + spoke.radius * c, 0);
    return along.cross(around).norm();
  });
}

double SyntheticPear::Volume() const {
  return IntegrateOverAngles([&](double theta, double longitude) {
    const double r = SpokeAt(theta, longitude).radius;
    return r * r / 2 * shape_.height * std::sin(theta) / 2;
  });
}

SurfaceMesh SyntheticPear::Mesh(int rings, int around) const {
  SurfaceMesh mesh;
  const auto add = [&](double theta, double longitude) {
    const Eigen::Vector3d p = Position(theta, longitude);
    mesh.vertices.push_back(p);
    mesh.normals.push_back(Normal(p));
    mesh.parameters.emplace_back(theta, longitude);
  };
  add(0, 0);
  for (int i = 1; i <= rings; ++i) {
    for (int j = 0; j < around; ++j) add(kPi * i / (rings + 1), 2 * kPi * j / around);
  }
  add(kPi, 0);
  const int last = rings * around + 1;
  const auto index = [&](int ring, int j) { return 1 + ring * around + j % around; };
  for (int j = 0; j < around; ++j) {
    mesh.triangles.push_back({0, index(0, j), index(0, j + 1)});
    for (int i = 0; i + 1 < rings; ++i) {
      mesh.triangles.push_back({index(i, j), index(i + 1, j), index(i + 1, j + 1)});
      mesh.triangles.push_back({index(i, j), index(i + 1, j + 1), index(i, j + 1)});
    }
    mesh.triangles.push_back({last, index(rings - 1, j + 1), index(rings - 1, j)});
  }
  return mesh;
}

}  // namespace frond
