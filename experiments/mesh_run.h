// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace frond {

struct MeshRunOptions {
  std::optional<double> size =
      {};               // of elements; default: 1/20 of the diagonal of the surface's bounding box
  int order = 1;        // 1 or 2
  bool volume = false;  // tetrahedra inside a closed surface
  std::optional<double> shell_thickness = {};
  std::vector<std::string> formats = {"msh"};  // of FeMeshFormats()
  std::filesystem::path out;                   // folder; empty: the run's
  bool overwrite = false;
};

// What mesh_quality.json says (docs: file formats).
struct MeshQuality {
  std::vector<std::string> files;
  std::string unit, gmsh;
  bool volume = false;
  int order = 1;
  double size = 0;
  std::optional<double> shell_thickness = {};
  std::size_t nodes = 0, elements = 0, below_0_1 = 0;  // the last: elements with SICN < 0.1
  double min_sicn = 0, mean_sicn = 0;
  double measure = 0;  // area, or volume, of the elements
};

struct MeshRunOutcome {
  std::filesystem::path folder;
  MeshQuality quality;
};

// A finite-element mesh of a run's surface by Gmsh: FOLDER/mesh.FORMAT, then mesh_quality.json, moved there
// when all are finished: where mesh_quality.json is, the files it names are whole. `overwrite` removes the
// old mesh_quality.json and every old mesh.FORMAT then. A failed mesh changes nothing. `run`: a folder with
// surface.json or surface.step, or a surface file. Throws ConfigError for options and for files that exist
// (without `overwrite`) or are folders, InputError where there is no surface or, for a volume, an open one,
// FitError for a mesh of less than half the surface, and as MeshByGmsh.
MeshRunOutcome MeshRun(const std::filesystem::path& run, const MeshRunOptions& options);

}  // namespace frond
