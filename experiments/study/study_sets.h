// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "problems/standard/problem_set.h"

namespace frond {

// All sets that a study, or a fit of type `standard`, can name, sorted by name: the standard ones, and
// frond's own fits over scans. A new one of those is one file and one line in study_sets.cc.
const std::vector<ProblemSetType>& StudySetTypes();

// `leaf_weights`: the weights of the paper's surface of a leaf (Wu et al. 2021, eq. (11)), by F or by Σ d².
ProblemSetType LeafWeightsSetType();

// `sheet`: the distance fit of a small NURBS surface over a scan.
ProblemSetType SheetSetType();

// `stereo_windows`: sub-pixel windows of a synthetic pair, whose true disparity their metrics know.
ProblemSetType StereoWindowsSetType();

}  // namespace frond
