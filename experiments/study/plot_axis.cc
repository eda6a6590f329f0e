// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plot_axis.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace frond {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kDecadesShown = 16;
constexpr int kMajorTicks = 7;  // at most

std::string Plain(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof(buffer), value, std::chars_format::general, 6).ptr;
  return {buffer, end};
}

std::string PowerOfTen(int exponent) {
  static constexpr const char* kDigits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = "10";
  if (exponent < 0) text += "⁻";
  for (const char c : std::to_string(std::abs(exponent))) text += kDigits[c - '0'];
  return text;
}

std::vector<AxisTick> LinearTicks(const AxisRange& range, bool percent) {
  const double raw = (range.upper - range.lower) / 5;
  const double power = std::pow(10, std::floor(std::log10(raw)));
  const double step = power * (raw < 1.5 * power ? 1 : raw < 3.5 * power ? 2 : raw < 7.5 * power ? 5 : 10);
  std::vector<AxisTick> ticks;
  for (double k = std::ceil(range.lower / step - 1e-9); k * step <= range.upper + 1e-9 * step; ++k) {
    // 10k/(10/step) would be exact for decimals; six digits of k·step are as good.
    const double value = k == 0 ? 0 : k * step;
    ticks.push_back({value, percent ? Plain(100 * value) + " %" : Plain(value)});
    if (ticks.size() > 20) break;  // a range too narrow for its magnitude
  }
  return ticks;
}

std::vector<AxisTick> LogarithmicTicks(const AxisRange& range) {
  const double low = std::log10(range.lower), high = std::log10(range.upper), slack = 1e-9;
  const int first = static_cast<int>(std::floor(low + slack)),
            last = static_cast<int>(std::floor(high + slack));
  const int stride = std::max(1, (last - first + kMajorTicks) / kMajorTicks);
  const bool plain = first >= -2 && last <= 4, subdivided = high - low < 2.2, minor = high - low < 8;
  std::vector<AxisTick> ticks;
  for (int e = first; e <= last; ++e) {
    for (int m = 1; m <= (minor ? 9 : 1); ++m) {
      const double exponent = e + std::log10(m);
      if (exponent < low - slack || exponent > high + slack) continue;
      const double value = e < 0 ? m / std::pow(10, -e) : m * std::pow(10, e);
      std::string label;
      if (m == 1 ? e % stride == 0 : subdivided && (m == 2 || m == 5)) {
        label = plain ? Plain(value) : m == 1 ? PowerOfTen(e) : std::to_string(m) + "·" + PowerOfTen(e);
      }
      ticks.push_back({value, label});
    }
  }
  return ticks;
}

}  // namespace

double AxisRange::At(double value) const {
  if (!std::isfinite(value)) return std::numeric_limits<double>::quiet_NaN();
  if (scale == AxisScale::kLinear) return (value - lower) / (upper - lower);
  return value > 0 ? std::log(value / lower) / std::log(upper / lower) : -1;
}

AxisRange RangeOf(const PlotAxis& axis, std::span<const double> values) {
  double low = kInfinity, high = -kInfinity, least_positive = kInfinity;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
    if (value > 0) least_positive = std::min(least_positive, value);
  }
  const bool any = low <= high;
  AxisRange range;
  range.scale =
      axis.scale.value_or(any && low > 0 && high / low > 10 ? AxisScale::kLogarithmic : AxisScale::kLinear);
  if (range.scale == AxisScale::kLogarithmic) {
    range.upper = axis.upper.value_or(any && high > 0 ? high : 1);
    range.lower = axis.lower.value_or(
        std::max(std::min(least_positive, range.upper), range.upper * std::pow(10, -kDecadesShown)));
    if (!(range.upper >= range.lower * 1.5)) range.upper = range.lower * 10;
    return range;
  }
  range.lower = axis.lower.value_or(any ? low : 0);
  range.upper = axis.upper.value_or(any ? high : range.lower + 1);
  const double margin = 1e-9 * std::max(std::abs(range.lower), std::abs(range.upper));
  if (!(range.upper - range.lower > margin)) {
    const double half = std::max(0.5, 0.05 * std::abs(range.lower));
    if (!axis.lower) range.lower -= half;
    range.upper += half;
  }
  return range;
}

std::vector<AxisTick> Ticks(const AxisRange& range, bool percent) {
  return range.scale == AxisScale::kLogarithmic ? LogarithmicTicks(range) : LinearTicks(range, percent);
}

}  // namespace frond
