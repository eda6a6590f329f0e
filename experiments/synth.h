// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/options.h"

namespace frond {

// A kind of synthetic scan that `frond synth KIND` makes, with its options (read from --set).
struct SynthKind {
  std::string name;
  std::string help;
  std::vector<OptionSpec> options;
};
const std::vector<SynthKind>& SynthKinds();

// Writes scan.ply, clean.ply (the scan's points without noise), truth.json (parameters, measures, pose), of a
// leaf truth.ply (dense clean points), of a turntable what WriteSynthTurntable tells, and config.yaml (kind,
// seed, options) into `out` (runs/synth_KIND if empty), all or nothing. `set`: "points=10000; noise=0.1".
// Throws ConfigError for an unknown kind or option, InputError where it cannot write. Returns the folder.
std::filesystem::path Synthesise(const std::string& kind, const std::string& set, std::uint64_t seed,
                                 const std::filesystem::path& out, bool overwrite, int threads = 1);

}  // namespace frond
