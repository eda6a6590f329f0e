// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/svg_plot.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "experiments/study/markup_text.h"

namespace frond {
namespace {

constexpr double kLegendRow = 18, kCharacter = 6.6;  // pixels; the latter of a font of 12
constexpr double kThinning = 0.5;                    // steps nearer than this are drawn as one
constexpr std::array<const char*, 8> kColours = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                 "#E69F00", "#56B4E9", "#000000", "#8C6D31"};
constexpr std::array<const char*, 8> kDarkColours = {"#3D9BDC", "#FF8040", "#2CC79B", "#E3A0C6",
                                                     "#F2B840", "#A5DAFA", "#EEEEEE", "#C7A35F"};
constexpr std::array<const char*, 4> kDashes = {"", "7 3", "2 2", "9 3 2 3"};

std::string Colour(std::size_t index) { return kColours[index % kColours.size()]; }

std::string Text(double x, double y, const std::string& attributes, const std::string& text) {
  return "<text x='" + Pixels(x) + "' y='" + Pixels(y) + "' fill='#222' class='ink'" + attributes + ">" +
         EscapeXml(text) + "</text>";
}

std::string Line(double x1, double y1, double x2, double y2, const std::string& attributes) {
  return "<line x1='" + Pixels(x1) + "' y1='" + Pixels(y1) + "' x2='" + Pixels(x2) + "' y2='" + Pixels(y2) +
         "' " + attributes + "/>";
}

// The axes of a panel that starts at `left`, and what they make of values.
struct Frame {
  AxisRange x, y;
  double left = 0;

  double Px(double value) const { return left + kPlotLeft + (kPlotRight - kPlotLeft) * x.At(value); }
  // Far values stay within what every viewer can draw; those too small for a logarithm lie on the lower edge.
  double Py(double value) const {
    const double least = y.scale == AxisScale::kLogarithmic ? 0 : -0.5;
    return kPlotBottom - (kPlotBottom - kPlotTop) * std::clamp(y.At(value), least, 1.5);
  }
  double Right() const { return left + kPlotRight; }
};

void Append(const std::vector<double>& from, std::vector<double>* to) {
  to->insert(to->end(), from.begin(), from.end());
}

void Widen(const PlotAxis& axis, AxisRange* range) {
  constexpr double kRoom = 0.04;
  if (range->scale == AxisScale::kLogarithmic) {
    const double factor = std::pow(range->upper / range->lower, kRoom);
    if (!axis.lower) range->lower /= factor;
    if (!axis.upper) range->upper *= factor;
  } else {
    const double span = kRoom * (range->upper - range->lower);
    if (!axis.lower) range->lower -= span;
    if (!axis.upper) range->upper += span;
  }
}

Frame FrameOf(const PlotPanel& panel, double left) {
  std::vector<double> x, y;
  for (const PlotSeries& series : panel.series) {
    Append(series.line.x, &x);
    Append(series.line.y, &y);
    if (!series.band) continue;
    for (const PlotPoints* points : {&series.band->lower, &series.band->upper}) {
      Append(points->x, &x);
      Append(points->y, &y);
    }
  }
  Frame frame{RangeOf(panel.x, x), RangeOf(panel.y, y), left};
  // Room around lines, and beside their points where these are marked; an end that was asked for stays.
  Widen(panel.y, &frame.y);
  if (panel.shape == LineShape::kSegments) Widen(panel.x, &frame.x);
  return frame;
}

std::string Axes(const PlotPanel& panel, const Frame& f) {
  const double left = f.left + kPlotLeft, right = f.Right();
  std::string svg = "<g class='axes'>";
  for (const AxisTick& tick : Ticks(f.x, panel.x.percent)) {
    const double x = f.Px(tick.value);
    const bool major = !tick.label.empty();
    svg += Line(x, major ? kPlotTop : kPlotBottom, x, kPlotBottom + (major ? 4 : 2.5),
                major ? "stroke='#e4e4e4' class='grid'" : "stroke='#888' class='frame'");
    if (major) svg += Text(x, kPlotBottom + 17, " text-anchor='middle'", tick.label);
  }
  for (const AxisTick& tick : Ticks(f.y, panel.y.percent)) {
    const double y = f.Py(tick.value);
    const bool major = !tick.label.empty();
    svg += Line(left - (major ? 4 : 2.5), y, major ? right : left, y,
                major ? "stroke='#e4e4e4' class='grid'" : "stroke='#888' class='frame'");
    if (major) svg += Text(left - 7, y + 4, " text-anchor='end'", tick.label);
  }
  svg += "<rect x='" + Pixels(left) + "' y='" + Pixels(kPlotTop) + "' width='" + Pixels(right - left) +
         "' height='" + Pixels(kPlotBottom - kPlotTop) + "' fill='none' stroke='#888' class='frame'/>";
  svg += Text((left + right) / 2, kPlotBottom + 36, " text-anchor='middle'", panel.x.label);
  svg += Text(f.left + 8, kPlotTop - 10, "", Shortened(panel.y.label, 40));
  if (!panel.title.empty()) {
    svg += Text(right, kPlotTop - 10, " text-anchor='end' font-weight='bold'", Shortened(panel.title, 38));
  }
  return svg + "</g>\n";
}

std::string SegmentPath(const PlotPoints& points, const Frame& f) {
  std::string path;
  bool down = false;
  for (std::size_t i = 0; i < points.x.size(); ++i) {
    const double x = f.Px(points.x[i]);
    if (!std::isfinite(x) || !std::isfinite(points.y[i])) {
      down = false;
      continue;
    }
    path += (down ? "L" : "M") + Pixels(x) + " " + Pixels(f.Py(points.y[i]));
    down = true;
  }
  return path;
}

// Steps as (pixel, value), the last at the right end: NaN values stay, steps that no one could see apart do
// not.
struct Steps {
  std::vector<double> x, y;
};
Steps StepsOf(const PlotPoints& points, const Frame& f) {
  Steps steps;
  for (std::size_t i = 0; i < points.x.size(); ++i) {
    const double x = std::max(f.Px(points.x[i]), f.left + kPlotLeft);
    if (!std::isfinite(x)) continue;
    if (!steps.x.empty() && x - steps.x.back() < kThinning) {
      steps.y.back() = points.y[i];
    } else {
      steps.x.push_back(x);
      steps.y.push_back(points.y[i]);
    }
  }
  return steps;
}

std::string StepPath(const PlotPoints& points, const Frame& f) {
  const Steps steps = StepsOf(points, f);
  std::string path;
  bool down = false;
  for (std::size_t i = 0; i < steps.x.size(); ++i) {
    if (!std::isfinite(steps.y[i])) {
      if (down) path += "H" + Pixels(steps.x[i]);
      down = false;
      continue;
    }
    const std::string y = Pixels(f.Py(steps.y[i]));
    path += down ? "H" + Pixels(steps.x[i]) + "V" + y : "M" + Pixels(steps.x[i]) + " " + y;
    down = true;
  }
  if (down) path += "H" + Pixels(f.Right());
  return path;
}

double StepAt(const Steps& steps, double x) {
  const auto next = std::upper_bound(steps.x.begin(), steps.x.end(), x);
  if (next == steps.x.begin()) return std::numeric_limits<double>::quiet_NaN();
  return steps.y[static_cast<std::size_t>(next - steps.x.begin()) - 1];
}

// A closed path for each stretch on which both edges are finite.
std::string BandPath(const PlotBand& band, const Frame& f) {
  const Steps lower = StepsOf(band.lower, f), upper = StepsOf(band.upper, f);
  std::vector<double> x = lower.x;
  Append(upper.x, &x);
  std::sort(x.begin(), x.end());
  x.erase(std::unique(x.begin(), x.end()), x.end());
  if (x.empty()) return "";
  x.push_back(f.Right());
  std::string path, forth, back;
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    const double low = StepAt(lower, x[i]), high = StepAt(upper, x[i]);
    if (!std::isfinite(low) || !std::isfinite(high)) {
      if (!forth.empty()) path += forth + back + "Z";
      forth.clear();
      back.clear();
      continue;
    }
    const std::string from = Pixels(x[i]), to = Pixels(x[i + 1]);
    const std::string top = Pixels(f.Py(high)), bottom = Pixels(f.Py(low));
    forth += (forth.empty() ? "M" : "L") + from + " " + top + "H" + to;
    back = "L" + to + " " + bottom + "H" + from + back;
  }
  if (!forth.empty()) path += forth + back + "Z";
  return path;
}

std::string Markers(const PlotSeries& series, std::size_t index, const Frame& f) {
  std::string svg;
  for (std::size_t i = 0; i < series.line.x.size(); ++i) {
    if (!std::isfinite(series.line.x[i]) || !std::isfinite(series.line.y[i])) continue;
    char value[32];
    const auto end =
        std::to_chars(value, value + sizeof(value), series.line.y[i], std::chars_format::general, 6).ptr;
    svg += "<circle cx='" + Pixels(f.Px(series.line.x[i])) + "' cy='" + Pixels(f.Py(series.line.y[i])) +
           "' r='2.5' " + SeriesFill(index) + "><title>" + EscapeXml(series.label) + ": " +
           std::string(value, end) + "</title></circle>";
  }
  return svg;
}

std::string References(const PlotPanel& panel, const Frame& f) {
  std::string svg;
  for (const PlotReference& reference : panel.references) {
    const double at = (reference.vertical ? f.x : f.y).At(reference.value);
    if (!(at >= 0 && at <= 1)) continue;
    const double x = f.Px(reference.value), y = f.Py(reference.value);
    const std::string stroke = "stroke='#666' class='frame' stroke-dasharray='4 3'";
    svg += reference.vertical ? Line(x, kPlotTop, x, kPlotBottom, stroke)
                              : Line(f.left + kPlotLeft, y, f.Right(), y, stroke);
  }
  return svg;
}

std::string Panel(const PlotPanel& panel, double left) {
  const Frame f = FrameOf(panel, left);
  std::string svg = Axes(panel, f);
  svg += "<svg x='" + Pixels(left + kPlotLeft) + "' y='" + Pixels(kPlotTop - 1) + "' width='" +
         Pixels(kPlotRight - kPlotLeft) + "' height='" + Pixels(kPlotBottom - kPlotTop + 2) + "' viewBox='" +
         Pixels(left + kPlotLeft) + " " + Pixels(kPlotTop - 1) + " " + Pixels(kPlotRight - kPlotLeft) + " " +
         Pixels(kPlotBottom - kPlotTop + 2) + "'>\n";
  for (std::size_t k = 0; k < panel.series.size(); ++k) {
    const std::string path = panel.series[k].band ? BandPath(*panel.series[k].band, f) : "";
    if (!path.empty()) svg += "<path d='" + path + "' " + SeriesFill(k) + " fill-opacity='0.16'/>\n";
  }
  for (std::size_t k = 0; k < panel.series.size(); ++k) {
    const PlotSeries& series = panel.series[k];
    const bool steps = panel.shape == LineShape::kSteps;
    const std::string path = steps ? StepPath(series.line, f) : SegmentPath(series.line, f);
    if (path.empty()) continue;
    svg += "<path d='" + path + "' fill='none' " + SeriesStroke(k) + " stroke-width='1.8'><title>" +
           EscapeXml(series.label) + "</title></path>\n";
    if (!steps) svg += Markers(series, k, f) + "\n";
  }
  return svg + "</svg>\n" + References(panel, f);
}

// Rows of labels from `top` down; returns the height they take.
double Legend(const std::vector<PlotSeries>& series, double width, double top, std::string* svg) {
  double x = 12, y = top;
  for (std::size_t k = 0; k < series.size(); ++k) {
    const std::string label = Shortened(series[k].label, 48);
    const double needs = 34 + kCharacter * static_cast<double>(TextWidth(label));
    if (x > 12 && x + needs > width) {
      x = 12;
      y += kLegendRow;
    }
    *svg += Line(x, y, x + 22, y, SeriesStroke(k) + " stroke-width='2.5'") + Text(x + 27, y + 4, "", label) +
            "\n";
    x += needs + 10;
  }
  return y - top + kLegendRow;
}

}  // namespace

std::string Pixels(double value) {
  char buffer[400];
  if (std::abs(value) < 0.05) value = 0;
  const auto end = std::to_chars(buffer, buffer + sizeof(buffer), value, std::chars_format::fixed, 1).ptr;
  std::string text(buffer, end);
  if (text.ends_with(".0")) text.resize(text.size() - 2);
  return text;
}

std::string SeriesStroke(std::size_t index) {
  const std::string dash = kDashes[index / kColours.size() % kDashes.size()];
  return "stroke='" + Colour(index) + "' class='s" + std::to_string(index % kColours.size()) + "'" +
         (dash.empty() ? "" : " stroke-dasharray='" + dash + "'");
}

std::string SeriesFill(std::size_t index) {
  return "fill='" + Colour(index) + "' class='f" + std::to_string(index % kColours.size()) + "'";
}

std::string PlotDarkCss() {
  std::string css = ".paper{fill:none}.ink{fill:#ddd}.grid{stroke:#3a3a3a}.frame{stroke:#999}";
  for (std::size_t k = 0; k < kDarkColours.size(); ++k) {
    const std::string class_name = std::to_string(k), colour = kDarkColours[k];
    css += ".s" + class_name + "{stroke:" + colour + "}.f" + class_name + "{fill:" + colour + "}";
  }
  return css;
}

std::string PlotSvg(const std::string& title, const std::vector<PlotPanel>& panels, bool show_title) {
  const double width = kPanelWidth * static_cast<double>(std::max<std::size_t>(panels.size(), 1));
  const double top = show_title ? 24 : 0;
  std::string body;
  for (std::size_t k = 0; k < panels.size(); ++k)
    body += Panel(panels[k], kPanelWidth * static_cast<double>(k));
  double height = kPanelHeight;
  if (!panels.empty() && panels[0].series.size() > 1) {
    height += Legend(panels[0].series, width, kPanelHeight + 6, &body) + 2;
  }
  std::string svg = "<svg xmlns='http://www.w3.org/2000/svg' width='" + Pixels(width) + "' height='" +
                    Pixels(height + top) + "' viewBox='0 " + Pixels(-top) + " " + Pixels(width) + " " +
                    Pixels(height + top) +
                    "' font-family='system-ui, sans-serif' font-size='12' role='img' " + "aria-label='" +
                    EscapeXml(title) + "'>\n<title>" + EscapeXml(title) + "</title>\n<rect y='" +
                    Pixels(-top) + "' width='100%' height='100%' fill='white' class='paper'/>\n";
  if (show_title) svg += Text(12, -6, " font-size='14'", title) + "\n";
  return svg + body + "</svg>\n";
}

}  // namespace frond
