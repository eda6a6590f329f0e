// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "models/tessellation.h"

namespace frond {

// A pear's shape. Lengths in mm, in its own frame: it stands on z = 0, its stalk end at z = `height`.
struct PearShape {
  double height = 100;
  double girth = 1;          // factor of all radii; at 1 the belly is 68 mm wide where the height is 100 mm
  double bend = 0.05;        // sideways shift of the stalk end over the height
  double flattening = 0.03;  // relative difference of the belly's half-axes from round
  double lobes = 0.03;       // relative height of three lobes at the belly
};

// A pear given by a polynomial, so that its surface is smooth everywhere, poles included. With s = z/height,
// the bent core line (bx, by)(s) and X = x − bx, Y = y − by, inside is where
//   F = X² + Y² + flattening (X² − Y²) + (lobes / r_belly) (X³ − 3XY²) − ρ²(s) < 0,  0 ≤ s ≤ 1,
// ρ² = height² s (1 − s) q(s) the squared radius, which falls to 0 linearly at both ends: round poles.
class SyntheticPear {
 public:
  explicit SyntheticPear(const PearShape& shape);  // throws ConfigError on a value out of its range

  const PearShape& shape() const { return shape_; }
  double LargestRadius() const { return largest_radius_; }  // of a cylinder about z that holds the pear

  // F (mm²) and its derivatives.
  double Value(const Eigen::Vector3d& point) const;
  Eigen::Vector3d Gradient(const Eigen::Vector3d& point) const;
  Eigen::Matrix3d Hessian(const Eigen::Vector3d& point) const;
  Eigen::Vector3d Normal(const Eigen::Vector3d& point) const { return Gradient(point).normalized(); }

  // The surface over the polar angle theta in [0, π] (0: the stalk end) and longitude in [0, 2π].
  Eigen::Vector3d Position(double theta, double longitude) const;

  // t of the first point origin + t · direction, t > 0, of a ray from outside, exact to rounding; none where
  // the ray misses.
  std::optional<double> CastRay(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;

  // The surface's nearest point, by Newton's method from the nearest of a grid of samples.
  Eigen::Vector3d Foot(const Eigen::Vector3d& point) const;
  double SignedDistance(const Eigen::Vector3d& point) const;  // positive outside

  // By quadrature, to 1e-9 of the value. mm², mm³.
  double Area() const;
  double Volume() const;

  // A closed mesh with its vertices on the surface: rings × around, and a vertex at each pole. Its
  // `parameters` are (theta, longitude).
  SurfaceMesh Mesh(int rings, int around) const;

 private:
  struct Section {  // at one z: the core line and ρ², with first and second derivatives by z
    double bx, by, square;
    double bx1, by1, square1;
    double bx2, by2, square2;
  };
  Section At(double z) const;
  double ValueOnly(double x, double y, double z) const;
  std::optional<double> FirstRoot(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                  double begin, double end) const;

  PearShape shape_;
  double lobe_ = 0;  // lobes / r_belly
  double largest_radius_ = 0;
  std::vector<Eigen::Vector3d> samples_;
};

}  // namespace frond
