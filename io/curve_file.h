// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/curve_json.h"

namespace frond {

// What WriteCurve takes: json, step, stp, igs, iges and, as a polyline, ply, obj.
const std::vector<std::string>& CurveWriteExtensions();

// Whether a .json, .step, .stp, .igs or .iges holds a curve alone: by its schema, or as it has no face.
// Throws InputError where it cannot be read.
bool IsCurveFile(const std::filesystem::path& path);

// By extension, from those of IsCurveFile. Throws InputError.
CurveDocument ReadCurve(const std::filesystem::path& path);

// By extension. A polyline has about 16 points a span: in ply the vertices alone, in obj with the line
// through them. Throws InputError, and as WriteStep.
void WriteCurve(const std::filesystem::path& path, const CurveDocument& document);

}  // namespace frond
