// SPDX-License-Identifier: BSD-3-Clause
#include "io/child_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

#include "base/errors.h"

namespace frond {
namespace {

std::vector<char*> Pointers(std::vector<std::string>* words) {
  std::vector<char*> pointers;
  for (std::string& word : *words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

std::vector<std::string> EnvironmentWith(const std::map<std::string, std::string>& changes) {
  std::vector<std::string> all;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    if (!changes.contains(text.substr(0, text.find('=')))) all.push_back(text);
  }
  for (const auto& [name, value] : changes) all.push_back(name + "=" + value);
  return all;
}

// The two ends of a pipe, closed at the end of the scope and in programs that others start meanwhile.
struct Pipe {
  int ends[2] = {-1, -1};
  Pipe() {
    if (::pipe2(ends, O_CLOEXEC) != 0) throw InputError(std::string("no pipe: ") + std::strerror(errno));
  }
  ~Pipe() {
    Close(0);
    Close(1);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  void Close(int end) {
    if (ends[end] >= 0) ::close(ends[end]);
    ends[end] = -1;
  }
};

struct FileActions {
  posix_spawn_file_actions_t actions;
  FileActions() { ::posix_spawn_file_actions_init(&actions); }
  ~FileActions() { ::posix_spawn_file_actions_destroy(&actions); }
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;
};

volatile std::sig_atomic_t running_child = 0;  // pids fit

extern "C" void EndWithChild(int signal) {
  if (running_child > 0) ::kill(static_cast<pid_t>(running_child), SIGTERM);
  ::signal(signal, SIG_DFL);
  ::raise(signal);
}

// For its scope, a SIGTERM or SIGHUP that would end this program ends the child first.
class SharedEnd {
 public:
  explicit SharedEnd(pid_t child) {
    running_child = child;
    struct sigaction action = {};
    action.sa_handler = EndWithChild;
    for (std::size_t k = 0; k < kSignals.size(); ++k) {
      ::sigaction(kSignals[k], nullptr, &before_[k]);
      if (before_[k].sa_handler == SIG_DFL) ::sigaction(kSignals[k], &action, nullptr);
    }
  }
  ~SharedEnd() {
    for (std::size_t k = 0; k < kSignals.size(); ++k) ::sigaction(kSignals[k], &before_[k], nullptr);
    running_child = 0;
  }
  SharedEnd(const SharedEnd&) = delete;
  SharedEnd& operator=(const SharedEnd&) = delete;

 private:
  static constexpr std::array<int, 2> kSignals = {SIGTERM, SIGHUP};
  std::array<struct sigaction, 2> before_ = {};
};

std::string ReadToEnd(int file) {
  std::string text;
  char buffer[4096];
  while (true) {
    const ssize_t count = ::read(file, buffer, sizeof(buffer));
    if (count > 0) text.append(buffer, static_cast<std::size_t>(count));
    if (count == 0 || (count < 0 && errno != EINTR)) return text;
  }
}

}  // namespace

ChildResult RunChild(const std::string& program, const std::vector<std::string>& arguments,
                     const std::filesystem::path& working,
                     const std::map<std::string, std::string>& environment) {
  std::vector<std::string> words = {program}, variables = EnvironmentWith(environment);
  words.insert(words.end(), arguments.begin(), arguments.end());
  Pipe pipe;
  FileActions files;
  ::posix_spawn_file_actions_addchdir_np(&files.actions, working.c_str());
  ::posix_spawn_file_actions_addopen(&files.actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_adddup2(&files.actions, pipe.ends[1], STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&files.actions, pipe.ends[1], STDERR_FILENO);
  pid_t child = 0;
  const int error = ::posix_spawnp(&child, program.c_str(), &files.actions, nullptr, Pointers(&words).data(),
                                   Pointers(&variables).data());
  if (error == ENOENT && std::filesystem::is_directory(working)) return {.found = false};
  if (error != 0) throw InputError("the program '" + program + "' does not start: " + std::strerror(error));
  pipe.Close(1);
  ChildResult result;
  {
    const SharedEnd shared(child);  // not beyond waitpid, which frees the number
    result.output = ReadToEnd(pipe.ends[0]);
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
  return result;
}

}  // namespace frond
