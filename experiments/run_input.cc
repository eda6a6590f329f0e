// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/run_input.h"

#include "base/errors.h"
#include "base/random.h"
#include "io/length_unit.h"
#include "io/mesh_file.h"
#include "io/surface_json.h"
#include "models/mesh_sampling.h"
#include "models/mesh_topology.h"
#include "problems/leaf/synthetic_leaf_scan.h"
#include "problems/surface/voxel_grid.h"

namespace frond {
namespace {

constexpr std::size_t kTruthSamples = 20000;  // of a true mesh, evenly by area

std::vector<OptionSpec> ScanInputSpecs() {
  return {
      {.name = "cloud",
       .type = OptionType::kText,
       .default_value = std::string(),
       .help = "The scan: ply, pcd, xyz, asc, csv, txt, pts, obj, stl, off"},
      {.name = "mesh",
       .type = OptionType::kText,
       .default_value = std::string(),
       .help = "Instead of a cloud, a scan with faces: ply, obj, stl, off"},
      {.name = "repair",
       .type = OptionType::kFlag,
       .default_value = false,
       .help = "Repair the mesh's defects (weld, drop, split) instead of refusing it"},
      {.name = "region",
       .type = OptionType::kRows,
       .default_value = OptionRows(),
       .help = "Keep what lies in all these half-spaces: a point of the plane and the normal to the inside, "
               "[[px, py, pz, nx, ny, nz], ...]",
       .min_size = 0,
       .max_size = 1000,
       .row_size = 6},
      {.name = "synthetic_leaf",
       .type = OptionType::kInteger,
       .default_value = std::int64_t{0},
       .help = "Instead of a scan: the leaf of this seed, as `frond synth leaf` makes it",
       .minimum = 0},
      {.name = "truth",
       .type = OptionType::kText,
       .default_value = std::string(),
       .help = "Clean points of the same object: adds truth_rmse and truth_max"},
      {.name = "unit",
       .type = OptionType::kChoice,
       .default_value = std::string("mm"),
       .help = "Unit of the coordinates",
       .words = LengthUnitNames()},
      {.name = "samples",
       .type = OptionType::kInteger,
       .default_value = std::int64_t{0},
       .help =
           "Of a mesh: fit this many points drawn evenly from its faces (by the seed) beside its vertices",
       .minimum = 0},
      {.name = "other_wall",
       .type = OptionType::kText,
       .default_value = std::string(),
       .help = "The surface.json of another wall of the object: adds wall_volume"},
      {.name = "points",
       .type = OptionType::kInteger,
       .default_value = std::int64_t{0},
       .help = "Thin to about this many by a voxel grid placed by the seed; 0: all",
       .minimum = 0}};
}

InputSource ReadScanSource(const ConfigFile& config) {
  Options options(ScanInputSpecs());
  config.ReadSection("input", &options);
  const bool cloud = config.Has("input.cloud"), synthetic = config.Has("input.synthetic_leaf");
  const bool mesh = config.Has("input.mesh");
  if (cloud + synthetic + mesh == 0)
    config.Fail("input", "no input: name a scan, for example --set=\"input.cloud=scan.ply\"");
  if (cloud + synthetic + mesh > 1)
    config.Fail("input", "name one of 'cloud', 'mesh' and 'synthetic_leaf', not several");
  if (mesh && options.Integer("points") > 0)
    config.Fail("input.points", "a mesh is not thinned: leave 'points' out, or name the file as 'cloud'");
  if (!mesh && options.Integer("samples") > 0)
    config.Fail("input.samples", "only a mesh has faces to sample: leave 'samples' out");
  if (!mesh && options.Flag("repair"))
    config.Fail("input.repair", "only a mesh is repaired: leave 'repair' out, or name the file as 'mesh'");
  InputSource source;
  if (cloud) source.cloud = config.ResolvePath("input.cloud");
  if (mesh) source.mesh = config.ResolvePath("input.mesh");
  source.repair = options.Flag("repair");
  for (const std::vector<double>& row : options.Rows("region")) {
    const HalfSpace half{{row[0], row[1], row[2]}, {row[3], row[4], row[5]}};
    if (!(half.normal.norm() > 0))
      config.Fail("input.region",
                  "a half-space of 'region' has the normal [0, 0, 0], which has no direction");
    source.region.push_back(half);
  }
  if (synthetic) source.synthetic_leaf = static_cast<std::uint64_t>(config.Integer("input.synthetic_leaf"));
  if (config.Has("input.truth")) source.truth = config.ResolvePath("input.truth");
  source.unit = options.Text("unit");
  source.points = static_cast<std::size_t>(options.Integer("points"));
  source.samples = static_cast<std::size_t>(options.Integer("samples"));
  if (config.Has("input.other_wall")) source.other_wall = config.ResolvePath("input.other_wall");
  return source;
}

void AddScan(const InputSource& source, ResolvedConfig* resolved) {
  if (source.synthetic_leaf) {
    resolved->Add("input.synthetic_leaf", static_cast<std::int64_t>(*source.synthetic_leaf));
  } else if (!source.mesh.empty()) {
    resolved->Add("input.mesh", source.mesh.string());
    resolved->Add("input.repair", source.repair);
    if (source.samples > 0) resolved->Add("input.samples", static_cast<std::int64_t>(source.samples));
  } else {
    resolved->Add("input.cloud", source.cloud.string());
  }
  if (!source.region.empty()) {
    OptionRows rows;
    for (const auto& [p, n] : source.region) rows.push_back({p.x(), p.y(), p.z(), n.x(), n.y(), n.z()});
    resolved->Add("input.region", rows);
  }
  if (!source.truth.empty()) resolved->Add("input.truth", source.truth.string());
  if (!source.other_wall.empty()) resolved->Add("input.other_wall", source.other_wall.string());
  resolved->Add("input.unit", source.unit);
  if (source.points > 0) resolved->Add("input.points", static_cast<std::int64_t>(source.points));
}

[[noreturn]] void FailEdges(const std::string& file, const MeshTopology& topology, bool repaired) {
  throw InputError(
      file + ": has " + std::to_string(topology.non_manifold_edges) + " edges with more than two faces" +
      (repaired ? ", which repair does not part: cut them off with input.region, or edit the mesh"
                : ": set input.repair to true where welded seams or doubled faces make them"));
}

void LoadMesh(const InputSource& source, RunInput* input) {
  SurfaceMesh mesh = ReadMesh(source.mesh, &input->report);
  const MeshDefects defects = FindMeshDefects(mesh);
  if (source.repair) {
    input->repaired.emplace();
    mesh = RepairMesh(mesh, &*input->repaired);
    if (mesh.triangles.empty())
      throw InputError(input->description +
                       ": repair leaves no face: each is degenerate or cancels with another");
  } else if (!defects.none()) {
    throw InputError(input->description + ": " + defects.InWords() +
                     "; set input.repair to true to weld and drop them");
  }
  input->mesh = std::move(mesh);
}

// Of the mesh where there is one, else of the points; of the truth too.
void CutRegion(std::span<const HalfSpace> region, RunInput* input) {
  if (input->mesh) {
    const std::size_t before = input->mesh->vertices.size();
    const std::size_t kept = PointsInside(region, input->mesh->vertices).size();
    input->mesh = MeshInside(region, *input->mesh);
    input->outside_region = before - kept;
  } else {
    const std::size_t before = input->cloud.points.size();
    input->cloud.points = PointsInside(region, input->cloud.points);
    input->outside_region = before - input->cloud.points.size();
  }
  if (input->mesh ? input->mesh->triangles.empty() : input->cloud.points.empty()) {
    throw InputError("the region keeps no " + std::string(input->mesh ? "face" : "point") + " of " +
                     input->description + ": the normals in input.region must point to what is kept");
  }
  input->truth = PointsInside(region, input->truth);
}

RunInput LoadScan(const InputSource& source, std::uint64_t seed) {
  RunInput input;
  input.unit = source.unit;
  if (source.synthetic_leaf) {
    const std::uint64_t leaf = *source.synthetic_leaf;
    LeafScanOptions options;
    options.seed = leaf;
    options.unit_mm = MetresPerUnit(source.unit) * 1000;
    LeafScan scan = ScanLeaf(RandomLeaf(leaf), options);
    input.description = "synthetic leaf " + std::to_string(leaf);
    input.cloud.points = std::move(scan.points);
    input.truth = std::move(scan.dense_clean);
    input.true_area = scan.measures.area;
    input.report.format = "synthetic";
    input.report.rows = input.cloud.points.size();
  } else if (!source.mesh.empty()) {
    input.description = source.mesh.string();
    LoadMesh(source, &input);
  } else {
    input.description = source.cloud.string();
    input.cloud = ReadPointCloud(source.cloud, &input.report);
  }
  if (!source.truth.empty()) input.truth = ReadPointCloud(source.truth).points;
  if (!source.region.empty()) CutRegion(source.region, &input);
  if (input.mesh) {
    const MeshTopology topology = FindMeshTopology(*input.mesh);
    if (topology.non_manifold_edges > 0) FailEdges(input.description, topology, source.repair);
    input.cloud.points = input.mesh->vertices;
    if (source.samples > 0) {
      Random random(seed);
      const std::vector<Eigen::Vector3d> samples = SampleMesh(*input.mesh, source.samples, &random);
      input.cloud.points.insert(input.cloud.points.end(), samples.begin(), samples.end());
    }
  }
  if (!source.other_wall.empty()) {
    SurfaceDocument wall = ReadSurfaceJson(source.other_wall);
    if (wall.unit != source.unit) {
      throw InputError(source.other_wall.string() + ": its unit is " + wall.unit + ", that of the input " +
                       source.unit + ": give both in one unit");
    }
    input.other_wall = std::move(wall.trimmed.surface);
  }
  if (source.points > 0 && source.points < input.cloud.points.size()) {
    input.cloud.points = DownsampleByVoxelGrid(input.cloud.points, source.points, seed);
  }
  return input;
}

RunInput LoadPhotographs(const InputSource& source, std::uint64_t seed) {
  const PhotographSource& photographs = source.photographs;
  RunInput input;
  input.report.format = "photographs";
  input.report.sha256 = PhotographDigest(photographs);
  if (source.kind == InputKind::kStereo) {
    input.description = photographs.left.empty()
                            ? photographs.boards.string()
                            : photographs.left.string() + " and " + photographs.right.string();
    input.stereo = LoadStereo(photographs);
    input.unit = input.stereo->unit;
  } else {
    input.description = (photographs.views.empty() ? photographs.board : photographs.views).string();
    input.turntable = LoadTurntable(photographs);
    input.unit = input.turntable->unit;
    input.truth = input.turntable->truth;
    if (const auto& mesh = input.turntable->truth_mesh) {  // its vertices may lie closer here than there
      Random random(seed);
      input.truth = SampleMesh(*mesh, kTruthSamples, &random);
    }
  }
  return input;
}

}  // namespace

std::vector<OptionSpec> InputSpecs(InputKind kind) {
  if (kind == InputKind::kNone) return {};
  if (kind == InputKind::kStereo) return StereoInputSpecs();
  return kind == InputKind::kTurntable ? TurntableInputSpecs() : ScanInputSpecs();
}

InputSource ReadInputSource(const ConfigFile& config, InputKind kind) {
  InputSource source;
  if (kind == InputKind::kScan) source = ReadScanSource(config);
  if (kind == InputKind::kStereo) source.photographs = ReadStereoSource(config);
  if (kind == InputKind::kTurntable) source.photographs = ReadTurntableSource(config);
  source.kind = kind;
  return source;
}

void AddInput(const InputSource& source, ResolvedConfig* resolved) {
  if (source.kind == InputKind::kNone) return;
  source.kind == InputKind::kScan ? AddScan(source, resolved) : AddPhotographs(source.photographs, resolved);
}

RunInput LoadInput(const InputSource& source, std::uint64_t seed) {
  if (source.kind == InputKind::kNone) {
    RunInput none;
    none.description = "no input";
    none.unit = "none";
    return none;
  }
  return source.kind == InputKind::kScan ? LoadScan(source, seed) : LoadPhotographs(source, seed);
}

}  // namespace frond
