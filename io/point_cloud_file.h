// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "models/point_cloud.h"

namespace frond {

// What reading a cloud did: rows = points kept + dropped_not_finite + merged_duplicates.
struct CloudReport {
  std::string format;                  // "ply", "pcd", "text", "obj", "stl" or "off"
  std::size_t rows = 0;                // points that the file holds
  std::size_t dropped_not_finite = 0;  // with a NaN, an infinity or a missing value in x, y or z
  std::size_t merged_duplicates = 0;   // equal to an earlier point, to the bit
  std::string sha256;                  // of the whole file
};

// The extensions ReadPointCloud knows: ply, pcd, xyz, asc, csv, txt, pts, obj, stl, off.
const std::vector<std::string>& CloudExtensions();

// Reads x, y, z of every point, in the file's order. Rows that are not finite are dropped, exact duplicates
// merged into the first; both are counted in `report` (may be null). Throws InputError, one line that names
// the file, the line or byte, and the way out.
PointCloud ReadPointCloud(const std::filesystem::path& path, CloudReport* report = nullptr);

// Per-point values written beside the coordinates: empty, or as many as there are points.
struct CloudAttributes {
  std::vector<double> deviation = {};                     // signed distance, in the cloud's unit
  std::vector<std::array<std::uint8_t, 3>> colours = {};  // red, green, blue
  std::vector<Eigen::Vector3d> normals = {};              // unit; written as floats nx, ny, nz
  std::vector<double> standard_deviation = {};            // in the cloud's unit; written as a float
};

// By extension: .ply (binary, coordinates in double), .xyz, .asc, .txt (blanks between) or .csv (commas, with
// a header line). Text is the shortest that reads back to the same bits. Throws InputError.
void WritePointCloud(const std::filesystem::path& path, const PointCloud& cloud,
                     const CloudAttributes& attributes = {});

}  // namespace frond
