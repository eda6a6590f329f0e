// SPDX-License-Identifier: BSD-3-Clause
#include "apps/summary.h"

#include <string>

#include "io/metrics_json.h"

namespace frond {
namespace {

// ", NAME VALUE UNIT" where the run has that metric.
void Print(const RunMetrics& run, const char* metric, const std::string& before, const std::string& unit,
           std::ostream& out) {
  if (run.metrics.Find(metric) != nullptr) out << ", " << before << run.metrics.Number(metric) << unit;
}

void PrintStandard(const RunMetrics& run, std::ostream& out) {
  out << ": objective " << run.solver.objective << ", " << run.solver.termination << ", "
      << run.solver.evaluations << " evaluations";
}

void PrintPhotographs(const RunMetrics& run, std::ostream& out) {
  const std::string unit = " " + run.unit;
  const bool windows = run.metrics.Find("windows") != nullptr;
  if (windows) {
    out << ": " << run.metrics.Number("windows") << " windows, " << run.metrics.Number("accepted")
        << " accepted (" << run.metrics.Number("accepted_percent") << " %)";
  } else {
    out << ": calibrated";
  }
  Print(run, "stereo_calibration_rms", "calibration rms ", " px", out);
  Print(run, "calibration_rms", "calibration rms ", " px", out);
  Print(run, "disparity_rmse_px", "disparity rmse ", " px", out);
  Print(run, "bad_1px_percent", "", " % off by more than 1 px", out);
  if (!windows) Print(run, "axis_distance", "axis distance ", unit, out);
  Print(run, "cloud_points", "", " points", out);
  Print(run, "cloud_truth_rmse", "off the truth by ", unit, out);
}

void PrintFit(const RunMetrics& run, std::ostream& out) {
  out << ", rmse " << run.metrics.Number("rmse") << " " << run.unit << ", max " << run.metrics.Number("max")
      << " " << run.unit;
  Print(run, "area", "area ", " " + run.unit + "^2", out);
  Print(run, "outliers", "", " outliers", out);
  Print(run, "length", "length ", " " + run.unit, out);
  out << ", " << run.solver.termination;
}

}  // namespace

void PrintSummary(const std::filesystem::path& folder, std::ostream& out) {
  const std::filesystem::path file = folder / "metrics.json";
  if (std::filesystem::exists(file)) {
    const RunMetrics run = ReadMetricsJson(file);
    const bool photographs = run.problem == "stereo" || run.problem == "turntable";
    out << run.problem;
    if (photographs) {
      PrintPhotographs(run, out);
      if (run.metrics.Find("rmse") != nullptr) PrintFit(run, out);
    } else if (run.input.points == 0) {
      PrintStandard(run, out);
    } else {
      out << ": " << run.input.points << " points";
      PrintFit(run, out);
    }
    out << ", " << run.seconds << " s\n";
  }
  out << folder.string() << "\n";
}

}  // namespace frond
