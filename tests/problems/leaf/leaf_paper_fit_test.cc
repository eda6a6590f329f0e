// SPDX-License-Identifier: BSD-3-Clause
// The figures of Wu et al. 2021 on eight synthetic leaves (seeds 1 to 8, each character twice).
#include "problems/leaf/leaf_paper_fit.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/errors.h"
#include "base/random.h"
#include "problems/surface/voxel_grid.h"
#include "tests/problems/leaf/scanned_leaves.h"

namespace frond {
namespace {

LeafPaperOptions Kind(PointSetKind kind) {
  LeafPaperOptions options;
  options.point_set.kind = kind;
  return options;
}

// Section 3.1.2: 5 particles, 10 iterations, inertia 0.9 → 0.4; weights from [0.9, 1.1], one particle at 1.
std::unique_ptr<Solver> PapersSwarm() {
  const SolverType& type = FindSolverType("pso");
  Options options(type.options);
  options.Set("swarm_size", std::int64_t{5});
  options.Set("iterations", std::int64_t{10});
  options.Set("inertia", std::string("linear"));
  options.Set("cognitive", 2.0);
  options.Set("social", 2.0);
  options.Set("start_box", std::vector<double>{0.9, 1.1});
  return type.create(options);
}

TEST(LeafPaperFit, OfEightLeaves_KeepsThePapersBounds) {
  for (int leaf = 1; leaf <= kLeaves; ++leaf) {
    const LeafScan& scan = ScannedLeaf(leaf);
    for (const PointSetKind kind : {PointSetKind::kOrdered, PointSetKind::kUnordered}) {
      const LeafPaperFit fit = FitLeafAsInPaper(scan.points, Kind(kind));
      const LeafError clean = MeasureLeaf(fit.surface, scan.dense_clean, {});
      std::printf("leaf %d %-9s 90 points: RMSE %.3f MV %.3f; clean: RMSE %.3f MV %.3f\n", leaf,
                  fit.point_set_kind == PointSetKind::kOrdered ? "ordered" : "unordered", fit.error.rmse,
                  fit.error.max, clean.rmse, clean.max);
      EXPECT_EQ(fit.test_points.size(), 90u);
      EXPECT_LE(fit.error.rmse, 0.45) << "leaf " << leaf;
      EXPECT_LE(fit.error.max, 1.6) << "leaf " << leaf;
      EXPECT_LE(clean.rmse, 0.45) << "leaf " << leaf;
      EXPECT_LE(clean.max, 1.6) << "leaf " << leaf;
    }
  }
}

TEST(LeafPaperFit, Swarm_LowersTheErrorOnEveryLeafInNineOfTenSeeds) {
  const std::unique_ptr<Solver> swarm = PapersSwarm();
  for (int leaf = 1; leaf <= kLeaves; ++leaf) {
    const LeafPaperFit start = FitLeafAsInPaper(ScannedLeaf(leaf).points, {});
    const LeafWeightsFit weights(start.surface, start.test_points, {});
    int lowered = 0;
    double least_gain = 1, most_gain = -1;
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      const SolverReport report = swarm->Solve(weights, {}, {.threads = 1, .seed = seed});
      EXPECT_LE(report.evaluations, 55);
      const double gain = 1 - weights.Metrics(report.x).at("objective") / start.error.objective;
      lowered += gain > 0 ? 1 : 0;
      least_gain = std::min(least_gain, gain);
      most_gain = std::max(most_gain, gain);
    }
    std::printf("leaf %d: F lowered in %d of 10, by %.1f to %.1f %%\n", leaf, lowered, 100 * least_gain,
                100 * most_gain);
    EXPECT_GE(lowered, 9) << "leaf " << leaf;
  }
}

// Figure 9, with fewer repetitions and counts than configs/leaf/point_count.yaml.
TEST(LeafPaperFit, OfSimplifiedClouds_KeepsTheBoundsOfFigure9) {
  LeafPaperOptions options;
  options.point_set.slices = 10;
  options.point_set.selected = 8;
  options.surface.count_u = 3;
  options.surface.count_v = 7;
  constexpr int kRepetitions = 4;
  for (int leaf = 1; leaf <= kLeaves; ++leaf) {
    const LeafScan& scan = ScannedLeaf(leaf);
    const LeafPaperFit full = FitLeafAsInPaper(scan.points, options);
    std::printf("leaf %d:", leaf);
    for (const std::size_t count : {300u, 1000u, 4000u, 32000u}) {
      LeafError mean;
      for (std::uint64_t repetition = 0; repetition < kRepetitions; ++repetition) {
        const auto points = DownsampleByVoxelGrid(scan.points, count, repetition);
        const LeafPaperFit fit = FitLeafAsInPaper(points, options);
        const LeafError error = MeasureLeaf(fit.surface, full.test_points, {});
        mean.rmse += error.rmse / kRepetitions;
        mean.max += error.max / kRepetitions;
      }
      std::printf("  %zu points RMSE %.2f MV %.2f", count, mean.rmse, mean.max);
      EXPECT_LT(mean.rmse, 1) << "leaf " << leaf << ", " << count << " points";
      EXPECT_LT(mean.max, 2) << "leaf " << leaf << ", " << count << " points";
    }
    std::printf("\n");
  }
}

TEST(LeafPaperFit, OfAnyPoseUnitAndOrder_IsTheSameSurfaceOnTheLeaf) {
  Random random(11);
  for (int leaf = 1; leaf <= kLeaves; ++leaf) {
    const LeafScan& scan = ScannedLeaf(leaf);
    for (const PointSetKind kind : {PointSetKind::kOrdered, PointSetKind::kUnordered}) {
      LeafPaperOptions options = Kind(kind);
      const LeafPaperFit plain = FitLeafAsInPaper(scan.points, options);
      LeafScanOptions pose_options;
      pose_options.points = 1;
      pose_options.dense_points = 0;
      pose_options.random_pose = true;
      pose_options.pose_seed = static_cast<std::uint64_t>(leaf);
      const Eigen::Isometry3d pose = ScanLeaf(RandomLeaf(1), pose_options).pose;
      std::vector<Eigen::Vector3d> moved;
      for (const Eigen::Vector3d& p : scan.points) moved.push_back(pose * p / 1000);
      for (std::size_t i = moved.size(); i-- > 1;) std::swap(moved[i], moved[random.Below(i + 1)]);
      options.point_set.petiole_width /= 1000;
      const LeafPaperFit fit = FitLeafAsInPaper(moved, options);
      const double size = plain.surface.Size();
      for (std::size_t k = 0; k < 25; ++k) {
        const Eigen::Vector3d expected = pose * plain.surface.control_points()[k] / 1000;
        EXPECT_LT((fit.surface.control_points()[k] - expected).norm() * 1000, 1e-6 * size);
      }
      EXPECT_NEAR(fit.error.rmse * 1000, plain.error.rmse, 1e-6 * size);
      EXPECT_NEAR(fit.error.max * 1000, plain.error.max, 1e-6 * size);
    }
  }
}

TEST(LeafPaperFit, FreeWeights_KeepControlPointsAndReport) {
  const std::unique_ptr<Solver> swarm = PapersSwarm();
  LeafPaperOptions options;
  options.free_weights = true;
  const auto& points = ScannedLeaf(2).points;
  const LeafPaperFit fit = FitLeafAsInPaper(points, options, swarm.get(), {}, {.threads = 1, .seed = 3});
  const LeafPaperFit two = FitLeafAsInPaper(points, options, swarm.get(), {}, {.threads = 2, .seed = 3});
  const LeafPaperFit plain = FitLeafAsInPaper(points, {});
  ASSERT_TRUE(fit.report.has_value());
  EXPECT_EQ(fit.surface.control_points(), plain.surface.control_points());
  EXPECT_EQ(fit.unweighted.objective, plain.error.objective);
  EXPECT_LT(fit.error.objective, plain.error.objective);
  EXPECT_TRUE(fit.surface.IsRational());
  EXPECT_EQ(fit.surface.weights(), two.surface.weights()) << "not one byte by threads";
  EXPECT_EQ(fit.stages.size(), 5u);
  EXPECT_THROW(FitLeafAsInPaper(points, options), std::invalid_argument);
}

TEST(LeafPaperFit, EveryAlgorithmAndParametrisation_FitsAHillShapedLeaf) {
  for (const auto algorithm : {LeafSurfaceAlgorithm::kAlgorithm1, LeafSurfaceAlgorithm::kApproximation,
                               LeafSurfaceAlgorithm::kInterpolation}) {
    for (const auto parametrisation :
         {Parametrisation::kUniform, Parametrisation::kChord, Parametrisation::kCentripetal}) {
      LeafPaperOptions options = Kind(PointSetKind::kOrdered);
      options.surface.algorithm = algorithm;
      options.surface.parametrisation = parametrisation;
      const LeafPaperFit fit = FitLeafAsInPaper(ScannedLeaf(5).points, options);
      EXPECT_EQ(fit.point_set_kind, PointSetKind::kOrdered);
      EXPECT_LT(fit.error.rmse, 0.45);
      EXPECT_LT(fit.error.max, 1.6);
    }
  }
}

TEST(LeafPaperFit, OfIncompleteLeaves_StaysSensible) {
  for (int leaf = 1; leaf <= kLeaves; ++leaf) {
    LeafScanOptions scan_options;
    scan_options.seed = static_cast<std::uint64_t>(leaf);
    scan_options.dense_points = 5000;
    scan_options.outlier_share = 0.03;
    scan_options.petiole_length = 10;
    scan_options.holes = 3;
    const LeafScan scan = ScanLeaf(RandomLeaf(scan_options.seed), scan_options);
    const LeafPaperFit fit = FitLeafAsInPaper(scan.points, {});
    const LeafError clean = MeasureLeaf(fit.surface, scan.dense_clean, {});
    EXPECT_LT(clean.rmse, 0.6) << "leaf " << leaf;
    ASSERT_FALSE(fit.warnings.empty());
    EXPECT_NE(fit.warnings.back().find("left out"), std::string::npos);
  }
}

}  // namespace
}  // namespace frond
