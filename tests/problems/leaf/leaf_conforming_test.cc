// SPDX-License-Identifier: BSD-3-Clause
// The distance fit at the paper's net against the paper's own path, judged by the clean leaf.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "problems/leaf/leaf_paper_fit.h"
#include "problems/leaf/synthetic_leaf_scan.h"
#include "problems/surface/surface_fit.h"
#include "solvers/solver.h"
#include "tests/problems/leaf/scanned_leaves.h"

namespace frond {
namespace {

// The leaf in its frame, conforming, 5 × 5 of degree (2, 2), control points and weights free.
SurfaceFit FitConforming(const LeafScan& scan, const LeafPaperFit& paper) {
  SurfaceFitOptions options;
  options.degree = {2, 2};
  options.control_points = {5, 5};
  options.unknowns = SurfaceUnknowns::kBoth;
  options.tie_tip = true;
  const SolverType& lm = FindSolverType("lm");
  Options solver_options(lm.options);
  for (const auto& [name, value] : SurfaceFitSolverDefaults("lm", options)) solver_options.Set(name, value);
  std::vector<Eigen::Vector3d> local;
  for (const auto& point : scan.points) local.push_back(paper.frame.FromInput(point));
  std::vector<Eigen::Vector3d> control_points;
  for (const auto& point : paper.surface.control_points()) {
    control_points.push_back(paper.frame.FromInput(point));
  }
  const NurbsSurface start(paper.surface.u(), paper.surface.v(), control_points, paper.surface.weights());
  return FitSurface(local, {}, start, options, *lm.create(solver_options), {}, {});
}

TEST(LeafConforming, AtThePapersNet_BeatsThePaperOnEveryLeaf) {
  std::vector<double> ratios;
  for (int leaf = 1; leaf <= kLeaves; ++leaf) {
    const LeafScan& scan = ScannedLeaf(leaf);
    const LeafPaperFit paper = FitLeafAsInPaper(scan.points, {});
    const SurfaceFit fit = FitConforming(scan, paper);
    std::vector<Eigen::Vector3d> truth;
    for (const auto& point : scan.dense_clean) truth.push_back(paper.frame.FromInput(point));
    ASSERT_FALSE(truth.empty());
    const LeafError of_paper = MeasureLeaf(paper.surface, scan.dense_clean, {});
    const LeafError of_fit = MeasureLeaf(fit.surface.surface, truth, {});
    ratios.push_back(of_fit.rmse / of_paper.rmse);
    EXPECT_LE(ratios.back(), 0.9) << "leaf " << leaf;
    EXPECT_LE(of_fit.max, 0.85 * of_paper.max) << "leaf " << leaf;
    EXPECT_NEAR(fit.quality.area, scan.measures.area, 0.025 * scan.measures.area) << "leaf " << leaf;
    EXPECT_LE(fit.quality.flipped_normals, 0.002 * fit.quality.surface_samples) << "leaf " << leaf;
  }
  std::sort(ratios.begin(), ratios.end());
  EXPECT_LE(0.5 * (ratios[3] + ratios[4]), 0.7);
}

// Strays included: the grid that finds them must not see the pose.
TEST(LeafFrame, WithOutliersInAnotherPose_HasTheSameStrays) {
  LeafScanOptions options;
  options.seed = 3;
  options.points = 10000;
  options.dense_points = 0;
  options.outlier_share = 0.03;
  const LeafScan scan = ScanLeaf(RandomLeaf(3), options);
  const Eigen::Isometry3d turn(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()));
  std::vector<Eigen::Vector3d> turned;
  for (const auto& point : scan.points) turned.push_back(turn * point + Eigen::Vector3d(10, -20, 30));
  EXPECT_EQ(FindLeafFrame(scan.points).strays, FindLeafFrame(turned).strays);
}

}  // namespace
}  // namespace frond
