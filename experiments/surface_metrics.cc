// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/surface_metrics.h"

#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "base/parallel.h"
#include "models/enclosed_volume.h"
#include "models/mesh_distance.h"
#include "models/mesh_topology.h"

namespace frond {

void SetQuality(const SurfaceQuality& quality, const NurbsSurface& surface, MetricTable* metrics) {
  using Pair = std::vector<std::int64_t>;
  metrics->Set("rmse", quality.rmse);
  metrics->Set("max", quality.max);
  metrics->Set("mean", quality.mean);
  metrics->Set("p95", quality.p95);
  metrics->Set("reverse_p95", quality.reverse_p95);
  metrics->Set("reverse_max", quality.reverse_max);
  metrics->Set("area", quality.area);
  metrics->Set("flipped_normals", std::int64_t{quality.flipped_normals});
  metrics->Set("control_points",
               Pair{surface.u().num_distinct_control_points(), surface.v().num_distinct_control_points()});
  metrics->Set("degree", Pair{surface.u().degree(), surface.v().degree()});
  metrics->Set("inlier_rmse", quality.inlier_rmse);
  metrics->Set("inlier_max", quality.inlier_max);
  metrics->Set("data_coverage", quality.data_coverage);
  metrics->Set("surface_samples", std::int64_t{quality.surface_samples});
  metrics->Set("local_noise", quality.local_noise);
  metrics->Set("point_spacing", quality.point_spacing);
}

void SetErrors(const SurfaceErrors& errors, MetricTable* metrics) {
  if (errors.parametric_total) metrics->Set("parametric_total", *errors.parametric_total);
  if (errors.parametric_mean) metrics->Set("parametric_mean", *errors.parametric_mean);
  metrics->Set("perpendicular_total", errors.perpendicular_total);
  metrics->Set("perpendicular_mean", errors.perpendicular_mean);
  metrics->Set("relative_total", errors.relative_total);
  metrics->Set("relative_mean_percent", 100 * errors.relative_mean);
  metrics->Set("p50", errors.p50);
  metrics->Set("p90", errors.p90);
  metrics->Set("p99", errors.p99);
}

void SetUncertainty(const std::optional<FitUncertainty>& uncertainty, const Eigen::Isometry3d& to_input,
                    FitOutcome* outcome) {
  if (!uncertainty) return;
  const SurfaceUncertainty& estimate = uncertainty->estimate;
  outcome->metrics.Set("noise_sigma", estimate.noise_sigma);
  outcome->metrics.Set("degrees_of_freedom", estimate.degrees_of_freedom);
  outcome->metrics.Set("uncertainty_mean", AreaMean(uncertainty->mesh, estimate.standard_deviation));
  outcome->metrics.Set("uncertainty_max", *std::max_element(estimate.standard_deviation.begin(),
                                                            estimate.standard_deviation.end()));
  outcome->uncertainty = UncertaintyMap{uncertainty->mesh, estimate.standard_deviation};
  for (auto& vertex : outcome->uncertainty->mesh.vertices) vertex = to_input * vertex;
  for (auto& normal : outcome->uncertainty->mesh.normals) normal = to_input.linear() * normal;
}

void TakeMeshAsItIs(const RunInput& input, const Options& problem, SurfaceFitOptions* options) {
  if (!input.mesh) return;
  options->noise_free = true;
  if (problem.HoldsWord("fit.outlier_threshold")) options->outlier_threshold = 0;
}

void SetSurfaceFit(const SurfaceFit& fit, FitOutcome* outcome) {
  SetQuality(fit.quality, fit.surface.surface, &outcome->metrics);
  SetErrors(fit.errors, &outcome->metrics);
  outcome->metrics.Set("outliers",
                       static_cast<std::int64_t>(std::count(fit.outlier.begin(), fit.outlier.end(), 1)));
  const char* const margins[] = {"trim", "conforming", "none"};
  outcome->metrics.Set("margin", std::string(margins[static_cast<int>(fit.margin)]));
  outcome->report = fit.report;
  outcome->signed_distances = fit.distances.signed_distance;
  outcome->outlier = fit.outlier;
  outcome->stages.insert(outcome->stages.end(), fit.stages.begin(), fit.stages.end());
  outcome->warnings.insert(outcome->warnings.end(), fit.warnings.begin(), fit.warnings.end());
  constexpr double kFewFolds = 1e-3;  // of the samples: at the edges of an open sheet
  const bool closed = fit.surface.surface.u().periodic();
  if (fit.quality.flipped_normals > (closed ? 0 : kFewFolds * fit.quality.surface_samples)) {
    outcome->warnings.push_back("the surface folds at " + std::to_string(fit.quality.flipped_normals) +
                                " of " + std::to_string(fit.quality.surface_samples) +
                                " samples: take another net or more fairness");
  }
}

void SetTruth(const RunInput& input, int threads, FitOutcome* outcome) {
  if (input.true_area) {
    outcome->metrics.Set("area_error", outcome->metrics.Number("area") / *input.true_area - 1);
  }
  if (input.truth.empty()) return;
  const PointDistances distances = MeasureDistances(input.truth, outcome->surface->surface, threads);
  double squared = 0, max = 0;
  for (const double d : distances.signed_distance) {
    squared += d * d;
    max = std::max(max, std::abs(d));
  }
  outcome->metrics.Set("truth_rmse", std::sqrt(squared / static_cast<double>(input.truth.size())));
  outcome->metrics.Set("truth_max", max);
}

void SetVolumes(const RunInput& input, FitOutcome* outcome) {
  const NurbsSurface& surface = outcome->surface->surface;
  if (!surface.u().periodic()) {
    if (input.other_wall) throw InputError("input.other_wall: a sheet has no walls; leave it out");
    return;
  }
  outcome->metrics.Set("volume", std::abs(EnclosedVolume(surface)));
  if (input.other_wall) {
    try {
      outcome->metrics.Set("wall_volume", std::abs(VolumeBetween(surface, *input.other_wall)));
    } catch (const InputError& error) {
      throw InputError(std::string("input.other_wall: ") + error.what() + "; fit both as the same topology");
    }
  }
}

void SetMeshComparison(const RunInput& input, int threads, FitOutcome* outcome) {
  if (!input.mesh) return;
  const SurfaceMesh& mesh = *input.mesh;
  MetricTable& metrics = outcome->metrics;
  const double area = MeshArea(mesh);
  metrics.Set("mesh_area", area);
  metrics.Set("area_error", metrics.Number("area") / area - 1);
  if (const MeshTopology topology = FindMeshTopology(mesh); topology.closed && !topology.oriented) {
    outcome->warnings.push_back("the mesh's faces are not turned alike: it has no volume to compare with");
  } else if (topology.closed) {
    const double volume = std::abs(MeshVolume(mesh));
    metrics.Set("mesh_volume", volume);
    metrics.Set("volume_error", metrics.Number("volume") / volume - 1);
  }
  const MeshDistance distance(mesh);
  const std::vector<Eigen::Vector3d> samples = SurfaceSamples(*outcome->surface, threads);
  std::vector<double> reverse(samples.size());
  ParallelFor(samples.size(), 512, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) reverse[k] = distance(samples[k]);
  });
  std::sort(reverse.begin(), reverse.end());
  if (reverse.empty()) return;
  metrics.Set("mesh_reverse_p95",
              reverse[static_cast<std::size_t>(0.95 * static_cast<double>(reverse.size() - 1))]);
  metrics.Set("mesh_reverse_max", reverse.back());
}

}  // namespace frond
