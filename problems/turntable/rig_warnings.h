// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "problems/turntable/axis_calibration.h"

namespace frond {

// How the angles given disagree with those that the views show, the simplest explanation first.
struct AngleFindings {
  bool scale = false;  // they grow as `factor` times the angles given
  double factor = 1;
  bool step = false;  // from view `step_view` on (as listed) they are off by `step_size` radians
  std::size_t step_view = 0;
  double step_size = 0;
  std::vector<std::size_t> suspects;   // single views whose angle is off,
  std::vector<double> suspect_errors;  // by so much, radians
};
AngleFindings FindAngleErrors(const std::vector<double>& angles, const std::vector<Estimate>& errors);

// One line each of what does not fit in a calibrated rig, or is too little: few or near angles, an angle
// scale, a board that slipped, single wrong angles, views that are off.
std::vector<std::string> RigWarnings(const AxisCalibration& calibration, const std::vector<AxisView>& views);

// And of what is good to know: the rig's tilt.
std::vector<std::string> RigNotes(const AxisCalibration& calibration);

}  // namespace frond
