// SPDX-License-Identifier: BSD-3-Clause
// Whatever is wrong with the input: the exit code of the design, one line on stderr that names the cause, and
// nothing left in the output folder. Each case with each way to fit.
#include <functional>
#include <ostream>
#include <random>

#include "io/point_cloud_file.h"
#include "tests/apps/run_program.h"
#include "tests/io/temp_folder.h"

namespace frond {
namespace {

struct Way {
  const char* name;
  const char* problem;  // YAML of the section, without its end
};

void PrintTo(const Way& way, std::ostream* out) { *out << way.name; }

const Way kWays[] = {
    {"distance", "{type: leaf, surface: {degree: [3, 3], control_points: [6, 6]}"},
    {"paper", "{type: leaf, method: paper, surface: {degree: [2, 2], control_points: [5, 5]}"},
    {"surface", "{type: surface, surface: {degree: [3, 3], control_points: [6, 6]}"},
};

std::string Lines(int count, const std::function<std::string(int)>& line) {
  std::string text;
  for (int i = 0; i < count; ++i) text += line(i) + "\n";
  return text;
}

// A gently bent sheet of 60 × 30: a scan that all three ways can fit.
std::string SheetText(int points) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  return Lines(points, [&](int) {
    const double x = 60 * unit(random), y = 30 * unit(random) - 15;
    return std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(0.01 * y * y);
  });
}

class BadInput : public ::testing::TestWithParam<Way> {
 protected:
  // Fits `file` with further lines of the problem section; expects `code` and `said` on stderr.
  void ExpectFailure(const std::string& file, int code, const std::string& said, const std::string& more = "",
                     const std::string& out = "out/run") {
    folder_.Write("fit.yaml", std::string("name: bad\ninput: {cloud: ") + file + ", unit: mm}\nproblem: " +
                                  GetParam().problem + more + "}\noutput: {formats: [json]}\n");
    std::filesystem::create_directory(folder_ / "out");
    const ProgramResult result = RunFrond({"fit", "fit.yaml", "--out=" + out}, folder_.path());
    EXPECT_EQ(result.exit_code, code) << result.err;
    EXPECT_TRUE(IsOneErrorLine(result.err)) << result.err;
    EXPECT_TRUE(Holds(result.err, said));
    EXPECT_EQ(NamesIn(folder_ / "out"), std::vector<std::string>());
  }

  void WriteGoodPly() {
    folder_.Write("good.xyz", SheetText(2000));
    WritePointCloud(folder_ / "good.ply", ReadPointCloud(folder_ / "good.xyz"));
  }

  TempFolder folder_;
};

TEST_P(BadInput, EmptyFile) {
  folder_.Write("empty.xyz", "");
  ExpectFailure("empty.xyz", 3, "empty.xyz: is empty");
}

TEST_P(BadInput, OnePoint) {
  folder_.Write("one.xyz", "1 2 3\n");
  ExpectFailure("one.xyz", 3, "one.xyz: ");
}

TEST_P(BadInput, CollinearPoints) {
  folder_.Write("line.xyz", Lines(1000, [](int i) {
                  return std::to_string(0.5 * i) + " " + std::to_string(0.25 * i) + " " +
                         std::to_string(0.125 * i);
                }));
  ExpectFailure("line.xyz", 3, "line.xyz: ");
}

TEST_P(BadInput, TenCoplanarPoints) {
  folder_.Write("ten.xyz", Lines(10, [](int i) {
                  return std::to_string(5 * (i % 5)) + " " + std::to_string(5 * (i / 5)) + " 0";
                }));
  ExpectFailure("ten.xyz", 3, "10 usable points cannot hold");
}

TEST_P(BadInput, NothingButNan) {
  folder_.Write("nan.xyz", Lines(500, [](int) { return "nan nan nan"; }));
  ExpectFailure("nan.xyz", 3, "all 500 rows hold NaN");
}

TEST_P(BadInput, BinaryRubbishNamedPly) {
  std::mt19937 random(3);
  std::string bytes(5000, ' ');
  for (char& byte : bytes) byte = static_cast<char>(random() & 255);
  folder_.Write("rubbish.ply", bytes);
  ExpectFailure("rubbish.ply", 3, "rubbish.ply: is not a PLY file");
}

TEST_P(BadInput, TruncatedPly) {
  WriteGoodPly();
  const std::string bytes = FileText(folder_ / "good.ply");
  folder_.Write("cut.ply", bytes.substr(0, bytes.size() / 2));
  ExpectFailure("cut.ply", 3, "cut.ply: is truncated");
}

TEST_P(BadInput, MissingFile) { ExpectFailure("nowhere.ply", 3, "nowhere.ply: no such file"); }

TEST_P(BadInput, UnwritableOutput) {
  WriteGoodPly();
  ExpectFailure("good.ply", 3, "cannot be made", "", "good.ply/run");
  ExpectFailure("good.ply", 3, "cannot be made", "", "/proc/frond/run");
}

TEST_P(BadInput, MisspeltKey) {
  WriteGoodPly();
  ExpectFailure("good.ply", 2, "fit.yaml:3:", ", sruface: {degree: 3}");
  ExpectFailure("good.ply", 2, "(did you mean 'surface'?)", ", sruface: {degree: 3}");
}

TEST_P(BadInput, WrongType) {
  WriteGoodPly();
  ExpectFailure("good.ply", 2, "'unknowns' in 'fit' is 7, expected one of", ", fit: {unknowns: 7}");
  ExpectFailure("good.ply", 2, "'hinge' in 'fit' is strong, expected a number", ", fit: {hinge: strong}");
}

TEST_P(BadInput, DegreeOutOfRange) {
  WriteGoodPly();
  const Way way = GetParam();
  for (const std::string degree : {"[0, 3]", "[3, 13]", "-1"}) {
    folder_.Write("fit.yaml", std::string("input: {cloud: good.ply}\nproblem: ") + way.problem + "}\n");
    const ProgramResult result = RunFrond(
        {"fit", "fit.yaml", "--out=out/run", "--set=problem.surface.degree=" + degree}, folder_.path());
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_TRUE(IsOneErrorLine(result.err)) << result.err;
    EXPECT_TRUE(Holds(result.err, "'degree' in 'surface' is " + degree));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
  }
}

TEST_P(BadInput, MoreControlPointsThanPoints) {
  folder_.Write("few.xyz", SheetText(24));
  ExpectFailure("few.xyz", 3, "24 usable points cannot hold");
}

INSTANTIATE_TEST_SUITE_P(Ways, BadInput, ::testing::ValuesIn(kWays),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace frond
