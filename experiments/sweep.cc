// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/sweep.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <map>
#include <mutex>

#include "base/errors.h"
#include "base/parallel.h"
#include "experiments/message.h"
#include "experiments/study/study.h"
#include "experiments/study/svg_plot.h"
#include "io/file_bytes.h"
#include "io/run_directory.h"

namespace frond {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
const char* const kRepetition = "seed";  // the axis that summaries average over

struct SweepRun {
  std::vector<OptionValue> values;  // one an axis
  std::string error;                // empty: it worked
  bool bad_input = false;           // the error is an InputError
  std::int64_t warnings = 0;
  MetricTable metrics;
};

struct PlotRequest {
  std::string x;
  std::vector<std::string> y;
};

std::vector<SweepRun> CrossedRuns(const std::vector<ConfigFile::SweepAxis>& axes) {
  std::vector<SweepRun> runs(1);
  for (const auto& axis : axes) {
    std::vector<SweepRun> longer;
    for (const SweepRun& run : runs) {
      for (const OptionValue& value : axis.values) {
        longer.push_back(run);
        longer.back().values.push_back(value);
      }
    }
    runs = std::move(longer);
  }
  return runs;
}

MetricValue AsMetric(const OptionValue& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return *whole;
  if (const auto* number = std::get_if<double>(&value)) return *number;
  return FormatValue(value);
}

// The numeric metrics that any run has, in the order of the first that has them.
std::vector<std::string> NumericMetrics(const std::vector<SweepRun>& runs) {
  std::vector<std::string> names;
  for (const SweepRun& run : runs) {
    for (const auto& [name, value] : run.metrics.entries()) {
      const bool number =
          std::holds_alternative<double>(value) || std::holds_alternative<std::int64_t>(value);
      if (number && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
  }
  return names;
}

void WriteRuns(const std::vector<ConfigFile::SweepAxis>& axes, const std::vector<SweepRun>& runs,
               const std::filesystem::path& path) {
  const std::vector<std::string> metrics = NumericMetrics(runs);
  std::vector<std::string> columns;
  for (const auto& axis : axes) columns.push_back(axis.key);
  columns.insert(columns.end(), {"status", "error", "warnings"});
  columns.insert(columns.end(), metrics.begin(), metrics.end());
  std::vector<std::vector<MetricValue>> rows;
  for (const SweepRun& run : runs) {
    std::vector<MetricValue> row;
    for (const OptionValue& value : run.values) row.push_back(AsMetric(value));
    row.emplace_back(std::string(run.error.empty() ? "ok" : "failed"));
    row.emplace_back(run.error);
    row.push_back(run.error.empty() ? MetricValue(run.warnings) : MetricValue(kNone));
    for (const std::string& name : metrics) row.emplace_back(run.metrics.Number(name));
    rows.push_back(std::move(row));
  }
  WriteCsv(path, columns, rows);
}

// One group of runs that differ in the seed alone, with the means of their metrics.
struct Group {
  std::vector<OptionValue> values;  // without the seed
  std::int64_t runs = 0, failed = 0;
  std::map<std::string, double> sums;
};

std::vector<Group> GroupRuns(const std::vector<ConfigFile::SweepAxis>& axes,
                             const std::vector<SweepRun>& runs, const std::vector<std::string>& metrics) {
  std::vector<Group> groups;
  std::map<std::string, std::size_t> place;
  for (const SweepRun& run : runs) {
    std::string key;
    std::vector<OptionValue> values;
    for (std::size_t k = 0; k < axes.size(); ++k) {
      if (axes[k].key == kRepetition) continue;
      key += FormatValue(run.values[k]) + ";";
      values.push_back(run.values[k]);
    }
    const auto [entry, added] = place.emplace(key, groups.size());
    if (added) groups.push_back({std::move(values), 0, 0, {}});
    Group& group = groups[entry->second];
    if (!run.error.empty()) {
      ++group.failed;
      continue;
    }
    ++group.runs;
    for (const std::string& name : metrics) group.sums[name] += run.metrics.Number(name);
  }
  return groups;
}

double MeanOf(const Group& group, const std::string& metric) {
  const auto sum = group.sums.find(metric);
  return group.runs > 0 && sum != group.sums.end() ? sum->second / static_cast<double>(group.runs) : kNone;
}

void WriteSummary(const std::vector<std::string>& axes, const std::vector<Group>& groups,
                  const std::vector<std::string>& metrics, const std::filesystem::path& path) {
  std::vector<std::string> columns = axes;
  columns.insert(columns.end(), {"runs", "failed"});
  columns.insert(columns.end(), metrics.begin(), metrics.end());
  std::vector<std::vector<MetricValue>> rows;
  for (const Group& group : groups) {
    std::vector<MetricValue> row;
    for (const OptionValue& value : group.values) row.push_back(AsMetric(value));
    row.emplace_back(group.runs);
    row.emplace_back(group.failed);
    for (const std::string& name : metrics) row.emplace_back(MeanOf(group, name));
    rows.push_back(std::move(row));
  }
  WriteCsv(path, columns, rows);
}

double AsNumber(const OptionValue& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  if (const auto* number = std::get_if<double>(&value)) return *number;
  return kNone;
}

std::string Plot(const std::string& title, const std::vector<std::string>& axes,
                 const std::vector<Group>& groups, const PlotRequest& request) {
  const auto x_axis = static_cast<std::size_t>(std::find(axes.begin(), axes.end(), request.x) - axes.begin());
  std::vector<PlotPanel> panels;
  for (const std::string& metric : request.y) {
    PlotPanel panel{.title = "",
                    .x = {.label = request.x},
                    .y = {.label = metric, .scale = AxisScale::kLinear, .lower = 0},
                    .shape = LineShape::kSegments,
                    .series = {}};
    for (const Group& group : groups) {
      std::string label;
      for (std::size_t k = 0; k < axes.size(); ++k) {
        if (k == x_axis) continue;
        const std::string key = axes[k].substr(axes[k].rfind('.') + 1);
        label += (label.empty() ? "" : ", ") + key + " " + FormatValue(group.values[k]);
      }
      auto series = std::find_if(panel.series.begin(), panel.series.end(),
                                 [&](const PlotSeries& s) { return s.label == label; });
      if (series == panel.series.end()) series = panel.series.insert(series, {label, {}});
      series->line.x.push_back(AsNumber(group.values[x_axis]));
      series->line.y.push_back(MeanOf(group, metric));
    }
    panels.push_back(std::move(panel));
  }
  return PlotSvg(title, panels, true);
}

std::optional<PlotRequest> ReadPlot(const ConfigFile& config,
                                    const std::vector<ConfigFile::SweepAxis>& axes) {
  if (!config.Has("output.plot")) return std::nullopt;
  config.CheckKeys("output.plot", {"x", "y"});
  PlotRequest plot{config.Text("output.plot.x"), config.Texts("output.plot.y")};
  const bool known = std::any_of(axes.begin(), axes.end(), [&](const auto& axis) {
    return axis.key == plot.x && axis.key != kRepetition &&
           std::all_of(axis.values.begin(), axis.values.end(),
                       [](const auto& v) { return std::isfinite(AsNumber(v)); });
  });
  if (!known)
    config.Fail("output.plot.x", "'x' must name a swept key with numbers for values, other than seed");
  return plot;
}

// The axes of `sweep`, paths made absolute as everywhere else in a config.
std::vector<ConfigFile::SweepAxis> ReadAxes(const ConfigFile& config) {
  std::vector<ConfigFile::SweepAxis> axes = config.Sweep();
  for (auto& axis : axes) {
    if (axis.key != "input.cloud" && axis.key != "input.mesh" && axis.key != "input.truth") continue;
    const bool command_line = axis.place == "--set";
    const std::filesystem::path base = command_line ? std::filesystem::current_path()
                                                    : std::filesystem::absolute(config.name()).parent_path();
    for (OptionValue& value : axis.values) {
      const auto* text = std::get_if<std::string>(&value);
      if (text != nullptr && !text->empty()) value = (base / *text).lexically_normal().string();
    }
  }
  return axes;
}

// The config of run `run`, before it is checked.
ConfigFile ConfigOf(const ConfigFile& config, const std::vector<ConfigFile::SweepAxis>& axes,
                    const SweepRun& run) {
  ConfigFile one = config;
  for (std::size_t k = 0; k < axes.size(); ++k) one.Set(axes[k].key, run.values[k]);
  return one;
}

std::vector<Experiment> ReadExperiments(const ConfigFile& config, const RunFlags& flags,
                                        const std::vector<ConfigFile::SweepAxis>& axes,
                                        const std::vector<SweepRun>& runs) {
  for (const auto& axis : axes) {
    if (axis.key == kRepetition && flags.seed) {
      throw ConfigError(axis.place +
                        ": 'seed' is swept; leave out --seed, which would make all repetitions equal");
    }
  }
  std::vector<Experiment> experiments;
  for (const SweepRun& run : runs) experiments.push_back(ReadExperiment(ConfigOf(config, axes, run), flags));
  return experiments;
}

void Execute(const std::vector<Experiment>& experiments, int threads, bool progress,
             std::vector<SweepRun>* runs) {
  std::mutex mutex;
  std::size_t done = 0;
  // Runs are spread over the threads, one thread each: many small fits keep all cores busy that way.
  ParallelFor(runs->size(), 1, threads, [&](std::size_t i, std::size_t) {
    SweepRun& run = (*runs)[i];
    try {
      const RunResult result = RunExperiment(experiments[i], 1);
      run.metrics = result.metrics.metrics;
      run.warnings = static_cast<std::int64_t>(result.outcome.warnings.size());
    } catch (const InputError& error) {
      run.error = error.what();
      run.bad_input = true;
    } catch (const FitError& error) {
      run.error = error.what();
    }
    const std::lock_guard lock(mutex);
    ++done;
    if (progress)
      std::cerr << "\r" << done << "/" << runs->size() << (done == runs->size() ? "\n" : "") << std::flush;
  });
}

void AddWhatIsSet(const ConfigFile& config, const std::string& section, const std::vector<OptionSpec>& specs,
                  ResolvedConfig* resolved) {
  Options options(specs);
  config.ReadSection(section, &options, {"type"});
  for (const OptionSpec& spec : specs) {
    if (options.IsSet(spec.name)) resolved->Add(section + "." + spec.name, options.Value(spec.name));
  }
}

std::string YamlOf(const OptionValue& value) {
  ResolvedConfig one;
  one.Add("v", value);
  const std::string yaml = one.Yaml();  // "v: VALUE\n"
  return yaml.substr(3, yaml.size() - 4);
}

// The config that repeats the sweep. Options of fit and solver are written where they are set: a default may
// hang on what is swept. Swept keys hold the first run's values, which the sweep replaces.
std::string SweepYaml(const ConfigFile& first_config, const Experiment& first,
                      const std::vector<ConfigFile::SweepAxis>& axes,
                      const std::optional<PlotRequest>& plot) {
  Experiment frame = first;
  frame.problem = Options({});
  frame.solver = Options({});
  ResolvedConfig resolved = frame.Resolved();
  AddWhatIsSet(first_config, "problem", FindFitType(first.problem_type).options, &resolved);
  AddWhatIsSet(first_config, "solver", FindSolverType(first.solver_type).options, &resolved);
  if (plot) {
    resolved.Add("output.plot.x", plot->x);
    resolved.Add("output.plot.y", plot->y);
  }
  std::string yaml = resolved.Yaml() + "sweep:\n";
  for (const auto& axis : axes) {
    yaml += "  " + axis.key + ": [";
    for (std::size_t k = 0; k < axis.values.size(); ++k) {
      yaml += (k > 0 ? ", " : "") + YamlOf(axis.values[k]);
    }
    yaml += "]\n";
  }
  return yaml;
}

}  // namespace

std::filesystem::path RunSweep(const ConfigFile& config, const RunFlags& flags,
                               const std::filesystem::path& out, bool overwrite, bool progress) {
  const std::vector<ConfigFile::SweepAxis> axes = ReadAxes(config);
  if (axes.empty()) config.Fail("sweep", "'sweep' names no values");
  const std::optional<PlotRequest> plot = ReadPlot(config, axes);
  std::vector<SweepRun> runs = CrossedRuns(axes);
  const std::vector<Experiment> experiments = ReadExperiments(config, flags, axes, runs);
  const std::filesystem::path target =
      out.empty() ? std::filesystem::path("runs") / experiments.front().name : out;
  RunDirectory directory(target, overwrite);
  Execute(experiments, flags.threads, progress, &runs);

  const std::vector<std::string> metrics = NumericMetrics(runs);
  std::vector<std::string> axis_names;
  for (const auto& axis : axes) {
    if (axis.key != kRepetition) axis_names.push_back(axis.key);
  }
  const std::vector<Group> groups = GroupRuns(axes, runs, metrics);
  WriteFileBytes(directory.File("config.yaml"),
                 SweepYaml(ConfigOf(config, axes, runs.front()), experiments.front(), axes, plot));
  WriteRuns(axes, runs, directory.File("runs.csv"));
  WriteSummary(axis_names, groups, metrics, directory.File("summary.csv"));
  if (plot)
    WriteFileBytes(directory.File("plot.svg"), Plot(experiments.front().name, axis_names, groups, *plot));
  const auto failed =
      std::count_if(runs.begin(), runs.end(), [](const SweepRun& run) { return !run.error.empty(); });
  if (failed == std::ssize(runs)) {
    const std::string message =
        config.name() + ": all " + std::to_string(failed) + " runs failed; the first: " + runs.front().error;
    if (runs.front().bad_input) throw InputError(message);
    throw FitError(message);
  }
  directory.Commit();
  if (failed > 0) {
    PrintMessage("warning: " + std::to_string(failed) + " of " + std::to_string(runs.size()) +
                 " runs failed; see " + (target / "runs.csv").string());
  }
  return target;
}

std::size_t CheckConfig(const std::filesystem::path& path, const RunFlags& flags) {
  ConfigFile config = ConfigFile::Load(path);
  if (!flags.set.empty()) config.Override(flags.set);
  if (IsStudy(config)) return CheckStudy(config, flags);
  if (!config.Has("sweep")) {
    (void)ReadExperiment(config, flags);
    return 1;
  }
  const std::vector<ConfigFile::SweepAxis> axes = ReadAxes(config);
  (void)ReadPlot(config, axes);
  return ReadExperiments(config, flags, axes, CrossedRuns(axes)).size();
}

}  // namespace frond
