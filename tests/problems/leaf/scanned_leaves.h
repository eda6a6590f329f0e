// SPDX-License-Identifier: BSD-3-Clause
// The eight synthetic leaves that the leaf tests share: seeds 1 to 8, scanned once a program.
#pragma once

#include <map>

#include "problems/leaf/synthetic_leaf_scan.h"

namespace frond {

inline constexpr int kLeaves = 8;

// 40,000 points, σ = 0.05 mm, in its own coordinates (base at 0, midrib along +x).
inline const LeafScan& ScannedLeaf(int seed) {
  static std::map<int, LeafScan> scans;
  const auto found = scans.find(seed);
  if (found != scans.end()) return found->second;
  LeafScanOptions options;
  options.seed = static_cast<std::uint64_t>(seed);
  options.dense_points = 20000;
  return scans.emplace(seed, ScanLeaf(RandomLeaf(options.seed), options)).first->second;
}

}  // namespace frond
