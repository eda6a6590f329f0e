// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <ostream>

namespace frond {

// What a run came to, in one line where the folder has metrics.json, and the folder's name in another.
void PrintSummary(const std::filesystem::path& folder, std::ostream& out);

}  // namespace frond
