// SPDX-License-Identifier: BSD-3-Clause
#include "io/run_directory.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <system_error>

#include "base/errors.h"
#include "io/file_bytes.h"

namespace frond {
namespace {

namespace fs = std::filesystem;

bool IsEmptyFolder(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path, error) && fs::is_empty(path, error) && !error;
}

bool LooksLikeARun(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path / "config.yaml", error) ||
         fs::is_regular_file(path / "metrics.json", error);
}

void CheckTarget(const fs::path& target, bool overwrite) {
  std::error_code error;
  const fs::file_status status = fs::symlink_status(target, error);
  if (status.type() == fs::file_type::not_found) return;
  if (status.type() != fs::file_type::directory) {
    throw ConfigError(target.string() + ": exists and is not a folder; choose another --out");
  }
  if (IsEmptyFolder(target)) return;
  if (!LooksLikeARun(target)) {
    throw ConfigError(target.string() +
                      ": exists and is not a run of frond (it has no config.yaml); choose another --out");
  }
  if (!overwrite) throw ConfigError(target.string() + ": exists; choose another --out, or give --overwrite");
}

// A sibling of `target`: on the same file system, so that a rename is atomic.
fs::path Sibling(const fs::path& target, const char* kind) {
  return target.parent_path() /
         ("." + target.filename().string() + "." + kind + "-" + std::to_string(::getpid()));
}

}  // namespace

RunDirectory::RunDirectory(fs::path target, bool overwrite) : overwrite_(overwrite) {
  if (target.empty()) throw ConfigError("the name of the output folder is empty; give --out");
  target_ = fs::absolute(target).lexically_normal();
  if (!target_.has_filename()) target_ = target_.parent_path();  // "out/" is "out"
  CheckTarget(target_, overwrite);
  const fs::path parent = target_.parent_path();
  // Two runs of one process to the same target differ by the number; leftovers of a killed one are not
  // touched. A parent that has vanished was made, and removed again, by another run.
  for (int attempt = 0;; ++attempt) {
    MakeParent();
    working_ = Sibling(target_, "partial");
    if (attempt > 0) working_ += "-" + std::to_string(attempt);
    if (::mkdir(working_.c_str(), 0777) == 0) return;
    const int cause = errno;
    if (attempt < (cause == EEXIST ? 1000 : cause == ENOENT ? 3 : 0)) continue;
    RemoveMadeParents();
    FailFile(parent, std::string("cannot be written: ") + std::strerror(cause));
  }
}

void RunDirectory::MakeParent() {
  const fs::path parent = target_.parent_path();
  std::error_code error;
  std::vector<fs::path> missing;
  for (fs::path folder = parent; !fs::exists(folder, error) && folder.has_relative_path();
       folder = folder.parent_path()) {
    missing.push_back(folder);
  }
  if (!missing.empty()) made_parents_ = missing;
  fs::create_directories(parent, error);
  if (!error) return;
  RemoveMadeParents();
  FailFile(parent, "cannot be made: " + error.message());
}

void RunDirectory::RemoveMadeParents() const {
  for (const fs::path& folder : made_parents_) (void)::rmdir(folder.c_str());  // fails unless it is empty
}

RunDirectory::~RunDirectory() {
  if (committed_) return;
  std::error_code ignored;
  fs::remove_all(working_, ignored);
  RemoveMadeParents();
}

void RunDirectory::Commit() {
  if (committed_) throw std::logic_error("a run directory is committed twice");
  CheckTarget(target_, overwrite_);  // it may have appeared since the start
  std::error_code error;
  if (!LooksLikeARun(target_)) {  // absent or empty: rename replaces an empty folder
    fs::rename(working_, target_, error);
    if (error) FailFile(target_, "cannot be written: " + error.message());
    committed_ = true;
    return;
  }
  fs::path old = Sibling(target_, "old");
  for (int attempt = 1; fs::exists(old, error); ++attempt) {
    old = Sibling(target_, "old");
    old += "-" + std::to_string(attempt);
  }
  fs::rename(target_, old, error);
  if (error) FailFile(target_, "cannot be replaced: " + error.message());
  fs::rename(working_, target_, error);
  if (error) {
    std::error_code ignored;
    fs::rename(old, target_, ignored);
    FailFile(target_, "cannot be written: " + error.message());
  }
  committed_ = true;
  fs::remove_all(old, error);
}

}  // namespace frond
