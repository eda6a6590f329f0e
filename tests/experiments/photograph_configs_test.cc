// SPDX-License-Identifier: BSD-3-Clause
// Every config of photographs runs, on small images of a known truth.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <functional>

#include "experiments/experiment.h"
#include "experiments/synth.h"
#include "io/calibration_file.h"
#include "io/image_file.h"
#include "io/mesh_file.h"
#include "io/metrics_json.h"
#include "io/point_cloud_file.h"
#include "tests/io/sample_pair.h"
#include "tests/io/temp_folder.h"

namespace frond {
namespace {

const std::filesystem::path kFolder = std::filesystem::path(FROND_SOURCE_DIR) / "configs";

MetricTable Fit(const std::string& config, const std::string& set, const std::filesystem::path& out,
                int threads = 1) {
  FitConfig(kFolder / config, {.set = set, .seed = {}, .threads = threads}, out, false, false);
  return ReadMetricsJson(out / "metrics.json").metrics;
}

std::string PairInput(const TempFolder& folder) {
  return "input={left: " + (folder / "left.png").string() + ", right: " + (folder / "right.png").string() +
         "}";
}

void WritePair(const TempFolder& folder, const Image& left, const Image& right) {
  WriteImage(folder / "left.png", left);
  WriteImage(folder / "right.png", right);
}

TEST(StereoConfigs, Pair_FindsTheDisparitiesOfASlantedPlane) {
  const TempFolder folder;
  const SamplePair pair = MakeSamplePair(240, 120, 6, 0.03);
  WritePair(folder, pair.left, pair.right);
  WriteFloatTiff(folder / "truth.tiff", pair.disparity);
  const std::string truth = "; input.truth=" + (folder / "truth.tiff").string();
  const MetricTable run = Fit("stereo/pair.yaml", PairInput(folder) + truth, folder / "run");
  EXPECT_GT(run.Number("windows"), 1000);
  EXPECT_GT(run.Number("accepted_percent"), 85);
  EXPECT_LT(run.Number("disparity_rmse_px"), 0.03);
  EXPECT_EQ(run.Number("bad_1px_percent"), 0);
  EXPECT_GT(run.Number("dense_coverage_percent"), 80);
  double rejected = 0;
  for (const auto& [name, value] : run.entries()) {
    if (name.starts_with("rejected_")) rejected += run.Number(name);
  }
  EXPECT_EQ(run.Number("accepted") + rejected, run.Number("windows"));
  const Image disparity = ReadRawImage(folder / "run/disparity.tiff");
  EXPECT_NEAR(disparity(120, 60), 6 + 0.03 * 120, 0.1);
  const Image sigma = ReadRawImage(folder / "run/sigma.tiff");
  EXPECT_GT(sigma(120, 60), 0);
  EXPECT_LT(sigma(120, 60), 0.1);
  EXPECT_TRUE(
      FileText(folder / "run/matches.csv").starts_with("x,y,disparity,sigma,correlation,noise,status\n"));
  EXPECT_FALSE(std::filesystem::exists(folder / "run/cloud.ply"));  // nothing is metric without a calibration
  EXPECT_FALSE(std::filesystem::exists(folder / "run/surface.json"));
  // As it was resolved, by two threads: the same.
  FitConfig(folder / "run/config.yaml", {.set = "", .seed = {}, .threads = 2}, folder / "again", false,
            false);
  EXPECT_EQ(FileText(folder / "again/matches.csv"), FileText(folder / "run/matches.csv"));
  EXPECT_EQ(FileText(folder / "again/disparity.tiff"), FileText(folder / "run/disparity.tiff"));
}

TEST(StereoConfigs, Pair_IsSolvedAlikeByAnySolver) {
  const TempFolder folder;
  const SamplePair pair = MakeSamplePair(120, 80, 5, 0.02);
  WritePair(folder, pair.left, pair.right);
  WriteFloatTiff(folder / "truth.tiff", pair.disparity);
  const std::string input =
      PairInput(folder) + "; input.truth=" + (folder / "truth.tiff").string() + "; problem.match.step=12";
  for (const std::string solver : {"lm", "dogleg"}) {
    const MetricTable run =
        Fit("stereo/pair.yaml", input + "; problem.match.derivatives=autodiff; solver.type=" + solver,
            folder / solver);
    EXPECT_GT(run.Number("accepted"), 20) << solver;
    EXPECT_LT(run.Number("disparity_rmse_px"), 0.03) << solver;
  }
}

// What `camera` at `camera_from_world` sees of the plane z = distance, painted with the speckle.
Image SeenPlane(const PinholeCamera& camera, const Eigen::Isometry3d& camera_from_world, double distance,
                double grain) {
  const Eigen::Isometry3d world_from_camera = camera_from_world.inverse();
  Image image(camera.width, camera.height);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const Eigen::Vector3d ray = world_from_camera.linear() * camera.Ray(Eigen::Vector2d(x, y));
      const Eigen::Vector3d& eye = world_from_camera.translation();
      const Eigen::Vector3d p = eye + (distance - eye.z()) / ray.z() * ray;
      image(x, y) = static_cast<float>(SampleSpeckle(p.x() / grain, p.y() / grain));
    }
  }
  return image;
}

TEST(StereoConfigs, CalibratedPair_GivesPointsOfThePlane) {
  const TempFolder folder;
  StereoPair cameras;
  cameras.left = {
      .width = 260, .height = 180, .focal = {400, 400, 130, 90}, .distortion = {-0.1, 0.02, 0, 0, 0}};
  cameras.right = {
      .width = 260, .height = 180, .focal = {410, 410, 128, 92}, .distortion = {-0.08, 0, 0, 0, 0}};
  cameras.right_from_left.linear() =
      Eigen::AngleAxisd(-0.03, Eigen::Vector3d(0.1, 1, 0.05).normalized()).toRotationMatrix();
  cameras.right_from_left.translation() = cameras.right_from_left.linear() * Eigen::Vector3d(-20, 0.5, 0.3);
  const double distance = 300;
  WritePair(folder, SeenPlane(cameras.left, Eigen::Isometry3d::Identity(), distance, distance / 400),
            SeenPlane(cameras.right, cameras.right_from_left, distance, distance / 400));
  CalibrationRecord record;
  record.unit = "cm";
  WriteCalibration(folder / "calibration.json", StereoPairCalibration{cameras, record});
  const std::string set = PairInput(folder) + "; input.calibration=" + (folder / "calibration.json").string();
  const MetricTable run = Fit("stereo/calibrated_pair.yaml", set, folder / "run");
  EXPECT_EQ(ReadMetricsJson(folder / "run/metrics.json").unit, "cm");
  EXPECT_NEAR(run.Number("baseline"), cameras.right_from_left.translation().norm(), 1e-9);
  const std::vector<Eigen::Vector3d> points = ReadPointCloud(folder / "run/cloud.ply").points;
  ASSERT_GT(points.size(), 1000U);
  EXPECT_EQ(static_cast<double>(points.size()), run.Number("cloud_points"));
  double squares = 0;
  for (const Eigen::Vector3d& p : points) squares += (p.z() - distance) * (p.z() - distance);
  // Depth is distance² / (f · baseline) = 11 for a pixel of disparity.
  EXPECT_LT(std::sqrt(squares / static_cast<double>(points.size())), 0.05 * 11);
  EXPECT_TRUE(std::filesystem::exists(folder / "run/normal_left.png"));
  EXPECT_TRUE(std::filesystem::exists(folder / "run/calibration.json"));
  const std::string header = FileText(folder / "run/cloud.ply").substr(0, 500);
  for (const char* property : {"nx", "standard_deviation", "red"}) EXPECT_TRUE(Holds(header, property));
}

TEST(StereoConfigs, Displacement_FindsShiftAndStrain) {
  const TempFolder folder;
  Image before(200, 140), after(200, 140);
  for (int y = 0; y < before.height; ++y) {
    for (int x = 0; x < before.width; ++x) {
      before(x, y) = static_cast<float>(SampleSpeckle(x, y));
      // x' = 1.01 x + 1.3, y' = y − 2.4
      after(x, y) = static_cast<float>(SampleSpeckle((x - 1.3) / 1.01, y + 2.4));
    }
  }
  WritePair(folder, before, after);
  const MetricTable run = Fit("stereo/displacement.yaml", PairInput(folder), folder / "run");
  EXPECT_GT(run.Number("accepted_percent"), 80);
  const Image u = ReadRawImage(folder / "run/displacement_x.tiff");
  const Image v = ReadRawImage(folder / "run/displacement_y.tiff");
  for (const int x : {60, 100, 140}) {
    EXPECT_NEAR(u(x, 70), 0.01 * x + 1.3, 0.03);
    EXPECT_NEAR(v(x, 70), -2.4, 0.03);
  }
  EXPECT_TRUE(Holds(FileText(folder / "run/matches.csv").substr(0, 80), "x,y,u,u_x,u_y,v,v_x,v_y,sigma"));
}

TEST(TurntableConfigs, Pear_BecomesACloudAndAClosedSurface) {
  const TempFolder folder;
  Synthesise("turntable",
             "pairs=10; phi=5; camera.width=480; camera.height=400; camera.focal=1150; "
             "sensor.supersampling=1; texture.grain=1.5; sensor.colour=true; board.first=-40; board.last=40; "
             "board.step=10",
             3, folder / "session", false, 2);
  const std::filesystem::path session = folder / "session";
  const std::string set = "input={views: " + (session / "views.csv").string() +
                          ", board: " + (session / "board.csv").string() +
                          ", truth: " + (session / "truth.ply").string() +
                          "}; problem.match.step=6; problem.surface.control_points=[12, 12]";
  const MetricTable run = Fit("turntable/pear.yaml", set, folder / "run", 2);
  EXPECT_EQ(run.Number("pairs"), 10);
  EXPECT_NEAR(run.Number("phi_degrees"), 5, 1e-9);
  EXPECT_LT(run.Number("calibration_rms"), 0.3);
  EXPECT_NEAR(run.Number("axis_distance"), 600, 5 * run.Number("axis_distance_sigma") + 1);
  EXPECT_GT(run.Number("accepted_percent"), 60);
  EXPECT_LT(run.Number("cloud_truth_rmse_percent_of_height"), 0.5);  // at a quarter of the pixels
  EXPECT_LT(run.Number("truth_rmse"), 1);
  EXPECT_GT(run.Number("volume"), 0);
  EXPECT_EQ(static_cast<double>(ReadPointCloud(folder / "run/cloud.ply").points.size()),
            run.Number("cloud_points"));
  EXPECT_EQ(static_cast<double>(ReadPointCloud(folder / "run/deviation.ply").points.size()),
            run.Number("cloud_points"));
  for (const char* file : {"surface.step", "surface.json", "views.csv", "calibration.json"}) {
    EXPECT_TRUE(std::filesystem::exists(folder / "run" / file)) << file;
  }
  // The calibration of a run is the next one's; without a surface.
  const std::string known = "input={views: " + (session / "views.csv").string() +
                            ", calibration: " + (folder / "run/calibration.json").string() +
                            "}; problem.match.step=12; problem.fit_surface=false";
  const MetricTable again = Fit("turntable/pear.yaml", known, folder / "again", 2);
  EXPECT_EQ(again.Number("axis_distance"), run.Number("axis_distance"));
  EXPECT_FALSE(std::filesystem::exists(folder / "again/surface.json"));
  EXPECT_TRUE(std::filesystem::exists(folder / "again/cloud.ply"));
}

}  // namespace
}  // namespace frond
