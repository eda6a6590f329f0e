// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/rig_warnings.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>
#include <utility>

#include "base/median.h"

namespace frond {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr std::size_t kEnoughAngles = 10;
constexpr double kSmallSpan = 45 * kDegree;         // of all angles
constexpr double kTiltThatMatters = 0.3 * kDegree;  // MATH.md §3: beyond it eqs 4-7 cost accuracy
constexpr double kSignificant = 5;                  // standard deviations
constexpr double kLeastAngleError = 0.02 * kDegree;
constexpr double kExplains = 0.3;    // of the deviation left by an explanation, to be one
constexpr double kBadView = 3;       // of the median view's RMS
constexpr double kBadViewRms = 0.3;  // px, less is never bad
constexpr double kTableNoise = 2;    // RMS over a fit with free angles, to be worth freeing them

std::string Number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

std::string Degrees(double angle) { return Number(angle / kDegree) + " degrees"; }

double MedianOf(const std::vector<double>& values, std::size_t begin, std::size_t end) {
  return Median({values.begin() + static_cast<std::ptrdiff_t>(begin),
                 values.begin() + static_cast<std::ptrdiff_t>(end)});
}

// Theil and Sen: the median slope over all pairs.
double RobustSlope(const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<double> slopes;
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (std::size_t j = i + 1; j < x.size(); ++j) {
      if (std::abs(x[j] - x[i]) > 1e-6) slopes.push_back((y[j] - y[i]) / (x[j] - x[i]));
    }
  }
  return Median(slopes);
}

// The sum of all distances from the median, or of the smaller three quarters, that of the first `split`
// values and that of the others: trimmed, single wrong values do not count.
double Deviations(const std::vector<double>& values, std::size_t split, bool trimmed) {
  std::vector<double> distances;
  for (const auto& [begin, end] : {std::pair(std::size_t{0}, split), std::pair(split, values.size())}) {
    const double median = MedianOf(values, begin, end);
    for (std::size_t k = begin; k < end; ++k) distances.push_back(std::abs(values[k] - median));
  }
  std::sort(distances.begin(), distances.end());
  const auto kept = static_cast<std::ptrdiff_t>(trimmed ? (3 * distances.size() + 3) / 4 : distances.size());
  return std::accumulate(distances.begin(), distances.begin() + kept, 0.0);
}

// Before which value a step leaves the smallest deviations, 0 where none does; at least 2 values on each
// side.
std::size_t BestStep(const std::vector<double>& values) {
  std::size_t best = 0;
  double least = Deviations(values, 0, false);
  for (std::size_t k = 2; k + 2 <= values.size(); ++k) {
    const double sum = Deviations(values, k, false);
    if (sum < least) {
      least = sum;
      best = k;
    }
  }
  return best;
}

// The smallest arc that holds all angles, and how many differ.
double Span(std::vector<double> angles, std::size_t* distinct) {
  for (double& angle : angles) {
    angle = std::fmod(angle, 2 * std::numbers::pi);
    if (angle < 0) angle += 2 * std::numbers::pi;
  }
  std::sort(angles.begin(), angles.end());
  double gap = angles.front() + 2 * std::numbers::pi - angles.back();
  *distinct = 1;
  for (std::size_t k = 1; k < angles.size(); ++k) {
    gap = std::max(gap, angles[k] - angles[k - 1]);
    if (angles[k] - angles[k - 1] > 1e-6) ++*distinct;
  }
  return 2 * std::numbers::pi - gap;
}

void WarnOfAngles(const AxisCalibration& calibration, const std::vector<AxisView>& views,
                  std::vector<std::string>* warnings) {
  std::vector<double> angles;
  for (const AxisView& view : views) angles.push_back(view.angle);
  std::size_t distinct = 0;
  const double span = Span(angles, &distinct);
  if (distinct < kEnoughAngles) {
    warnings->push_back("the axis is calibrated from " + std::to_string(distinct) +
                        " table angle(s) only: 10 and more are recommended");
  }
  if (span < kSmallSpan) {
    warnings->push_back("the table's angles span " + Degrees(span) +
                        " only: the axis is the better known the farther the board turns");
  }
  if (calibration.angle_errors.empty()) return;
  const AngleFindings found = FindAngleErrors(angles, calibration.angle_errors);
  if (found.scale) {
    warnings->push_back("the table turns " + Number(found.factor) +
                        " times the angles given: correct their scale, or set free_angles");
  }
  if (found.step) {
    warnings->push_back("from " + views[found.step_view].name + " on the angles are off by " +
                        Degrees(found.step_size) + ": the board slipped, or the table did");
  }
  for (std::size_t k = 0; k < found.suspects.size(); ++k) {
    const AxisView& view = views[found.suspects[k]];
    warnings->push_back(view.name + ": its angle does not fit the other views: " + Degrees(view.angle) +
                        " is off by " + Degrees(-found.suspect_errors[k]) + ", the board shows " +
                        Degrees(view.angle + found.suspect_errors[k]) +
                        ": correct it, leave the view out, or set free_angles");
  }
  const bool named = found.scale || found.step || !found.suspects.empty();
  if (!named && calibration.rms > kTableNoise * calibration.free_angles_rms) {
    warnings->push_back("the table's angles scatter: corners are off by " + Number(calibration.rms) +
                        " px with the angles given, by " + Number(calibration.free_angles_rms) +
                        " px with each angle free: set free_angles");
  }
}

}  // namespace

AngleFindings FindAngleErrors(const std::vector<double>& angles, const std::vector<Estimate>& errors) {
  AngleFindings found;
  const std::size_t count = angles.size();
  std::vector<double> values, sigmas;
  for (const Estimate& error : errors) {
    values.push_back(error.value);
    if (error.sigma > 0) sigmas.push_back(error.sigma);
  }
  const double threshold = std::max(kLeastAngleError, kSignificant * Median(sigmas));
  const double centre = Median(values);
  double widest = 0;
  for (const double value : values) widest = std::max(widest, std::abs(value - centre));
  if (count < 4 || widest <= threshold) return found;

  const double deviations = Deviations(values, 0, true);
  const double slope = RobustSlope(angles, values);
  std::vector<double> detrended = values;
  for (std::size_t k = 0; k < count; ++k) detrended[k] -= slope * angles[k];
  const std::size_t step = BestStep(values);
  if (Deviations(detrended, 0, true) < kExplains * deviations) {
    found.scale = true;
    found.factor = 1 + slope;
    values = detrended;
  } else if (step > 0 && Deviations(values, step, true) < kExplains * deviations) {
    found.step = true;
    found.step_view = step;
    found.step_size = MedianOf(values, step, count) - MedianOf(values, 0, step);
    for (std::size_t k = step; k < count; ++k) values[k] -= found.step_size;
  }
  const double median = Median(values);
  std::vector<double> spread;
  for (const double value : values) spread.push_back(std::abs(value - median));
  const double limit = std::max(threshold, kSignificant * 1.4826 * Median(spread));
  for (std::size_t k = 0; k < count; ++k) {
    if (std::abs(values[k] - median) <= limit) continue;
    found.suspects.push_back(k);
    found.suspect_errors.push_back(values[k] - median);
  }
  return found;
}

std::vector<std::string> RigWarnings(const AxisCalibration& calibration, const std::vector<AxisView>& views) {
  std::vector<std::string> warnings;
  WarnOfAngles(calibration, views, &warnings);
  const double median = Median(calibration.view_rms);
  for (std::size_t k = 0; k < views.size(); ++k) {
    if (calibration.view_rms[k] < std::max(kBadViewRms, kBadView * median)) continue;
    warnings.push_back(views[k].name + ": its corners are off by " + Number(calibration.view_rms[k]) +
                       " px, those of the median view by " + Number(median) + " px");
  }
  return warnings;
}

std::vector<std::string> RigNotes(const AxisCalibration& calibration) {
  if (std::abs(calibration.tilt.value) <= kTiltThatMatters) return {};
  return {"the camera looks " + std::string(calibration.tilt.value > 0 ? "down" : "up") + " at the disk by " +
          Degrees(std::abs(calibration.tilt.value)) +
          ": more than 0.3, so that normal images are made by the general rotations, not by eqs 4-7"};
}

}  // namespace frond
