// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/options.h"

namespace frond {

struct ConfigNode;

// A YAML config and the overrides of the command line, each value with its place. Keys are addressed by
// dotted paths from the top: "problem.surface.degree". Every complaint is a ConfigError of one line that
// starts with the place, "leaf.yaml:12:5: " (line and column from 1) or "--set: ".
//
// Refused at once: syntax errors, more than 1 MB, a top level that is not a map, a key twice in one map, keys
// without a value (null), aliases that nest without end or unfold to more than 100,000 values.
class ConfigFile {
 public:
  // Throws ConfigError, also if there is no such file to read.
  static ConfigFile Load(const std::filesystem::path& path);
  // `name` stands for the file in messages; relative paths are resolved from `folder`.
  static ConfigFile Parse(std::string_view yaml, std::string name, std::filesystem::path folder = ".");

  ConfigFile(const ConfigFile& other);  // deep: a sweep's runs each change their own
  ConfigFile& operator=(const ConfigFile& other);
  ConfigFile(ConfigFile&&) noexcept;
  ConfigFile& operator=(ConfigFile&&) noexcept;
  ~ConfigFile();

  // "a.b=1; c.d=[2, 3]": YAML values, `;` between. A missing section is made.
  void Override(std::string_view assignments);
  void Set(const std::string& key, const OptionValue& value);  // placed as "--set"

  const std::string& name() const { return name_; }
  bool Has(const std::string& key) const;
  bool IsSection(const std::string& key) const;                     // a map
  std::vector<std::string> Keys(const std::string& section) const;  // in file order; "" is the top level
  std::string Place(const std::string& key) const;                  // of its value; the file's name if absent
  [[noreturn]] void Fail(const std::string& key, const std::string& message) const;

  // Typed values. A key that is absent gives `fallback`, or a ConfigError where there is none.
  bool Flag(const std::string& key, std::optional<bool> fallback = {}) const;
  std::int64_t Integer(const std::string& key, std::optional<std::int64_t> fallback = {}) const;
  double Number(const std::string& key, std::optional<double> fallback = {}) const;
  std::string Text(const std::string& key, std::optional<std::string> fallback = {}) const;
  std::vector<double> Numbers(const std::string& key) const;     // a single one is a list of one
  std::vector<std::string> Texts(const std::string& key) const;  // likewise
  OptionValue Value(const std::string& key) const;               // scalar, list of numbers or of such lists
  // A list of values of any kind, or a list of such lists: [lm, pso], [[10, 10], [20, 20]].
  std::vector<OptionValue> Values(const std::string& key) const;

  // An absolute path: relative ones from the config's folder, those from --set from the working folder.
  std::filesystem::path ResolvePath(const std::string& key) const;
  std::vector<std::filesystem::path> ResolvePaths(const std::string& key) const;  // of one path or a list

  // ConfigError at the first key of `section` ("" is the top level) that is not in `known`, with the nearest.
  void CheckKeys(const std::string& section, const std::vector<std::string>& known) const;

  // Sets every value below `section` on `options`, nested maps as dotted names ("surface.control_points").
  // Keys of the section that others read are named in `also_known`. An absent section sets nothing.
  void ReadSection(const std::string& section, Options* options,
                   const std::vector<std::string>& also_known = {}) const;

  // One axis of `sweep:`, whose keys are dotted paths or nested maps down to lists.
  struct SweepAxis {
    std::string key, place;
    std::vector<OptionValue> values;
  };
  std::vector<SweepAxis> Sweep() const;

 private:
  ConfigFile(std::string name, std::filesystem::path folder, std::unique_ptr<ConfigNode> root);
  const ConfigNode* Find(const std::string& key) const;
  const ConfigNode& Require(const std::string& key, std::string_view expected) const;

  std::string name_;
  std::filesystem::path folder_;
  std::unique_ptr<ConfigNode> root_;
};

// The resolved config of a run, written so that reading it repeats the run: keys in the order they were
// added, defaults included, paths absolute.
class ResolvedConfig {
 public:
  void Add(const std::string& key, const OptionValue& value);
  void Add(const std::string& key, const std::vector<std::string>& texts);
  void AddSection(const std::string& section, const Options& options);  // every option, set or not
  std::string Yaml() const;

 private:
  struct Entry {
    std::string key, yaml;
  };
  std::vector<Entry> entries_;
};

}  // namespace frond
