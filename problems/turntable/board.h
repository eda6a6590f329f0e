// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace frond {

// A printed pattern for calibration.
struct Board {
  enum class Kind { kChessboard, kCharuco };
  Kind kind = Kind::kChessboard;
  int columns = 9, rows = 6;  // inner corners of a chessboard, squares of a ChArUco board
  double square = 1;
  double marker = 0;
  std::string dictionary = {};
};

}  // namespace frond
