// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "io/metrics_json.h"

namespace frond {

// frond's version, Ceres's, and the commit this build was configured from ("" outside a checkout).
MetricTable VersionTable();
std::string VersionText();  // one line for --version

}  // namespace frond
