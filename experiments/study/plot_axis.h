// SPDX-License-Identifier: BSD-3-Clause
// Axes of plots: their range, where ticks go and what stands at them.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace frond {

enum class AxisScale { kLinear, kLogarithmic };

struct PlotAxis {
  std::string label;
  std::optional<AxisScale> scale = {};  // else logarithmic where the data are positive and span over a decade
  std::optional<double> lower = {}, upper = {};  // else the data's
  bool percent = false;                          // ticks of shares: "50 %"
};

// An axis with its range: finite, lower < upper, positive where logarithmic.
struct AxisRange {
  double lower = 0, upper = 1;
  AxisScale scale = AxisScale::kLinear;

  // 0 at the lower end, 1 at the upper, beyond them where the value is; NaN where it is not finite. A value
  // that a logarithm does not have is far below the lower end.
  double At(double value) const;
};

// The range of all finite values (on a logarithmic axis: positive ones, over at most 16 decades below the
// largest).
AxisRange RangeOf(const PlotAxis& axis, std::span<const double> values);

struct AxisTick {
  double value = 0;
  std::string label;  // empty on a minor tick
};
std::vector<AxisTick> Ticks(const AxisRange& range, bool percent);

}  // namespace frond
