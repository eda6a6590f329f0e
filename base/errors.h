// SPDX-License-Identifier: BSD-3-Clause
// The exceptions of frond, one for each cause that a user can act on. Libraries throw them; apps/ alone turns
// them into exit codes. A message is one line that names the file (or option), the place and the way out.
// Broken preconditions (a caller's bug) are std::invalid_argument or std::logic_error: exit code 5.
#pragma once

#include <stdexcept>
#include <string>

namespace frond {

// A wrong flag, config key, option value or combination of options. Exit code 2.
struct ConfigError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Input data that cannot be read or used, or output that cannot be written. Exit code 3.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A fit that failed or whose result was rejected. Exit code 4.
struct FitError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace frond
