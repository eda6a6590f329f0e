// SPDX-License-Identifier: BSD-3-Clause
#include "io/config_file.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "base/errors.h"
#include "io/config_node.h"
#include "io/file_bytes.h"

namespace frond {
namespace {

constexpr const char* kCommandLine = "--set";

// "problem.surface.degree": "'degree' in 'surface'"; a key of the top level stands alone.
std::string Quoted(const std::string& key) {
  const std::size_t dot = key.rfind('.');
  if (dot == std::string::npos) return "'" + key + "'";
  const std::string section = key.substr(0, dot);
  return "'" + key.substr(dot + 1) + "' in '" + section.substr(section.rfind('.') + 1) + "'";
}

std::vector<std::string> SplitKey(const std::string& key) {
  std::vector<std::string> parts;
  std::size_t at = 0;
  for (std::size_t dot; (dot = key.find('.', at)) != std::string::npos; at = dot + 1) {
    parts.push_back(key.substr(at, dot - at));
  }
  parts.push_back(key.substr(at));
  return parts;
}

std::string Joined(const std::string& section, const std::string& key) {
  return section.empty() ? key : section + "." + key;
}

[[noreturn]] void FailUnknownKey(const std::string& place, const std::string& section, const std::string& key,
                                 const std::vector<std::string>& known) {
  const std::string nearest = NearestWord(key, known);
  std::string message = place + ": unknown key " +
                        (section.empty() ? "'" + key + "' at the top level" : Quoted(Joined(section, key)));
  if (!nearest.empty()) {
    message += " (did you mean '" + nearest + "'?)";
  } else if (!known.empty()) {
    message += " (known:";
    for (const std::string& word : known) message += (&word == &known.front() ? " " : ", ") + word;
    message += ")";
  }
  throw ConfigError(message);
}

// Puts `value` at `key` below `root`, making the sections on the way.
void PutAt(const std::string& key, ConfigNode value, ConfigNode* root) {
  ConfigNode* node = root;
  std::string path;
  for (const std::string& part : SplitKey(key)) {
    if (part.empty()) throw ConfigError(value.place + ": '" + key + "' is not a key (an empty part)");
    if (node->kind != ConfigNode::Kind::kMap) {
      throw ConfigError(value.place + ": '" + key + "': " + Quoted(path) + " is " + node->Describe() +
                        ", not a section");
    }
    path = Joined(path, part);
    const auto found = std::find(node->keys.begin(), node->keys.end(), part);
    const auto index = static_cast<std::size_t>(found - node->keys.begin());
    if (found == node->keys.end()) {
      ConfigNode section;
      section.kind = ConfigNode::Kind::kMap;
      section.place = value.place;
      node->keys.push_back(part);
      node->key_places.push_back(value.place);
      node->items.push_back(std::move(section));
    }
    node = &node->items[index];
    if (path.size() == key.size()) node->place = value.place;
  }
  *node = std::move(value);
}

// The parts of "a=1; b=[x; y]; c=';'" between the semicolons outside quotes and brackets.
std::vector<std::string> SplitAssignments(std::string_view text) {
  std::vector<std::string> parts(1);
  int depth = 0;
  char quote = 0;
  for (const char c : text) {
    if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '[' || c == '{') {
      ++depth;
    } else if (c == ']' || c == '}') {
      --depth;
    }
    if (c == ';' && depth == 0 && quote == 0) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

std::string Trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

void RefuseNulls(const std::string& key, const ConfigNode& node) {
  if (node.null)
    throw ConfigError(node.place + ": " + (key.empty() ? "the config" : Quoted(key)) + " has no value");
  for (std::size_t k = 0; k < node.items.size(); ++k) {
    const bool list = node.kind == ConfigNode::Kind::kList;
    RefuseNulls(list ? key : Joined(key, node.keys[k]), node.items[k]);
  }
}

}  // namespace

ConfigFile::ConfigFile(std::string name, std::filesystem::path folder, std::unique_ptr<ConfigNode> root)
    : name_(std::move(name)), folder_(std::move(folder)), root_(std::move(root)) {}
ConfigFile::ConfigFile(const ConfigFile& other)
    : name_(other.name_), folder_(other.folder_), root_(std::make_unique<ConfigNode>(*other.root_)) {}
ConfigFile& ConfigFile::operator=(const ConfigFile& other) { return *this = ConfigFile(other); }
ConfigFile::ConfigFile(ConfigFile&&) noexcept = default;
ConfigFile& ConfigFile::operator=(ConfigFile&&) noexcept = default;
ConfigFile::~ConfigFile() = default;

ConfigFile ConfigFile::Load(const std::filesystem::path& path) {
  std::string yaml;
  try {
    yaml = ReadFileBytes(path);
  } catch (const InputError& error) {  // a wrong argument, not wrong data
    throw ConfigError(error.what());
  }
  return Parse(yaml, path.string(), std::filesystem::absolute(path).parent_path());
}

ConfigFile ConfigFile::Parse(std::string_view yaml, std::string name, std::filesystem::path folder) {
  ConfigNode root = ParseYaml(yaml, name, /*with_positions=*/true);
  if (root.kind == ConfigNode::Kind::kScalar && root.null) throw ConfigError(name + ": is empty");
  if (root.kind != ConfigNode::Kind::kMap) {
    throw ConfigError((root.place.empty() ? name : root.place) +
                      ": expected keys at the top level ('name: value')");
  }
  RefuseNulls("", root);
  return {std::move(name), std::filesystem::absolute(folder), std::make_unique<ConfigNode>(std::move(root))};
}

void ConfigFile::Override(std::string_view assignments) {
  for (const std::string& part : SplitAssignments(assignments)) {
    std::string assignment = Trimmed(part);
    std::replace(assignment.begin(), assignment.end(), '\n', ' ');  // messages are one line
    if (assignment.empty()) continue;
    const std::size_t equals = assignment.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw ConfigError(std::string(kCommandLine) + ": '" + assignment + "' is not KEY=VALUE");
    }
    const std::string key = Trimmed(assignment.substr(0, equals));
    if (key.find_first_of(" \t\r\n") != std::string::npos) {
      throw ConfigError(std::string(kCommandLine) + ": a key must be a word; write 'a.b=1; c.d=2'");
    }
    ConfigNode value = ParseYaml(assignment.substr(equals + 1), kCommandLine, /*with_positions=*/false);
    value.place = kCommandLine;
    if (value.kind == ConfigNode::Kind::kScalar && value.text.empty() && !value.quoted) value.null = true;
    RefuseNulls(key, value);
    PutAt(key, std::move(value), root_.get());
  }
}

void ConfigFile::Set(const std::string& key, const OptionValue& value) {
  PutAt(key, MakeNode(value, kCommandLine), root_.get());
}

const ConfigNode* ConfigFile::Find(const std::string& key) const {
  const ConfigNode* node = root_.get();
  if (key.empty()) return node;
  for (const std::string& part : SplitKey(key)) {
    node = node->Child(part);
    if (node == nullptr) return nullptr;
  }
  return node;
}

const ConfigNode& ConfigFile::Require(const std::string& key, std::string_view expected) const {
  const ConfigNode* const node = Find(key);
  if (node != nullptr) return *node;
  // The nearest section that is there tells where the key belongs.
  std::string section = key;
  const ConfigNode* nearest = nullptr;
  while (nearest == nullptr) {
    section = section.substr(0, section.rfind('.') == std::string::npos ? 0 : section.rfind('.'));
    nearest = Find(section);
  }
  throw ConfigError((section.empty() ? name_ : nearest->place) + ": " + Quoted(key) +
                    " is missing, expected " + std::string(expected));
}

bool ConfigFile::Has(const std::string& key) const { return Find(key) != nullptr; }

bool ConfigFile::IsSection(const std::string& key) const {
  const ConfigNode* const node = Find(key);
  return node != nullptr && node->kind == ConfigNode::Kind::kMap;
}

std::vector<std::string> ConfigFile::Keys(const std::string& section) const {
  const ConfigNode* const node = Find(section);
  return node == nullptr ? std::vector<std::string>() : node->keys;
}

std::string ConfigFile::Place(const std::string& key) const {
  const ConfigNode* const node = Find(key);
  return node == nullptr || node == root_.get() ? name_ : node->place;
}

void ConfigFile::Fail(const std::string& key, const std::string& message) const {
  throw ConfigError(Place(key) + ": " + message);
}

namespace {

[[noreturn]] void FailType(const std::string& key, const ConfigNode& node, const std::string& expected) {
  throw ConfigError(node.place + ": " + Quoted(key) + " is " + node.Describe() + ", expected " + expected);
}

}  // namespace

bool ConfigFile::Flag(const std::string& key, std::optional<bool> fallback) const {
  if (fallback && !Has(key)) return *fallback;
  const ConfigNode& node = Require(key, "true or false");
  const auto value = node.Value();
  if (!value || !std::holds_alternative<bool>(*value)) FailType(key, node, "true or false");
  return std::get<bool>(*value);
}

std::int64_t ConfigFile::Integer(const std::string& key, std::optional<std::int64_t> fallback) const {
  if (fallback && !Has(key)) return *fallback;
  const ConfigNode& node = Require(key, "an integer");
  const auto value = node.Value();
  if (value) {
    if (const auto* whole = std::get_if<std::int64_t>(&*value)) return *whole;
    const auto* number = std::get_if<double>(&*value);
    if (number != nullptr && *number == std::floor(*number) && std::abs(*number) < 9e15) {
      return static_cast<std::int64_t>(*number);
    }
  }
  FailType(key, node, "an integer");
}

double ConfigFile::Number(const std::string& key, std::optional<double> fallback) const {
  if (fallback && !Has(key)) return *fallback;
  const ConfigNode& node = Require(key, "a number");
  const auto value = node.Value();
  if (value) {
    if (const auto* number = std::get_if<double>(&*value)) return *number;
    if (const auto* whole = std::get_if<std::int64_t>(&*value)) return static_cast<double>(*whole);
  }
  FailType(key, node, "a number");
}

std::string ConfigFile::Text(const std::string& key, std::optional<std::string> fallback) const {
  if (fallback && !Has(key)) return *fallback;
  const ConfigNode& node = Require(key, "text");
  if (node.kind != ConfigNode::Kind::kScalar) FailType(key, node, "text");
  return node.text;  // `name: 12` names it "12"
}

std::vector<double> ConfigFile::Numbers(const std::string& key) const {
  const ConfigNode& node = Require(key, "a list of numbers");
  const auto value = node.Value();
  if (value) {
    if (const auto* list = std::get_if<std::vector<double>>(&*value)) return *list;
    if (const auto* number = std::get_if<double>(&*value)) return {*number};
    if (const auto* whole = std::get_if<std::int64_t>(&*value)) return {static_cast<double>(*whole)};
  }
  FailType(key, node, "a list of numbers");
}

std::vector<std::string> ConfigFile::Texts(const std::string& key) const {
  const ConfigNode& node = Require(key, "a list of words");
  if (node.kind == ConfigNode::Kind::kScalar) return {node.text};
  if (node.kind != ConfigNode::Kind::kList) FailType(key, node, "a list of words");
  std::vector<std::string> texts;
  for (const ConfigNode& item : node.items) {
    if (item.kind != ConfigNode::Kind::kScalar) FailType(key, node, "a list of words");
    texts.push_back(item.text);
  }
  return texts;
}

OptionValue ConfigFile::Value(const std::string& key) const {
  const ConfigNode& node = Require(key, "a value");
  const auto value = node.Value();
  if (!value) FailType(key, node, "a value or a list of numbers");
  return *value;
}

std::vector<OptionValue> ConfigFile::Values(const std::string& key) const {
  const ConfigNode& node = Require(key, "a list of values");
  if (node.kind != ConfigNode::Kind::kList || node.items.empty()) FailType(key, node, "a list of values");
  std::vector<OptionValue> values;
  for (const ConfigNode& item : node.items) {
    const auto value = item.Value();
    if (!value) FailType(key, item, "a value or a list of numbers");
    values.push_back(*value);
  }
  return values;
}

std::filesystem::path ConfigFile::ResolvePath(const std::string& key) const {
  (void)Text(key);  // one path, not a list
  return ResolvePaths(key).front();
}

std::vector<std::filesystem::path> ConfigFile::ResolvePaths(const std::string& key) const {
  const bool command_line = Place(key) == kCommandLine;
  const std::filesystem::path base = command_line ? std::filesystem::current_path() : folder_;
  std::vector<std::filesystem::path> paths;
  for (const std::string& text : Texts(key)) {
    if (text.empty()) FailType(key, *Find(key), "the path of a file");
    paths.push_back((base / text).lexically_normal());
  }
  if (paths.empty()) FailType(key, *Find(key), "the path of a file");
  return paths;
}

void ConfigFile::CheckKeys(const std::string& section, const std::vector<std::string>& known) const {
  const ConfigNode* const node = Find(section);
  if (node == nullptr) return;
  if (node->kind != ConfigNode::Kind::kMap) FailType(section, *node, "a section");
  for (std::size_t k = 0; k < node->keys.size(); ++k) {
    if (std::find(known.begin(), known.end(), node->keys[k]) == known.end()) {
      FailUnknownKey(node->key_places[k], section, node->keys[k], known);
    }
  }
}

}  // namespace frond
