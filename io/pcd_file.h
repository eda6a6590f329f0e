// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string_view>
#include <vector>

namespace frond {

// The points of a PCD file (versions .6 and .7; ascii, binary, binary_compressed), those that are not finite
// included. Read by hand rather than by PCL: PCL 1.13 reserves what the header promises before it compares
// with the file, aborts in its LZF decoder on rubbish, and writes its complaints to stderr. Tests read the
// same files with both. The viewpoint is not applied (as in PCL). Throws InputError.
std::vector<Eigen::Vector3d> ParsePcd(const std::filesystem::path& path, std::string_view bytes);

}  // namespace frond
