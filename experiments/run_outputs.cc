// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <sstream>

#include "experiments/experiment.h"
#include "io/cad_file.h"
#include "io/curve_file.h"
#include "io/file_bytes.h"
#include "io/mesh_file.h"
#include "io/run_directory.h"
#include "models/tessellation.h"

namespace frond {
namespace {

constexpr int kSegmentsPerSpan = 4;

void WriteSurfaces(const Experiment& experiment, const RunResult& result, const RunDirectory& run) {
  if (!result.outcome.surface) return;
  const SurfaceDocument document{*result.outcome.surface, result.input.unit};
  WriteSurfaceJson(run.File("surface.json"), document);  // whatever the formats: it alone holds all digits
  std::optional<SurfaceMesh> mesh;
  for (const std::string& format : experiment.formats) {
    if (format == "json") continue;
    if (format == "step") {
      WriteStep(run.File("surface.step"), document);
    } else if (format == "iges") {
      WriteIges(run.File("surface.igs"), document);
    } else {
      if (!mesh) mesh = Tessellate(document.trimmed, kSegmentsPerSpan);
      WriteMesh(run.File("surface." + format), *mesh, document.unit);
    }
  }
}

void WriteCurves(const Experiment& experiment, const RunResult& result, const RunDirectory& run) {
  if (!result.outcome.curve) return;
  const CurveDocument document{*result.outcome.curve, result.input.unit};
  WriteCurve(run.File("curve.json"), document);  // whatever the formats: it alone holds all digits
  for (const std::string& format : experiment.formats) {
    if (format != "json") WriteCurve(run.File("curve." + (format == "iges" ? "igs" : format)), document);
  }
}

void WriteOutliers(const RunResult& result, const std::filesystem::path& path) {
  const std::vector<std::string> columns = {"index", "x", "y", "z", "signed_distance"};
  std::vector<std::vector<MetricValue>> rows;
  for (std::size_t i = 0; i < result.outcome.outlier.size(); ++i) {
    if (!result.outcome.outlier[i]) continue;
    const Eigen::Vector3d& point = result.Cloud().points[i];
    rows.push_back(
        {static_cast<std::int64_t>(i), point.x(), point.y(), point.z(), result.outcome.signed_distances[i]});
  }
  WriteCsv(path, columns, rows);
}

std::string LogText(const Experiment& experiment, const RunResult& result) {
  std::ostringstream log;
  log << "run " << experiment.name << ": " << experiment.problem_type << " by " << result.metrics.solver.name
      << "\n";
  if (experiment.input.kind != InputKind::kNone) log << "input " << result.input.description;
  if (experiment.input.kind == InputKind::kScan) {
    log << ": " << result.input.report.rows << " rows, " << result.input.report.dropped_not_finite
        << " not finite, " << result.input.report.merged_duplicates << " duplicates, "
        << result.input.cloud.points.size() << " points used";
  }
  if (experiment.input.kind != InputKind::kNone) log << "\n";
  if (result.input.repaired) {
    const MeshRepairCounts& counts = *result.input.repaired;
    log << "repaired: " << counts.welded_vertices << " vertices welded, " << counts.split_vertices
        << " split, " << counts.unreferenced_vertices << " without faces dropped; " << counts.degenerate_faces
        << " degenerate and " << counts.duplicate_faces << " duplicate faces dropped, "
        << counts.swapped_edges << " edges swapped\n";
  }
  if (result.input.mesh) log << "mesh: " << result.input.mesh->triangles.size() << " faces\n";
  if (result.input.outside_region) log << "region: " << *result.input.outside_region << " points outside\n";
  for (const StageTime& stage : result.outcome.stages) {
    log << "stage " << stage.name << ": " << stage.seconds << " s\n";
  }
  if (result.outcome.report) {
    log << "solver " << result.metrics.solver.termination << ": " << result.outcome.report->message << "\n";
  }
  for (const std::string& warning : result.outcome.warnings) log << "warning: " << warning << "\n";
  return log.str();
}

}  // namespace

void WriteRun(const Experiment& experiment, const RunResult& result, const std::filesystem::path& target,
              bool overwrite) {
  RunDirectory run(target, overwrite);
  WriteFileBytes(run.File("config.yaml"), experiment.Resolved().Yaml());
  WriteMetricsJson(run.File("metrics.json"), result.metrics);
  std::vector<TraceRow> trace;
  if (result.outcome.report) {
    for (const TracePoint& point : result.outcome.report->trace) {
      trace.push_back({point.evaluations, point.seconds, point.best_objective});
    }
  }
  WriteTrace(run.File("trace.csv"), trace);
  WriteSurfaces(experiment, result, run);
  WriteCurves(experiment, result, run);
  if (experiment.input.kind == InputKind::kScan || !result.outcome.signed_distances.empty()) {
    WritePointCloud(run.File("deviation.ply"), result.Cloud(), {result.outcome.signed_distances, {}});
    WriteOutliers(result, run.File("outliers.csv"));
  }
  if (const auto& map = result.outcome.uncertainty) {
    WritePlyMesh(run.File("uncertainty.ply"), map->mesh, {"standard_deviation", map->standard_deviation});
  }
  for (const RunFile& file : result.outcome.files) file.write(run.File(file.name));
  WriteFileBytes(run.File("log.txt"), LogText(experiment, result));
  run.Commit();
}

}  // namespace frond
