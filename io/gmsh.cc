// SPDX-License-Identifier: BSD-3-Clause
#include "io/gmsh.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <sstream>
#include <string_view>

#include "base/errors.h"
#include "io/cad_file.h"
#include "io/child_process.h"
#include "io/file_bytes.h"
#include "io/number_text.h"
#include "io/shell_section.h"

namespace frond {
namespace {

namespace fs = std::filesystem;

// Names that Open CASCADE, and so Gmsh, gives our units.
const std::map<std::string, std::string>& GmshUnits() {
  static const std::map<std::string, std::string> units = {
      {"um", "UM"}, {"mm", "MM"}, {"cm", "CM"}, {"m", "M"}, {"km", "KM"}, {"in", "INCH"}, {"ft", "FT"}};
  return units;
}

std::string Script(const GmshOptions& options, const std::string& unit) {
  const std::string size = FormatNumber(options.size), order = std::to_string(options.order);
  const std::string dimension = options.volume ? "3" : "2";
  std::string script =
      "General.NumThreads = 1;\n"
      "Mesh.RandomSeed = 1;\n"
      "SetFactory(\"OpenCASCADE\");\n"
      "Geometry.OCCTargetUnit = \"" +
      GmshUnits().at(unit) +
      "\";\n"
      "Mesh.MeshSizeMin = " +
      size + ";\nMesh.MeshSizeMax = " + size + ";\nMesh.ElementOrder = " + order +
      ";\n"
      "Mesh.Optimize = 1;\n"
      "Mesh.HighOrderOptimize = " +  // 1: nodes are moved until no element is inside out
      (options.order == 2 ? "1" : "0") +
      ";\n"
      "Mesh.HighOrderThresholdMin = 0.5;\n"  // of the least to the largest Jacobian in an element
      "Merge \"surface.step\";\n";
  script += options.volume ? "parts[] = Volume{:};\nPhysical Volume(\"volume\", 1) = parts[];\n"
                           : "parts[] = Surface{:};\nPhysical Surface(\"surface\", 1) = parts[];\n";
  script += "Mesh " + dimension + ";\nMesh.BdfFieldFormat = 2;\n";  // 2: fields of 16 columns
  for (const std::string& format : options.formats) script += "Save \"mesh." + format + "\";\n";
  script += "Save \"check.msh2\";\n";
  script += "Print.PostElementary = 0;\nPrint.PostElement = 0;\nPrint.PostGamma = 0;\nPrint.PostEta = 0;\n";
  script += "Print.PostDisto = 0;\nPrint.PostSICN = 1;\nSave \"sicn.pos\";\n";
  return script;
}

ChildResult RunGmsh(const std::vector<std::string>& arguments, const fs::path& folder) {
  // GMSH_HOME, or else HOME, is where Gmsh would look for a user's settings.
  ChildResult result =
      RunChild("gmsh", arguments, folder, {{"GMSH_HOME", "."}, {"HOME", "."}, {"LC_ALL", "C"}});
  if (!result.found) {
    throw ConfigError("there is no program 'gmsh' on PATH; install the package gmsh");
  }
  return result;
}

std::string Trimmed(std::string text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0) text.pop_back();
  return text;
}

std::string Version(const fs::path& folder) {
  const ChildResult child = RunGmsh({"--version"}, folder);
  if (child.exit_code == 0) return Trimmed(child.output);
  const std::string line = Trimmed(child.output.substr(0, child.output.find('\n')));
  throw ConfigError("gmsh does not run: 'gmsh --version' ends with " +
                    (child.signal != 0 ? "signal " + std::to_string(child.signal)
                                       : "exit code " + std::to_string(child.exit_code)) +
                    (line.empty() ? "" : " (" + line + ")") + "; install the package gmsh anew");
}

// What a failed run says: Gmsh's first line "Error   : …". That its optimiser of curved elements fell short
// of its own aim is none: the elements are judged afterwards.
std::string FirstError(const std::string& output) {
  std::istringstream lines(output);
  std::string line;
  while (std::getline(lines, line)) {
    const std::size_t at = line.find("Error ");
    if (at == std::string::npos || line.find("Failed to reach critical value") != std::string::npos) continue;
    const std::size_t colon = line.find(": ", at);
    return Trimmed(line.substr(colon == std::string::npos ? at : colon + 2));
  }
  return "";
}

// The value of each line "SS(x, y, z, …){0.93, 0.93, …};" of Gmsh's format pos.
std::vector<double> ParsePos(const std::string& text) {
  std::vector<double> values;
  std::istringstream lines(text);
  std::string line;
  while (std::getline(lines, line)) {
    const std::size_t at = line.find("){");
    double value = 0;
    if (line[0] == 'S' && at != std::string::npos &&
        ParseNumber(std::string_view(line).substr(at + 2), &value) > 0) {
      values.push_back(value);
    }
  }
  return values;
}

}  // namespace

const std::vector<std::string>& FeMeshFormats() {
  static const std::vector<std::string> formats = {"msh", "inp", "bdf", "unv", "vtk"};
  return formats;
}

GmshMesh MeshByGmsh(const SurfaceDocument& document, const GmshOptions& options, const fs::path& folder) {
  GmshMesh result;
  result.version = Version(folder);
  WriteStep(folder / "surface.step", document);
  WriteFileBytes(folder / "mesh.geo", Script(options, document.unit));
  const ChildResult child = RunGmsh({"mesh.geo", "-", "-nopopup", "-v", "2"}, folder);
  if (child.signal != 0) {
    throw FitError("gmsh was killed by signal " + std::to_string(child.signal) +
                   " (out of memory? take a larger --size)");
  }
  const std::string error = FirstError(child.output);
  if (!error.empty() || child.exit_code != 0) {
    throw FitError("Gmsh cannot mesh the surface: " +
                   (error.empty() ? "exit code " + std::to_string(child.exit_code) : error) +
                   "; try a smaller --size");
  }
  result.sicn = ParsePos(ReadFileBytes(folder / "sicn.pos"));
  try {
    result.mesh = ParseMsh2(ReadFileBytes(folder / "check.msh2"), "Gmsh's mesh");
  } catch (const InputError& error) {  // Gmsh leaves out what it cannot mesh without a word
    throw FitError(error.what() + std::string("; try a smaller --size"));
  }
  if (result.mesh.dimension != (options.volume ? 3 : 2) || result.sicn.size() != result.mesh.NumElements()) {
    throw FitError("Gmsh made no whole mesh of the surface; try another --size");
  }
  const auto inside_out =
      std::count_if(result.sicn.begin(), result.sicn.end(), [](double s) { return s <= 0; });
  if (inside_out > 0) {
    throw FitError("the mesh has " + std::to_string(inside_out) +
                   " elements that are inside out; try a smaller --size, or --order=1");
  }
  for (const std::string& format : options.formats) {
    const fs::path path = folder / ("mesh." + format);
    if (format == "inp" && !options.volume) WriteFileBytes(path, WithShellElements(ReadFileBytes(path)));
  }
  return result;
}

}  // namespace frond
