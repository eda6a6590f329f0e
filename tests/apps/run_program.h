// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace frond {

struct ProgramResult {
  int exit_code = -1;  // -1: ended by a signal
  std::string out, err;
};

// Runs the built frond with `arguments` in the folder `working` and waits for its end.
ProgramResult RunFrond(const std::vector<std::string>& arguments, const std::filesystem::path& working);

// Starts it and returns at once; its output is dropped. The caller waits for the process.
pid_t StartFrond(const std::vector<std::string>& arguments, const std::filesystem::path& working);

// "frond: …" and a line end: what every failure leaves on stderr, and nothing else.
bool IsOneErrorLine(const std::string& err);

// The names in a folder, hidden ones included, sorted.
std::vector<std::string> NamesIn(const std::filesystem::path& folder);

}  // namespace frond
