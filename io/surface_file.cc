// SPDX-License-Identifier: BSD-3-Clause
#include "io/surface_file.h"

#include "io/cad_file.h"
#include "io/file_bytes.h"

namespace frond {
namespace {

[[noreturn]] void FailUnknown(const std::filesystem::path& path) {
  std::string known;
  for (const std::string& extension : SurfaceExtensions()) known += (known.empty() ? "" : ", ") + extension;
  FailFile(path, "unknown kind of surface '." + Extension(path) + "' (known: " + known + ")");
}

}  // namespace

const std::vector<std::string>& SurfaceExtensions() {
  static const std::vector<std::string> extensions = {"json", "step", "stp", "igs", "iges"};
  return extensions;
}

SurfaceDocument ReadSurface(const std::filesystem::path& path) {
  const std::string extension = Extension(path);
  if (extension == "json") return ReadSurfaceJson(path);
  if (extension == "step" || extension == "stp") return ReadStep(path);
  if (extension == "igs" || extension == "iges") return ReadIges(path);
  FailUnknown(path);
}

void WriteSurface(const std::filesystem::path& path, const SurfaceDocument& document) {
  const std::string extension = Extension(path);
  if (extension == "json") return WriteSurfaceJson(path, document);
  if (extension == "step" || extension == "stp") return WriteStep(path, document);
  if (extension == "igs" || extension == "iges") return WriteIges(path, document);
  FailUnknown(path);
}

}  // namespace frond
