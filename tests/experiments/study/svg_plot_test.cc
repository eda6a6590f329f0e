// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/svg_plot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "experiments/study/critical_difference_plot.h"
#include "sample_study.h"

namespace frond {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

bool Holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

PlotPanel Panel(PlotPoints points) {
  return {.title = "",
          .x = {.label = "x", .scale = AxisScale::kLogarithmic, .lower = 1, .upper = 10000},
          .y = {.label = "y", .scale = AxisScale::kLinear, .lower = 0, .upper = 1},
          .series = {{"a", std::move(points)}}};
}

TEST(SvgPlot, Steps_StandWhereTheDataAre) {
  // 376 pixels from x = 62 for 4 decades, 250 up from y = 284 for 0 to 1.
  const std::string svg = PlotSvg("steps", {Panel({{10, 100}, {0.25, 0.5}})});
  EXPECT_TRUE(Holds(svg, "d='M156 221.5H250V159H438'")) << svg;
}

TEST(SvgPlot, ValuesThatAreNotFinite_BreakTheLine) {
  PlotPanel panel = Panel({{1, 10, 100, 1000}, {0.5, kNone, 0.5, std::numeric_limits<double>::infinity()}});
  EXPECT_TRUE(Holds(PlotSvg("steps", {panel}), "d='M62 159H156M250 159H344'"));
  panel.shape = LineShape::kSegments;
  panel.series[0].line.y = {0, 1, kNone, 1};
  EXPECT_TRUE(Holds(PlotSvg("segments", {panel}), "d='M62 284L156 34M344 34'"));
}

TEST(SvgPlot, Band_SpansLowerToUpper) {
  PlotPanel panel = Panel({{10}, {0.5}});
  panel.series[0].band = {{{10}, {0.2}}, {{10, 100}, {0.6, kNone}}};
  EXPECT_TRUE(Holds(PlotSvg("band", {panel}), "d='M156 134H250L250 234H156Z'"));
}

TEST(SvgPlot, NamesAreEscaped_AndTheDocumentIsWellFormed) {
  PlotPanel panel = Panel({{1}, {1}});
  panel.series.push_back({kOddName, {{1}, {0.5}}});
  panel.title = panel.x.label = panel.y.label = kOddName;
  const std::string svg = PlotSvg(kOddName, {panel, panel}, true);
  EXPECT_TRUE(IsWellFormed(svg));
  EXPECT_FALSE(Holds(svg, "<b>"));
}

TEST(SvgPlot, WithoutData_IsStillAPlot) {
  EXPECT_TRUE(IsWellFormed(PlotSvg("empty", {})));
  PlotPanel panel{
      .title = "", .x = {.label = "x"}, .y = {.label = "y"}, .series = {{"a", {{kNone}, {kNone}}}}};
  EXPECT_TRUE(IsWellFormed(PlotSvg("empty", {panel})));
  panel.series[0].line = {{3}, {7}};
  EXPECT_FALSE(Holds(PlotSvg("one point", {panel}), "nan"));
}

TEST(PlotAxis, LogarithmicTicks_AreDecadesWithMinorOnesBetween) {
  const auto ticks = Ticks({1, 1e5, AxisScale::kLogarithmic}, false);
  std::string labels;
  for (const AxisTick& tick : ticks) labels += tick.label.empty() ? "" : tick.label + " ";
  EXPECT_EQ(labels, "10⁰ 10¹ 10² 10³ 10⁴ 10⁵ ");
  EXPECT_EQ(ticks.size(), 5U * 9 + 1);
  EXPECT_EQ(Ticks({1e-3, 1e-2, AxisScale::kLogarithmic}, false)[0].label, "10⁻³");
}

TEST(PlotAxis, LinearTicks_AreRoundNumbers) {
  const auto ticks = Ticks({0, 1.02, AxisScale::kLinear}, true);
  ASSERT_EQ(ticks.size(), 6U);
  EXPECT_EQ(ticks[1].label, "20 %");
  EXPECT_EQ(Ticks({-0.3, 0.31, AxisScale::kLinear}, false)[3].label, "0");
}

TEST(PlotAxis, Range_LeavesOutWhatALogarithmDoesNotHave) {
  const AxisRange range =
      RangeOf({.label = "", .scale = AxisScale::kLogarithmic}, std::vector<double>{0, 2, kNone, 500});
  EXPECT_EQ(range.lower, 2);
  EXPECT_EQ(range.upper, 500);
  EXPECT_LT(range.At(0), 0);
}

TEST(CriticalDifferencePlot, RanksStandToScale) {
  // Ranks 1 to 3 from x = 150 to 410: 1.5 is at 215, the bar of a group 4 beyond its ends.
  const std::string svg =
      CriticalDifferenceSvg({{"a", 1.5}, {kOddName, 2}, {"c", 2.5}}, 0.8, {{0, 1}, {1, 2}});
  EXPECT_TRUE(IsWellFormed(svg));
  EXPECT_TRUE(Holds(svg, "M215 60V"));
  EXPECT_TRUE(Holds(svg, "x1='211' y1='71' x2='284' y2='71'"));
  EXPECT_TRUE(Holds(svg, "x1='276' y1='80' x2='349' y2='80'"));  // overlaps the first, hence a row below
  EXPECT_TRUE(Holds(svg, "x1='150' y1='24' x2='254' y2='24'"));
}

TEST(CriticalDifferencePlot, OfLessThanTwo_IsNone) {
  EXPECT_EQ(CriticalDifferenceSvg({{"a", 1}}, 1, {}), "");
  EXPECT_EQ(CriticalDifferenceSvg({{"a", 1}, {"b", kNone}}, 1, {}), "");
}

}  // namespace
}  // namespace frond
