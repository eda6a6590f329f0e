// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>

#include "models/pinhole_camera.h"

namespace frond {

// Two cameras: a point p of the left one's frame is right_from_left · p in the right one's.
struct StereoPair {
  PinholeCamera left;
  PinholeCamera right;
  Eigen::Isometry3d right_from_left = Eigen::Isometry3d::Identity();
};

// Two normal images (acquisition paper, 2.1): of one focal length f, side by side along x, so that a point is
// seen in the same row of both. A direction r of a camera's frame is rotation · r in its normal image's, at
// x = f r_x/r_z + cx and y = f r_y/r_z + cy. cx may differ between the two, so that the disparities of an
// object that both cameras look at are small.
struct Rectification {
  std::array<Eigen::Matrix3d, 2> rotation{Eigen::Matrix3d::Identity(),
                                          Eigen::Matrix3d::Identity()};  // left, right
  double f = 1;                                                          // pixels
  std::array<double, 2> cx{0, 0};                                        // left, right; pixels
  double cy = 0;
  double baseline = 1;        // > 0, in the pair's unit
  int width = 0, height = 0;  // of both normal images

  // The point seen in column x of the left image and x − disparity of the right one, in the left camera's
  // frame: eqs 1-3, with z = f · baseline / (disparity − cx_left + cx_right).
  Eigen::Vector3d Triangulate(double x, double y, double disparity) const;

  // Of a point in the left camera's frame: x and y in the left normal image, and the disparity.
  Eigen::Vector3d Project(const Eigen::Vector3d& point) const;

  // d|point − centre of the left camera| / d disparity, in units a pixel: with σ of the disparity it gives σ
  // of the distance.
  double RangeSlope(double x, double y, double disparity) const;
};

// The general rotations: x along the baseline, z as near as can be to the mean of both viewing directions.
// The focal length is the mean of the pair's; images of the left camera's size, centred on where the viewing
// directions fall or, where given, on `centre`, a point in the left camera's frame whose disparity becomes 0.
// Throws InputError where the pair has no baseline, or where the baseline points away from the right camera's
// side (a swapped pair) or along the viewing direction.
Rectification Rectify(const StereoPair& pair);
Rectification Rectify(const StereoPair& pair, const Eigen::Vector3d& centre);

// Eqs 4-7 with the signs of MATH.md §3, the square-on case: the camera of focal length f (principal point at
// the origin of the image coordinates) looks straight at an axis upright in its image at distance d, and the
// object turns by phi between the images. (x, y) of a view to (x', y') of its normal image.
Eigen::Vector2d SquareOnNormalLeft(double f, double phi, const Eigen::Vector2d& pixel);   // eqs 6, 7
Eigen::Vector2d SquareOnNormalRight(double f, double phi, const Eigen::Vector2d& pixel);  // eqs 4, 5

}  // namespace frond
