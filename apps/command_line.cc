// SPDX-License-Identifier: BSD-3-Clause
#include "apps/command_line.h"

#include <gflags/gflags.h>

#include <algorithm>

#include "base/errors.h"
#include "base/options.h"

namespace frond {
namespace {

const std::vector<std::string>& FlagNames() {
  static const std::vector<std::string> names = {
      "set",   "out",    "overwrite", "threads",         "seed", "quiet",  "size",
      "order", "format", "volume",    "shell_thickness", "help", "version"};
  return names;
}

bool IsKnown(const std::string& name) {
  for (const std::string& known : FlagNames()) {
    if (known == name) return true;
  }
  return false;
}

bool IsBoolean(const std::string& name) {
  gflags::CommandLineFlagInfo info;
  return gflags::GetCommandLineFlagInfo(name.c_str(), &info) && info.type == "bool";
}

// As users write it: gflags' own names have underscores.
std::string Dashed(std::string name) {
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

[[noreturn]] void FailUnknown(const std::string& name) {
  const std::string nearest = NearestWord(name, FlagNames());
  throw ConfigError("unknown flag '--" + Dashed(name) + "'" +
                    (nearest.empty() ? "" : " (did you mean '--" + Dashed(nearest) + "'?)") +
                    "; see frond --help");
}

}  // namespace

std::vector<std::string> ParseFlags(int argc, char** argv) {
  std::vector<std::string> others;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "-h") {
      gflags::SetCommandLineOption("help", "true");
      continue;
    }
    if (argument.size() < 2 || argument[0] != '-') {
      others.push_back(argument);
      continue;
    }
    const std::size_t dashes = argument.find_first_not_of('-');
    if (dashes > 2) throw ConfigError("'" + argument + "' is not a flag; see frond --help");  // npos: "--"
    const std::string body = argument.substr(dashes);
    const std::size_t equals = body.find('=');
    std::string name = body.substr(0, equals), value;
    std::replace(name.begin(), name.end(), '-', '_');
    if (!IsKnown(name) && name.rfind("no", 0) == 0 && IsKnown(name.substr(2)) && IsBoolean(name.substr(2))) {
      name = name.substr(2);
      value = "false";
    } else if (!IsKnown(name)) {
      FailUnknown(name);
    } else if (equals != std::string::npos) {
      value = body.substr(equals + 1);
    } else if (IsBoolean(name)) {
      value = "true";
    } else if (i + 1 < argc) {
      value = argv[++i];
    } else {
      throw ConfigError("flag '--" + Dashed(name) + "' needs a value");
    }
    if (std::string before; name == "set" && gflags::GetCommandLineOption("set", &before)) {
      if (!before.empty()) value = before + ";" + value;  // --set adds up; of other flags the last one holds
    }
    if (gflags::SetCommandLineOption(name.c_str(), value.c_str()).empty()) {
      throw ConfigError("flag '--" + Dashed(name) + "' cannot be '" + value + "'");
    }
  }
  return others;
}

}  // namespace frond
