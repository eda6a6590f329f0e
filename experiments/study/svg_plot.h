// SPDX-License-Identifier: BSD-3-Clause
// Plots as SVG: no script, no font and nothing from a network. Colours are Okabe and Ito's, told apart by
// colour-blind readers too; from the ninth series on they come again with dashes.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "experiments/study/plot_axis.h"

namespace frond {

// Values that are not finite break a line.
struct PlotPoints {
  std::vector<double> x, y;
};

struct PlotBand {
  PlotPoints lower, upper;
};

struct PlotSeries {
  std::string label;
  PlotPoints line;
  std::optional<PlotBand> band = {};  // filled, behind all lines
};

enum class LineShape {
  kSegments,  // straight from point to point, each marked
  kSteps,     // constant from each point to the next, the last on to the right end
};

// A dashed line across, drawn where its value is in range.
struct PlotReference {
  double value = 0;
  bool vertical = true;
};

struct PlotPanel {
  std::string title;
  PlotAxis x, y;
  LineShape shape = LineShape::kSteps;
  std::vector<PlotSeries> series;
  std::vector<PlotReference> references = {};  // not part of the axes' ranges
};

// A panel's size, and where in it the axes are, in pixels: x grows to the right, y down.
inline constexpr double kPanelWidth = 460, kPanelHeight = 330;
inline constexpr double kPlotLeft = 62, kPlotRight = 438, kPlotTop = 34, kPlotBottom = 284;

// An SVG document: the panels side by side, under them a legend of the first panel's series (where there are
// several). `title` is for those who hear it; it is drawn where `show_title`. The same bytes for the same
// data.
std::string PlotSvg(const std::string& title, const std::vector<PlotPanel>& panels, bool show_title = false);

// Attributes of series `index`: its stroke or fill, dashes, and a class for PlotDarkCss.
std::string SeriesStroke(std::size_t index);
std::string SeriesFill(std::size_t index);

// Rules that turn the plots of a page dark; without them they are dark on white.
std::string PlotDarkCss();

// "12.3": for coordinates.
std::string Pixels(double value);

}  // namespace frond
