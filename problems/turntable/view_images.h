// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>

#include "models/raster.h"
#include "models/rectification.h"
#include "models/turntable_rig.h"
#include "problems/turntable/turntable_view.h"

namespace frond {

// Round the axis of the disk, in its frame and unit: the object is inside.
struct BoundingCylinder {
  double radius = 1;
  double bottom = 0;  // z
  double top = 1;
  double Height() const { return top - bottom; }
};

// The least cylinder (and a share of `margin` more) that all silhouettes allow: no ray of a mask's pixel
// passes the axis farther off than the object reaches. Its top and bottom are those of the rays inside it.
// `masks`: of the views' masks, none empty. Throws InputError where all of a mask is 0.
BoundingCylinder CylinderOfSilhouettes(std::span<const TurntableView> views, const TurntableRig& rig,
                                       double margin = 0.03);

// A pair of views as normal images (acquisition paper, 2.1), cut to where the object can be.
struct NormalPair {
  Rectification normal;
  Image left, right;
  ColourImage left_colour;     // empty where the view has none
  Mask left_mask, right_mask;  // 1: of the object and inside the photograph
  double min_disparity = 0;    // that the cylinder's points have
  double max_disparity = 0;
};

// Which disparities and which part of the normal images the cylinder takes; the disparity of the axis at half
// height is 0. Throws InputError as Rectify, or where the cylinder is outside the images.
Rectification CropToCylinder(const TurntableRig& rig, double left_angle, double right_angle,
                             const BoundingCylinder& cylinder, std::array<double, 2>* disparities);

// The two views (angles in degrees) resampled: grey values by a cubic B-spline, colours and masks linearly.
// Throws InputError where a view's images are not all of the camera's size.
NormalPair RectifyViews(const TurntableView& left, const TurntableView& right, const TurntableRig& rig,
                        const BoundingCylinder& cylinder, int threads);

}  // namespace frond
