// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/board.h"

#include <algorithm>

#include "base/errors.h"

namespace frond {

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
  if (charuco && !(board.marker > 0 && board.marker < board.square)) {
    throw ConfigError("board: marker: must be greater than 0 and less than square");
  }
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
