// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace frond {

// A calibration board. Its frame: x along the rows of corners, y down the columns, z = 0 the board, away from
// who looks at it; the origin is the first inner corner of a chessboard, the outer corner of a ChArUco board.
struct Board {
  enum class Kind { kChessboard, kCharuco };
  Kind kind = Kind::kChessboard;
  int columns = 9, rows = 6;               // inner corners of a chessboard, squares of a ChArUco board
  double square = 1;                       // its side, in the unit of all results
  double marker = 0.75;                    // side of a ChArUco board's markers, less than `square`
  std::string dictionary = "DICT_4X4_50";  // of a ChArUco board, as OpenCV calls it
};

// The dictionaries of markers that are known, and the number by which OpenCV calls one. Throws ConfigError
// naming the nearest one.
const std::vector<std::string>& MarkerDictionaries();
int MarkerDictionaryNumber(const std::string& name);

// Throws ConfigError: too few corners, lengths that are not positive, an unknown dictionary or one
// with too few markers, or as many columns as rows of a chessboard (it looks the same turned by 90 degrees).
void CheckBoard(const Board& board);

// "9x6 chessboard", for messages.
std::string BoardName(const Board& board);

// Of a chessboard with both counts even or both odd: it looks the same turned by 180 degrees. One odd and one
// even count is the better board.
bool LooksTheSameUpsideDown(const Board& board);

// The inner corners, row by row.
std::vector<Eigen::Vector3d> BoardPoints(const Board& board);

// The corners seen in one image.
struct BoardCorners {
  std::vector<Eigen::Vector2d> pixels = {};
  std::vector<Eigen::Vector3d> points = {};  // as many, in the board's frame
  bool may_be_upside_down = false;           // as LooksTheSameUpsideDown has it
};

// The same board read from its other end: the pixels of the first corner go to the last point, and so on.
// Only for a whole chessboard.
BoardCorners TurnedUpsideDown(const BoardCorners& corners);

}  // namespace frond
