// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/match_outputs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "base/errors.h"
#include "base/median.h"
#include "io/image_file.h"
#include "io/point_cloud_file.h"

namespace frond {
namespace {

constexpr double kBad = 1;  // pixels

double Percent(double part, double whole) {
  return whole > 0 ? 100 * part / whole : std::numeric_limits<double>::quiet_NaN();
}

// Errors of disparities against a truth.
struct DisparityErrors {
  std::size_t count = 0, bad = 0;
  double squares = 0;

  void Add(double error) {
    ++count;
    if (std::abs(error) > kBad) ++bad;
    squares += error * error;
  }
  double Rmse() const {
    return count > 0 ? std::sqrt(squares / static_cast<double>(count))
                     : std::numeric_limits<double>::quiet_NaN();
  }
  double BadPercent() const { return Percent(static_cast<double>(bad), static_cast<double>(count)); }
};

// A disparity is left minus right; a displacement is where a point of the left image went, right minus left.
Image Negated(Image image) {
  for (float& value : image.values) value = -value;
  return image;
}

void WriteMatches(const std::filesystem::path& path, const StereoMatches& matches, bool rectified) {
  std::vector<std::string> columns = {"x", "y"};
  const std::vector<std::string> values =
      rectified ? std::vector<std::string>{"disparity"}
                : std::vector<std::string>{"u", "u_x", "u_y", "v", "v_x", "v_y"};
  columns.insert(columns.end(), values.begin(), values.end());
  columns.insert(columns.end(), {"sigma", "correlation", "noise", "status"});
  std::vector<std::vector<MetricValue>> rows;
  rows.reserve(matches.windows.size());
  for (const MatchedWindow& window : matches.windows) {
    std::vector<MetricValue> row = {static_cast<std::int64_t>(window.x), static_cast<std::int64_t>(window.y)};
    for (std::size_t k = 0; k < values.size(); ++k)
      row.emplace_back((rectified ? 1 : -1) * window.match.warp[k]);
    row.insert(row.end(), {window.match.sigma, window.match.correlation, window.match.noise,
                           std::string(WindowStatusName(window.status))});
    rows.push_back(std::move(row));
  }
  WriteCsv(path, columns, rows);
}

}  // namespace

void SetMatchMetrics(const StereoMatches& matches, const Mask& mask, MetricTable* metrics) {
  const std::size_t windows = matches.windows.size();
  const std::size_t accepted = matches.counts[static_cast<std::size_t>(WindowStatus::kAccepted)];
  metrics->Set("windows", static_cast<std::int64_t>(windows));
  metrics->Set("accepted", static_cast<std::int64_t>(accepted));
  metrics->Set("accepted_percent", Percent(static_cast<double>(accepted), static_cast<double>(windows)));
  for (std::size_t k = 1; k < kWindowStatuses; ++k) {
    metrics->Set(std::string("rejected_") + WindowStatusName(static_cast<WindowStatus>(k)),
                 static_cast<std::int64_t>(matches.counts[k]));
  }
  std::size_t object = 0, covered = 0;
  for (std::size_t i = 0; i < matches.disparity.values.size(); ++i) {
    if (!mask.empty() && mask.values[i] == 0) continue;
    ++object;
    if (std::isfinite(matches.disparity.values[i])) ++covered;
  }
  metrics->Set("coverage_percent", Percent(static_cast<double>(covered), static_cast<double>(object)));
  std::vector<double> sigmas;
  for (const MatchedWindow& window : matches.windows) {
    if (window.status == WindowStatus::kAccepted) sigmas.push_back(window.match.sigma);
  }
  metrics->Set("median_sigma_px", Median(std::move(sigmas)));
  const auto& [least, most] = matches.disparity_range;
  metrics->Set("disparity_range", std::vector<std::int64_t>{least, most});
}

void SetDisparityTruth(const StereoMatches& matches, const Image& truth, double scale, MetricTable* metrics) {
  const auto known = [&](float level) { return std::isfinite(level) && level != 0; };
  DisparityErrors windows, dense;
  for (const MatchedWindow& window : matches.windows) {
    const float level = truth(window.x, window.y);
    if (window.status != WindowStatus::kAccepted || !known(level)) continue;
    windows.Add(window.match.warp[0] - level / scale);
  }
  std::size_t with_truth = 0;
  for (std::size_t i = 0; i < truth.values.size(); ++i) {
    if (!known(truth.values[i])) continue;
    ++with_truth;
    const float disparity = matches.disparity.values[i];
    if (std::isfinite(disparity)) dense.Add(disparity - truth.values[i] / scale);
  }
  if (with_truth == 0) throw InputError("input.truth: all its pixels are 0, that is, unknown");
  metrics->Set("truth_windows", static_cast<std::int64_t>(windows.count));
  metrics->Set("disparity_rmse_px", windows.Rmse());
  metrics->Set("bad_1px_percent", windows.BadPercent());
  metrics->Set("dense_coverage_percent",
               Percent(static_cast<double>(dense.count), static_cast<double>(with_truth)));
  metrics->Set("dense_rmse_px", dense.Rmse());
  metrics->Set("dense_bad_1px_percent", dense.BadPercent());
}

void AddMatchFiles(std::shared_ptr<const StereoMatches> matches, bool rectified, FitOutcome* outcome) {
  outcome->files.push_back(
      {"matches.csv", [=](const auto& path) { WriteMatches(path, *matches, rectified); }});
  if (rectified) {
    outcome->files.push_back(
        {"disparity.tiff", [=](const auto& path) { WriteFloatTiff(path, matches->disparity); }});
  } else {
    outcome->files.push_back({"displacement_x.tiff",
                              [=](const auto& path) { WriteFloatTiff(path, Negated(matches->disparity)); }});
    outcome->files.push_back({"displacement_y.tiff", [=](const auto& path) {
                                WriteFloatTiff(path, Negated(matches->displacement_y));
                              }});
  }
  outcome->files.push_back({"sigma.tiff", [=](const auto& path) { WriteFloatTiff(path, matches->sigma); }});
}

void AddCloudFile(ColouredCloud cloud, FitOutcome* outcome) {
  const auto shared = std::make_shared<const ColouredCloud>(std::move(cloud));
  outcome->files.push_back({"cloud.ply", [=](const std::filesystem::path& path) {
                              WritePointCloud(path, {shared->points},
                                              {.colours = shared->colours,
                                               .normals = shared->normals,
                                               .standard_deviation = shared->standard_deviation});
                            }});
}

}  // namespace frond
