// SPDX-License-Identifier: BSD-3-Clause
#include "problems/leaf/synthetic_leaf.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numeric>

#include "base/errors.h"
#include "problems/leaf/synthetic_leaf_scan.h"
#include "tests/problems/leaf/scanned_leaves.h"

namespace frond {
namespace {

LeafShape FlatShape() {
  LeafShape shape;
  shape.tooth_depth = shape.fold_slope = shape.rib_height = shape.sag = shape.tip_droop = 0;
  shape.sideways = shape.curl_angle = 0;
  return shape;
}

// Area by triangles of a grid over the outline.
double TriangulatedArea(const SyntheticLeaf& leaf, int along, int across) {
  const auto row = [&](int i) {
    std::vector<Eigen::Vector3d> points;
    const double a = leaf.shape().length * i / along;
    const double left = leaf.HalfWidth(a, 1), right = leaf.HalfWidth(a, -1);
    for (int j = 0; j <= across; ++j)
      points.push_back(leaf.Position(a, -right + (left + right) * j / across));
    return points;
  };
  double area = 0;
  std::vector<Eigen::Vector3d> last = row(0);
  for (int i = 1; i <= along; ++i) {
    const std::vector<Eigen::Vector3d> next = row(i);
    for (std::size_t j = 1; j < next.size(); ++j) {
      area += 0.5 * (next[j] - last[j - 1]).cross(next[j - 1] - last[j]).norm();
    }
    last = next;
  }
  return area;
}

TEST(SyntheticLeaf, FlatArea_MatchesTheBetaFunction) {
  const LeafShape shape = FlatShape();
  const double beta = shape.tip_sharpness, alpha = beta * shape.widest_at / (1 - shape.widest_at);
  const double peak = std::pow(shape.widest_at, alpha) * std::pow(1 - shape.widest_at, beta);
  const double integral = std::tgamma(alpha + 1) * std::tgamma(beta + 1) / std::tgamma(alpha + beta + 2);
  const double expected = shape.length * (shape.width * integral / peak + shape.petiole_width / 4);
  const LeafMeasures measures = SyntheticLeaf(shape).Measure();
  EXPECT_NEAR(measures.area, expected, 1e-5 * expected);
  EXPECT_DOUBLE_EQ(measures.length, shape.length);
  EXPECT_NEAR(measures.midrib_length, shape.length, 1e-9);
}

TEST(SyntheticLeaf, Curl_ChangesNoArea) {
  LeafShape shape = FlatShape();
  const double flat = SyntheticLeaf(shape).Measure().area;
  shape.curl_angle = 70;
  EXPECT_NEAR(SyntheticLeaf(shape).Measure().area, flat, 1e-9 * flat);
}

TEST(SyntheticLeaf, Area_MatchesAFineTriangulation) {
  for (int seed = 1; seed <= kLeaves; ++seed) {
    const SyntheticLeaf leaf(RandomLeaf(static_cast<std::uint64_t>(seed)));
    const double area = leaf.Measure().area;
    EXPECT_NEAR(area, TriangulatedArea(leaf, 3000, 300), 5e-5 * area) << "leaf " << seed;
  }
}

TEST(SyntheticLeaf, Normal_IsOrthogonalToTheSurface) {
  const SyntheticLeaf leaf(RandomLeaf(3));
  const double h = 1e-5;
  for (double a = 5; a < 70; a += 7.3) {
    for (double b = -8; b <= 8; b += 2.1) {
      const auto sample = leaf.Evaluate(a, b);
      const Eigen::Vector3d da = (leaf.Position(a + h, b) - leaf.Position(a - h, b)) / (2 * h);
      const Eigen::Vector3d db = (leaf.Position(a, b + h) - leaf.Position(a, b - h)) / (2 * h);
      EXPECT_NEAR(sample.normal.dot(da), 0, 1e-8);
      EXPECT_NEAR(sample.normal.dot(db), 0, 1e-8);
      EXPECT_NEAR(sample.area_element, da.cross(db).norm(), 1e-8);
      EXPECT_GT(sample.normal.z(), 0.3);
    }
  }
}

TEST(SyntheticLeaf, Seeds_GoRoundTheCharactersWithinTheRangesOfTeaLeaves) {
  const char* expected[] = {"hill", "smooth", "wrinkled", "flat"};
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const LeafShape shape = RandomLeaf(seed);
    EXPECT_STREQ(LeafCharacterName(shape.character), expected[(seed - 1) % 4]);
    EXPECT_GE(shape.length, 45);
    EXPECT_LE(shape.length, 85);
    EXPECT_GT(shape.width / shape.length, 0.35);
    EXPECT_LT(shape.width / shape.length, 0.5);
    EXPECT_NO_THROW(SyntheticLeaf{shape});
  }
}

TEST(SyntheticLeaf, WrongValues_AreRefusedByName) {
  LeafShape shape;
  shape.widest_at = 2;
  try {
    SyntheticLeaf leaf(shape);
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_NE(std::string(error.what()).find("widest_at"), std::string::npos) << error.what();
  }
  EXPECT_THROW(FindLeafCharacter("round"), ConfigError);
  LeafScanOptions options;
  options.missing_tip = 1;
  EXPECT_THROW(ScanLeaf(LeafShape{}, options), ConfigError);
}

TEST(LeafScan, Noise_HasTheAskedDeviationInEveryCoordinate) {
  const LeafScan& scan = ScannedLeaf(1);
  ASSERT_EQ(scan.points.size(), 40000u);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero(), squares = sum;
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const Eigen::Vector3d d = scan.points[i] - scan.clean_points[i];
    sum += d;
    squares += d.cwiseAbs2();
  }
  const double n = 40000;
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(sum[c] / n, 0, 4 * 0.05 / std::sqrt(n));
    EXPECT_NEAR(std::sqrt(squares[c] / n), 0.05, 0.001);
  }
}

TEST(LeafScan, NormalNoise_HasNoPartAlongAFlatLeaf) {
  LeafScanOptions options;
  options.noise_direction = NoiseDirection::kNormal;
  options.points = 2000;
  options.dense_points = 0;
  const LeafScan scan = ScanLeaf(FlatShape(), options);
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    EXPECT_NEAR((scan.points[i] - scan.clean_points[i]).head<2>().norm(), 0, 1e-12);
  }
}

TEST(LeafScan, Points_AreUniformByArea) {
  const LeafScan& scan = ScannedLeaf(5);
  const SyntheticLeaf leaf(RandomLeaf(5));
  const double length = leaf.shape().length;
  std::vector<double> expected(8, 0.0), found(8, 0.0);
  for (int i = 0; i < 4000; ++i) {  // midpoint rule over the blade
    const double a = length * (i + 0.5) / 4000;
    for (const int side : {-1, 1}) {
      const double half = leaf.HalfWidth(a, side);
      for (int j = 0; j < 60; ++j) {
        const double element = leaf.Evaluate(a, side * half * (j + 0.5) / 60).area_element * half;
        expected[static_cast<std::size_t>(i / 500)] += element;
      }
    }
  }
  const double sum = std::accumulate(expected.begin(), expected.end(), 0.0);
  // x is a but for the relief's tilt, which moves few points over a strip's border.
  for (const Eigen::Vector3d& p : scan.dense_clean) {
    found[static_cast<std::size_t>(std::clamp(p.x() / length * 8, 0.0, 7.99))] += 1;
  }
  for (std::size_t k = 0; k < 8; ++k) {
    const double n = static_cast<double>(scan.dense_clean.size()), share = expected[k] / sum;
    EXPECT_NEAR(found[k] / n, share, 4 * std::sqrt(share / n) + 0.01) << "strip " << k;
  }
}

TEST(LeafScan, SameSeed_GivesTheSameBytes) {
  LeafScanOptions options;
  options.points = 1000;
  options.dense_points = 100;
  const LeafScan first = ScanLeaf(RandomLeaf(2), options), second = ScanLeaf(RandomLeaf(2), options);
  EXPECT_EQ(first.points, second.points);
  options.seed = 1;
  EXPECT_NE(first.points, ScanLeaf(RandomLeaf(2), options).points);
}

TEST(LeafScan, PoseAndUnit_MoveAllThatIsWritten) {
  LeafScanOptions options;
  options.points = 500;
  options.dense_points = 50;
  const LeafScan plain = ScanLeaf(RandomLeaf(2), options);
  options.random_pose = true;
  options.unit_mm = 1000;
  const LeafScan posed = ScanLeaf(RandomLeaf(2), options);
  for (std::size_t i = 0; i < plain.points.size(); ++i) {
    EXPECT_LT((posed.pose * plain.points[i] / 1000 - posed.points[i]).norm(), 1e-12);
  }
  EXPECT_LT((posed.pose * plain.dense_clean[7] / 1000 - posed.dense_clean[7]).norm(), 1e-12);
  EXPECT_NEAR(posed.measures.area, plain.measures.area * 1e-6, 1e-15);
  EXPECT_NEAR(posed.measures.length, plain.measures.length * 1e-3, 1e-12);
  EXPECT_NEAR(posed.pose.linear().determinant(), 1, 1e-12);
}

TEST(LeafScan, Defects_AreWhereTheyWereAskedFor) {
  LeafScanOptions options;
  options.noise = 0;
  options.points = 20000;
  options.dense_points = 20000;
  options.outlier_share = 0.03;
  options.holes = 3;
  options.missing_tip = 0.1;
  options.petiole_length = 8;
  const LeafShape shape = RandomLeaf(2);
  const LeafScan scan = ScanLeaf(shape, options);
  int outliers = 0, petiole = 0;
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const double thrown = (scan.points[i] - scan.clean_points[i]).norm();
    if (scan.kinds[i] == ScanPointKind::kOutlier) {
      ++outliers;
      EXPECT_GE(thrown, options.outlier_near - 1e-9);
      EXPECT_LE(thrown, options.outlier_far + 1e-9);
      continue;
    }
    EXPECT_LT(thrown, 1e-12);
    if (scan.kinds[i] == ScanPointKind::kPetiole) {
      ++petiole;
      EXPECT_LT(scan.points[i].x(), 0.5);
    }
    EXPECT_LT(scan.points[i].x(), 0.905 * shape.length);
  }
  EXPECT_EQ(outliers, 600);
  EXPECT_GT(petiole, 300);
  EXPECT_LT(scan.scanned_area, 0.99 * scan.measures.area);
  EXPECT_GT(scan.scanned_area, 0.8 * scan.measures.area);
  EXPECT_EQ(scan.values.at("measures.area"), scan.measures.area);
  EXPECT_EQ(scan.values.at("shape.length"), shape.length);
}

}  // namespace
}  // namespace frond
