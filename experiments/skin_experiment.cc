// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/skin_experiment.h"

#include <Eigen/Geometry>
#include <string>
#include <utility>

#include "base/errors.h"
#include "experiments/surface_metrics.h"
#include "models/mesh_topology.h"
#include "problems/skinning/skin_fit.h"
#include "problems/surface/cloud_topology.h"

namespace frond {
namespace {

constexpr double kResolved = 0.1;      // of a cloud's extent; what is seen more coarsely may be no sheet
constexpr double kMostFlipped = 0.01;  // of the surface samples

// Sections go once round one object without handles. Planes that the user gives may cut what looks like
// parts: a cloud of a few contours.
void CheckTopology(const RunInput& input, const SkinFitOptions& options) {
  const TopologyFinding found = input.mesh ? FindSurfaceTopology(*input.mesh, FindMeshTopology(*input.mesh))
                                           : FindSurfaceTopology(input.cloud.points);
  const bool parts = found.components > 1 && options.by != SectionsBy::kPlanes;
  if (parts || found.genus.value_or(0) > 0) throw FitError("no skin goes through this: " + found.message);
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : input.cloud.points) box.extend(point);
  const bool seen = found.exact || found.resolution <= kResolved * box.diagonal().norm();
  if (seen && found.topology == SurfaceTopology::kSheet) {
    throw FitError("a skin goes round an object, but " + found.message +
                   ": fit it with 'problem.type: surface'");
  }
}

void CheckFlips(const SurfaceQuality& quality) {
  if (static_cast<double>(quality.flipped_normals) <=
      kMostFlipped * static_cast<double>(quality.surface_samples)) {
    return;
  }
  throw FitError(
      "the skin folds at " + std::to_string(quality.flipped_normals) + " of " +
      std::to_string(quality.surface_samples) +
      " samples: take other sections ('sections.by: centre_line' for a bent object), or fit it with "
      "'problem.type: surface'");
}

FitOutcome Run(const RunInput& input, const Options& problem, const Solver& /*solver*/,
               const Budget& /*budget*/, const SolveContext& context) {
  const SkinFitOptions options = SkinFitOptionsFrom(problem);
  StageClock clock;
  CheckTopology(input, options);
  clock.End("topology");
  SkinFit fit = FitSkin(input.cloud.points, options, context);
  CheckFlips(fit.quality);
  FitOutcome outcome;
  SetQuality(fit.quality, fit.surface, &outcome.metrics);
  SetErrors(fit.errors, &outcome.metrics);
  outcome.metrics.Set("sections", static_cast<std::int64_t>(fit.sections.size()));
  outcome.metrics.Set("section_tolerance", fit.tolerance);
  outcome.metrics.Set("twist_max_degrees", fit.twist_max_degrees);
  if (fit.quality.flipped_normals > 0) {
    outcome.warnings.push_back("the surface folds at " + std::to_string(fit.quality.flipped_normals) +
                               " of " + std::to_string(fit.quality.surface_samples) +
                               " samples: take other planes or another surface.control_points_v");
  }
  outcome.signed_distances = std::move(fit.distances.signed_distance);
  outcome.outlier.assign(input.cloud.points.size(), 0);
  outcome.stages = clock.stages();
  outcome.stages.insert(outcome.stages.end(), fit.stages.begin(), fit.stages.end());
  outcome.surface = TrimmedSurface{std::move(fit.surface), {}};
  SetTruth(input, context.threads, &outcome);
  SetVolumes(input, &outcome);
  SetMeshComparison(input, context.threads, &outcome);
  return outcome;
}

}  // namespace

FitType SkinFitType() {
  return {
      .name = "skin",
      .help = "A NURBS surface through plane sections of a closed or tubular cloud (cross-sectional design)",
      .options = SkinFitSpecs(),
      .solver_defaults = [](const Options&, const std::string&) { return OptionDefaults(); },
      .check = CheckSkinOptions,
      .run = Run,
      .has_walls = true};
}

}  // namespace frond
