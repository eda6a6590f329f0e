// SPDX-License-Identifier: BSD-3-Clause
#include "io/calibration_file.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <opencv2/core.hpp>

#include "base/errors.h"
#include "tests/io/temp_folder.h"

namespace frond {
namespace {

PinholeCamera ExampleCamera(double f) {
  return {.width = 1280,
          .height = 1024,
          .focal = {f, f / 3, 640.1, 1.0 / 3},
          .distortion = {-.1, .05, 1e-3, 0, 7}};
}

Eigen::Isometry3d ExamplePose() {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  pose.translation() = Eigen::Vector3d(-83.2, 1.0 / 7, 600);
  return pose;
}

TurntableCalibration ExampleTurntable() {
  return {{.camera = ExampleCamera(2000.1), .camera_from_disk = ExamplePose()},
          {.unit = "mm",
           .rms = 0.1414,
           .parameters = {{"axis.direction_x", 0, 1e-4}, {"angle.a \"b\"\n\xff.png", 1.0 / 3, 2e-4}},
           .covariance = {1e-8, 1e-9, 1e-9, 4e-8}}};
}

StereoPairCalibration ExampleStereo() {
  return {{.left = ExampleCamera(2000.1), .right = ExampleCamera(1990.7), .right_from_left = ExamplePose()},
          {.unit = "cm", .rms = 0.25, .parameters = {}, .covariance = {}}};
}

bool SameBits(const PinholeCamera& a, const PinholeCamera& b) {
  return a.width == b.width && a.height == b.height && a.focal == b.focal && a.distortion == b.distortion;
}

std::string ErrorOf(const std::vector<std::filesystem::path>& paths) {
  try {
    ReadCalibration(paths);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(CalibrationFileTest, EveryKind_WrittenAndRead_HasTheSameBits) {
  const TempFolder folder;
  const auto path = folder / "calibration.json";
  WriteCalibration(path, ExampleTurntable());
  const auto rig = std::get<TurntableCalibration>(ReadCalibration(path));
  EXPECT_TRUE(SameBits(rig.rig.camera, ExampleTurntable().rig.camera));
  EXPECT_EQ(rig.rig.camera_from_disk.matrix(), ExamplePose().matrix());
  EXPECT_EQ(rig.record.rms, 0.1414);
  EXPECT_EQ(rig.record.covariance, ExampleTurntable().record.covariance);
  ASSERT_EQ(rig.record.parameters.size(), 2u);
  EXPECT_EQ(rig.record.parameters[1].value, 1.0 / 3);
  EXPECT_EQ(rig.record.parameters[1].name.rfind("angle.a \"b\"\n", 0), 0u);

  WriteCalibration(path, ExampleStereo());
  const auto stereo = std::get<StereoPairCalibration>(ReadCalibration(path));
  EXPECT_TRUE(SameBits(stereo.pair.left, ExampleStereo().pair.left));
  EXPECT_TRUE(SameBits(stereo.pair.right, ExampleStereo().pair.right));
  EXPECT_EQ(stereo.pair.right_from_left.matrix(), ExamplePose().matrix());
  EXPECT_EQ(stereo.record.unit, "cm");

  WriteCalibration(path, CameraCalibration{ExampleCamera(900), {}});
  EXPECT_TRUE(SameBits(std::get<CameraCalibration>(ReadCalibration(path)).camera, ExampleCamera(900)));
}

TEST(CalibrationFileTest, OurFile_ReadByPython_GivesTheSameNumbers) {
  if (std::system("python3 -c 'import json' >/dev/null 2>&1") != 0) GTEST_SKIP() << "no python3 here";
  const TempFolder folder;
  WriteCalibration(folder / "calibration.json", ExampleTurntable());
  const std::string script =
      "import json, sys; c = json.load(open(sys.argv[1])); T = c['camera_from_disk']; "
      "assert c['schema'] == 'frond.calibration/1' and c['kind'] == 'turntable' and c['unit'] == 'mm'; "
      "assert c['camera']['focal'][3] == 1 / 3 and T[1][3] == 1 / 7 and T[0][3] == -83.2; "
      "assert c['parameters'][1]['sigma'] == 2e-4 and c['covariance'][1] == [1e-9, 4e-8]";
  const std::string command =
      "python3 -c \"" + script + "\" '" + (folder / "calibration.json").string() + "'";
  EXPECT_EQ(std::system(command.c_str()), 0);
}

TEST(CalibrationFileTest, OurFile_ReadByOpencv_GivesTheSameNumbers) {
  const TempFolder folder;
  WriteCalibration(folder / "calibration.json", ExampleStereo());
  const cv::FileStorage storage((folder / "calibration.json").string(), cv::FileStorage::READ);
  ASSERT_TRUE(storage.isOpened());
  EXPECT_EQ(static_cast<std::string>(storage["kind"]), "stereo");
  EXPECT_EQ(static_cast<double>(storage["right"]["focal"][0]), 1990.7);
  EXPECT_EQ(static_cast<double>(storage["right_from_left"][1][3]), 1.0 / 7);
}

// As OpenCV's stereo_calib writes it.
void WriteIntrinsics(const std::filesystem::path& path, int distortions) {
  cv::FileStorage storage(path.string(), cv::FileStorage::WRITE);
  cv::Mat D = cv::Mat::zeros(1, distortions, CV_64F);
  D.at<double>(0) = -0.25;
  if (distortions > 3) D.at<double>(3) = 1e-3;
  storage << "M1" << (cv::Mat_<double>(3, 3) << 800.5, 0, 320, 0, 801, 240, 0, 0, 1);
  storage << "D1" << D;
  storage << "M2" << (cv::Mat_<double>(3, 3) << 700, 0, 321, 0, 701, 241, 0, 0, 1) << "D2" << D;
}

void WriteExtrinsics(const std::filesystem::path& path, double scale) {
  cv::FileStorage storage(path.string(), cv::FileStorage::WRITE);
  cv::Mat R(3, 3, CV_64F), T = (cv::Mat_<double>(3, 1) << -3.5, 0.1, 0.2);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) R.at<double>(i, j) = scale * ExamplePose()(i, j);
  }
  storage << "R" << R << "T" << T;
}

TEST(CalibrationFileTest, OpencvsStereoFiles_InYamlXmlAndJson_AreRead) {
  const TempFolder folder;
  for (const std::string extension : {".yml", ".xml", ".json"}) {
    const auto intrinsics = folder / ("intrinsics" + extension),
               extrinsics = folder / ("extrinsics" + extension);
    WriteIntrinsics(intrinsics, 5);
    WriteExtrinsics(extrinsics, 1);
    const auto read = std::get<StereoPairCalibration>(
        ReadCalibration({intrinsics, extrinsics}, {.unit = "cm", .width = 640, .height = 480}));
    EXPECT_EQ(read.pair.left.focal, (std::array<double, 4>{800.5, 801, 320, 240}));
    EXPECT_EQ(read.pair.right.focal, (std::array<double, 4>{700, 701, 321, 241}));
    EXPECT_EQ(read.pair.left.distortion, (std::array<double, 5>{-0.25, 0, 0, 1e-3, 0}));
    EXPECT_TRUE(read.pair.right_from_left.linear().isApprox(ExamplePose().linear(), 1e-15));
    EXPECT_EQ(read.pair.right_from_left.translation(), Eigen::Vector3d(-3.5, 0.1, 0.2));
    EXPECT_EQ(read.pair.left.width, 640);
    EXPECT_EQ(read.record.unit, "cm");
  }
}

TEST(CalibrationFileTest, OpencvsCameraFile_OfItsSampleData_IsRead) {
  const auto path = std::filesystem::path(FROND_SHARED_DATA) / "stereo/chessboard_opencv/left_intrinsics.yml";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path;
  const auto read = std::get<CameraCalibration>(ReadCalibration(path));
  EXPECT_EQ(read.camera.width, 640);
  EXPECT_EQ(read.camera.height, 480);
  EXPECT_DOUBLE_EQ(read.camera.focal[0], 535.91573396163199);
  EXPECT_DOUBLE_EQ(read.camera.distortion[4], 0.23839153080878486);
}

TEST(CalibrationFileTest, OpencvsStereoFiles_WithAPartMissing_SayWhichAndWhere) {
  const TempFolder folder;
  const auto intrinsics = folder / "intrinsics.yml", extrinsics = folder / "extrinsics.yml";
  WriteIntrinsics(intrinsics, 5);
  std::string error = ErrorOf({intrinsics});
  EXPECT_NE(error.find("intrinsics.yml: has no 'R'"), std::string::npos) << error;
  EXPECT_NE(error.find("extrinsics.yml"), std::string::npos);
  WriteExtrinsics(extrinsics, 1.1);
  EXPECT_NE(ErrorOf({intrinsics, extrinsics}).find("extrinsics.yml: R: is no rotation"), std::string::npos);
  WriteExtrinsics(extrinsics, 1);
  WriteIntrinsics(intrinsics, 8);
  EXPECT_EQ(ErrorOf({intrinsics, extrinsics}), "");  // the further coefficients are 0
  WriteIntrinsics(intrinsics, 3);
  EXPECT_NE(ErrorOf({intrinsics, extrinsics}).find("intrinsics.yml: D1: expected k1, k2"), std::string::npos);
}

TEST(CalibrationFileTest, DamagedFiles_AreRefusedWithFileAndKey) {
  const TempFolder folder;
  const std::string good = FormatCalibration(ExampleStereo());
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    return ErrorOf({folder.Write("calibration.json", text)});
  };
  EXPECT_NE(with("frond.calibration/1", "frond.calibration/9").find("calibration.json: schema: expected"),
            std::string::npos);
  EXPECT_NE(with("\"stereo\"", "\"mono\"").find("calibration.json: kind: expected"), std::string::npos);
  EXPECT_NE(with("\"cm\"", "\"ell\"").find("calibration.json: unit:"), std::string::npos);
  EXPECT_NE(with("[2000.1, ", "[-1, ").find("left.focal: fx and fy must be positive"), std::string::npos);
  EXPECT_NE(with("[2000.1, ", "[").find("left.focal: has 3 values, expected 4"), std::string::npos);
  EXPECT_NE(with("\"right\": {", "\"wrong\": {").find("has no 'right'"), std::string::npos);
  EXPECT_NE(with("\"right_from_left\": [\n    [", "\"right_from_left\": [\n    [1").find("no rotation"),
            std::string::npos);
  EXPECT_NE(ErrorOf({folder.Write("cut.json", good.substr(0, good.size() / 2))}).find("cut.json: byte"),
            std::string::npos);
  EXPECT_NE(ErrorOf({folder.Write("cut.yml", "%YAML:1.0\nM1: !!opencv-matrix\n   rows: [")}).find("cut.yml"),
            std::string::npos);
  EXPECT_NE(ErrorOf({folder / "absent.json"}).find("absent.json"), std::string::npos);
  EXPECT_NE(ErrorOf({folder.Write("calibration.txt", good)}).find("expected calibration.json"),
            std::string::npos);
  const auto whole = folder.Write("whole.json", good);
  EXPECT_NE(ErrorOf({whole, whole}).find("name it alone"), std::string::npos);
}

}  // namespace
}  // namespace frond
