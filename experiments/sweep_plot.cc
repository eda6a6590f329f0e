// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/sweep_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

namespace frond {
namespace {

constexpr double kWidth = 460, kHeight = 320, kLeft = 58, kTop = 40, kRight = 12, kBottom = 46;
// Okabe and Ito's colours: told apart by colour-blind readers too.
constexpr std::array<const char*, 8> kColours = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                 "#E69F00", "#56B4E9", "#000000", "#8C6D31"};

std::string Escaped(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '<') {
      escaped += "&lt;";
    } else if (c == '&') {
      escaped += "&amp;";
    } else {
      escaped += c;
    }
  }
  return escaped;
}

struct Axis {
  double low, high;
  bool logarithmic;
  double At(double value) const {
    return logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
  }
};

Axis XAxis(const PlotPanel& panel) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const PlotLine& line : panel.lines) {
    for (const double x : line.x) {
      low = std::min(low, x);
      high = std::max(high, x);
    }
  }
  if (!(high > low)) return {low - 0.5, low + 0.5, false};
  return {low, high, low > 0 && high / low > 10};
}

Axis YAxis(const PlotPanel& panel) {
  double high = 0;
  for (const PlotLine& line : panel.lines) {
    for (const double y : line.y) {
      if (std::isfinite(y)) high = std::max(high, y);
    }
  }
  return {0, high > 0 ? 1.08 * high : 1, false};
}

std::vector<double> Ticks(const Axis& axis) {
  std::vector<double> ticks;
  if (axis.logarithmic) {
    for (double t = std::pow(10, std::floor(std::log10(axis.low))); t <= axis.high * 1.001; t *= 10) {
      for (const double m : {1.0, 3.0}) {
        if (m * t >= axis.low * 0.999 && m * t <= axis.high * 1.001) ticks.push_back(m * t);
      }
    }
    return ticks;
  }
  const double raw = (axis.high - axis.low) / 5, power = std::pow(10, std::floor(std::log10(raw)));
  const double step = power * (raw < 2 * power ? 2 : raw < 5 * power ? 5 : 10);
  for (double t = std::ceil(axis.low / step) * step; t <= axis.high + 1e-9 * step; t += step)
    ticks.push_back(t);
  return ticks;
}

void DrawPanel(const PlotPanel& panel, double x0, std::ostringstream* svg) {
  const Axis ax = XAxis(panel), ay = YAxis(panel);
  const double w = kWidth - kLeft - kRight, h = kHeight - kTop - kBottom;
  const auto px = [&](double x) { return x0 + kLeft + w * ax.At(x); };
  const auto py = [&](double y) { return kTop + h * (1 - ay.At(y)); };
  *svg << "<rect x='" << x0 + kLeft << "' y='" << kTop << "' width='" << w << "' height='" << h
       << "' fill='none' stroke='#888'/>\n";
  for (const double t : Ticks(ax)) {
    *svg << "<text x='" << px(t) << "' y='" << kTop + h + 16 << "' text-anchor='middle'>" << std::defaultfloat
         << t << std::fixed << "</text>\n";
  }
  for (const double t : Ticks(ay)) {
    *svg << "<line x1='" << x0 + kLeft << "' x2='" << x0 + kLeft + w << "' y1='" << py(t) << "' y2='" << py(t)
         << "' stroke='#ddd'/><text x='" << x0 + kLeft - 6 << "' y='" << py(t) + 4 << "' text-anchor='end'>"
         << std::defaultfloat << t << std::fixed << "</text>\n";
  }
  *svg << "<text x='" << x0 + kLeft + w / 2 << "' y='" << kHeight - 8 << "' text-anchor='middle'>"
       << Escaped(panel.x_label) << "</text><text x='" << x0 + kLeft << "' y='" << kTop - 8 << "'>"
       << Escaped(panel.y_label) << "</text>\n";
  for (std::size_t k = 0; k < panel.lines.size(); ++k) {
    const PlotLine& line = panel.lines[k];
    const char* colour = kColours[k % kColours.size()];
    std::ostringstream path;
    path << std::fixed << std::setprecision(1);
    bool pen_down = false;
    for (std::size_t i = 0; i < line.x.size(); ++i) {
      if (!std::isfinite(line.y[i])) {
        pen_down = false;
        continue;
      }
      path << (pen_down ? "L" : "M") << px(line.x[i]) << " " << py(line.y[i]);
      pen_down = true;
      *svg << "<circle cx='" << px(line.x[i]) << "' cy='" << py(line.y[i]) << "' r='2.5' fill='" << colour
           << "'><title>" << Escaped(line.label) << ": " << std::defaultfloat << line.y[i] << std::fixed
           << "</title></circle>\n";
    }
    *svg << "<path d='" << path.str() << "' fill='none' stroke='" << colour << "' stroke-width='1.5'/>\n";
  }
}

}  // namespace

std::string PlotSvg(const std::string& title, const std::vector<PlotPanel>& panels) {
  const std::size_t lines = panels.empty() ? 0 : panels[0].lines.size();
  const double legend = lines > 1 ? 150 : 0;
  const double width = kWidth * static_cast<double>(panels.size()) + legend;
  std::ostringstream svg;
  svg << std::fixed << std::setprecision(1);
  svg << "<svg xmlns='http://www.w3.org/2000/svg' width='" << width << "' height='" << kHeight
      << "' viewBox='0 0 " << width << " " << kHeight
      << "' font-family='sans-serif' font-size='11'>\n<rect width='100%' height='100%' "
      << "fill='white'/>\n<text x='12' y='16' font-size='13'>" << Escaped(title) << "</text>\n";
  for (std::size_t k = 0; k < panels.size(); ++k) DrawPanel(panels[k], kWidth * static_cast<double>(k), &svg);
  for (std::size_t k = 0; legend > 0 && k < lines; ++k) {
    const double y = kTop + 8 + 16 * static_cast<double>(k);
    svg << "<line x1='" << width - legend + 4 << "' x2='" << width - legend + 24 << "' y1='" << y << "' y2='"
        << y << "' stroke='" << kColours[k % kColours.size()] << "' stroke-width='2'/><text x='"
        << width - legend + 30 << "' y='" << y + 4 << "'>" << Escaped(panels[0].lines[k].label)
        << "</text>\n";
  }
  svg << "</svg>\n";
  return svg.str();
}

}  // namespace frond
