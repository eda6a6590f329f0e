// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/opencv_corners.h"

namespace frond {

std::vector<cv::Point2d> OpencvPixels(const BoardCorners& corners) {
  std::vector<cv::Point2d> pixels;
  for (const Eigen::Vector2d& p : corners.pixels) pixels.emplace_back(p.x(), p.y());
  return pixels;
}

std::vector<cv::Point3d> OpencvPoints(const BoardCorners& corners) {
  std::vector<cv::Point3d> points;
  for (const Eigen::Vector3d& p : corners.points) points.emplace_back(p.x(), p.y(), p.z());
  return points;
}

cv::Mat OpencvMatrix(const PinholeCamera& camera) {
  return (cv::Mat_<double>(3, 3) << camera.focal[0], 0, camera.focal[2], 0, camera.focal[1], camera.focal[3],
          0, 0, 1);
}

cv::Mat OpencvDistortion(const PinholeCamera& camera) {
  const auto& d = camera.distortion;
  return (cv::Mat_<double>(1, 5) << d[0], d[1], d[2], d[3], d[4]);
}

Eigen::Isometry3d PoseFromOpencv(const cv::Mat& rotation_vector, const cv::Mat& translation) {
  const auto value = [](const cv::Mat& m, int k) { return m.at<double>(k); };
  const Eigen::Vector3d r(value(rotation_vector, 0), value(rotation_vector, 1), value(rotation_vector, 2));
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  if (r.norm() > 0) pose.linear() = Eigen::AngleAxisd(r.norm(), r.normalized()).toRotationMatrix();
  pose.translation() = Eigen::Vector3d(value(translation, 0), value(translation, 1), value(translation, 2));
  return pose;
}

}  // namespace frond
