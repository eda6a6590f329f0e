// SPDX-License-Identifier: BSD-3-Clause
// STEP and IGES by Open CASCADE, whose headers stay in io/cad_*.
// Open CASCADE's settings are global: calls take turns on one mutex, so they are safe from many threads.
#pragma once

#include <cstddef>
#include <filesystem>

#include "io/curve_json.h"
#include "io/surface_json.h"

namespace frond {

// One B-spline face in the document's unit, with all digits. Untrimmed: the whole surface; trimmed: bounded
// by the loops, the outer first. A periodic direction is written clamped, by knot insertion at the seam (same
// shape, same parameters), where the face has a seam edge. An untrimmed surface that closes on itself (two
// poles and a seam: a pear; two seams: a torus) becomes a solid, bounded by that one face, outward. Throws
// InputError where the file cannot be written, FitError where Open CASCADE finds the face invalid.
void WriteStep(const std::filesystem::path& path, const SurfaceDocument& document);
void WriteIges(const std::filesystem::path& path, const SurfaceDocument& document);

// The first face over a B-spline or Bézier surface. Wires that are not the surface's
// natural boundary become trim loops, sampled where they curve. Throws InputError.
SurfaceDocument ReadStep(const std::filesystem::path& path);
SurfaceDocument ReadIges(const std::filesystem::path& path);

// A curve: an edge over a B-spline curve in STEP, entity 126 in IGES. A periodic one is written clamped, its
// ends on one vertex. Throw as above.
void WriteStep(const std::filesystem::path& path, const CurveDocument& document);
void WriteIges(const std::filesystem::path& path, const CurveDocument& document);

// The first edge that belongs to no face, in its sense. Throw InputError.
CurveDocument ReadStepCurve(const std::filesystem::path& path);
CurveDocument ReadIgesCurve(const std::filesystem::path& path);

// Whether a STEP or IGES file holds any face. Throws InputError.
bool HasFaces(const std::filesystem::path& path);

// What Open CASCADE says of a face or a file's faces.
struct CadCheck {
  bool valid = false;  // BRepCheck_Analyzer
  double area = 0;     // in the unit squared, by BRepGProp: to 1e-4, less across creases
  std::size_t faces = 0;
  std::size_t solids = 0;
  bool closed = false;   // has shells, all of them watertight
  double volume = 0;     // of the solids, in the unit cubed, as accurate; positive: faces look outward
  double tolerance = 0;  // the largest of any face, edge or vertex, in the unit
};
CadCheck CheckShape(const SurfaceDocument& document);      // what WriteStep would write
CadCheck CheckCadFile(const std::filesystem::path& path);  // .step, .stp, .igs, .iges

}  // namespace frond
