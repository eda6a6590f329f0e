// SPDX-License-Identifier: BSD-3-Clause
// Photographs that cannot be used: one line that names the file and the way out, exit code 3, and no half
// run.
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "io/image_file.h"
#include "tests/apps/run_program.h"
#include "tests/io/sample_pair.h"
#include "tests/io/temp_folder.h"

namespace frond {
namespace {

namespace fs = std::filesystem;

void ExpectRefusal(const TempFolder& folder, const std::vector<std::string>& arguments, int code,
                   const std::vector<std::string>& said) {
  const ProgramResult result = RunFrond(arguments, folder.path());
  EXPECT_EQ(result.exit_code, code) << result.err;
  EXPECT_TRUE(IsOneErrorLine(result.err)) << result.err;
  for (const std::string& part : said) EXPECT_TRUE(Holds(result.err, part));
  EXPECT_FALSE(fs::exists(folder / "run"));
}

class BadPair : public ::testing::Test {
 protected:
  BadPair() {
    const SamplePair pair = MakeSamplePair(160, 90, 8, 0);
    WriteImage(folder_ / "left.png", pair.left);
    WriteImage(folder_ / "right.png", pair.right);
  }

  void Expect(const std::string& input, int code, const std::vector<std::string>& said,
              const std::string& set = "") {
    folder_.Write("pair.yaml", "input: {" + input + "}\nproblem: {type: stereo}\n");
    std::vector<std::string> arguments = {"fit", "pair.yaml", "--out=run"};
    if (!set.empty()) arguments.push_back("--set=" + set);
    ExpectRefusal(folder_, arguments, code, said);
  }

  void WriteUniform(const std::string& name, float level, int width = 160, int height = 90) {
    WriteImage(folder_ / name, Image(width, height, level));
  }

  TempFolder folder_;
};

TEST_F(BadPair, ImagesOfDifferentSizes) {
  WriteImage(folder_ / "right.png", MakeSamplePair(150, 90, 8, 0).right);
  Expect("left: left.png, right: right.png", 3,
         {"right.png: is 150 x 90 pixels, but ", "left.png is 160 x 90"});
}

TEST_F(BadPair, MissingImage) {
  Expect("left: left.png, right: nowhere.png", 3, {"nowhere.png: no such file"});
  Expect("left: left.png", 2, {"pair.yaml:1:", "'left' is named without 'right'"});
  Expect("unit: mm", 2, {"no input: name two images"});
}

TEST_F(BadPair, NotAnImage) {
  folder_.Write("right.png", "hello");
  Expect("left: left.png, right: right.png", 3, {"right.png: is not an image"});
}

TEST_F(BadPair, SwappedPair) {
  Expect("left: right.png, right: left.png", 3,
         {"right.png and ", "left.png: the pair is swapped", "exchange the images"});
}

TEST_F(BadPair, BlackImage) {
  WriteUniform("right.png", 0);
  Expect("left: left.png, right: right.png", 3, {"right.png: the right image is black", "expose longer"});
}

TEST_F(BadPair, SaturatedImage) {
  WriteUniform("left.png", 255);
  Expect("left: left.png, right: right.png", 3,
         {"left.png and ", "the left image is saturated", "expose shorter"});
}

TEST_F(BadPair, UnreadableCalibration) {
  folder_.Write("calibration.json", "{\"schema\": \"frond.calibration/1\", ");
  Expect("left: left.png, right: right.png, calibration: calibration.json", 3, {"calibration.json: "});
  folder_.Write("cameras.yml", "%YAML:1.0\nnothing: 1\n");
  Expect("left: left.png, right: right.png, calibration: [cameras.yml]", 3, {"cameras.yml: "});
  Expect("left: left.png, right: right.png, calibration: nowhere.yml", 3, {"nowhere.yml: no such file"});
}

TEST_F(BadPair, MaskOfAnotherSize) {
  WriteUniform("mask.png", 255, 80, 45);
  Expect("left: left.png, right: right.png, left_mask: mask.png", 3,
         {"mask.png: is 80 x 45 pixels, but ", "left.png is 160 x 90"});
}

TEST_F(BadPair, EmptyMask) {
  WriteUniform("mask.png", 0);
  Expect("left: left.png, right: right.png, left_mask: mask.png", 3, {"left.png", "mask", "is empty"});
}

TEST_F(BadPair, WrongOptions) {
  const std::string input = "left: left.png, right: right.png";
  Expect(input, 2, {"'window' in 'match'"}, "problem.match.window=big");
  Expect(input, 2, {"unknown key 'wndow'", "did you mean 'window'"}, "problem.match.wndow=15");
  Expect(input, 2, {"has no surface: leave 'formats' out"}, "output.formats=[step]");
  Expect(input, 2, {"'pso' would not be used"}, "solver.type=pso");
  Expect(input + ", cloud: a.ply", 2, {"unknown key 'cloud'"});
}

TEST_F(BadPair, BoardNotFound) {
  folder_.Write("boards.csv", "left,right\nleft.png,right.png\n");
  Expect("boards: boards.csv", 3, {"boards.csv:2: no 9x6 chessboard found in ", "left.png", "problem.board"},
         "problem.board.square=10");
  Expect("boards: boards.csv", 2, {"measure it on the print and set 'problem.board.square'"});
}

// One synthetic session for all tests: a few views of the pear and of the board.
class BadTurn : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    session_ = new TempFolder;
    const ProgramResult made =
        RunFrond({"synth", "turntable", "--out=session",
                  "--set=pairs=3; phi=5; camera.width=480; camera.height=400; camera.focal=1150; "
                  "sensor.supersampling=1; board.first=-40; board.last=40; board.step=20; board.free=6"},
                 session_->path());
    ASSERT_EQ(made.exit_code, 0) << made.err;
  }
  static void TearDownTestSuite() {
    delete session_;
    session_ = nullptr;
  }

  BadTurn() {
    fs::copy(*session_ / "session", folder_.path(), fs::copy_options::recursive);
    folder_.Write("turn.yaml",
                  "input: {views: views.csv, board: board.csv}\n"
                  "problem: {type: turntable, board: {square: 9}, fit_surface: false, match: {step: 8}}\n");
    folder_.Write("known.yaml",
                  "input: {views: views.csv, calibration: calibration.json}\n"
                  "problem: {type: turntable, fit_surface: false, match: {step: 8}}\n");
  }

  void Expect(const std::string& config, int code, const std::vector<std::string>& said,
              const std::string& set = "") {
    std::vector<std::string> arguments = {"fit", config, "--out=run"};
    if (!set.empty()) arguments.push_back("--set=" + set);
    ExpectRefusal(folder_, arguments, code, said);
  }

  // Rewrites each line below a list's header.
  void Change(const std::string& list,
              const std::function<std::string(std::size_t row, std::string image, std::string angle)>& line) {
    std::istringstream in(FileText(folder_ / list));
    std::string text, out;
    std::getline(in, out);
    out += "\n";
    for (std::size_t row = 0; std::getline(in, text); ++row) {
      const std::size_t comma = text.find(',');
      const std::string changed = line(row, text.substr(0, comma), text.substr(comma + 1));
      if (!changed.empty()) out += changed + "\n";
    }
    folder_.Write(list, out);
  }

  static std::string Negated(std::size_t /*row*/, const std::string& image, const std::string& angle) {
    if (angle.empty()) return image + ",";
    return image + "," + (angle.starts_with('-') ? angle.substr(1) : "-" + angle);
  }

  static TempFolder* session_;
  TempFolder folder_;
};
TempFolder* BadTurn::session_ = nullptr;

TEST_F(BadTurn, ViewWithoutItsPartner) {
  Change("views.csv", [](std::size_t row, const std::string& image, const std::string& angle) {
    return row == 3 ? "" : image + "," + angle;
  });
  Expect("known.yaml", 3, {"views.csv: ", "002.png", "has no partner 5 degrees before or after it"});
}

TEST_F(BadTurn, MissingPhotograph) {
  fs::remove(folder_ / "views/003.png");
  Expect("known.yaml", 3, {"views.csv:5: no such file: ", "003.png"});
  fs::remove(folder_ / "board/001.png");
  Expect("turn.yaml", 3, {"no such file: "});
}

TEST_F(BadTurn, BoardNotFound) {
  WriteImage(folder_ / "board/002.png", Image(480, 400, 90));
  Expect("turn.yaml", 3, {"board.csv:4: no 9x6 chessboard found in ", "002.png", "or take the line out"});
  Expect("turn.yaml", 3, {"board.csv:2: no 8x5 chessboard found in ", "more of "},
         "problem.board={columns: 8, rows: 5, square: 9}");
}

TEST_F(BadTurn, AnglesOfTheWrongSign) {
  Change("board.csv", Negated);
  Expect("turn.yaml", 3, {"board.csv: the table turns the other way", "negate the angles"});
}

TEST_F(BadTurn, ViewsOfTheWrongSign) {
  Change("views.csv", Negated);
  Expect("known.yaml", 3, {"views.csv: ", "sign"});
}

TEST_F(BadTurn, BlackOrSaturatedView) {
  WriteImage(folder_ / "views/001.png", Image(480, 400, 0));
  Expect("known.yaml", 3, {"views.csv: ", "001.png", "black"});
  WriteImage(folder_ / "views/001.png", Image(480, 400, 255));
  Expect("known.yaml", 3, {"views.csv: ", "001.png", "saturated"});
}

TEST_F(BadTurn, ViewOfAnotherSize) {
  WriteImage(folder_ / "views/001.png", Image(400, 400, 90));
  Expect("known.yaml", 3, {"001.png: is 400 x 400 pixels, but ", "000.png is 480 x 400"});
}

TEST_F(BadTurn, MaskOfAnotherSize) {
  WriteImage(folder_ / "mask.png", Image(48, 40, 255));
  std::string text = FileText(folder_ / "views.csv");
  text.replace(0, text.find('\n'), "image,angle,mask");
  for (std::size_t at = text.find('\n') + 1; (at = text.find('\n', at)) != std::string::npos; at += 10) {
    text.insert(at, ",mask.png");
  }
  folder_.Write("views.csv", text);
  Expect("known.yaml", 3, {"mask.png: is 48 x 40 pixels, but ", "000.png is 480 x 400"});
}

TEST_F(BadTurn, CalibrationOfSomethingElse) {
  folder_.Write("calibration.json", "rubbish");
  Expect("known.yaml", 3, {"calibration.json: "});
  Expect("turn.yaml", 2, {"measure it on the print and set 'problem.board.square'"},
         "problem.board.square=0");
  Expect("known.yaml", 2, {"the views need a calibration"}, "input={views: views.csv}");
  Expect("known.yaml", 2, {"'background' in 'mask' is green"}, "problem.mask.background=green");
}

}  // namespace
}  // namespace frond
