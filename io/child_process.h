// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace frond {

struct ChildResult {
  bool found = true;        // false: no such program on PATH
  int exit_code = -1;       // -1: ended by a signal
  int signal = 0;           // its number; 0: none
  std::string output = {};  // of stdout and stderr
};

// Runs a program, found on PATH, without a shell, in the folder `working`, and waits for its end. Its
// environment is ours but for `environment`; its input is empty. Throws InputError where it cannot be started
// although it is there. SIGTERM and SIGHUP, unless they are handled or ignored, end it too, so one thread at
// a time may call.
ChildResult RunChild(const std::string& program, const std::vector<std::string>& arguments,
                     const std::filesystem::path& working,
                     const std::map<std::string, std::string>& environment);

}  // namespace frond
