// SPDX-License-Identifier: BSD-3-Clause
// `problem.type: skin` as a user runs it: what is refused, and how.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/apps/run_program.h"
#include "tests/io/temp_folder.h"

namespace frond {
namespace {

// A tube of radius 1 along z from 0 to 6.
std::string TubeText() {
  std::string text;
  for (int j = 0; j <= 60; ++j) {
    for (int i = 0; i < 60; ++i) {
      const double angle = 6.283185307179586 * (i + 0.5 * (j % 2)) / 60;
      text += std::to_string(std::cos(angle)) + " " + std::to_string(std::sin(angle)) + " " +
              std::to_string(0.1 * j) + "\n";
    }
  }
  return text;
}

ProgramResult Fit(const TempFolder& folder, const std::string& problem) {
  folder.Write("tube.xyz", TubeText());
  folder.Write("fit.yaml", "name: tube\ninput: {cloud: tube.xyz, unit: mm}\nproblem: {type: skin, " +
                               problem + "}\noutput: {formats: [json, step]}\n");
  return RunFrond({"fit", "fit.yaml", "--out=run"}, folder.path());
}

void ExpectRefused(const std::string& problem, int code, const std::string& said) {
  const TempFolder folder;
  const ProgramResult result = Fit(folder, problem);
  EXPECT_EQ(result.exit_code, code) << result.err;
  EXPECT_TRUE(IsOneErrorLine(result.err)) << result.err;
  EXPECT_NE(result.err.find(said), std::string::npos) << result.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "run"));
}

TEST(SkinCommand, GivenPlanes_WriteTheSurface) {
  const TempFolder folder;
  const ProgramResult result =
      Fit(folder,
          "sections: {by: planes, planes: [[0, 0, 1, 0, 0, 1], [0, 0, 2, 0, 0.1, 1], [0, 0, 3, 0, 0, 1], "
          "[0, 0, 4, 0, 0, 1]]}");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const char* file : {"surface.json", "surface.step", "metrics.json", "deviation.ply"}) {
    EXPECT_TRUE(std::filesystem::exists(folder / "run" / file)) << file;
  }
}

TEST(SkinCommand, PlaneThatMissesTheCloud_IsNamed) {
  ExpectRefused(
      "sections: {by: planes, planes: [[0, 0, 1, 0, 0, 1], [0, 0, 2, 0, 0, 1], [0, 0, 3, 0, 0, 1], "
      "[0, 0, 40, 0, 0, 1]]}",
      3, "tube.xyz: the plane of section 4 misses the cloud");
}

TEST(SkinCommand, PlanesThatCrossInside_AreNamed) {
  ExpectRefused(
      "sections: {by: planes, planes: [[0, 0, 1, 0, 0, 1], [0, 0, 2, 0, 0, 1], [0, 0, 2.3, 0.6, 0, 1], "
      "[0, 0, 4, 0, 0, 1]]}",
      3, "sections 2 and 3 cross each other inside the object");
}

TEST(SkinCommand, TooFewSections_AreCounted) {
  ExpectRefused(
      "sections: {by: planes, planes: [[0, 0, 1, 0, 0, 1], [0, 0, 2, 0, 0, 1], [0, 0, 3, 0, 0, 1]]}", 3,
      "degree 3 along v needs at least 4 sections, not 3");
}

TEST(SkinCommand, SectionWithTooFewPoints_IsNamedWithTheirCount) {
  // A tilted plane that meets a ring's points within so small a tolerance in two places only.
  ExpectRefused(
      "sections: {tolerance: 0.001, by: planes, planes: [[0, 0, 1, 0, 0, 1], [0, 0, 2, 0, 0.11, 1], "
      "[0, 0, 3, 0, 0, 1], [0, 0, 4, 0, 0, 1]]}",
      3, "section 2 has ");
}

TEST(SkinCommand, OptionsThatCannotWork_AreConfigErrors) {
  ExpectRefused("sections: {by: planes}", 2, "'sections.planes' has none");
  ExpectRefused("sections: {planes: [[0, 0, 1, 0, 0, 1]]}", 2, "but 'sections.by' is axis");
  ExpectRefused("sections: {by: planes, planes: [[0, 0, 1, 0, 0, 0]]}", 2,
                "plane 1 of 'sections.planes' has a normal");
  ExpectRefused("sections: {by: planes, planes: [[0, 0, 1]]}", 2, "lists of 6 numbers");
  ExpectRefused("curve: {control_points: 3}", 2, "needs at least 4");
  ExpectRefused("surface: {control_points_v: 3}", 2, "needs at least 4");
}

}  // namespace
}  // namespace frond
