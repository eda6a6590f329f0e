// SPDX-License-Identifier: BSD-3-Clause
#include "io/surface_json.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <span>

#include "base/errors.h"
#include "io/surface_file.h"
#include "tests/io/sample_surfaces.h"
#include "tests/io/temp_folder.h"

namespace frond {
namespace {

bool SameBits(std::span<const double> a, std::span<const double> b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

TEST(SurfaceJson, EverySurface_ReadsBackToTheBit) {
  const TempFolder folder;
  for (const SampleSurface& sample : SampleSurfaces()) {
    const SurfaceDocument written{sample.trimmed, "cm"};
    WriteSurfaceJson(folder / "surface.json", written);
    const SurfaceDocument read = ReadSurfaceJson(folder / "surface.json");
    const NurbsSurface &a = written.trimmed.surface, &b = read.trimmed.surface;
    EXPECT_EQ(read.unit, "cm");
    EXPECT_EQ(a.u().degree(), b.u().degree());
    EXPECT_EQ(a.v().degree(), b.v().degree());
    EXPECT_EQ(a.u().periodic(), b.u().periodic());
    EXPECT_TRUE(SameBits(a.u().knots(), b.u().knots())) << sample.name;
    EXPECT_TRUE(SameBits(a.v().knots(), b.v().knots())) << sample.name;
    EXPECT_TRUE(SameBits(a.weights(), b.weights())) << sample.name;
    EXPECT_TRUE(SameBits({a.control_points()[0].data(), 3 * a.control_points().size()},
                         {b.control_points()[0].data(), 3 * b.control_points().size()}))
        << sample.name;
    EXPECT_EQ(written.trimmed.trim, read.trimmed.trim) << sample.name;
    EXPECT_EQ(FormatSurfaceJson(read), FileText(folder / "surface.json"));
  }
}

TEST(SurfaceJson, AwkwardNumbers_ReadBackToTheBit) {
  const std::vector<Eigen::Vector3d> points = {{-0.0, 1e-310, 1e300},
                                               {0.1, 1e22, 123456789012345678.0},
                                               {1.0 / 3, -5e-324, 9007199254740993.0},
                                               {1e21, 4294967296.0, 1}};
  const BSplineBasis line(1, {0, 0, 1, 1});
  const NurbsSurface surface(line, line, points);
  const SurfaceDocument read = ParseSurfaceJson(FormatSurfaceJson({{surface, {}}, "mm"}), "a.json");
  EXPECT_TRUE(SameBits({points[0].data(), 12}, {read.trimmed.surface.control_points()[0].data(), 12}));
}

TEST(SurfaceJson, Python_ReadsTheSameNumbers) {
  if (std::system("python3 -c 'import json' >/dev/null 2>&1") != 0) GTEST_SKIP() << "no python3 here";
  const TempFolder folder;
  const NurbsSurface surface = WavySheet(3, 2, 8, 6, true);
  WriteSurfaceJson(folder / "surface.json", {{surface, {LeafOutline(12)}}, "mm"});
  char expected[64];
  std::snprintf(expected, sizeof(expected), "%.17g", surface.control_point(3, 4).y());
  const std::string script =
      "import json,sys; s=json.load(open(sys.argv[1])); "
      "assert list(s)==['schema','unit','degree','periodic','knots','control_points','weights','trim'], "
      "list(s); "
      "assert s['schema']=='frond.nurbs_surface/1' and s['degree']==[3,2] and s['periodic']==[False,False]; "
      "assert len(s['knots'][0])==12 and len(s['knots'][1])==9; "
      "assert len(s['control_points'])==8 and len(s['control_points'][0])==6; "
      "assert s['control_points'][3][4][1]==float(sys.argv[2]); assert len(s['trim'][0])==12";
  const std::string command =
      "python3 -c \"" + script + "\" '" + (folder / "surface.json").string() + "' " + expected;
  EXPECT_EQ(std::system(command.c_str()), 0);
}

std::string ErrorAfter(const std::string& from, const std::string& to) {
  std::string text = FormatSurfaceJson({{WavySheet(3, 3, 8, 6, true), {LeafOutline(8)}}, "mm"});
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  return MessageOf<InputError>([&] { ParseSurfaceJson(text, "surface.json"); });
}

TEST(SurfaceJson, BadFiles_AreRefusedWithTheirJsonPath) {
  EXPECT_TRUE(
      Holds(ErrorAfter("frond.nurbs_surface/1", "frond.nurbs_surface/9"), "surface.json: schema: expected"));
  EXPECT_TRUE(
      Holds(ErrorAfter("\"mm\"", "\"parsec\""), "surface.json: unit: unknown unit of length 'parsec'"));
  EXPECT_TRUE(Holds(ErrorAfter("\"degree\": [3, 3]", "\"degree\": [3, 99]"),
                    "degree[1]: is 99, expected an integer in [1, 12]"));
  EXPECT_TRUE(
      Holds(ErrorAfter("\"degree\": [3, 3]", "\"degree\": [3, 2.5]"), "degree[1]: expected an integer"));
  EXPECT_TRUE(Holds(ErrorAfter("\"degree\": [3, 3]", "\"degree\": [3]"), "degree: has 1 values, expected 2"));
  EXPECT_TRUE(Holds(ErrorAfter("\"periodic\": [false, false]", "\"periodic\": [false, 0]"),
                    "periodic[1]: expected true or false"));
  EXPECT_TRUE(Holds(ErrorAfter("\"knots\": [\n    [0, ", "\"knots\": [\n    [0, \"a\", "),
                    "knots[0][1]: expected a number"));
  EXPECT_TRUE(Holds(ErrorAfter("\"knots\": [\n    [0, ", "\"knots\": [\n    [5, "), "knots[0]: "));
  EXPECT_TRUE(
      Holds(ErrorAfter("[[0, 1, 2], [", "[[0, null, 2], ["), "control_points[0][0][1]: expected a number"));
  EXPECT_TRUE(Holds(ErrorAfter("[[0, 1, 2], [", "[["), "control_points[0]: has 5 values, expected 6"));
  EXPECT_TRUE(Holds(ErrorAfter("\"weights\": [\n    [1, ", "\"weights\": [\n    [-1, "),
                    "weights[0][0]: a weight must be positive"));
  EXPECT_TRUE(Holds(ErrorAfter("\"weights\"", "\"wights\""), "has no 'weights'"));
  EXPECT_TRUE(Holds(ErrorAfter("\"trim\": [", "\"trim\": [[[0, 0], [1, 1]], "),
                    "trim[0]: a loop needs at least 3 points"));
  EXPECT_TRUE(Holds(ErrorAfter("\"trim\"", "\"trim"), "is not valid JSON"));
  EXPECT_TRUE(Holds(MessageOf<InputError>([] { ParseSurfaceJson("[1]", "a.json"); }),
                    "a.json: expected a JSON object"));
  EXPECT_TRUE(Holds(MessageOf<InputError>([] { ParseSurfaceJson("", "a.json"); }),
                    "a.json: byte 1: is not valid JSON"));
}

TEST(SurfaceFile, UnknownExtension_ListsTheKnown) {
  const std::string message = MessageOf<InputError>([] { ReadSurface("surface.sldprt"); });
  EXPECT_TRUE(Holds(message, "unknown kind of surface '.sldprt' (known: json, step, stp, igs, iges)"));
}

}  // namespace
}  // namespace frond
