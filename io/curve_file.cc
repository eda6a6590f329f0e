// SPDX-License-Identifier: BSD-3-Clause
#include "io/curve_file.h"

#include "io/cad_file.h"
#include "io/file_bytes.h"
#include "io/number_text.h"
#include "io/point_cloud_file.h"
#include "models/curve_spans.h"

namespace frond {
namespace {

constexpr int kPolylinePerSpan = 16;

[[noreturn]] void FailUnknown(const std::filesystem::path& path) {
  std::string known;
  for (const std::string& extension : CurveWriteExtensions()) {
    known += (known.empty() ? "" : ", ") + extension;
  }
  FailFile(path, "unknown kind of curve '." + Extension(path) + "' (known: " + known + ")");
}

bool IsStep(const std::string& extension) { return extension == "step" || extension == "stp"; }
bool IsIges(const std::string& extension) { return extension == "igs" || extension == "iges"; }

std::string ObjOf(const std::vector<Eigen::Vector3d>& polyline) {
  std::string text, line = "l";
  for (std::size_t i = 0; i < polyline.size(); ++i) {
    text += "v";
    for (const double value : polyline[i]) text += " " + FormatNumber(value);
    text += "\n";
    line += " " + std::to_string(i + 1);
  }
  return text + line + "\n";
}

}  // namespace

const std::vector<std::string>& CurveWriteExtensions() {
  static const std::vector<std::string> extensions = {"json", "step", "stp", "igs", "iges", "ply", "obj"};
  return extensions;
}

bool IsCurveFile(const std::filesystem::path& path) {
  const std::string extension = Extension(path);
  if (extension == "json") return IsCurveJson(path);
  return (IsStep(extension) || IsIges(extension)) && !HasFaces(path);
}

CurveDocument ReadCurve(const std::filesystem::path& path) {
  const std::string extension = Extension(path);
  if (extension == "json") return ReadCurveJson(path);
  if (IsStep(extension)) return ReadStepCurve(path);
  if (IsIges(extension)) return ReadIgesCurve(path);
  FailUnknown(path);
}

void WriteCurve(const std::filesystem::path& path, const CurveDocument& document) {
  const std::string extension = Extension(path);
  if (extension == "json") return WriteCurveJson(path, document);
  if (IsStep(extension)) return WriteStep(path, document);
  if (IsIges(extension)) return WriteIges(path, document);
  if (extension != "ply" && extension != "obj") FailUnknown(path);
  const std::vector<Eigen::Vector3d> polyline = CurvePolyline(CurveSpans(document.curve), kPolylinePerSpan);
  if (extension == "ply") return WritePointCloud(path, {polyline});
  WriteFileBytes(path, ObjOf(polyline));
}

}  // namespace frond
