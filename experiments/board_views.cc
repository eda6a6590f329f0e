// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/board_views.h"

#include <utility>

#include "base/errors.h"
#include "base/option_specs.h"
#include "base/parallel.h"
#include "io/image_file.h"
#include "problems/turntable/board_detection.h"

namespace frond {
namespace {

constexpr double kLongest = 1e9;  // of lengths, in the unit

// One image of a list.
struct Photograph {
  std::filesystem::path file;
  std::string place;  // "board.csv:3"
};

struct Detection {
  int width = 0, height = 0;
  std::optional<BoardCorners> corners;
};

void CheckSizes(const std::vector<Photograph>& photographs, const std::vector<Detection>& found) {
  for (std::size_t k = 1; k < found.size(); ++k) {
    if (found[k].width == found[0].width && found[k].height == found[0].height) continue;
    const auto size = [](const Detection& one) {
      return std::to_string(one.width) + " x " + std::to_string(one.height);
    };
    throw InputError(photographs[k].place + ": " + photographs[k].file.string() + " is " + size(found[k]) +
                     " pixels, the first image " + size(found[0]) + "; all are to be of one size");
  }
}

void CheckFound(const std::vector<Photograph>& photographs, const std::vector<Detection>& found,
                const Board& board) {
  std::size_t missing = 0, first = 0;
  for (std::size_t k = found.size(); k-- > 0;) {
    if (found[k].corners) continue;
    ++missing;
    first = k;
  }
  if (missing == 0) return;
  const std::string looked_for = board.kind == Board::Kind::kChessboard
                                     ? "the counts of inner corners in problem.board"
                                     : "the counts of squares and the dictionary in problem.board";
  throw InputError(photographs[first].place + ": no " + BoardName(board) + " found in " +
                   photographs[first].file.string() +
                   (missing > 1 ? ", nor in " + std::to_string(missing - 1) + " more of " +
                                      std::to_string(found.size()) + " images"
                                : "") +
                   "; check " + looked_for +
                   ", that all of the board is seen and sharp, or take the line out");
}

std::vector<Detection> Detect(const std::vector<Photograph>& photographs, const Board& board, int threads) {
  std::vector<Detection> found(photographs.size());
  ParallelFor(photographs.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const Image image = ReadImage(photographs[k].file);
      found[k] = {image.width, image.height, DetectBoard(image, board)};
    }
  });
  CheckSizes(photographs, found);
  CheckFound(photographs, found, board);
  return found;
}

}  // namespace

std::vector<OptionSpec> BoardSpecs() {
  const Board board;
  return {ChoiceSpec("board.kind", {"chessboard", "charuco"}, "The calibration board"),
          IntegerSpec("board.columns", board.columns, 2, 1000,
                      "Of a chessboard: inner corners in a row; of a ChArUco board: squares"),
          IntegerSpec("board.rows", board.rows, 2, 1000, "Rows of them"),
          NumberSpec("board.square", 0, 0, kLongest,
                     "Side of a square, in the unit of all results; measure it on the print"),
          NumberSpec("board.marker", 0, 0, kLongest, "Of a ChArUco board: side of a marker"),
          {.name = "board.dictionary",
           .type = OptionType::kText,
           .default_value = board.dictionary,
           .help = "Of a ChArUco board: the markers' dictionary, as OpenCV calls it"}};
}

Board BoardFrom(const Options& options) {
  Board board;
  board.kind = options.Text("board.kind") == "charuco" ? Board::Kind::kCharuco : Board::Kind::kChessboard;
  board.columns = options.Integer("board.columns");
  board.rows = options.Integer("board.rows");
  board.square = options.Number("board.square");
  board.marker = options.Number("board.marker");
  board.dictionary = options.Text("board.dictionary");
  return board;
}

void CheckBoardOptions(const Options& options, bool needed) {
  if (!needed) return;
  if (!(options.Number("board.square") > 0)) {
    throw ConfigError(
        "the side of the board's squares is missing: measure it on the print and set "
        "'problem.board.square'");
  }
  CheckBoard(BoardFrom(options));
}

BoardViews FindBoards(const ViewList& list, const Board& board, int threads) {
  std::vector<Photograph> photographs;
  for (std::size_t k = 0; k < list.views.size(); ++k) {
    photographs.push_back({list.views[k].image, list.Place(k)});
  }
  std::vector<Detection> found = Detect(photographs, board, threads);
  BoardViews boards{{}, found[0].width, found[0].height};
  for (std::size_t k = 0; k < found.size(); ++k) {
    boards.views.push_back({list.views[k].image.string(), list.views[k].angle, std::move(*found[k].corners)});
  }
  return boards;
}

BoardPairs FindBoardPairs(const ImagePairList& list, const Board& board, int threads) {
  std::vector<Photograph> photographs;  // left, right, left, right, …
  for (std::size_t k = 0; k < list.pairs.size(); ++k) {
    photographs.push_back({list.pairs[k].left, list.Place(k)});
    photographs.push_back({list.pairs[k].right, list.Place(k)});
  }
  std::vector<Detection> found = Detect(photographs, board, threads);
  BoardPairs boards{{}, found[0].width, found[0].height};
  for (std::size_t k = 0; k < list.pairs.size(); ++k) {
    boards.pairs.push_back({std::move(*found[2 * k].corners), std::move(*found[2 * k + 1].corners),
                            list.pairs[k].left.string()});
  }
  return boards;
}

}  // namespace frond
