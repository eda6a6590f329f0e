// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "models/nurbs_surface.h"

namespace frond {

// A surface and the unit of its coordinates (LengthUnitNames): what a surface file holds.
struct SurfaceDocument {
  TrimmedSurface trimmed;
  std::string unit = "mm";
};

// The native format, schema frond.nurbs_surface/1 (docs: file formats). Reading what was written gives the
// same surface to the bit. Throws InputError.
void WriteSurfaceJson(const std::filesystem::path& path, const SurfaceDocument& document);

// Throws InputError "surface.json: control_points[3][4][1]: expected a number": the place is a JSON path.
SurfaceDocument ReadSurfaceJson(const std::filesystem::path& path);

// The same on text; `name` is how messages call it.
std::string FormatSurfaceJson(const SurfaceDocument& document);
SurfaceDocument ParseSurfaceJson(std::string_view text, const std::string& name);

}  // namespace frond
