// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/board.h"

#include <algorithm>

#include "base/errors.h"
#include "base/options.h"

namespace frond {
namespace {

// In the order of OpenCV's cv::aruco::PREDEFINED_DICTIONARY_NAME, with the markers in each.
struct Dictionary {
  const char* name;
  int markers;
};
constexpr Dictionary kDictionaries[] = {
    {"DICT_4X4_50", 50},        {"DICT_4X4_100", 100},         {"DICT_4X4_250", 250},
    {"DICT_4X4_1000", 1000},    {"DICT_5X5_50", 50},           {"DICT_5X5_100", 100},
    {"DICT_5X5_250", 250},      {"DICT_5X5_1000", 1000},       {"DICT_6X6_50", 50},
    {"DICT_6X6_100", 100},      {"DICT_6X6_250", 250},         {"DICT_6X6_1000", 1000},
    {"DICT_7X7_50", 50},        {"DICT_7X7_100", 100},         {"DICT_7X7_250", 250},
    {"DICT_7X7_1000", 1000},    {"DICT_ARUCO_ORIGINAL", 1024}, {"DICT_APRILTAG_16h5", 30},
    {"DICT_APRILTAG_25h9", 35}, {"DICT_APRILTAG_36h10", 2320}, {"DICT_APRILTAG_36h11", 587}};

void CheckCharuco(const Board& board) {
  if (!(board.marker > 0 && board.marker < board.square)) {
    throw ConfigError("board: marker: must be greater than 0 and less than square");
  }
  const Dictionary& dictionary = kDictionaries[MarkerDictionaryNumber(board.dictionary)];
  const int markers = board.columns * board.rows / 2;
  if (markers > dictionary.markers) {
    throw ConfigError("board: dictionary: " + board.dictionary + " has " +
                      std::to_string(dictionary.markers) + " markers, a " + BoardName(board) + " needs " +
                      std::to_string(markers));
  }
}

}  // namespace

const std::vector<std::string>& MarkerDictionaries() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Dictionary& dictionary : kDictionaries) all.emplace_back(dictionary.name);
    return all;
  }();
  return names;
}

int MarkerDictionaryNumber(const std::string& name) {
  const std::vector<std::string>& names = MarkerDictionaries();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<int>(found - names.begin());
  const std::string nearest = NearestWord(name, names);
  throw ConfigError("board: dictionary: unknown '" + name + "'" +
                    (nearest.empty() ? ", for example DICT_4X4_50" : "; did you mean '" + nearest + "'?"));
}

void CheckBoard(const Board& board) {
  const bool charuco = board.kind == Board::Kind::kCharuco;
  const int least = charuco ? 3 : 2;
  if (board.columns < least || board.rows < least) {
    throw ConfigError("board: " + BoardName(board) + " has too few corners: at least " +
                      std::to_string(least) + " columns and rows are needed");
  }
  if (!charuco && board.columns == board.rows) {
    throw ConfigError("board: a " + BoardName(board) +
                      " looks the same turned by 90 degrees; use one with one odd and one even count");
  }
  if (!(board.square > 0)) throw ConfigError("board: square: must be greater than 0");
  if (charuco) CheckCharuco(board);
}

std::string BoardName(const Board& board) {
  return std::to_string(board.columns) + "x" + std::to_string(board.rows) +
         (board.kind == Board::Kind::kCharuco ? " ChArUco board" : " chessboard");
}

bool LooksTheSameUpsideDown(const Board& board) {
  return board.kind == Board::Kind::kChessboard && (board.columns + board.rows) % 2 == 0;
}

std::vector<Eigen::Vector3d> BoardPoints(const Board& board) {
  const bool charuco = board.kind == Board::Kind::kCharuco;
  const int columns = charuco ? board.columns - 1 : board.columns;
  const int rows = charuco ? board.rows - 1 : board.rows;
  const double first = charuco ? board.square : 0;
  std::vector<Eigen::Vector3d> points;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      points.emplace_back(first + i * board.square, first + j * board.square, 0);
    }
  }
  return points;
}

BoardCorners TurnedUpsideDown(const BoardCorners& corners) {
  BoardCorners turned = corners;
  std::reverse(turned.pixels.begin(), turned.pixels.end());
  return turned;
}

}  // namespace frond
