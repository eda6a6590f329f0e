// SPDX-License-Identifier: BSD-3-Clause
// What a config says about a leaf: the options of `problem.type: leaf` but for those of the distance fit, and
// of `synth leaf`, and how they become the steps' own option structs.
#pragma once

#include <cstdint>
#include <vector>

#include "base/options.h"
#include "problems/leaf/leaf_paper_fit.h"
#include "problems/leaf/synthetic_leaf_scan.h"

namespace frond {

enum class LeafMethod { kDistance, kPaper };

// `method`, `point_set.*`, `test_subset.*`, `paper.*`, `frame.*`. `surface.degree` and
// `surface.control_points` are shared with the distance fit and declared there.
std::vector<OptionSpec> LeafSpecs();

// From options that hold LeafSpecs() (and more, if wanted).
LeafMethod LeafMethodFrom(const Options& options);
LeafFrameOptions LeafFrameOptionsFrom(const Options& options);
// `unit_mm`: the input's unit in mm.
PointSetOptions PointSetOptionsFrom(const Options& options, double unit_mm = 1);
TestSubsetOptions TestSubsetOptionsFrom(const Options& options);
LeafWeightsOptions LeafWeightsOptionsFrom(const Options& options);

// Degrees and control points are {across, along}; the defaults of the paper are {2, 2} and {5, 5}.
LeafSurfaceOptions LeafSurfaceOptionsFrom(const Options& options, const std::vector<int>& degree,
                                          const std::vector<int>& control_points);
LeafPaperOptions LeafPaperOptionsFrom(const Options& options, const std::vector<int>& degree,
                                      const std::vector<int>& control_points, double unit_mm = 1);

// `synth leaf`: the scan, the look of the leaf (RandomLeaf by `character` and seed), and single numbers of
// its shape (`shape.length`, …) to be set apart; lengths in mm.
std::vector<OptionSpec> SyntheticLeafSpecs();
LeafShape LeafShapeFrom(const Options& options, std::uint64_t seed);
LeafScanOptions LeafScanOptionsFrom(const Options& options, std::uint64_t seed);

}  // namespace frond
