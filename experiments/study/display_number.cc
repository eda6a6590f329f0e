// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/display_number.h"

#include <charconv>
#include <cmath>
#include <limits>

#include "io/number_text.h"

namespace frond {
namespace {

std::string Formatted(double value, std::chars_format format, int precision) {
  char buffer[400];
  const auto end = std::to_chars(buffer, buffer + sizeof(buffer), value, format, precision).ptr;
  return {buffer, end};
}

}  // namespace

std::string ThreeDigits(double value) {
  if (std::isnan(value)) return "—";
  if (std::isinf(value)) return value > 0 ? "∞" : "-∞";
  if (value == 0) return "0";
  if (std::abs(value) < 1000 && value == std::floor(value)) {
    return Formatted(value, std::chars_format::fixed, 0);
  }
  const std::string scientific = Formatted(value, std::chars_format::scientific, 2);
  const std::size_t e = scientific.find('e');
  const int exponent = std::stoi(scientific.substr(e + 1));
  if (exponent < -3 || exponent > 5) return scientific.substr(0, e) + "e" + std::to_string(exponent);
  double rounded = 0;
  std::from_chars(scientific.data(), scientific.data() + scientific.size(), rounded);
  return Formatted(rounded, std::chars_format::fixed, exponent < 2 ? 2 - exponent : 0);
}

std::string InFull(double value) {
  std::string text = FormatNumber(value);
  // to_chars writes at least two digits of an exponent.
  const std::size_t e = text.find('e');
  if (e != std::string::npos && e + 2 < text.size() && text[e + 2] == '0') text.erase(e + 2, 1);
  return text;
}

std::string UntilText(double value) {
  return value == std::numeric_limits<double>::infinity() ? "never" : ThreeDigits(value);
}

std::string Percent(double share) {
  if (!std::isfinite(share)) return "—";
  const double percent = 100 * share;
  return Formatted(percent, std::chars_format::fixed, percent == std::floor(percent) ? 0 : 1) + " %";
}

std::string Significance(double p) {
  if (std::isnan(p)) return "—";
  return p < 0.001 ? "< 0.001" : Formatted(p, std::chars_format::fixed, 3);
}

std::string CountOf(int count, int all) { return std::to_string(count) + "/" + std::to_string(all); }

std::string UntilText(const Interval& interval) {
  return UntilText(interval.lower) + "–" + UntilText(interval.upper);
}

std::string PercentInterval(const Interval& interval) {
  if (std::isnan(interval.lower) || std::isnan(interval.upper)) return "—";
  const std::string lower = Percent(interval.lower);
  return lower.substr(0, lower.size() - 2) + "–" + Percent(interval.upper);
}

std::string WholeNumber(std::int64_t value) {
  std::string text = std::to_string(value);
  const std::size_t first = value < 0 ? 1 : 0;
  for (std::size_t k = text.size(); k > first + 3; k -= 3) text.insert(k - 3, ",");
  return text;
}

}  // namespace frond
