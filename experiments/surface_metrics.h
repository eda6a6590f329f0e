// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <span>

#include "experiments/fit_type.h"
#include "problems/surface/surface_fit.h"

namespace frond {

// The metrics that every surface fit reports (metrics.json), in the order of the design.
void SetQuality(const SurfaceQuality& quality, const NurbsSurface& surface, MetricTable* metrics);

// The errors of eqs (34)-(39) of the acquisition paper.
void SetErrors(const SurfaceErrors& errors, MetricTable* metrics);

// The uncertainty's metrics, and its mesh in the input's coordinates; nothing where there is none.
void SetUncertainty(const std::optional<FitUncertainty>& uncertainty, const Eigen::Isometry3d& to_input,
                    FitOutcome* outcome);

// A mesh was made from scans by those who knew them: its vertices are without noise, and outliers among them
// are looked for only where a threshold is set.
void TakeMeshAsItIs(const RunInput& input, const Options& problem, SurfaceFitOptions* options);

// All of a sheet fit's metrics and per-point results; the surface itself is the caller's to move to the
// input's coordinates.
void SetSurfaceFit(const SurfaceFit& fit, FitOutcome* outcome);

// truth_rmse and truth_max: the distances of the input's clean points, if it has any, to the outcome's
// surface; area_error, the relative error of the area, where the true one is known.
void SetTruth(const RunInput& input, int threads, FitOutcome* outcome);

// volume of an outcome's surface that is closed in u (EnclosedVolume), and wall_volume, between it and the
// input's other wall, if it has one. Throws InputError where there is a wall and the surface is not closed in
// u.
void SetVolumes(const RunInput& input, FitOutcome* outcome);

// Against the input's mesh, if it has one: mesh_area, area_error; of a closed one mesh_volume, volume_error;
// mesh_reverse_p95 and mesh_reverse_max, distances of samples of the surface (inside its trim) to the nearest
// point of any face.
void SetMeshComparison(const RunInput& input, int threads, FitOutcome* outcome);

}  // namespace frond
