// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "models/tessellation.h"

namespace frond {

// A pear's shape. Lengths in mm, in its own frame: it stands on z = 0, its stalk end is at z = `height`.
struct PearShape {
  double height = 100;
  double bend = 0.05;        // sideways shift of the stalk end over the height
  double flattening = 0.03;  // of the squared half-axes of a section from round, up and down
  double lobes = 0.03;       // relative height of three lobes at the belly
};

// A pear given by a polynomial, so that its surface is smooth everywhere, poles included. With s = z/height,
// the bent core line (bx, by)(s) and X = x − bx, Y = y − by, inside is where
//   F = X² + Y² + flattening (X² − Y²) + (lobes / belly radius) (X³ − 3XY²) − ρ²(s) < 0,  0 < s < 1;
// ρ² = height² s (1 − s) q(s), the squared radius, falls to 0 linearly at both ends: round poles.
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

  // t > 0 of the first point origin + t · direction on the surface, exact to rounding, for an origin outside;
  // none where the ray misses.
  std::optional<double> CastRay(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;

  // The surface's point next to `point`: Newton's method from the nearest of a grid of samples. Meant for
  // points nearer to the surface than its radii of curvature.
  Eigen::Vector3d Foot(const Eigen::Vector3d& point) const;
  double SignedDistance(const Eigen::Vector3d& point) const;  // positive outside

  // By quadrature, to 1e-9 of the value. mm², mm³.
  double Area() const;
  double Volume() const;

  // A closed mesh, its vertices on the surface: `rings` rings of `around` vertices and one at each pole.
  // `parameters` are (theta, longitude).
  SurfaceMesh Mesh(int rings, int around) const;

 private:
  // At one z: the core line and the squared radius with their first and second derivatives by z.
  struct Section {
    std::array<double, 3> x, y, square;
  };
  // A place of a section: the radius at one longitude and its derivatives by theta and longitude.
  struct Spoke {
    double radius, by_theta, by_longitude;
  };
  // A place along a ray: F there and its derivative by t.
  struct RayPlace {
    double t, value, slope;
  };
  Section At(double z) const;
  Spoke SpokeAt(double theta, double longitude) const;
  RayPlace PlaceOn(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double t) const;
  std::optional<double> FirstRoot(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                  const RayPlace& first, const RayPlace& second, int depth) const;
  double Refine(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double outside,
                double inside) const;

  PearShape shape_;
  std::array<double, 7> square_{};  // of ρ² by powers of z
  double bend_x_ = 0, bend_y_ = 0;  // of the core line by z³ and z²
  double lobe_ = 0;                 // lobes / belly radius
  double largest_radius_ = 0;
  std::vector<Eigen::Vector3d> samples_;
};

}  // namespace frond
