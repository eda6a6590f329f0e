// SPDX-License-Identifier: BSD-3-Clause
#include "apps/listing.h"

#include <algorithm>
#include <iomanip>

#include "base/errors.h"
#include "experiments/experiment.h"
#include "experiments/fit_type.h"
#include "experiments/study/study_sets.h"
#include "experiments/synth.h"
#include "io/gmsh.h"
#include "io/mesh_file.h"
#include "io/point_cloud_file.h"
#include "io/surface_file.h"
#include "solvers/solver.h"

namespace frond {
namespace {

void PrintOptions(const std::string& name, const std::string& help, const std::vector<OptionSpec>& options,
                  std::ostream& out) {
  out << name << ": " << help << "\n";
  for (const OptionSpec& spec : options) {
    out << "  " << spec.name << " = " << FormatValue(spec.default_value) << "  (" << DescribeAccepted(spec)
        << ")\n"
        << "      " << spec.help << "\n";
  }
}

void PrintNames(const std::string& title, const std::vector<std::string>& names, std::ostream& out) {
  out << "  " << std::left << std::setw(20) << title;
  for (std::size_t k = 0; k < names.size(); ++k) out << (k > 0 ? ", " : "") << names[k];
  out << "\n";
}

template <typename Types>
void PrintTypes(const std::string& title, const Types& types, std::ostream& out) {
  out << title << "\n";
  for (const auto& type : types) out << "  " << std::left << std::setw(20) << type.name << type.help << "\n";
}

void PrintFormats(std::ostream& out) {
  out << "formats\n";
  PrintNames("clouds", CloudExtensions(), out);
  PrintNames("surfaces", SurfaceExtensions(), out);
  PrintNames("meshes", MeshWriteExtensions(), out);
  PrintNames("finite elements", FeMeshFormats(), out);
  PrintNames("output.formats", SurfaceFormats(), out);
}

}  // namespace

void PrintList(const std::string& what, std::ostream& out) {
  std::vector<std::string> names = {"fits", "solvers", "sets", "synth", "formats"};
  if (what.empty() || what == "fits") PrintTypes("fits (problem.type)", FitTypes(), out);
  if (what.empty() || what == "solvers") PrintTypes("solvers (solver.type)", SolverTypes(), out);
  if (what.empty() || what == "sets")
    PrintTypes("problem sets (problems.NAME.set of a study)", StudySetTypes(), out);
  if (what.empty() || what == "synth") PrintTypes("synthetic scans (frond synth)", SynthKinds(), out);
  if (what == "synth") {
    for (const SynthKind& kind : SynthKinds())
      PrintOptions("synth " + kind.name, kind.help, kind.options, out);
  }
  if (what.empty() || what == "formats") PrintFormats(out);
  if (what.empty()) out << "`frond list NAME` gives one's options\n";
  if (what.empty() || std::find(names.begin(), names.end(), what) != names.end()) return;
  bool found = false;
  const auto print_matching = [&](const auto& types) {
    for (const auto& type : types) {
      names.push_back(type.name);
      if (type.name != what) continue;
      PrintOptions(type.name, type.help, type.options, out);
      found = true;
    }
  };
  print_matching(FitTypes());
  print_matching(SolverTypes());
  print_matching(StudySetTypes());
  if (!found) print_matching(SynthKinds());
  if (what == "leaf") out << "(`frond list synth` gives the options of synthetic leaves)\n";
  if (found) return;
  const std::string nearest = NearestWord(what, names);
  throw ConfigError("list: nothing is named '" + what + "'" +
                    (nearest.empty() ? "" : " (did you mean '" + nearest + "'?)"));
}

}  // namespace frond
