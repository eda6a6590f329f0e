// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/options.h"
#include "io/config_file.h"
#include "io/point_cloud_file.h"

namespace frond {

// What the section `input` names, before anything is read.
struct InputSource {
  std::filesystem::path cloud;                  // or empty: synthetic
  std::filesystem::path truth;                  // clean points to judge against, or empty
  std::optional<std::uint64_t> synthetic_leaf;  // the seed of a leaf made in memory (`input.synthetic_leaf`)
  std::string unit = "mm";
  std::size_t points = 0;  // thin to about this many by a voxel grid; 0: all

  bool none() const { return cloud.empty() && !synthetic_leaf; }  // of a fit that takes no input
};

// A run's data. `description` stands for the file in messages and metrics.
struct RunInput {
  std::string description;
  std::string unit;
  PointCloud cloud;
  CloudReport report;
  std::vector<Eigen::Vector3d> truth;  // clean points, or empty
  std::optional<double> true_area;     // of a synthetic leaf
};

// The options of the section `input` (`cloud`, `truth`, `unit`, `points`, `synthetic_leaf`).
std::vector<OptionSpec> InputSpecs();

// Throws ConfigError unless exactly one of cloud and synthetic_leaf is named, with a known unit.
InputSource ReadInputSource(const ConfigFile& config);
void AddInput(const InputSource& source, ResolvedConfig* resolved);

// Reads or makes the points; none where the source is none. `seed` places the voxel grid when they are
// thinned. Throws InputError.
RunInput LoadInput(const InputSource& source, std::uint64_t seed);

}  // namespace frond
