// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/sheet_metrics.h"

#include <algorithm>
#include <cmath>

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
  metrics->Set("control_points", Pair{surface.count_u(), surface.count_v()});
  metrics->Set("degree", Pair{surface.u().degree(), surface.v().degree()});
  metrics->Set("inlier_rmse", quality.inlier_rmse);
  metrics->Set("inlier_max", quality.inlier_max);
  metrics->Set("data_coverage", quality.data_coverage);
  metrics->Set("surface_samples", std::int64_t{quality.surface_samples});
  metrics->Set("local_noise", quality.local_noise);
  metrics->Set("point_spacing", quality.point_spacing);
}

void SetSheetFit(const SheetFit& fit, FitOutcome* outcome) {
  SetQuality(fit.quality, fit.surface.surface, &outcome->metrics);
  outcome->metrics.Set("outliers",
                       static_cast<std::int64_t>(std::count(fit.outlier.begin(), fit.outlier.end(), 1)));
  const char* const margins[] = {"trim", "conforming", "none"};
  outcome->metrics.Set("margin", std::string(margins[static_cast<int>(fit.margin)]));
  outcome->report = fit.report;
  outcome->signed_distances = fit.distances.signed_distance;
  outcome->outlier = fit.outlier;
  outcome->stages.insert(outcome->stages.end(), fit.stages.begin(), fit.stages.end());
  outcome->warnings.insert(outcome->warnings.end(), fit.warnings.begin(), fit.warnings.end());
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

}  // namespace frond
