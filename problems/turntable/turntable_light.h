// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <span>

#include "problems/turntable/camera_film.h"
#include "problems/turntable/turntable_scene.h"

namespace frond {

// The light that arrives at the camera from the scene with the disk at one angle: a speckled, shiny pear
// (where there is one) that darkens towards its foot, a dark disk with the pear's shadow, a dark room.
// Ambient light depends on the slope against the axis alone, so that it turns with the object.
class TurntableLight {
 public:
  TurntableLight(const TurntableScene& scene, double angle, bool with_pear, bool colour);

  // From the direction of the pixel (u, v).
  std::array<float, 3> Seen(double u, double v) const;
  bool SeesPear(double u, double v) const;

  std::array<float, 3> Room() const;  // where there is nothing
  PixelBox PearBox() const;           // that holds all pixels which see it
  PixelBox DiskBox() const;

  // To the pixel's place on the disk's plane, in the disk's frame; none beyond its edge.
  std::optional<Eigen::Vector3d> OnDisk(const Eigen::Vector3d& direction) const;

 private:
  std::array<float, 3> OfPear(const Eigen::Vector3d& point, const Eigen::Vector3d& direction) const;
  std::array<float, 3> OfDisk(const Eigen::Vector3d& point) const;
  Eigen::Vector3d Direction(double u, double v) const;  // in the disk's frame

  const TurntableScene& scene_;
  bool with_pear_, colour_;
  Eigen::Isometry3d camera_from_disk_, disk_from_camera_;
  Eigen::Vector3d eye_, to_lamp_;  // disk's frame
};

// The smallest box in the camera's image around the pixels of the points (camera's frame) with `margin`
// pixels more on each side.
PixelBox BoxAround(const PinholeCamera& camera, std::span<const Eigen::Vector3d> points, int margin);

}  // namespace frond
