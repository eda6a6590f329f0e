// SPDX-License-Identifier: BSD-3-Clause
// Corners and cameras as OpenCV takes them; includes OpenCV's headers: for .cc files only.
#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>
#include <vector>

#include "models/pinhole_camera.h"
#include "problems/turntable/board.h"

namespace frond {

std::vector<cv::Point2d> OpencvPixels(const BoardCorners& corners);
std::vector<cv::Point3d> OpencvPoints(const BoardCorners& corners);

cv::Mat OpencvMatrix(const PinholeCamera& camera);      // 3 × 3
cv::Mat OpencvDistortion(const PinholeCamera& camera);  // 1 × 5

Eigen::Isometry3d PoseFromOpencv(const cv::Mat& rotation_vector, const cv::Mat& translation);

}  // namespace frond
