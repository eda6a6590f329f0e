// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include "models/pinhole_camera.h"
#include "models/rectification.h"

namespace frond {

// A camera that looks at a turning disk (acquisition paper, section 2). The disk's frame: z is the axis of
// turning (up), the origin the point of the axis next to the camera's centre, x points to the camera's centre
// where the disk stands at 0 degrees; it turns with the object. The disk at `angle` (radians,
// counter-clockwise seen from above) shows a point p of the disk at camera_from_disk · Rz(angle) · p in the
// camera's frame.
struct TurntableRig {
  PinholeCamera camera;
  Eigen::Isometry3d camera_from_disk = Eigen::Isometry3d::Identity();

  // The paper's d: of the camera's centre from the axis.
  double AxisDistance() const { return camera_from_disk.translation().norm(); }

  // Between the image's y axis and the axis as the camera sees it: about its x axis (the camera looking down
  // or up at the disk), and about its viewing direction (roll). Radians; square on (eqs 4-7) both are 0.
  double Tilt() const;
  double Roll() const;

  // Of the disk at `angle`.
  Eigen::Isometry3d CameraFromDisk(double angle) const;

  // The two views as a stereo pair with fixed object: as in Fig. 1, the camera moves round it instead. The
  // first camera is the left one where first_angle > second_angle.
  StereoPair Pair(double first_angle, double second_angle) const;
};

// The rig of an axis given in the camera's frame by any of its points and its direction, of any length and
// sign (the axis is taken to point up: against the image's y).
TurntableRig RigFromAxis(const PinholeCamera& camera, const Eigen::Vector3d& point,
                         const Eigen::Vector3d& direction);

}  // namespace frond
