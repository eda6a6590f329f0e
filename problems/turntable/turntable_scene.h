// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

#include "models/turntable_rig.h"
#include "problems/turntable/solid_texture.h"
#include "problems/turntable/synthetic_pear.h"

namespace frond {

// The lamp stands in the laboratory, far away, while the object turns. Shares of 255 grey levels on a white
// surface.
struct Lighting {
  double lamp_left = 40, lamp_up = 40;  // degrees, seen from the object, from the direction to the camera
  double ambient = 0.3;                 // from everywhere
  double diffuse = 0.7;                 // Lambert's, where the lamp shines straight at the surface
  double specular = 0.08;               // Phong's highlight, at its brightest
  double shininess = 25;

  Eigen::Vector3d ToLamp() const;  // unit vector, camera's frame
};

// A pear on a turning disk before a camera. Lengths in mm.
struct TurntableScene {
  TurntableRig rig;
  SyntheticPear pear{PearShape()};
  Eigen::Vector3d pear_origin{0, 0, 0};  // in the disk's frame: where the pear stands, on top of the disk
  double disk_radius = 80;
  SolidTexture speckle{1, 1};  // in the pear's frame
  double contrast = 0.2;       // of the albedo: its standard deviation over its mean
  double albedo = 0.5;         // the pear's mean
  Lighting lighting;
};

// Where a ray of the disk's frame (which turns with the disk) first meets the pear.
std::optional<Eigen::Vector3d> CastRay(const TurntableScene& scene, const Eigen::Vector3d& origin,
                                       const Eigen::Vector3d& direction);

// Of a point of the disk's frame to the pear: positive outside.
double DistanceToPear(const TurntableScene& scene, const Eigen::Vector3d& point);

// What a pixel of a pair's left normal image sees, exactly.
struct TrueMatch {
  Eigen::Vector3d point = {0, 0, 0}, normal = {0, 0, 0};  // disk's frame
  double disparity = 0;
  bool seen = false;                         // by the right camera too, inside the normal image
  double left_cosine = 0, right_cosine = 0;  // between the normal and the direction to each camera
};

// Of (x, y) in the left normal image of the views at left_angle and right_angle (radians); none where it does
// not see the pear.
std::optional<TrueMatch> FindTrueMatch(const TurntableScene& scene, const Rectification& normal,
                                       double left_angle, double right_angle, double x, double y);

}  // namespace frond
