// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "tests/apps/run_program.h"
#include "tests/io/temp_folder.h"

namespace frond {
namespace {

constexpr char kConfig[] = R"(name: small
input: {synthetic_leaf: 1, points: 3000}
problem: {type: leaf, surface: {control_points: [6, 6]}}
output: {formats: [json]}
)";

struct Case {
  std::vector<std::string> arguments;
  int code;
  const char* said;
};

TEST(CommandLine, WrongUsage_IsCode2AndOneLineWithTheWayOut) {
  const TempFolder folder;
  folder.Write("fit.yaml", kConfig);
  const Case cases[] = {
      {{}, 2, "no command; see frond --help"},
      {{"fti", "fit.yaml"}, 2, "unknown command 'fti' (did you mean 'fit'?)"},
      {{"zzzzzz"}, 2, "unknown command 'zzzzzz'; see frond --help"},
      {{"fit", "fit.yaml", "--overwite"}, 2, "unknown flag '--overwite' (did you mean '--overwrite'?)"},
      {{"fit", "fit.yaml", "--threads=many"}, 2, "flag '--threads' cannot be 'many'"},
      {{"fit", "fit.yaml", "--threads=-1"}, 2, "'--threads' must be in [0, 1024]"},
      {{"fit", "fit.yaml", "--seed=18446744073709551615"}, 2, "'--seed' must be in"},
      {{"fit", "fit.yaml", "--seed"}, 2, "flag '--seed' needs a value"},
      {{"fit"}, 2, "usage: frond fit CONFIG"},
      {{"fit", "fit.yaml", "other.yaml"}, 2, "usage: frond fit CONFIG"},
      {{"fit", "fit.yaml", "--set=seed"}, 2, "'seed' is not KEY=VALUE"},
      {{"check"}, 2, "usage: frond check CONFIG"},
      {{"convert", "only.ply"}, 2, "usage: frond convert IN OUT"},
      {{"list", "leafs"}, 2, "(did you mean 'leaf'?)"},
      {{"synth", "leef"}, 2, "unknown kind 'leef'"},
      {{"synth", "leaf", "--set=ponits=100"}, 2, "(did you mean 'points'?)"},
      {{"fit", "fit.yaml", "--set=solver.type=ml"}, 2, "unknown solver 'ml'"},
      {{"fit", "fit.yaml", "--set=problem.type=laef"},
       2,
       "unknown problem type 'laef' (did you mean 'leaf'?)"},
      {{"fit", "nowhere.yaml"}, 2, "nowhere.yaml: no such file"},
      {{"--"}, 2, "'--' is not a flag; see frond --help"},
      {{"---help"}, 2, "'---help' is not a flag; see frond --help"},
      {{"f\ni\tt\x1b[31m"}, 2, "unknown command 'f?i?t?[31m'"},
      {{"fit", "fit.yaml", "--set=seed=1", "--set=problem.type=laef"}, 2, "unknown problem type 'laef'"},
      {{"fit", "fit.yaml", "--set=seed=-1", "--set=name=other"}, 2, "'seed' must not be negative"},
  };
  for (const Case& one : cases) {
    const ProgramResult result = RunFrond(one.arguments, folder.path());
    EXPECT_EQ(result.exit_code, one.code) << one.said;
    EXPECT_TRUE(IsOneErrorLine(result.err)) << result.err;
    EXPECT_TRUE(Holds(result.err, one.said));
    EXPECT_EQ(result.out, "");
  }
  EXPECT_EQ(NamesIn(folder.path()), std::vector<std::string>{"fit.yaml"});
}

TEST(CommandLine, HelpAndVersion_GoToStdoutWithCode0) {
  const TempFolder folder;
  for (const char* flag : {"--help", "-h", "-help"}) {
    const ProgramResult help = RunFrond({flag}, folder.path());
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_EQ(help.err, "");
    for (const char* command : {"fit", "check", "list", "synth", "convert", "exit codes"}) {
      EXPECT_TRUE(Holds(help.out, command));
    }
  }
  const ProgramResult version = RunFrond({"--version"}, folder.path());
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_TRUE(version.out.starts_with("frond 0."));
}

TEST(CommandLine, List_NamesEverythingAndTheOptionsOfEach) {
  const TempFolder folder;
  const ProgramResult all = RunFrond({"list"}, folder.path());
  EXPECT_EQ(all.exit_code, 0);
  for (const char* name :
       {"leaf", "surface", "curve", "lm", "dogleg", "lbfgs", "pso", "pso_lm", "step", "iges", "pcd"}) {
    EXPECT_TRUE(Holds(all.out, name));
    EXPECT_EQ(all.err, "");
  }
  EXPECT_TRUE(Holds(RunFrond({"list", "leaf"}, folder.path()).out, "point_set.petiole_width = auto"));
  EXPECT_TRUE(Holds(RunFrond({"list", "pso"}, folder.path()).out, "swarm_size = 40"));
  EXPECT_TRUE(Holds(RunFrond({"list", "synth"}, folder.path()).out, "petiole_length = 0"));
}

TEST(CommandLine, Check_SaysRightWithoutRunning) {
  const TempFolder folder;
  folder.Write("fit.yaml", kConfig);
  const ProgramResult right = RunFrond({"check", "fit.yaml"}, folder.path());
  EXPECT_EQ(right.exit_code, 0);
  EXPECT_EQ(right.out, "fit.yaml: right\n");
  const ProgramResult sweep = RunFrond({"check", "fit.yaml", "--set=sweep={seed: [1, 2, 3]}"}, folder.path());
  EXPECT_EQ(sweep.out, "fit.yaml: right, 3 runs\n");
  const ProgramResult wrong =
      RunFrond({"check", "fit.yaml", "--set=problem.surface.degree=0"}, folder.path());
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_EQ(NamesIn(folder.path()), std::vector<std::string>{"fit.yaml"});
}

TEST(CommandLine, Fit_WritesTheRunWhereAskedAndSaysSo) {
  const TempFolder folder;
  folder.Write("fit.yaml", kConfig);
  const ProgramResult result = RunFrond({"fit", "fit.yaml"}, folder.path());
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_TRUE(Holds(result.out, "leaf: "));
  EXPECT_TRUE(Holds(result.out, "runs/small"));
  EXPECT_TRUE(std::filesystem::exists(folder / "runs/small/metrics.json"));
  EXPECT_EQ(NamesIn(folder / "runs"), std::vector<std::string>{"small"});
  const ProgramResult quiet = RunFrond({"fit", "fit.yaml", "--quiet", "--out", "other"}, folder.path());
  EXPECT_EQ(quiet.exit_code, 0) << quiet.err;
  EXPECT_EQ(quiet.out + quiet.err, "");
  EXPECT_TRUE(std::filesystem::exists(folder / "other/surface.json"));
}

TEST(CommandLine, Sweep_CountsItsFailuresAndFailsByTheFirstIfAllDo) {
  const TempFolder folder;
  folder.Write("fit.yaml", kConfig);
  const ProgramResult some = RunFrond({"fit", "fit.yaml", "--out=some", "--quiet", "--set=input.points=300",
                                       "--set=sweep={problem.surface.control_points: [6, 40]}"},
                                      folder.path());
  EXPECT_EQ(some.exit_code, 0);
  EXPECT_EQ(some.err, "frond: warning: 1 of 2 runs failed; see some/runs.csv\n");
  const ProgramResult all = RunFrond(
      {"fit", "fit.yaml", "--out=all/deep/run", "--set=input={cloud: nowhere.ply}; sweep={seed: [1, 2]}"},
      folder.path());
  EXPECT_EQ(all.exit_code, 3);
  EXPECT_TRUE(IsOneErrorLine(all.err)) << all.err;
  EXPECT_EQ(NamesIn(folder.path()), (std::vector<std::string>{"fit.yaml", "some"}));
}

TEST(CommandLine, ExistingRun_IsKeptUnlessOverwriteIsGiven) {
  const TempFolder folder;
  folder.Write("fit.yaml", kConfig);
  const std::vector<std::string> fit = {"fit", "fit.yaml", "--out=run"};
  ASSERT_EQ(RunFrond(fit, folder.path()).exit_code, 0);
  const std::string before = FileText(folder / "run/metrics.json");
  const ProgramResult refused = RunFrond(fit, folder.path());
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_TRUE(IsOneErrorLine(refused.err));
  EXPECT_TRUE(Holds(refused.err, "--overwrite"));
  EXPECT_EQ(FileText(folder / "run/metrics.json"), before);

  std::vector<std::string> again = fit;
  again.insert(again.end(), {"--overwrite", "--seed=7"});
  EXPECT_EQ(RunFrond(again, folder.path()).exit_code, 0);
  EXPECT_TRUE(Holds(FileText(folder / "run/metrics.json"), "\"seed\": 7"));
  // A failing run with --overwrite leaves the old one alone.
  again.push_back("--set=input={cloud: nowhere.ply}");
  EXPECT_EQ(RunFrond(again, folder.path()).exit_code, 3);
  EXPECT_TRUE(Holds(FileText(folder / "run/metrics.json"), "\"seed\": 7"));
  EXPECT_EQ(NamesIn(folder.path()), (std::vector<std::string>{"fit.yaml", "run"}));
}

TEST(CommandLine, FolderThatIsNoRun_IsNeverReplaced) {
  const TempFolder folder;
  folder.Write("fit.yaml", kConfig);
  std::filesystem::create_directory(folder / "mine");
  folder.Write("mine/thesis.txt", "years of work");
  const ProgramResult result = RunFrond({"fit", "fit.yaml", "--out=mine", "--overwrite"}, folder.path());
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_TRUE(IsOneErrorLine(result.err));
  EXPECT_EQ(FileText(folder / "mine/thesis.txt"), "years of work");
}

TEST(CommandLine, SynthFitConvert_WorkOneAfterTheOther) {
  const TempFolder folder;
  folder.Write("fit.yaml", kConfig);
  const ProgramResult synth = RunFrond(
      {"synth", "leaf", "--seed=3", "--set=points=2000; dense_points=1000", "--out=leaf"}, folder.path());
  ASSERT_EQ(synth.exit_code, 0) << synth.err;
  EXPECT_EQ(synth.out.find('\n'), synth.out.size() - 1);
  const ProgramResult fit =
      RunFrond({"fit", "fit.yaml", "--set=input={cloud: leaf/scan.ply, truth: leaf/truth.ply}", "--out=run"},
               folder.path());
  ASSERT_EQ(fit.exit_code, 0) << fit.err;
  EXPECT_TRUE(Holds(FileText(folder / "run/metrics.json"), "\"truth_rmse\""));
  const ProgramResult convert = RunFrond({"convert", "run/surface.json", "leaf.step"}, folder.path());
  EXPECT_EQ(convert.exit_code, 0) << convert.err;
  EXPECT_TRUE(Holds(FileText(folder / "leaf.step"), "B_SPLINE_SURFACE"));
  const ProgramResult wrong = RunFrond({"convert", "run/surface.json", "leaf.docx"}, folder.path());
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_TRUE(IsOneErrorLine(wrong.err)) << wrong.err;
}

}  // namespace
}  // namespace frond
