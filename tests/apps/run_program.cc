// SPDX-License-Identifier: BSD-3-Clause
#include "tests/apps/run_program.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>

#include "tests/io/temp_folder.h"

namespace frond {
namespace {

// In the child: nothing but calls that are safe between fork and exec.
[[noreturn]] void Execute(char* const* arguments, const char* working, const char* out, const char* err) {
  const int out_file = ::open(out, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  const int err_file = ::open(err, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (out_file < 0 || err_file < 0 || ::chdir(working) != 0) ::_exit(126);
  ::dup2(out_file, STDOUT_FILENO);
  ::dup2(err_file, STDERR_FILENO);
  ::execv(FROND_PROGRAM, arguments);
  ::_exit(127);
}

pid_t Start(const std::vector<std::string>& arguments, const std::filesystem::path& working,
            const std::filesystem::path& out, const std::filesystem::path& err) {
  std::vector<std::string> words = {FROND_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const pid_t child = ::fork();
  if (child == 0) Execute(pointers.data(), working.c_str(), out.c_str(), err.c_str());
  return child;
}

}  // namespace

ProgramResult RunFrond(const std::vector<std::string>& arguments, const std::filesystem::path& working) {
  const TempFolder output;
  const pid_t child = Start(arguments, working, output / "out", output / "err");
  int status = 0;
  if (child < 0 || ::waitpid(child, &status, 0) != child) return {};
  return {.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1,
          .out = FileText(output / "out"),
          .err = FileText(output / "err")};
}

pid_t StartFrond(const std::vector<std::string>& arguments, const std::filesystem::path& working) {
  return Start(arguments, working, "/dev/null", "/dev/null");
}

bool IsOneErrorLine(const std::string& err) {
  return err.starts_with("frond: ") && std::count(err.begin(), err.end(), '\n') == 1 && err.back() == '\n';
}

std::vector<std::string> NamesIn(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    names.push_back(entry.path().filename());
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace frond
