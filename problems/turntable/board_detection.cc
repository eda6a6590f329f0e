// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/board_detection.h"

#include <algorithm>
#include <limits>
#include <opencv2/aruco/charuco.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace frond {
namespace {

constexpr int kFewestCharucoCorners = 6;
constexpr double kSmallestPitch = 4;    // px between neighbouring corners, less is no board
constexpr double kWindowOfPitch = 0.4;  // of a neighbour's distance: no window reaches the next corner
constexpr double kBlurOfPitch = 0.1;    // at most 1 px
constexpr int kWidestWindow = 11;       // px to either side

cv::Mat GreyBytes(const Image& image) {
  cv::Mat bytes;
  // The float image itself is read only.
  cv::Mat(image.height, image.width, CV_32F, const_cast<float*>(image.values.data())).convertTo(bytes, CV_8U);
  return bytes;
}

// A chessboard's corners in the order of OpenCV, as a grid of `columns` × `rows`.
class CornerGrid {
 public:
  CornerGrid(std::vector<cv::Point2f> corners, int columns, int rows)
      : corners_(std::move(corners)), columns_(columns), rows_(rows) {}

  std::vector<cv::Point2f>& corners() { return corners_; }

  // The smallest distance between neighbours.
  double Pitch() const {
    double pitch = std::numeric_limits<double>::infinity();
    for (int j = 0; j < rows_; ++j) {
      for (int i = 0; i < columns_; ++i) {
        if (i > 0) pitch = std::min(pitch, cv::norm(At(i, j) - At(i - 1, j)));
        if (j > 0) pitch = std::min(pitch, cv::norm(At(i, j) - At(i, j - 1)));
      }
    }
    return pitch;
  }

  // Seen from the front, rows × columns turn as x × y of the image; otherwise the rows are read backwards.
  void ReadFromFront() {
    const cv::Point2f row = At(columns_ - 1, 0) - At(0, 0), column = At(0, rows_ - 1) - At(0, 0);
    if (row.cross(column) > 0) return;
    for (int j = 0; j < rows_; ++j) {
      const auto begin = corners_.begin() + static_cast<std::ptrdiff_t>(j) * columns_;
      std::reverse(begin, begin + columns_);
    }
  }

  // So that the inner squares (i, j) with even i + j are the black ones: only where columns + rows is odd.
  void ReadFromBlackEnd(const cv::Mat& image) {
    double even_minus_odd = 0;
    for (int j = 0; j + 1 < rows_; ++j) {
      for (int i = 0; i + 1 < columns_; ++i) {
        const cv::Point2f centre = (At(i, j) + At(i + 1, j) + At(i, j + 1) + At(i + 1, j + 1)) / 4;
        const int x = std::clamp(cvRound(centre.x), 0, image.cols - 1);
        const int y = std::clamp(cvRound(centre.y), 0, image.rows - 1);
        const double grey = image.at<unsigned char>(y, x);
        even_minus_odd += (i + j) % 2 == 0 ? grey : -grey;
      }
    }
    // As many even as odd squares, or one even more, which must not count as bright.
    if ((columns_ - 1) * (rows_ - 1) % 2 == 1) even_minus_odd -= cv::mean(image)[0];
    if (even_minus_odd > 0) std::reverse(corners_.begin(), corners_.end());
  }

 private:
  const cv::Point2f& At(int i, int j) const {
    return corners_[static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_) +
                    static_cast<std::size_t>(i)];
  }

  std::vector<cv::Point2f> corners_;
  int columns_, rows_;
};

// Slightly blurred: cornerSubPix interpolates linearly, which edges as sharp as a pixel bias (a drawn board's
// corners by 0.04 px RMS, blurred by 0.016 px).
void Refine(const cv::Mat& image, double pitch, double window, std::vector<cv::Point2f>* corners) {
  cv::Mat blurred;
  cv::GaussianBlur(image, blurred, {}, std::min(1.0, kBlurOfPitch * pitch));
  const int half = std::clamp(static_cast<int>(window * pitch), 2, kWidestWindow);
  const cv::TermCriteria until(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 60, 1e-4);
  cv::cornerSubPix(blurred, *corners, {half, half}, {-1, -1}, until);
}

std::optional<BoardCorners> DetectChessboard(const cv::Mat& image, const Board& board) {
  const cv::Size size(board.columns, board.rows);
  std::vector<cv::Point2f> found;
  if (!cv::findChessboardCorners(image, size, found,
                                 cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE) &&
      !cv::findChessboardCornersSB(image, size, found, cv::CALIB_CB_NORMALIZE_IMAGE)) {
    return std::nullopt;
  }
  CornerGrid grid(std::move(found), board.columns, board.rows);
  const double pitch = grid.Pitch();
  if (pitch < kSmallestPitch) return std::nullopt;
  Refine(image, pitch, kWindowOfPitch, &grid.corners());
  grid.ReadFromFront();
  if (!LooksTheSameUpsideDown(board)) grid.ReadFromBlackEnd(image);
  BoardCorners corners;
  for (const cv::Point2f& p : grid.corners()) corners.pixels.emplace_back(p.x, p.y);
  corners.points = BoardPoints(board);
  corners.may_be_upside_down = LooksTheSameUpsideDown(board);
  return corners;
}

std::optional<BoardCorners> DetectCharuco(const cv::Mat& image, const Board& board) {
  const auto dictionary = cv::aruco::getPredefinedDictionary(MarkerDictionaryNumber(board.dictionary));
  const auto charuco =
      cv::aruco::CharucoBoard::create(board.columns, board.rows, static_cast<float>(board.square),
                                      static_cast<float>(board.marker), dictionary);
  std::vector<std::vector<cv::Point2f>> marker_corners;
  std::vector<int> marker_ids, ids;
  cv::aruco::detectMarkers(image, dictionary, marker_corners, marker_ids);
  if (marker_ids.empty()) return std::nullopt;
  std::vector<cv::Point2f> found;
  cv::aruco::interpolateCornersCharuco(marker_corners, marker_ids, image, charuco, found, ids);
  if (static_cast<int>(ids.size()) < kFewestCharucoCorners) return std::nullopt;
  // Again by ourselves: OpenCV 4.6 gives these corners half a pixel too far right and down. The window stays
  // clear of the markers.
  double pitch = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < found.size(); ++k) {
    for (std::size_t l = 0; l < k; ++l) pitch = std::min(pitch, cv::norm(found[k] - found[l]));
  }
  if (pitch < kSmallestPitch) return std::nullopt;
  for (cv::Point2f& corner : found) corner -= cv::Point2f(0.5F, 0.5F);
  Refine(image, pitch, std::min(kWindowOfPitch, 0.5 * (1 - board.marker / board.square)), &found);
  // Versions of OpenCV count this board's y up from its bottom or down from its top: a marker's corners,
  // which go round from its upper left one, tell.
  const std::vector<cv::Point3f>& marker = charuco->objPoints.front();
  const bool y_up = marker[3].y < marker[0].y;
  BoardCorners corners;
  for (std::size_t k = 0; k < ids.size(); ++k) {
    corners.pixels.emplace_back(found[k].x, found[k].y);
    const cv::Point3f& point = charuco->chessboardCorners[static_cast<std::size_t>(ids[k])];
    corners.points.emplace_back(point.x, y_up ? board.rows * board.square - point.y : point.y, 0);
  }
  return corners;
}

}  // namespace

std::optional<BoardCorners> DetectBoard(const Image& image, const Board& board) {
  CheckBoard(board);
  if (image.empty()) return std::nullopt;
  const cv::Mat bytes = GreyBytes(image);
  return board.kind == Board::Kind::kCharuco ? DetectCharuco(bytes, board) : DetectChessboard(bytes, board);
}

}  // namespace frond
