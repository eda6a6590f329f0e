// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace frond {

struct PlotLine {
  std::string label;
  std::vector<double> x, y;  // NaN where there is no value
};

// One panel a metric, side by side, x logarithmic where it spans more than a decade: an SVG document.
struct PlotPanel {
  std::string x_label, y_label;
  std::vector<PlotLine> lines;
};
std::string PlotSvg(const std::string& title, const std::vector<PlotPanel>& panels);

}  // namespace frond
