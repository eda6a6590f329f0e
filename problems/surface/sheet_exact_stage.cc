// SPDX-License-Identifier: BSD-3-Clause
// Shapes that the net can take exactly, from scans without noise.
#include <cmath>

#include "problems/surface/spatial_order.h"
#include "problems/surface/surface_fit_stages.h"

namespace frond {
namespace {

// Of the data's diagonal over 70, as all lengths that were tuned in mm. A scan with less noise than kClean is
// worth the try; a fit whose RMS is below kExact has hit.
constexpr double kClean = 1e-2, kExact = 2e-5, kNothingLeft = 1e-10;
// The energies' weight falls by kFall a round from kFirstFairness and the ridge of the weights with it, until
// a round leaves more than kStall of the RMS; then they are left away.
constexpr double kFirstFairness = 1e-6, kFall = 0.1, kStall = 0.8;
constexpr double kFirstRidge = 2.5e-4, kMembrane = 10;
constexpr int kMaxRounds = 12, kMaxPlainRounds = 4;

double RootMeanSquareDistance(const std::vector<Eigen::Vector3d>& points, const NurbsSurface& surface,
                              int threads) {
  double squared = 0;
  for (const double d : MeasureDistances(points, surface, threads).signed_distance) squared += d * d;
  return std::sqrt(squared / static_cast<double>(points.size()));
}

}  // namespace

// Without fairness and ridge nothing keeps a fit from a cylinder, say: the exact surfaces are many, each a
// reparametrisation of the others, and from a start far off that family the way to it is a narrow bent
// valley. So the fit is led to the member of least energy, by energies that fall to nothing. The membrane
// energy holds the surface together where it lies beyond the data, which the thin plate does not (a ruled
// surface may be as long as it likes). The hinge looks at the surface of the round before, and is at rest in
// the end. None where the scan is noisy or the net cannot take the shape: that shows in the second round.
std::optional<NurbsSurface> SurfaceFitStages::FitExactly(const Points& points,
                                                         const std::optional<NurbsSurface>& start) {
  if (options_.topology != SurfaceTopology::kSheet || margin_ == MarginMode::kConforming ||
      options_.loss != "none" || options_.peak_emphasis > 0 || options_.fairness ||
      !(scan_.noise < kClean * length_scale_)) {
    return std::nullopt;
  }
  const Points some = Thinned(points, static_cast<std::size_t>(options_.subset));
  const auto run = [&](const Points& used, const NurbsSurface& from, double fairness) {
    DistanceFitOptions fit = StageOptions(used, from, fairness);
    fit.membrane = kMembrane;
    fit.weight_ridge = fairness / kFirstFairness * kFirstRidge;
    return RunStage(used, from, from, fit, {}, used.size());
  };
  for (const NurbsSurface& candidate : Starts(points, start)) {
    double fairness = kFirstFairness;
    NurbsSurface surface = run(some, candidate, fairness);
    double left = RootMeanSquareDistance(some, surface, context_.threads);
    for (int round = 1; round < kMaxRounds && left > kNothingLeft * length_scale_; ++round) {
      fairness *= kFall;
      surface = run(some, surface, fairness);
      const double before = left;
      left = RootMeanSquareDistance(some, surface, context_.threads);
      if (!(left < kStall * before)) break;
    }
    if (!(left < 10 * kExact * length_scale_)) continue;
    for (int round = 0; round < kMaxPlainRounds; ++round) {
      surface = run(points, surface, 0);
      const double before = left;
      left = RootMeanSquareDistance(points, surface, context_.threads);
      if (!(left < kStall * before) || left < kNothingLeft * length_scale_) break;
    }
    if (left < kExact * length_scale_) return surface;
  }
  return std::nullopt;
}

}  // namespace frond
