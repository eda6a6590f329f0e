// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>

#include "experiments/fit_type.h"
#include "problems/surface/sheet_fit.h"

namespace frond {

// The metrics that every surface fit reports (metrics.json), in the order of the design.
void SetQuality(const SurfaceQuality& quality, const NurbsSurface& surface, MetricTable* metrics);

// All of a sheet fit's metrics and per-point results; the surface itself is the caller's to move to the
// input's coordinates.
void SetSheetFit(const SheetFit& fit, FitOutcome* outcome);

// truth_rmse and truth_max: the distances of the input's clean points, if it has any, to the outcome's
// surface; area_error, the relative error of the area, where the true one is known.
void SetTruth(const RunInput& input, int threads, FitOutcome* outcome);

}  // namespace frond
