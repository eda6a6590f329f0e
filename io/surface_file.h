// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/surface_json.h"

namespace frond {

// json, step, stp, igs, iges.
const std::vector<std::string>& SurfaceExtensions();

// By extension. Throw InputError; an unknown extension's message lists the known ones.
SurfaceDocument ReadSurface(const std::filesystem::path& path);
void WriteSurface(const std::filesystem::path& path, const SurfaceDocument& document);

}  // namespace frond
