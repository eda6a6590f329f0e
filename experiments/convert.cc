// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/convert.h"

#include <algorithm>
#include <string>
#include <vector>

#include "base/errors.h"
#include "io/curve_file.h"
#include "io/file_bytes.h"
#include "io/mesh_file.h"
#include "io/point_cloud_file.h"
#include "io/surface_file.h"
#include "models/tessellation.h"

namespace frond {
namespace {

constexpr int kSegmentsPerSpan = 8;

bool In(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string Joined(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
  return all;
}

void ConvertSurface(const std::filesystem::path& in, const std::filesystem::path& out) {
  const SurfaceDocument document = ReadSurface(in);
  if (In(SurfaceExtensions(), Extension(out))) {
    WriteSurface(out, document);
  } else if (In(MeshWriteExtensions(), Extension(out))) {
    WriteMesh(out, Tessellate(document.trimmed, kSegmentsPerSpan), document.unit);
  } else {
    throw ConfigError(out.string() + ": a surface is written as " + Joined(SurfaceExtensions()) +
                      " or, as a mesh, " + Joined(MeshWriteExtensions()));
  }
}

void ConvertCurve(const std::filesystem::path& in, const std::filesystem::path& out) {
  if (!In(CurveWriteExtensions(), Extension(out))) {
    throw ConfigError(out.string() + ": a curve is written as " + Joined(CurveWriteExtensions()));
  }
  WriteCurve(out, ReadCurve(in));
}

}  // namespace

void Convert(const std::filesystem::path& in, const std::filesystem::path& out) {
  const std::string from = Extension(in), to = Extension(out);
  if (In(SurfaceExtensions(), from)) {
    return IsCurveFile(in) ? ConvertCurve(in, out) : ConvertSurface(in, out);
  }
  const std::vector<std::string> text = {"xyz", "asc", "csv", "txt"};
  const bool mesh_in = In(MeshReadExtensions(), from), cloud_in = In(CloudExtensions(), from);
  if (!mesh_in && !cloud_in) {
    throw InputError(in.string() + ": unknown format '" + from + "'; known: " + Joined(SurfaceExtensions()) +
                     ", " + Joined(CloudExtensions()));
  }
  if (cloud_in && In(text, to)) return WritePointCloud(out, ReadPointCloud(in));
  if (mesh_in && In(MeshWriteExtensions(), to)) {
    const SurfaceMesh mesh = ReadMesh(in);
    if (!mesh.triangles.empty()) return WriteMesh(out, mesh, "mm");
  }
  if (cloud_in && to == "ply") return WritePointCloud(out, ReadPointCloud(in));
  throw ConfigError(out.string() + ": cannot convert ." + from + " to ." + to +
                    "; clouds become ply, xyz, asc, csv or txt, meshes " + Joined(MeshWriteExtensions()));
}

}  // namespace frond
