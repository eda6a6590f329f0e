// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "base/errors.h"
#include "base/options.h"

namespace frond {

// Throws ConfigError for options that `choice`, made elsewhere, leaves without meaning. Their defaults may be
// spelled out, as configs of runs do.
inline void RefuseSet(const Options& options, const std::vector<std::string>& names,
                      const std::string& choice) {
  const Options defaults(options.specs());
  for (const std::string& name : names) {
    if (options.Value(name) == defaults.Value(name)) continue;
    throw ConfigError("option '" + name + "' does not apply to '" + choice + "'");
  }
}

}  // namespace frond
