// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/mesh_run.h"

#include <unistd.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "base/errors.h"
#include "io/cad_file.h"
#include "io/file_bytes.h"
#include "io/gmsh.h"
#include "io/number_text.h"
#include "io/shell_section.h"
#include "io/surface_file.h"
#include "models/tessellation.h"

namespace frond {
namespace {

namespace fs = std::filesystem;

constexpr const char* kQualityName = "mesh_quality.json";

std::string Joined(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
  return all;
}

bool In(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

void CheckLength(const std::string& flag, double length) {
  if (!(length > 0) || !std::isfinite(length)) {
    throw ConfigError("flag '" + flag + "' must be positive and finite");
  }
}

void CheckOptions(const MeshRunOptions& options) {
  if (options.order != 1 && options.order != 2) throw ConfigError("flag '--order' must be 1 or 2");
  if (options.size) CheckLength("--size", *options.size);
  if (options.formats.empty()) {
    throw ConfigError("flag '--format' names no format; known: " + Joined(FeMeshFormats()));
  }
  for (std::size_t k = 0; k < options.formats.size(); ++k) {
    const std::string& format = options.formats[k];
    if (std::find(options.formats.begin(), options.formats.begin() + static_cast<std::ptrdiff_t>(k),
                  format) != options.formats.begin() + static_cast<std::ptrdiff_t>(k)) {
      throw ConfigError("flag '--format' names '" + format + "' twice");
    }
    if (!In(FeMeshFormats(), format)) {
      throw ConfigError("flag '--format': unknown format '" + format +
                        "'; known: " + Joined(FeMeshFormats()));
    }
    if (options.shell_thickness && !In(ShellSectionFormats(), format)) {
      throw ConfigError("flag '--shell-thickness': a ." + format + " file holds no shell sections; use " +
                        "--format=inp or --format=bdf");
    }
  }
  if (!options.shell_thickness) return;
  if (options.volume) throw ConfigError("flag '--shell-thickness' goes with shells, not with --volume");
  CheckLength("--shell-thickness", *options.shell_thickness);
}

fs::path SurfacePath(const fs::path& run) {
  if (!fs::exists(run)) throw InputError(run.string() + ": no such run");
  if (!fs::is_directory(run)) return run;
  for (const char* name : {"surface.json", "surface.step"}) {
    if (fs::exists(run / name)) return run / name;
  }
  throw InputError(run.string() + ": holds neither surface.json nor surface.step; is it a run of a surface?");
}

std::vector<std::string> FileNames(const MeshRunOptions& options) {
  std::vector<std::string> names;
  for (const std::string& format : options.formats) names.push_back("mesh." + format);
  return names;
}

// All that any mesh of the folder may have written; the quality file first.
std::vector<std::string> OldNames() {
  std::vector<std::string> names = {kQualityName};
  for (const std::string& format : FeMeshFormats()) names.push_back("mesh." + format);
  return names;
}

void RefuseExisting(const fs::path& folder, const MeshRunOptions& options) {
  std::vector<std::string> names = options.overwrite ? OldNames() : FileNames(options);
  if (!options.overwrite) names.emplace_back(kQualityName);
  for (const std::string& name : names) {
    const fs::path file = folder / name;
    if (options.overwrite && fs::is_directory(file)) {
      throw ConfigError(file.string() + ": is a folder, not replaced; give another place by --out");
    }
    if (!options.overwrite && fs::exists(file)) {
      throw ConfigError(file.string() +
                        ": exists already; give --overwrite to replace it, or another folder by --out");
    }
  }
}

void RemoveOld(const fs::path& folder) {
  for (const std::string& name : OldNames()) {
    std::error_code error;
    fs::remove(folder / name, error);
    if (error) throw InputError((folder / name).string() + ": cannot be replaced: " + error.message());
  }
}

double DefaultSize(const TrimmedSurface& surface) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& vertex : Tessellate(surface, 4).vertices) box.extend(vertex);
  return box.diagonal().norm() / 20;
}

// Gmsh would work for hours. Regular triangles have √3/4 of size² each, tetrahedra in a mesh about 0.12 of
// size³.
void RefuseTooSmall(double size, const CadCheck& shape, const SurfaceDocument& document, bool volume) {
  constexpr double kMost = 2e7;
  double elements = shape.area / (0.433 * size * size);
  if (volume) elements = std::max(elements, shape.volume / (0.12 * size * size * size));
  if (elements <= kMost) return;
  throw ConfigError("flag '--size': " + FormatNumber(size) + " " + document.unit +
                    " would make more than 20 million elements; the default is " +
                    FormatNumber(DefaultSize(document.trimmed)) + " " + document.unit);
}

// Where elements are as large as the object, Gmsh may leave out most of it without a word.
void RefuseMostlyEmpty(const MeshQuality& quality, const CadCheck& shape) {
  const double share = quality.measure / (quality.volume ? shape.volume : shape.area);
  if (share >= 0.5) return;
  throw FitError("the mesh covers " + std::to_string(static_cast<int>(100 * share)) + " % of the surface's " +
                 (quality.volume ? "volume" : "area") + "; take a smaller --size");
}

// A hidden folder inside the target, so that finished files are renamed, not copied. Folders that were made
// for it go with it where they stay empty.
class WorkingFolder {
 public:
  explicit WorkingFolder(const fs::path& parent)
      : path_(parent / (".mesh.partial-" + std::to_string(::getpid()))) {
    std::error_code error;
    for (fs::path above = parent; !above.empty() && !fs::exists(above, error); above = above.parent_path()) {
      made_.push_back(above);
    }
    fs::create_directories(path_, error);
    if (error) throw InputError(path_.string() + ": cannot be made: " + error.message());
  }
  ~WorkingFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
    for (const fs::path& folder : made_) fs::remove(folder, ignored);
  }
  WorkingFolder(const WorkingFolder&) = delete;
  WorkingFolder& operator=(const WorkingFolder&) = delete;

  const fs::path& path() const { return path_; }

  void Release(const std::string& name) const {
    std::error_code error;
    const fs::path target = path_.parent_path() / name;
    fs::rename(path_ / name, target, error);
    if (error) throw InputError(target.string() + ": cannot be written: " + error.message());
  }

 private:
  fs::path path_;
  std::vector<fs::path> made_;  // innermost first
};

MeshQuality QualityOf(const GmshMesh& mesh, const MeshRunOptions& options, const std::string& unit,
                      double size) {
  MeshQuality quality;
  quality.files = FileNames(options);
  quality.unit = unit;
  quality.gmsh = mesh.version;
  quality.volume = options.volume;
  quality.order = options.order;
  quality.size = size;
  quality.shell_thickness = options.shell_thickness;
  quality.nodes = mesh.mesh.nodes.size();
  quality.elements = mesh.mesh.NumElements();
  const auto count = static_cast<double>(mesh.sicn.size());
  quality.min_sicn = *std::min_element(mesh.sicn.begin(), mesh.sicn.end());
  quality.mean_sicn = std::accumulate(mesh.sicn.begin(), mesh.sicn.end(), 0.0) / count;
  const auto bad = std::count_if(mesh.sicn.begin(), mesh.sicn.end(), [](double s) { return s < 0.1; });
  quality.below_0_1 = static_cast<std::size_t>(bad);
  quality.measure = Measure(mesh.mesh);
  return quality;
}

std::string FormatQuality(const MeshQuality& quality) {
  nlohmann::ordered_json json;
  json["schema"] = "frond.mesh_quality/1";
  json["unit"] = quality.unit;
  json["files"] = quality.files;
  json["element"] = quality.volume ? "tetrahedron" : "triangle";
  json["order"] = quality.order;
  json["size"] = quality.size;
  json["shell_thickness"] = nullptr;
  if (quality.shell_thickness) json["shell_thickness"] = *quality.shell_thickness;
  json["nodes"] = quality.nodes;
  json["elements"] = quality.elements;
  json["min_sicn"] = quality.min_sicn;
  json["mean_sicn"] = quality.mean_sicn;
  json["below_0.1"] = quality.below_0_1;
  json[quality.volume ? "volume" : "area"] = quality.measure;
  json["gmsh"] = quality.gmsh;
  return json.dump(2) + "\n";
}

}  // namespace

MeshRunOutcome MeshRun(const fs::path& run, const MeshRunOptions& options) {
  CheckOptions(options);
  const fs::path path = SurfacePath(run);
  const fs::path folder = options.out.empty() ? path.parent_path() : options.out;
  RefuseExisting(folder, options);
  const SurfaceDocument document = ReadSurface(path);
  const CadCheck shape = CheckShape(document);
  if (options.volume && shape.solids == 0) {
    throw InputError(path.string() + ": the surface is open; --volume needs a closed one");
  }
  const double size = options.size.value_or(DefaultSize(document.trimmed));
  RefuseTooSmall(size, shape, document, options.volume);
  const WorkingFolder working(folder.empty() ? "." : folder);
  const GmshOptions gmsh{size, options.order, options.volume, options.formats};
  const GmshMesh mesh = MeshByGmsh(document, gmsh, working.path());
  MeshRunOutcome outcome{folder, QualityOf(mesh, options, document.unit, size)};
  RefuseMostlyEmpty(outcome.quality, shape);
  for (const std::string& format : options.formats) {
    if (!options.shell_thickness) break;
    const fs::path file = working.path() / ("mesh." + format);
    WriteFileBytes(file, WithShellSection(ReadFileBytes(file), format, *options.shell_thickness));
  }
  WriteFileBytes(working.path() / kQualityName, FormatQuality(outcome.quality));
  RefuseExisting(folder, options);  // as it is by now
  if (options.overwrite) RemoveOld(folder);
  for (const std::string& name : outcome.quality.files) working.Release(name);
  working.Release(kQualityName);
  return outcome;
}

}  // namespace frond
