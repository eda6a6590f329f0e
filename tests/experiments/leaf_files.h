// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "experiments/experiment.h"
#include "tests/io/temp_folder.h"

namespace frond {

// Writes scan.ply (seed 1, σ = 0.05 mm, random pose) and truth.ply into the folder.
void WriteLeafFiles(const TempFolder& folder, int points = 3000, int truth_points = 3000);

// Writes `yaml` as fit.yaml, runs it with `flags` into folder/NAME and returns that folder.
std::filesystem::path Fit(const TempFolder& folder, const std::string& yaml, const std::string& name,
                          const RunFlags& flags = {});

// The experiment of a config text whose relative paths start at the folder.
Experiment ReadText(const std::string& yaml, const RunFlags& flags = {});

}  // namespace frond
