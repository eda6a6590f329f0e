// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace frond {

// While one lives no other process works in a study's folder. Ends with the process, however that ends.
class StudyLock {
 public:
  // Throws ConfigError where another process holds it (after two seconds: that one may just be dying).
  explicit StudyLock(const std::filesystem::path& folder);
  ~StudyLock();
  StudyLock(const StudyLock&) = delete;
  StudyLock& operator=(const StudyLock&) = delete;

  // In a forked process: lets go of it there without ending the parent's.
  void CloseInChild();

 private:
  int file_ = -1;
};

}  // namespace frond
