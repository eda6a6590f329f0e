// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string_view>
#include <vector>

namespace frond {

// The rows of a text cloud (XYZ, ASC, CSV, TXT, PTS), those that are not finite included; an empty or "NA"
// value is a NaN. The separator (semicolon, comma, tab or blanks) and the columns are found from the first
// line that holds three numbers: columns named x, y, z in a header line above it, or else the first three.
// Lines that are empty or start with # or // are comments; further columns are ignored. Throws InputError
// naming `path` and the line.
std::vector<Eigen::Vector3d> ParseTextCloud(const std::filesystem::path& path, std::string_view bytes);

}  // namespace frond
