// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace frond {

// The units of length a config's `input.unit` may name: um, mm, cm, m, km, in, ft.
const std::vector<std::string>& LengthUnitNames();

// Metres in one `unit`, exactly by definition (in: 0.0254). Throws ConfigError naming the known ones.
double MetresPerUnit(std::string_view unit);

}  // namespace frond
