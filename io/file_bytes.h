// SPDX-License-Identifier: BSD-3-Clause
// Whole files in and out, with every failure turned into one line that names the file.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace frond {

// Throws InputError where `path` does not exist, is not a regular file, or cannot be read to its end.
std::string ReadFileBytes(const std::filesystem::path& path);

// Throws InputError where `path` cannot be created or written to its end (a full disk shows on flush or
// close).
void WriteFileBytes(const std::filesystem::path& path, std::string_view bytes);

// "scan.ply" -> "ply": lower case, without the dot.
std::string Extension(const std::filesystem::path& path);

// Throws InputError "PATH: MESSAGE".
[[noreturn]] void FailFile(const std::filesystem::path& path, const std::string& message);

}  // namespace frond
