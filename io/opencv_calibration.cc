// SPDX-License-Identifier: BSD-3-Clause
#include "io/opencv_calibration.h"

#include <cmath>
#include <map>
#include <opencv2/core.hpp>
#include <string>

#include "base/errors.h"
#include "io/calibration_json.h"
#include "io/file_bytes.h"
#include "io/length_unit.h"

namespace frond {
namespace {

constexpr const char* kKeys[] = {
    "M1", "D1", "M2", "D2", "R", "T", "camera_matrix", "distortion_coefficients"};

// The matrices found in all files, and where.
class OpencvFiles {
 public:
  explicit OpencvFiles(const std::vector<std::filesystem::path>& paths) {
    for (const std::filesystem::path& path : paths) {
      names_ += (names_.empty() ? "" : ", ") + path.string();
      ReadFile(path);
    }
  }

  bool Has(const std::string& key) const { return matrices_.count(key) > 0; }
  int width() const { return width_; }
  int height() const { return height_; }

  [[noreturn]] void Fail(const std::string& key, const std::string& message) const {
    const auto found = files_.find(key);
    throw InputError((found == files_.end() ? names_ : found->second) + ": " + key + ": " + message);
  }

  // rows × columns numbers.
  Eigen::MatrixXd Matrix(const std::string& key, int rows, int columns) const {
    const cv::Mat matrix = Numbers(key);
    if (matrix.rows != rows || matrix.cols != columns) {
      Fail(key, "is " + std::to_string(matrix.rows) + " x " + std::to_string(matrix.cols) + ", expected " +
                    std::to_string(rows) + " x " + std::to_string(columns));
    }
    Eigen::MatrixXd result(rows, columns);
    for (int i = 0; i < rows; ++i) {
      for (int j = 0; j < columns; ++j) result(i, j) = matrix.at<double>(i, j);
    }
    return result;
  }

  // A row or a column.
  std::vector<double> Vector(const std::string& key) const {
    const cv::Mat matrix = Numbers(key);
    if (matrix.rows != 1 && matrix.cols != 1) Fail(key, "expected a row or a column");
    return {matrix.begin<double>(), matrix.end<double>()};
  }

  PinholeCamera Camera(const std::string& matrix_key, const std::string& distortion_key) const {
    const Eigen::MatrixXd K = Matrix(matrix_key, 3, 3);
    if (!(K(0, 0) > 0 && K(1, 1) > 0) || K(2, 2) != 1 || K(0, 1) != 0 || K(1, 0) != 0 || K(2, 0) != 0 ||
        K(2, 1) != 0) {
      Fail(matrix_key, "expected [fx 0 cx; 0 fy cy; 0 0 1] with positive fx and fy");
    }
    PinholeCamera camera;
    camera.focal = {K(0, 0), K(1, 1), K(0, 2), K(1, 2)};
    const std::vector<double> distortion = Vector(distortion_key);
    if (distortion.size() < 4) Fail(distortion_key, "expected k1, k2, p1, p2 and, if any, k3");
    for (std::size_t k = 0; k < distortion.size(); ++k) {
      if (k < camera.distortion.size()) {
        camera.distortion[k] = distortion[k];
      } else if (distortion[k] != 0) {
        Fail(
            distortion_key,
            "has more than k1, k2, p1, p2, k3: calibrate without the rational, thin prism and tilted models");
      }
    }
    return camera;
  }

 private:
  void ReadFile(const std::filesystem::path& path) {
    const std::string text = ReadFileBytes(path);
    try {
      const cv::FileStorage storage(text, cv::FileStorage::READ | cv::FileStorage::MEMORY);
      for (const char* key : kKeys) {
        const cv::FileNode node = storage[key];
        if (node.empty()) continue;
        files_[key] = path.string();
        cv::Mat matrix;
        node >> matrix;
        matrices_[key] = matrix;
      }
      if (storage["image_width"].isInt()) width_ = static_cast<int>(storage["image_width"]);
      if (storage["image_height"].isInt()) height_ = static_cast<int>(storage["image_height"]);
    } catch (const cv::Exception&) {
      FailFile(path, "cannot be read as OpenCV's YAML, XML or JSON (cut short or damaged?)");
    }
  }

  cv::Mat Numbers(const std::string& key) const {
    const auto found = matrices_.find(key);
    if (found == matrices_.end()) {
      throw InputError(
          names_ + ": has no '" + key +
          "'; a pair needs M1, D1, M2, D2, R and T (name intrinsics.yml and extrinsics.yml, both)"
          ", a camera camera_matrix and distortion_coefficients");
    }
    if (found->second.empty() || found->second.channels() != 1) Fail(key, "expected a matrix");
    cv::Mat numbers;
    found->second.convertTo(numbers, CV_64F);
    for (auto value = numbers.begin<double>(); value != numbers.end<double>(); ++value) {
      if (!std::isfinite(*value)) Fail(key, "holds a number that is not finite");
    }
    return numbers;
  }

  std::string names_;
  std::map<std::string, cv::Mat> matrices_;
  std::map<std::string, std::string> files_;
  int width_ = 0, height_ = 0;
};

StereoPair PairOf(const OpencvFiles& files) {
  StereoPair pair{.left = files.Camera("M1", "D1"), .right = files.Camera("M2", "D2")};
  pair.right_from_left.linear() = files.Matrix("R", 3, 3);
  if (!IsRotation(pair.right_from_left.linear())) files.Fail("R", "is no rotation");
  const std::vector<double> T = files.Vector("T");
  if (T.size() != 3) files.Fail("T", "expected 3 numbers");
  pair.right_from_left.translation() = Eigen::Vector3d(T[0], T[1], T[2]);
  return pair;
}

}  // namespace

Calibration ReadOpencvCalibration(const std::vector<std::filesystem::path>& paths,
                                  const ForeignCalibration& foreign) {
  MetresPerUnit(foreign.unit);
  const OpencvFiles files(paths);
  const auto set_size = [&](PinholeCamera* camera) {
    camera->width = files.width() > 0 ? files.width() : foreign.width;
    camera->height = files.height() > 0 ? files.height() : foreign.height;
  };
  CalibrationRecord record{.unit = foreign.unit, .parameters = {}, .covariance = {}};
  if (files.Has("camera_matrix") && !files.Has("M1")) {
    CameraCalibration camera{files.Camera("camera_matrix", "distortion_coefficients"), record};
    set_size(&camera.camera);
    return camera;
  }
  StereoPairCalibration pair{PairOf(files), record};
  set_size(&pair.pair.left);
  set_size(&pair.pair.right);
  return pair;
}

}  // namespace frond
