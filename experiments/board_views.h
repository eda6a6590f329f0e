// SPDX-License-Identifier: BSD-3-Clause
// Photographs of a calibration board, from a list to corners.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/options.h"
#include "io/view_list.h"
#include "problems/stereo/stereo_calibration.h"
#include "problems/turntable/board.h"

namespace frond {

// `board.kind`, `board.columns`, …: the board in front of the camera. `board.square` has no default: all
// lengths are in its unit.
std::vector<OptionSpec> BoardSpecs();
Board BoardFrom(const Options& options);

// Throws ConfigError for a board that cannot be used, or where `needed` and its square is not given.
void CheckBoardOptions(const Options& options, bool needed);

// One photograph with its board.
struct BoardView {
  std::string name;             // its file
  std::optional<double> angle;  // of the disk, radians
  BoardCorners corners;
};
struct BoardViews {
  std::vector<BoardView> views;  // in the list's order
  int width = 0, height = 0;     // of all images
};

// Throw InputError for images that cannot be read, of different sizes, or in which no board is found; one
// line that names the place of the first in the list, and how many more there are.
BoardViews FindBoards(const ViewList& list, const Board& board, int threads);

struct BoardPairs {
  std::vector<BoardPair> pairs;
  int width = 0, height = 0;
};
BoardPairs FindBoardPairs(const ImagePairList& list, const Board& board, int threads);

}  // namespace frond
