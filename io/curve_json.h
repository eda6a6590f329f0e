// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "models/nurbs_curve.h"

namespace frond {

// A curve and the unit of its coordinates (LengthUnitNames): what a curve file holds.
struct CurveDocument {
  NurbsCurve curve;
  std::string unit = "mm";
};

// The native format, schema frond.nurbs_curve/1 (docs: file formats). Reading what was written gives the same
// curve to the bit. Throws InputError.
void WriteCurveJson(const std::filesystem::path& path, const CurveDocument& document);

// Throws InputError "curve.json: control_points[3][1]: expected a number": the place is a JSON path.
CurveDocument ReadCurveJson(const std::filesystem::path& path);

// Whether it is JSON of a curve's schema. Throws InputError where it cannot be read or is no JSON.
bool IsCurveJson(const std::filesystem::path& path);

// The same on text; `name` is how messages call it.
std::string FormatCurveJson(const CurveDocument& document);
CurveDocument ParseCurveJson(std::string_view text, const std::string& name);

}  // namespace frond
