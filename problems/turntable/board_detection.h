// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "models/raster.h"
#include "problems/turntable/board.h"

namespace frond {

// The inner corners of `board` in an image, to a fraction of a pixel, by OpenCV: a chessboard's all or none,
// of a ChArUco board those between seen markers, at least 6. Nothing where no board is found.
//
// A chessboard is always read in the same way: seen from its front (rows × columns turn as x × y of the image
// do) and, where one count is odd and the other even, from the end whose first inner square is black. Of any
// other board the end is a guess, see BoardCorners::may_be_upside_down.
//
// Throws ConfigError as CheckBoard does.
std::optional<BoardCorners> DetectBoard(const Image& image, const Board& board);

}  // namespace frond
