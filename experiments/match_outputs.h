// SPDX-License-Identifier: BSD-3-Clause
// What a run writes and reports of matched pairs and of clouds made of photographs.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "experiments/fit_type.h"
#include "models/raster.h"
#include "problems/stereo/stereo_matcher.h"
#include "problems/turntable/scan_point.h"

namespace frond {

// windows, accepted, accepted_percent, rejected_STATUS, coverage_percent (pixels of the mask with a
// disparity), median_sigma_px.
void SetMatchMetrics(const StereoMatches& matches, const Mask& mask, MetricTable* metrics);

// disparity_rmse_px and bad_1px_percent over accepted windows whose true disparity is known; the same over
// all pixels with a disparity as dense_rmse_px, dense_bad_1px_percent. `truth`: disparities of the left image
// times `scale`; 0 and what is not finite is unknown. Throws InputError where the truth knows none of them.
void SetDisparityTruth(const StereoMatches& matches, const Image& truth, double scale, MetricTable* metrics);

// matches.csv (a line a window), disparity.tiff, sigma.tiff; of pairs that are not rectified
// displacement_x.tiff and displacement_y.tiff instead of the disparity.
void AddMatchFiles(std::shared_ptr<const StereoMatches> matches, bool rectified, FitOutcome* outcome);

// cloud.ply: colour, normal and standard deviation of each point.
struct ColouredCloud {
  std::vector<Eigen::Vector3d> points, normals;
  std::vector<double> standard_deviation;
  std::vector<std::array<std::uint8_t, 3>> colours;
};
void AddCloudFile(ColouredCloud cloud, FitOutcome* outcome);

}  // namespace frond
