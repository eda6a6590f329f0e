// SPDX-License-Identifier: BSD-3-Clause
// From the sections of a config to options and back.
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/errors.h"
#include "io/config_file.h"
#include "io/config_node.h"

namespace frond {
namespace {

// Reads one section into options; `path` is where the walk stands below it, dotted, "" at its top.
class SectionReader {
 public:
  SectionReader(std::string section, Options* options, const std::vector<std::string>& also_known)
      : section_(std::move(section)), options_(options), also_known_(also_known) {}

  void Read(const ConfigNode& node, const std::string& path) const {
    for (std::size_t k = 0; k < node.keys.size(); ++k) {
      const std::string name = path.empty() ? node.keys[k] : path + "." + node.keys[k];
      if (std::find(also_known_.begin(), also_known_.end(), name) != also_known_.end()) continue;
      const ConfigNode& item = node.items[k];
      const auto& specs = options_->specs();
      const auto spec =
          std::find_if(specs.begin(), specs.end(), [&](const auto& s) { return s.name == name; });
      if (spec != specs.end()) {
        SetOption(*spec, item, node.keys[k], path);
      } else if (KnownBelow(name).empty()) {
        FailUnknown(node.key_places[k], node.keys[k], path);
      } else if (item.kind == ConfigNode::Kind::kMap) {
        Read(item, name);
      } else {
        std::string keys;
        for (const std::string& key : KnownBelow(name)) keys += (keys.empty() ? "" : ", ") + key;
        Fail(item, node.keys[k], path, "a section with keys among " + keys);
      }
    }
  }

 private:
  std::string SectionName(const std::string& path) const {
    const std::string whole = path.empty() ? section_ : path;
    return whole.substr(whole.rfind('.') + 1);
  }

  [[noreturn]] void Fail(const ConfigNode& item, const std::string& key, const std::string& path,
                         const std::string& expected) const {
    throw ConfigError(item.place + ": '" + key + "' in '" + SectionName(path) + "' is " + item.Describe() +
                      ", expected " + expected);
  }

  // The next parts of all names below `path`.
  std::vector<std::string> KnownBelow(const std::string& path) const {
    std::vector<std::string> names;
    for (const OptionSpec& spec : options_->specs()) names.push_back(spec.name);
    names.insert(names.end(), also_known_.begin(), also_known_.end());
    const std::string prefix = path.empty() ? "" : path + ".";
    std::vector<std::string> known;
    for (const std::string& name : names) {
      if (!name.starts_with(prefix)) continue;
      const std::string part = name.substr(prefix.size(), name.find('.', prefix.size()) - prefix.size());
      if (std::find(known.begin(), known.end(), part) == known.end()) known.push_back(part);
    }
    return known;
  }

  [[noreturn]] void FailUnknown(const std::string& place, const std::string& key,
                                const std::string& path) const {
    const std::vector<std::string> known = KnownBelow(path);
    const std::string nearest = NearestWord(key, known);
    const std::string section = SectionName(path);
    std::string message =
        place + ": unknown key '" + key + "'" + (section.empty() ? "" : " in '" + section + "'");
    if (!nearest.empty()) throw ConfigError(message + " (did you mean '" + nearest + "'?)");
    for (const std::string& word : known) message += (&word == &known.front() ? " (known: " : ", ") + word;
    throw ConfigError(message + (known.empty() ? "" : ")"));
  }

  void SetOption(const OptionSpec& spec, const ConfigNode& item, const std::string& key,
                 const std::string& path) const {
    const bool scalar = item.kind == ConfigNode::Kind::kScalar;
    std::optional<OptionValue> value = item.Value();
    const bool worded = spec.type == OptionType::kText || spec.type == OptionType::kChoice;
    if (scalar && worded) value = item.text;  // `name: 12` names it "12"
    if (!value) Fail(item, key, path, DescribeAccepted(spec));
    try {
      options_->Set(spec.name, *value);
    } catch (const ConfigError&) {
      Fail(item, key, path, DescribeAccepted(spec));
    }
  }

  std::string section_;
  Options* options_;
  const std::vector<std::string>& also_known_;
};

void CollectAxes(const ConfigNode& node, const std::string& path, std::vector<ConfigFile::SweepAxis>* axes) {
  for (std::size_t k = 0; k < node.keys.size(); ++k) {
    const std::string key = path.empty() ? node.keys[k] : path + "." + node.keys[k];
    const ConfigNode& item = node.items[k];
    const std::string what = item.place + ": '" + key + "' in 'sweep' is " + item.Describe();
    if (item.kind == ConfigNode::Kind::kMap) {
      CollectAxes(item, key, axes);
      continue;
    }
    if (item.kind != ConfigNode::Kind::kList || item.items.empty()) {
      throw ConfigError(what + ", expected a list of values");
    }
    ConfigFile::SweepAxis axis{key, item.place, {}};
    for (const ConfigNode& entry : item.items) {
      const auto value = entry.Value();
      if (!value) throw ConfigError(what + ", expected a list of values or of lists of numbers");
      axis.values.push_back(*value);
    }
    axes->push_back(std::move(axis));
  }
}

// Plain where YAML reads it back as the same text, else in double quotes.
std::string YamlText(const std::string& text) {
  const std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./-";
  ConfigNode node;
  node.text = text;
  const bool is_text = std::holds_alternative<std::string>(*node.Value());
  const std::string_view reserved[] = {"null", "Null", "NULL", "yes", "no", "on", "off", "y", "n"};
  const bool free = std::find(std::begin(reserved), std::end(reserved), text) == std::end(reserved);
  if (is_text && free && !text.empty() && text[0] != '-' && text[0] != '.' &&
      text.find_first_not_of(plain) == std::string::npos) {
    return text;
  }
  std::string quoted = "\"";
  for (const char c : text) {
    constexpr char kHex[] = "0123456789abcdef";
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += c;
    } else if (byte < 0x20) {
      quoted += {'\\', 'x', kHex[byte >> 4], kHex[byte & 15]};
    } else {
      quoted += c;
    }
  }
  return quoted + "\"";
}

std::string YamlValue(const OptionValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return YamlText(*text);
  return MakeNode(value, "").Describe();  // numbers, flags and lists of them
}

}  // namespace

void ConfigFile::ReadSection(const std::string& section, Options* options,
                             const std::vector<std::string>& also_known) const {
  const ConfigNode* const node = Find(section);
  if (node == nullptr) return;
  if (node->kind != ConfigNode::Kind::kMap) {
    throw ConfigError(node->place + ": '" + section + "' is " + node->Describe() + ", expected a section");
  }
  SectionReader(section, options, also_known).Read(*node, "");
}

std::vector<ConfigFile::SweepAxis> ConfigFile::Sweep() const {
  std::vector<SweepAxis> axes;
  const ConfigNode* const node = Find("sweep");
  if (node == nullptr) return axes;
  if (node->kind != ConfigNode::Kind::kMap)
    Fail("sweep", "'sweep' is " + node->Describe() + ", expected a section");
  CollectAxes(*node, "", &axes);
  return axes;
}

void ResolvedConfig::Add(const std::string& key, const OptionValue& value) {
  entries_.push_back({key, YamlValue(value)});
}

void ResolvedConfig::Add(const std::string& key, const std::vector<std::string>& texts) {
  std::string yaml = "[";
  for (const std::string& text : texts) yaml += (yaml.size() > 1 ? ", " : "") + YamlText(text);
  entries_.push_back({key, yaml + "]"});
}

void ResolvedConfig::AddSection(const std::string& section, const Options& options) {
  for (const OptionSpec& spec : options.specs()) {
    Add(section.empty() ? spec.name : section + "." + spec.name, options.Value(spec.name));
  }
}

std::string ResolvedConfig::Yaml() const {
  // A tree in the order of first appearance, so that a section's keys stand together.
  struct Tree {
    std::string key, yaml;
    std::vector<Tree> children;

    void Put(std::string_view path, const std::string& value) {
      const std::size_t dot = path.find('.');
      const std::string_view part = path.substr(0, dot);
      auto child =
          std::find_if(children.begin(), children.end(), [&](const Tree& t) { return t.key == part; });
      if (child == children.end()) child = children.insert(children.end(), Tree{std::string(part), "", {}});
      if (dot == std::string_view::npos) {
        child->yaml = value;
      } else {
        child->Put(path.substr(dot + 1), value);
      }
    }

    void Print(std::size_t depth, std::string* out) const {
      for (const Tree& child : children) {
        *out += std::string(2 * depth, ' ') + child.key + ":";
        *out += child.children.empty() ? " " + child.yaml + "\n" : "\n";
        child.Print(depth + 1, out);
      }
    }
  };
  Tree root;
  for (const Entry& entry : entries_) root.Put(entry.key, entry.yaml);
  std::string out;
  root.Print(0, &out);
  return out;
}

}  // namespace frond
