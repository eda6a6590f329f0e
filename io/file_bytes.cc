// SPDX-License-Identifier: BSD-3-Clause
#include "io/file_bytes.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>

#include "base/errors.h"

namespace frond {
namespace {

// Closes on every way out. Close() reports a failure that only shows then, as on a network file system.
class FileDescriptor {
 public:
  explicit FileDescriptor(int fd) : fd_(fd) {}
  ~FileDescriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  int get() const { return fd_; }
  bool Close() {
    const int fd = fd_;
    fd_ = -1;
    return ::close(fd) == 0;
  }

 private:
  int fd_;
};

}  // namespace

void FailFile(const std::filesystem::path& path, const std::string& message) {
  throw InputError(path.string() + ": " + message);
}

std::string ReadFileBytes(const std::filesystem::path& path) {
  // O_NONBLOCK: opening a pipe that nobody writes must not hang; it is refused below.
  FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (file.get() < 0) {
    if (errno == ENOENT) FailFile(path, "no such file");
    FailFile(path, std::string("cannot be opened: ") + std::strerror(errno));
  }
  struct stat status {};
  if (::fstat(file.get(), &status) != 0) FailFile(path, std::strerror(errno));
  if (S_ISDIR(status.st_mode)) FailFile(path, "is a directory, not a file");
  if (!S_ISREG(status.st_mode)) FailFile(path, "is not a regular file (pipes and devices are not read)");
  std::string bytes(static_cast<std::size_t>(status.st_size), '\0');
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t got = ::read(file.get(), bytes.data() + done, bytes.size() - done);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) FailFile(path, std::string("cannot be read: ") + std::strerror(errno));
    if (got == 0) break;  // it shrank since fstat
    done += static_cast<std::size_t>(got);
  }
  bytes.resize(done);
  return bytes;
}

void WriteFileBytes(const std::filesystem::path& path, std::string_view bytes) {
  FileDescriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (file.get() < 0) FailFile(path, std::string("cannot be written: ") + std::strerror(errno));
  while (!bytes.empty()) {
    const ssize_t put = ::write(file.get(), bytes.data(), bytes.size());
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) FailFile(path, std::string("cannot be written to its end: ") + std::strerror(errno));
    bytes.remove_prefix(static_cast<std::size_t>(put));
  }
  if (!file.Close()) FailFile(path, std::string("cannot be written to its end: ") + std::strerror(errno));
}

std::string Extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  if (!extension.empty()) extension.erase(0, 1);
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

}  // namespace frond
