// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/study_lock.h"

#include <fcntl.h>
#include <string.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <thread>

#include "base/errors.h"
#include "io/file_bytes.h"

namespace frond {

StudyLock::StudyLock(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "lock";
  file_ = ::open(path.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0666);
  if (file_ < 0) FailFile(path, std::string("cannot be made: ") + ::strerror(errno));
  for (int attempt = 0; ::flock(file_, LOCK_EX | LOCK_NB) != 0; ++attempt) {
    if (attempt == 40) {
      ::close(file_);
      throw ConfigError(folder.string() +
                        ": another process is running this study; wait for it, or choose another "
                        "--out");
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

StudyLock::~StudyLock() {
  if (file_ >= 0) ::close(file_);
}

void StudyLock::CloseInChild() {
  ::close(file_);  // closes this process's copy alone
  file_ = -1;
}

}  // namespace frond
