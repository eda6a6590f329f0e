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
  std::error_code error;
  fs::create_directories(parent, error);
  if (error) FailFile(parent, "cannot be made: " + error.message());
  // Two runs of one process to the same target differ by the number; leftovers of a killed one are not
  // touched.
  for (int attempt = 0;; ++attempt) {
    working_ = Sibling(target_, "partial");
    if (attempt > 0) working_ += "-" + std::to_string(attempt);
    if (::mkdir(working_.c_str(), 0777) == 0) return;
    if (errno != EEXIST || attempt > 1000) {
      FailFile(parent, std::string("cannot be written: ") + std::strerror(errno));
    }
  }
}

RunDirectory::~RunDirectory() {
  if (committed_) return;
  std::error_code ignored;
  fs::remove_all(working_, ignored);
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
