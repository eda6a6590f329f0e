// SPDX-License-Identifier: BSD-3-Clause
#include "io/length_unit.h"

#include <array>
#include <utility>

#include "base/errors.h"
#include "base/options.h"

namespace frond {
namespace {

// International yard and pound agreement (1959): the inch is 25.4 mm, the foot 0.3048 m, exactly.
constexpr std::array<std::pair<const char*, double>, 7> kUnits = {
    {{"um", 1e-6}, {"mm", 1e-3}, {"cm", 1e-2}, {"m", 1.0}, {"km", 1e3}, {"in", 0.0254}, {"ft", 0.3048}}};

}  // namespace

const std::vector<std::string>& LengthUnitNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const auto& unit : kUnits) list.emplace_back(unit.first);
    return list;
  }();
  return names;
}

double MetresPerUnit(std::string_view unit) {
  for (const auto& [name, metres] : kUnits) {
    if (unit == name) return metres;
  }
  std::string known;
  for (const std::string& name : LengthUnitNames()) known += (known.empty() ? "" : ", ") + name;
  throw ConfigError("unknown unit of length '" + std::string(unit) + "' (known: " + known + ")");
}

}  // namespace frond
