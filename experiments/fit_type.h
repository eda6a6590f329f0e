// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/options.h"
#include "base/stage_clock.h"
#include "experiments/run_input.h"
#include "io/metrics_json.h"
#include "models/nurbs_curve.h"
#include "models/nurbs_surface.h"
#include "models/tessellation.h"
#include "solvers/solver.h"

namespace frond {

// A mesh over the fitted surface and its standard deviation along the normal, by vertex.
struct UncertaintyMap {
  SurfaceMesh mesh;
  std::vector<double> standard_deviation;
};

// A file of one kind of fit, beside those that all runs have.
struct RunFile {
  std::string name;  // in the run directory
  std::function<void(const std::filesystem::path& path)> write;
};

// What one fit gives back, in the input's coordinates and unit.
struct FitOutcome {
  std::optional<TrimmedSurface> surface;
  std::optional<NurbsCurve> curve;
  MetricTable metrics;
  std::optional<SolverReport> report;    // none where no solver was needed
  std::optional<PointCloud> cloud = {};  // made of photographs: it stands for the input's
  std::vector<double> signed_distances;  // by input point; may be empty where there is no surface
  std::vector<std::uint8_t> outlier;     // likewise
  std::optional<UncertaintyMap> uncertainty;
  std::vector<StageTime> stages;
  std::vector<std::string> warnings;
  std::vector<RunFile> files = {};
};

// How a fit is run: with a solver's own context it takes a place to tell how far long work is.
struct RunContext : SolveContext {
  std::function<void(const std::string& line)> progress = {};  // "pair 3 of 24"; empty: nobody looks
};

using OptionDefaults = std::vector<std::pair<std::string, OptionValue>>;

// What `output.formats` may hold for a surface, and for a curve (ply and obj: a polyline).
const std::vector<std::string>& SurfaceFormats();
const std::vector<std::string>& CurveFormats();

// A registered fit: its name in configs (`problem.type`), its options, and how to run it.
struct FitType {
  std::string name;
  std::string help;
  std::vector<OptionSpec> options;
  // Options whose default hangs on another one's value; set where the config leaves them out. May be empty.
  std::function<OptionDefaults(const Options& problem)> dependent_defaults = {};
  // Defaults of a solver's options that suit this fit with these options.
  std::function<OptionDefaults(const Options& problem, const std::string& solver)> solver_defaults;
  // Checks what single options cannot tell; throws ConfigError.
  std::function<void(const Options& problem)> check;
  // Checks what hangs on the files that are named too; throws ConfigError. May be empty.
  std::function<void(const InputSource& input, const Options& problem)> check_input = {};
  // Checks that the named solver can be of use; throws ConfigError. May be empty.
  std::function<void(const Options& problem, const std::string& solver)> check_solver = {};
  std::function<FitOutcome(const RunInput& input, const Options& problem, const Solver& solver,
                           const Budget& budget, const RunContext& context)>
      run;
  std::vector<std::string> formats = SurfaceFormats();  // of its result; empty: neither surface nor curve
  InputKind input = InputKind::kScan;
  bool has_walls = false;  // makes use of `input.other_wall`
};

// All fits, sorted by name. A new one is one file and one line in fit_type.cc.
const std::vector<FitType>& FitTypes();

// Throws ConfigError naming the unknown fit and the nearest known one.
const FitType& FindFitType(const std::string& name);

}  // namespace frond
