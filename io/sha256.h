// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace frond {

// SHA-256 (FIPS 180-4) as 64 lower-case hexadecimal digits: a run's metrics.json identifies its input by it.
std::string Sha256(std::string_view bytes);

}  // namespace frond
