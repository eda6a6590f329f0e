// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/options.h"

namespace frond {

// A YAML value with its place. Maps keep the file's order; keys[k] names items[k]. Lists have no keys.
struct ConfigNode {
  enum class Kind { kScalar, kList, kMap };

  Kind kind = Kind::kScalar;
  std::string text;     // scalars
  bool quoted = false;  // scalars: text even where it looks like a number
  bool null = false;    // scalars: nothing, `~` or `null`
  std::string place;    // "leaf.yaml:7:12" or "--set"
  std::vector<std::string> keys, key_places;
  std::vector<ConfigNode> items;

  const ConfigNode* Child(std::string_view key) const;  // null if there is none

  // `true`, `12`, `1e-3`, `.inf`, text; a list of numbers or of lists of numbers; nothing where it is a map,
  // a null or another list.
  std::optional<OptionValue> Value() const;
  std::string Describe() const;  // as a config would write it, for messages: "20", "[2, x]", "a section"
};

// Parses one YAML document. `name` begins the places; with `with_positions` line and column follow it. Throws
// ConfigError (see ConfigFile for what is refused).
ConfigNode ParseYaml(std::string_view yaml, const std::string& name, bool with_positions);

// The node that holds `value`.
ConfigNode MakeNode(const OptionValue& value, const std::string& place);

}  // namespace frond
