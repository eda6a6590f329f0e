// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/options.h"
#include "experiments/photograph_input.h"
#include "io/config_file.h"
#include "io/point_cloud_file.h"
#include "models/mesh_repair.h"
#include "models/nurbs_surface.h"
#include "models/region.h"

namespace frond {

// What a fit takes: nothing, points or a mesh, or photographs.
enum class InputKind { kNone, kScan, kStereo, kTurntable };

// What the section `input` names, before anything is read.
struct InputSource {
  InputKind kind = InputKind::kScan;
  std::filesystem::path cloud;                  // or empty: a mesh or synthetic
  std::filesystem::path mesh;                   // or empty
  bool repair = false;                          // the mesh's defects, instead of refusing it
  std::vector<HalfSpace> region;                // what is left of the input; all of it where empty
  std::filesystem::path truth;                  // clean points to judge against, or empty
  std::optional<std::uint64_t> synthetic_leaf;  // the seed of a leaf made in memory (`input.synthetic_leaf`)
  std::string unit = "mm";
  std::size_t points = 0;            // thin to about this many by a voxel grid; 0: all
  std::size_t samples = 0;           // of a mesh: points drawn from its faces, beside its vertices
  std::filesystem::path other_wall;  // the surface.json of another wall of the same object, or empty
  PhotographSource photographs = {};
};

// A run's data. `description` stands for the file in messages and metrics.
struct RunInput {
  std::string description;
  std::string unit;
  PointCloud cloud;  // of a mesh its vertices, in their order, and then samples of its faces
  CloudReport report;
  std::optional<SurfaceMesh> mesh;
  std::optional<MeshRepairCounts> repaired;   // where repair was asked for
  std::optional<std::size_t> outside_region;  // points (of a mesh: vertices) dropped, where there is a region
  std::vector<Eigen::Vector3d> truth;         // clean points, or empty
  std::optional<double> true_area;            // of a synthetic leaf
  std::optional<NurbsSurface> other_wall;
  std::optional<StereoInput> stereo = {};
  std::optional<TurntableInput> turntable = {};
};

// The options of the section `input` for a kind (`cloud`, `mesh`, `truth`, `unit`, `points`, …).
std::vector<OptionSpec> InputSpecs(InputKind kind);

// Throws ConfigError unless what the kind needs is named and all that is named suits it: of a scan exactly
// one of cloud, mesh and synthetic_leaf, with a known unit.
InputSource ReadInputSource(const ConfigFile& config, InputKind kind);
void AddInput(const InputSource& source, ResolvedConfig* resolved);

// Reads or makes the points, or reads the photographs; none where the source is of kind kNone. A mesh with
// duplicate vertices or faces, faces without area, vertices without faces or edges of more than two faces is
// refused, unless repair is asked for and leaves none. The region is cut out next, of the truth too, then
// points are thinned by a voxel grid that `seed` places; it draws a mesh's samples too. Throws InputError.
RunInput LoadInput(const InputSource& source, std::uint64_t seed);

}  // namespace frond
