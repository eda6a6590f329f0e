// SPDX-License-Identifier: BSD-3-Clause
#include "io/shell_section.h"

#include <array>
#include <cstdio>
#include <utility>

#include "base/errors.h"
#include "io/number_text.h"

namespace frond {
namespace {

// Nastran's large fields, 16 columns each: PID MID1 T MID2, then 12I/T³ (its default) and MID3.
std::string PShell(double thickness) {
  std::array<char, 128> card;
  std::snprintf(card.data(), card.size(), "PSHELL* %-16d%-16d%-16.9E%-16d\n*       %-16s%-16d\n", 1, 1,
                thickness, 1, "", 1);
  return card.data();
}

}  // namespace

std::string WithShellElements(const std::string& inp) {
  std::string text = inp;
  for (const auto& [plane, shell] : {std::pair<std::string, std::string>("type=CPS3,", "type=S3,"),
                                     std::pair<std::string, std::string>("type=CPS6,", "type=S6,")}) {
    for (std::size_t at = text.find(plane); at != std::string::npos; at = text.find(plane, at)) {
      text.replace(at, plane.size(), shell);
    }
  }
  return text;
}

const std::vector<std::string>& ShellSectionFormats() {
  static const std::vector<std::string> formats = {"inp", "bdf"};
  return formats;
}

std::string WithShellSection(const std::string& text, const std::string& format, double thickness) {
  if (format == "inp") {
    return text + "*SHELL SECTION, ELSET=surface, MATERIAL=material\n" + FormatNumber(thickness) + "\n";
  }
  const std::size_t end = text.rfind("ENDDATA");
  if (format != "bdf" || end == std::string::npos) {
    throw ConfigError("a ." + format + " file holds no shell sections");
  }
  return text.substr(0, end) + PShell(thickness) + text.substr(end);
}

}  // namespace frond
