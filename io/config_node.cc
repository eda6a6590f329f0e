// SPDX-License-Identifier: BSD-3-Clause
#include "io/config_node.h"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <limits>
#include <map>
#include <sstream>
#include <utility>

#include "base/errors.h"
#include "io/number_text.h"

namespace frond {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{1} << 20;
constexpr std::size_t kMaxNodes = 100000;
constexpr std::size_t kMaxDepth = 64;

// Messages are one line: control characters become blanks.
std::string OneLine(std::string text) {
  for (char& c : text) c = static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  return text;
}

std::size_t CountNodes(const ConfigNode& node) {
  std::size_t count = 1;
  for (const ConfigNode& item : node.items) count += CountNodes(item);
  return count;
}

// Builds the tree from yaml-cpp's events rather than from its nodes: these would follow recursive aliases
// without end and drop repeated keys.
class TreeBuilder : public YAML::EventHandler {
 public:
  TreeBuilder(const std::string& name, bool with_positions) : name_(name), with_positions_(with_positions) {
    root_.null = true;  // what an empty document holds
  }

  std::string Place(const YAML::Mark& mark) const {
    if (!with_positions_ || mark.is_null()) return name_;
    return name_ + ":" + std::to_string(mark.line + 1) + ":" + std::to_string(mark.column + 1);
  }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (done_) throw ConfigError(Place(mark) + ": more than one YAML document");
  }
  void OnDocumentEnd() override { done_ = true; }

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    ConfigNode node = Make(ConfigNode::Kind::kScalar, mark);
    node.null = true;
    Attach(std::move(node), anchor);
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    ConfigNode node = Make(ConfigNode::Kind::kScalar, mark);
    node.text = value;
    node.quoted = tag == "!";  // yaml-cpp's tag of a quoted scalar
    Attach(std::move(node), anchor);
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto found = anchors_.find(anchor);
    if (found == anchors_.end()) throw ConfigError(Place(mark) + ": an alias stands inside its own anchor");
    nodes_ += CountNodes(found->second);
    CheckCount(mark);
    Attach(ConfigNode(found->second), 0);
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    Open(ConfigNode::Kind::kList, mark, anchor);
  }
  void OnSequenceEnd() override { Close(); }

  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    Open(ConfigNode::Kind::kMap, mark, anchor);
  }
  void OnMapEnd() override { Close(); }

  ConfigNode Take() { return std::move(root_); }

 private:
  struct OpenNode {
    ConfigNode node;
    YAML::anchor_t anchor;
  };

  ConfigNode Make(ConfigNode::Kind kind, const YAML::Mark& mark) {
    ++nodes_;
    CheckCount(mark);
    ConfigNode node;
    node.kind = kind;
    node.place = Place(mark);
    return node;
  }

  void CheckCount(const YAML::Mark& mark) const {
    if (nodes_ > kMaxNodes) throw ConfigError(Place(mark) + ": more than 100000 values (nested aliases?)");
  }

  void Open(ConfigNode::Kind kind, const YAML::Mark& mark, YAML::anchor_t anchor) {
    if (open_.size() >= kMaxDepth) throw ConfigError(Place(mark) + ": nested more than 64 deep");
    open_.push_back({Make(kind, mark), anchor});
  }

  void Close() {
    OpenNode closed = std::move(open_.back());
    open_.pop_back();
    Attach(std::move(closed.node), closed.anchor);
  }

  void Attach(ConfigNode node, YAML::anchor_t anchor) {
    if (anchor != 0) anchors_[anchor] = node;
    if (open_.empty()) {
      root_ = std::move(node);
      return;
    }
    ConfigNode& parent = open_.back().node;
    const bool is_key = parent.kind == ConfigNode::Kind::kMap && parent.keys.size() == parent.items.size();
    if (is_key) {
      AddKey(std::move(node), &parent);
    } else {
      parent.items.push_back(std::move(node));
    }
  }

  void AddKey(ConfigNode key, ConfigNode* parent) const {
    if (key.kind != ConfigNode::Kind::kScalar || key.null)
      throw ConfigError(key.place + ": a key must be a word");
    if (OneLine(key.text) != key.text) throw ConfigError(key.place + ": a key must be a word");
    const auto same = std::find(parent->keys.begin(), parent->keys.end(), key.text);
    if (same != parent->keys.end()) {
      const auto index = static_cast<std::size_t>(same - parent->keys.begin());
      throw ConfigError(key.place + ": key '" + key.text + "' stands twice (first at " +
                        parent->key_places[index] + ")");
    }
    parent->keys.push_back(std::move(key.text));
    parent->key_places.push_back(std::move(key.place));
  }

  const std::string& name_;
  bool with_positions_, done_ = false;
  std::size_t nodes_ = 0;
  std::vector<OpenNode> open_;
  std::map<YAML::anchor_t, ConfigNode> anchors_;
  ConfigNode root_;
};

OptionValue ScalarValue(const std::string& text, bool quoted) {
  if (quoted || text.empty()) return text;
  if (text == "true" || text == "True" || text == "TRUE") return true;
  if (text == "false" || text == "False" || text == "FALSE") return false;
  const double infinity = std::numeric_limits<double>::infinity();
  if (text == ".inf" || text == "+.inf") return infinity;
  if (text == "-.inf") return -infinity;
  if (text == ".nan") return std::numeric_limits<double>::quiet_NaN();
  if (std::string_view("+-.0123456789").find(text[0]) == std::string_view::npos) return text;
  std::int64_t whole = 0;
  const char* const first = text.data() + (text[0] == '+' ? 1 : 0);
  const char* const last = text.data() + text.size();
  const auto result = std::from_chars(first, last, whole);
  if (result.ec == std::errc() && result.ptr == last && first != last) return whole;
  double number = 0;
  if (ParseNumber(text, &number) == text.size()) return number;
  return text;
}

}  // namespace

const ConfigNode* ConfigNode::Child(std::string_view key) const {
  const auto found = std::find(keys.begin(), keys.end(), key);
  return found == keys.end() ? nullptr : &items[static_cast<std::size_t>(found - keys.begin())];
}

std::optional<OptionValue> ConfigNode::Value() const {
  if (null || kind == Kind::kMap) return std::nullopt;
  if (kind == Kind::kScalar) return ScalarValue(text, quoted);
  if (!items.empty() && items[0].kind == Kind::kList) {
    OptionRows rows;
    for (const ConfigNode& item : items) {
      const std::optional<OptionValue> row = item.Value();
      if (!row || !std::holds_alternative<std::vector<double>>(*row)) return std::nullopt;
      rows.push_back(std::get<std::vector<double>>(*row));
    }
    return rows;
  }
  std::vector<double> numbers;
  for (const ConfigNode& item : items) {
    if (item.kind != Kind::kScalar || item.null) return std::nullopt;
    const OptionValue value = ScalarValue(item.text, item.quoted);
    if (const auto* whole = std::get_if<std::int64_t>(&value)) {
      numbers.push_back(static_cast<double>(*whole));
    } else if (const auto* number = std::get_if<double>(&value)) {
      numbers.push_back(*number);
    } else {
      return std::nullopt;
    }
  }
  return numbers;
}

std::string ConfigNode::Describe() const {
  if (null) return "empty";
  if (kind == Kind::kMap) return "a section";
  if (kind == Kind::kScalar) return OneLine(quoted ? "\"" + text + "\"" : text);
  std::string list = "[";
  for (const ConfigNode& item : items) list += (list.size() > 1 ? ", " : "") + item.Describe();
  return list + "]";
}

ConfigNode ParseYaml(std::string_view yaml, const std::string& name, bool with_positions) {
  if (yaml.size() > kMaxBytes) throw ConfigError(name + ": is larger than 1 MB, too large for a config");
  const std::size_t zero = yaml.find('\0');
  if (zero != std::string_view::npos)
    throw ConfigError(name + ": byte " + std::to_string(zero) + " is zero: not a YAML file");
  std::istringstream stream{std::string(yaml)};
  TreeBuilder builder(name, with_positions);
  try {
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const YAML::Exception& error) {
    throw ConfigError(builder.Place(error.mark) + ": not valid YAML: " + error.msg);
  }
  return builder.Take();
}

ConfigNode MakeNode(const OptionValue& value, const std::string& place) {
  ConfigNode node;
  node.place = place;
  if (const auto* list = std::get_if<std::vector<double>>(&value)) {
    node.kind = ConfigNode::Kind::kList;
    for (const double number : *list) node.items.push_back(MakeNode(number, place));
    return node;
  }
  if (const auto* rows = std::get_if<OptionRows>(&value)) {
    node.kind = ConfigNode::Kind::kList;
    for (const std::vector<double>& row : *rows) node.items.push_back(MakeNode(row, place));
    return node;
  }
  const auto* number = std::get_if<double>(&value);
  const bool finite = number == nullptr || (*number - *number == 0);
  node.text = finite ? FormatValue(value) : *number > 0 ? ".inf" : *number < 0 ? "-.inf" : ".nan";
  node.quoted = std::holds_alternative<std::string>(value);
  return node;
}

}  // namespace frond
