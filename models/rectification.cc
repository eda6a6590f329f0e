// SPDX-License-Identifier: BSD-3-Clause
#include "models/rectification.h"

#include <cmath>

#include "base/errors.h"

namespace frond {
namespace {

// Where the baseline runs nearer to the viewing direction than this (60 degrees from the image's x axis),
// normal images would be of next to nothing.
constexpr double kLeastBaselineShare = 0.5;

Rectification Rotations(const StereoPair& pair) {
  // In the left camera's frame.
  const Eigen::Vector3d right_centre = pair.right_from_left.inverse().translation();
  const double baseline = right_centre.norm();
  if (!(baseline > 0)) throw InputError("the two cameras of the pair stand in the same place: no baseline");
  const Eigen::Vector3d right_view = pair.right_from_left.linear().transpose() * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d x = right_centre / baseline;
  if (x.x() < -kLeastBaselineShare) {
    throw InputError(
        "the pair is swapped: the right camera stands to the left of the left one; exchange them");
  }
  if (x.x() < kLeastBaselineShare) {
    throw InputError(
        "the cameras of the pair do not stand side by side: the baseline has to run along the "
        "images' x axis");
  }
  const Eigen::Vector3d view = (Eigen::Vector3d::UnitZ() + right_view).normalized();
  const Eigen::Vector3d y = view.cross(x).normalized();
  Rectification normal;
  normal.baseline = baseline;
  normal.rotation[0].row(0) = x;
  normal.rotation[0].row(1) = y;
  normal.rotation[0].row(2) = x.cross(y);
  normal.rotation[1] = normal.rotation[0] * pair.right_from_left.linear().transpose();
  normal.f = (pair.left.focal[0] + pair.left.focal[1] + pair.right.focal[0] + pair.right.focal[1]) / 4;
  normal.width = pair.left.width;
  normal.height = pair.left.height;
  return normal;
}

// Shifts the images so that the direction of the normal frame falls on the middle of image `side`.
double CentreColumn(const Rectification& normal, const Eigen::Vector3d& direction) {
  return (normal.width - 1) / 2.0 - normal.f * direction.x() / direction.z();
}

double CentreRow(const Rectification& normal, const Eigen::Vector3d& direction) {
  return (normal.height - 1) / 2.0 - normal.f * direction.y() / direction.z();
}

}  // namespace

Rectification Rectify(const StereoPair& pair) {
  Rectification normal = Rotations(pair);
  const PinholeCamera* cameras[2] = {&pair.left, &pair.right};
  double rows = 0;
  for (std::size_t side = 0; side < 2; ++side) {
    const Eigen::Vector2d middle((cameras[side]->width - 1) / 2.0, (cameras[side]->height - 1) / 2.0);
    const Eigen::Vector3d direction = normal.rotation[side] * cameras[side]->Ray(middle);
    normal.cx[side] = CentreColumn(normal, direction);
    rows += CentreRow(normal, direction);
  }
  normal.cy = rows / 2;
  return normal;
}

Rectification Rectify(const StereoPair& pair, const Eigen::Vector3d& centre) {
  Rectification normal = Rotations(pair);
  const Eigen::Vector3d left = normal.rotation[0] * centre;
  normal.cx[0] = CentreColumn(normal, left);
  normal.cx[1] = CentreColumn(normal, left - normal.baseline * Eigen::Vector3d::UnitX());
  normal.cy = CentreRow(normal, left);
  return normal;
}

Eigen::Vector3d Rectification::Triangulate(double x, double y, double disparity) const {
  const double z = f * baseline / (disparity - cx[0] + cx[1]);
  return rotation[0].transpose() * Eigen::Vector3d((x - cx[0]) * z / f, (y - cy) * z / f, z);
}

Eigen::Vector3d Rectification::Project(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d p = rotation[0] * point;
  return {f * p.x() / p.z() + cx[0], f * p.y() / p.z() + cy, f * baseline / p.z() + cx[0] - cx[1]};
}

double Rectification::RangeSlope(double x, double y, double disparity) const {
  const double z = f * baseline / (disparity - cx[0] + cx[1]);
  const double stretch = std::sqrt(1 + ((x - cx[0]) * (x - cx[0]) + (y - cy) * (y - cy)) / (f * f));
  return -stretch * z * z / (f * baseline);
}

Eigen::Vector2d SquareOnNormalLeft(double f, double phi, const Eigen::Vector2d& pixel) {
  const double c = std::cos(phi / 2), s = std::sin(phi / 2);
  const double scale = f / (f * c - pixel.x() * s);
  return {scale * (f * s + pixel.x() * c), scale * pixel.y()};
}

Eigen::Vector2d SquareOnNormalRight(double f, double phi, const Eigen::Vector2d& pixel) {
  const double c = std::cos(phi / 2), s = std::sin(phi / 2);
  const double scale = f / (f * c + pixel.x() * s);
  return {scale * (pixel.x() * c - f * s), scale * pixel.y()};
}

}  // namespace frond
