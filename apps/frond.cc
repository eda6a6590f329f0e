// SPDX-License-Identifier: BSD-3-Clause
// frond COMMAND [CONFIG] [--flags]: parses, calls experiments/, and turns exceptions into exit codes.
#include <gflags/gflags.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <iostream>
#include <limits>
#include <new>
#include <sstream>
#include <thread>

#include "apps/command_line.h"
#include "apps/listing.h"
#include "apps/summary.h"
#include "base/errors.h"
#include "experiments/convert.h"
#include "experiments/experiment.h"
#include "experiments/mesh_run.h"
#include "experiments/message.h"
#include "experiments/study/study.h"
#include "experiments/sweep.h"
#include "experiments/synth.h"
#include "experiments/version.h"

DEFINE_string(set, "", "Config values, \"a.b=1; c.d=[2, 3]\"");
DEFINE_string(out, "", "Where to write; a run directory: runs/NAME");
DEFINE_bool(overwrite, false, "Replace an existing run directory");
DEFINE_int32(threads, 0, "Threads; 0: all cores. Results do not depend on it");
DEFINE_uint64(seed, 0, "Seed instead of the config's");
DEFINE_double(size, 0, "mesh: size of elements, in the surface's unit");
DEFINE_int32(order, 1, "mesh: order of elements, 1 or 2");
DEFINE_string(format, "msh", "mesh: msh, inp, bdf, unv, vtk; or several, comma between");
DEFINE_bool(volume, false, "mesh: tetrahedra inside a closed surface");
DEFINE_double(shell_thickness, 0, "mesh: thickness of the shell section, for inp and bdf");
DEFINE_bool(quiet, false, "No progress, no summary");

namespace frond {
namespace {

enum ExitCode { kDone = 0, kUsage = 2, kInput = 3, kFit = 4, kInternal = 5 };

constexpr auto kMaxSeed = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());

constexpr char kHelp[] = R"(frond: scans of natural objects to exact CAD surfaces

usage: frond COMMAND [ARGUMENTS] [--flags]

  fit CONFIG      fit one scan, or match and merge photographs (or all runs of a config's sweep), and write a
                  run directory
  study CONFIG [FOLDER...]
                  compare solvers: problems x solvers x repetitions, then tables, profiles, tests; goes on where
                  it was stopped; takes over results from FOLDERs of the same study run elsewhere
  report FOLDER   write the report of a study again
  check CONFIG    say whether a config is right, without running it
  list [NAME]     fits, solvers, problem sets, synthetic scans and formats; or one's options
  synth KIND      make a synthetic scan with its truth: leaf, cylinder, cone, sphere, torus, turntable
  mesh RUN        finite elements on a run's surface, or inside it (by Gmsh, package gmsh): RUN/mesh.FORMAT
  convert IN OUT  surfaces, curves, clouds and meshes from one format to another

  --set="a.b=1; c.d=[2, 3]"  config values (synth: its options); may be repeated
  --out=PATH                 where to write (runs/NAME)
  --overwrite                replace an existing run directory (study: begin anew)
  --threads=N                threads; 0: all cores. Results do not depend on it
  --seed=N                   seed, instead of the config's
  --quiet                    no progress, no summary

  of mesh (--out is a folder):
  --size=LENGTH              of elements, in the surface's unit; default 1/20 of its diagonal
  --order=1|2                linear or quadratic elements (1)
  --format=FORMAT[,FORMAT]   msh, inp, bdf, unv, vtk (msh)
  --volume                   tetrahedra inside a closed surface
  --shell-thickness=LENGTH   a shell section of this thickness, in inp and bdf

  --version, --help

exit codes: 0 done; 2 usage or config; 3 input data or output; 4 the fit failed; 5 internal
)";

bool IsGiven(const char* flag) { return !gflags::GetCommandLineFlagInfoOrDie(flag).is_default; }

RunFlags Flags() {
  if (FLAGS_threads < 0 || FLAGS_threads > 1024) throw ConfigError("flag '--threads' must be in [0, 1024]");
  RunFlags flags;
  flags.set = FLAGS_set;
  if (FLAGS_seed > kMaxSeed) throw ConfigError("flag '--seed' must be in [0, 9223372036854775807]");
  if (IsGiven("seed")) flags.seed = FLAGS_seed;
  const auto cores = static_cast<int>(std::thread::hardware_concurrency());
  flags.threads = FLAGS_threads > 0 ? FLAGS_threads : std::max(1, cores);
  return flags;
}

void CheckCount(const std::vector<std::string>& arguments, std::size_t least, std::size_t most,
                const std::string& usage) {
  if (arguments.size() - 1 < least || arguments.size() - 1 > most) throw ConfigError("usage: frond " + usage);
}

void Fit(const std::vector<std::string>& arguments) {
  CheckCount(arguments, 1, 1, "fit CONFIG [--set=…] [--out=DIR] [--overwrite]");
  const bool progress = !FLAGS_quiet && isatty(STDERR_FILENO) != 0;
  const std::filesystem::path folder = FitConfig(arguments[1], Flags(), FLAGS_out, FLAGS_overwrite, progress);
  if (!FLAGS_quiet) PrintSummary(folder, std::cout);
}

void Study(const std::vector<std::string>& arguments) {
  CheckCount(arguments, 1, 1000, "study CONFIG [FOLDER...] [--set=…] [--out=DIR] [--overwrite]");
  const bool progress = !FLAGS_quiet && isatty(STDERR_FILENO) != 0;
  const RunFlags flags = Flags();
  const StudyRunOptions options{.workers = flags.threads,
                                .overwrite = FLAGS_overwrite,
                                .progress = progress,
                                .merge = {arguments.begin() + 2, arguments.end()}};
  const StudyOutcome outcome = RunStudy(arguments[1], flags, FLAGS_out, options);
  if (outcome.missing > 0) {
    PrintMessage(outcome.folder.string() + ": " + std::to_string(outcome.missing) + " of " +
                 std::to_string(outcome.jobs) +
                 " jobs have no result yet; run the other parts, then the study with their folders");
  }
  if (outcome.failed > 0) {
    PrintMessage("warning: " + std::to_string(outcome.failed) + " of " + std::to_string(outcome.jobs) +
                 " jobs failed; see " +
                 (outcome.folder / (outcome.missing > 0 ? "jobs" : "runs.csv")).string());
  }
  if (!FLAGS_quiet) std::cout << outcome.text << outcome.folder.string() << "\n";
}

void Report(const std::vector<std::string>& arguments) {
  CheckCount(arguments, 1, 1, "report FOLDER");
  const StudyOutcome outcome = ReportStudy(arguments[1]);
  if (!FLAGS_quiet) std::cout << outcome.text << outcome.folder.string() << "\n";
}

void Check(const std::vector<std::string>& arguments) {
  CheckCount(arguments, 1, 1, "check CONFIG [--set=…]");
  const std::size_t runs = CheckConfig(arguments[1], Flags());
  if (!FLAGS_quiet) {
    std::cout << arguments[1] << ": right" << (runs > 1 ? ", " + std::to_string(runs) + " runs" : "") << "\n";
  }
}

void List(const std::vector<std::string>& arguments) {
  CheckCount(arguments, 0, 1, "list [NAME]");
  PrintList(arguments.size() > 1 ? arguments[1] : "", std::cout);
}

void Synth(const std::vector<std::string>& arguments) {
  CheckCount(
      arguments, 1, 1,
      "synth KIND [--seed=N] [--set=…] [--out=DIR]; KIND: leaf, cylinder, cone, sphere, torus, turntable");
  const RunFlags flags = Flags();
  const std::filesystem::path folder =
      Synthesise(arguments[1], FLAGS_set, flags.seed.value_or(1), FLAGS_out, FLAGS_overwrite, flags.threads);
  if (!FLAGS_quiet) std::cout << folder.string() << "\n";
}

std::vector<std::string> SplitAtCommas(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, ',');) parts.push_back(part);
  return parts;
}

void Mesh(const std::vector<std::string>& arguments) {
  CheckCount(arguments, 1, 1,
             "mesh RUN [--size=…] [--order=1|2] [--format=…] [--volume] [--shell-thickness=…] [--out=DIR] "
             "[--overwrite]");
  MeshRunOptions options{.order = FLAGS_order,
                         .volume = FLAGS_volume,
                         .formats = SplitAtCommas(FLAGS_format),
                         .out = FLAGS_out,
                         .overwrite = FLAGS_overwrite};
  if (IsGiven("size")) options.size = FLAGS_size;
  if (IsGiven("shell_thickness")) options.shell_thickness = FLAGS_shell_thickness;
  const auto [folder, mesh] = MeshRun(arguments[1], options);
  if (FLAGS_quiet) return;
  std::cout << "mesh: " << mesh.nodes << " nodes, " << mesh.elements
            << (mesh.volume ? " tetrahedra" : " triangles") << " of order " << mesh.order << ", size "
            << mesh.size << " " << mesh.unit << ", SICN min " << mesh.min_sicn << " mean " << mesh.mean_sicn
            << ", " << (mesh.volume ? "volume " : "area ") << mesh.measure << " " << mesh.unit
            << (mesh.volume ? "^3" : "^2") << "\n";
  for (const std::string& file : mesh.files) std::cout << (folder / file).string() << "\n";
}

// Flags of `mesh` mean nothing elsewhere, nor flags of runs to `mesh`.
void RefuseForeignFlags(const std::string& command) {
  for (const char* flag : {"set", "seed", "threads"}) {
    if (command == "mesh" && IsGiven(flag)) {
      throw ConfigError(std::string("flag '--") + flag + "' means nothing to frond mesh; leave it out");
    }
  }
  for (const char* flag : {"size", "order", "format", "volume", "shell_thickness"}) {
    if (command != "mesh" && IsGiven(flag)) {
      std::string name = flag;
      std::replace(name.begin(), name.end(), '_', '-');
      throw ConfigError("flag '--" + name + "' is of frond mesh, not of frond " + command);
    }
  }
}

void ConvertFiles(const std::vector<std::string>& arguments) {
  CheckCount(arguments, 2, 2, "convert IN OUT");
  Convert(arguments[1], arguments[2]);
}

void Dispatch(const std::vector<std::string>& arguments) {
  struct Command {
    const char* name;
    void (*run)(const std::vector<std::string>&);
  };
  constexpr Command kCommands[] = {{"fit", Fit},     {"study", Study},         {"report", Report},
                                   {"check", Check}, {"list", List},           {"synth", Synth},
                                   {"mesh", Mesh},   {"convert", ConvertFiles}};
  std::vector<std::string> names;
  for (const Command& command : kCommands) {
    if (arguments[0] == command.name) {
      RefuseForeignFlags(command.name);
      return command.run(arguments);
    }
    names.emplace_back(command.name);
  }
  const std::string nearest = NearestWord(arguments[0], names);
  throw ConfigError("unknown command '" + arguments[0] + "'" +
                    (nearest.empty() ? "" : " (did you mean '" + nearest + "'?)") + "; see frond --help");
}

int Fail(ExitCode code, const std::string& message) {
  PrintMessage(message);
  return code;
}

int Main(int argc, char** argv) {
  try {
    const std::vector<std::string> arguments = ParseFlags(argc, argv);
    if (gflags::GetCommandLineFlagInfoOrDie("help").current_value == "true") {
      std::cout << kHelp;
      return kDone;
    }
    if (gflags::GetCommandLineFlagInfoOrDie("version").current_value == "true") {
      std::cout << VersionText() << "\n";
      return kDone;
    }
    if (arguments.empty()) throw ConfigError("no command; see frond --help");
    Dispatch(arguments);
    std::cout.flush();
    if (!std::cout) return Fail(kInput, "cannot write to standard output");
    return kDone;
  } catch (const ConfigError& error) {
    return Fail(kUsage, error.what());
  } catch (const InputError& error) {
    return Fail(kInput, error.what());
  } catch (const FitError& error) {
    return Fail(kFit, error.what());
  } catch (const std::bad_alloc&) {
    return Fail(kInternal, "out of memory");
  } catch (const std::exception& error) {
    return Fail(kInternal, std::string("internal error: ") + error.what());
  } catch (...) {
    return Fail(kInternal, "internal error: an exception of unknown type");
  }
}

}  // namespace
}  // namespace frond

int main(int argc, char** argv) { return frond::Main(argc, argv); }
