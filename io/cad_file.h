// SPDX-License-Identifier: BSD-3-Clause
// STEP and IGES by Open CASCADE, whose headers stay in cad_file.cc (files) and cad_shape.cc (faces).
// Open CASCADE's settings are global: calls take turns on one mutex, so they are safe from many threads.
#pragma once

#include <cstddef>
#include <filesystem>

#include "io/surface_json.h"

namespace frond {

// One B-spline face in the document's unit, with all digits. Untrimmed: the whole surface; trimmed: bounded
// by the loops, the outer first. A periodic direction is written clamped, by knot insertion at the seam (same
// shape, same parameters). Throws InputError where the file cannot be written, FitError where Open CASCADE
// finds the face invalid.
void WriteStep(const std::filesystem::path& path, const SurfaceDocument& document);
void WriteIges(const std::filesystem::path& path, const SurfaceDocument& document);

// The first face over a B-spline or Bézier surface. Wires that are not the surface's
// natural boundary become trim loops, sampled where they curve. Throws InputError.
SurfaceDocument ReadStep(const std::filesystem::path& path);
SurfaceDocument ReadIges(const std::filesystem::path& path);

// What Open CASCADE says of a face or a file's faces.
struct CadCheck {
  bool valid = false;  // BRepCheck_Analyzer
  double area = 0;     // in the unit squared, by BRepGProp: to 1e-4, less across creases
  std::size_t faces = 0;
  double tolerance = 0;  // the largest of any face, edge or vertex, in the unit
};
CadCheck CheckShape(const SurfaceDocument& document);      // the face that WriteStep would write
CadCheck CheckCadFile(const std::filesystem::path& path);  // .step, .stp, .igs, .iges

}  // namespace frond
