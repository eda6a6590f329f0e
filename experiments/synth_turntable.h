// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "base/options.h"
#include "io/run_directory.h"

namespace frond {

// Options of `frond synth turntable`.
std::vector<OptionSpec> SynthTurntableSpecs();

// A session at the turntable, as configs/turntable takes it: views/ with views.csv, board/ with board.csv,
// the true calibration.json, the pear as a mesh (truth.ply, in the disk's frame) and truth.json; with the
// option `masks` the silhouettes, which views.csv then names. Throws ConfigError for options that do not go
// together.
void WriteSynthTurntable(const Options& options, std::uint64_t seed, int threads, const RunDirectory& run);

}  // namespace frond
