// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace frond {

// A result folder that appears whole or not at all. Files are written into a hidden sibling
// (.NAME.partial-PID), which Commit renames to the target; without Commit it is removed, and so are the
// parent folders made for it, while they are empty.
class RunDirectory {
 public:
  // Throws InputError where the parent cannot be made or written. An existing target is a ConfigError, unless
  // it is an empty folder or `overwrite` is given and it looks like a run (holds config.yaml or
  // metrics.json): a user's other folder is never deleted.
  RunDirectory(std::filesystem::path target, bool overwrite);
  ~RunDirectory();
  RunDirectory(const RunDirectory&) = delete;
  RunDirectory& operator=(const RunDirectory&) = delete;

  const std::filesystem::path& target() const { return target_; }
  const std::filesystem::path& working() const { return working_; }
  std::filesystem::path File(const std::string& name) const {
    return working_ / name;
  }  // where to write it now

  // Renames the folder into place, at most once. A replaced target is first renamed away, then deleted; if
  // the new one cannot take its place it comes back. Throws InputError.
  void Commit();

 private:
  void MakeParent();
  void RemoveMadeParents() const;

  std::filesystem::path target_, working_;
  std::vector<std::filesystem::path> made_parents_;  // the deepest first
  bool overwrite_ = false;
  bool committed_ = false;
};

}  // namespace frond
