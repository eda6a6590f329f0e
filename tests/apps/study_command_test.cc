// SPDX-License-Identifier: BSD-3-Clause
// `frond study`, `report`, `check` and `list` of studies, as a user runs them.
#include "tests/apps/run_program.h"
#include "tests/io/temp_folder.h"

namespace frond {
namespace {

constexpr char kConfig[] = R"(name: small
problems:
  bowl: {set: functions, function: sphere, dimension: 2}
solvers: {lm: {}, pso: {swarm_size: 10}}
budget: {evaluations: 500}
study: {repetitions: 2, starts: random}
)";

struct Case {
  std::vector<std::string> arguments;
  int code;
  const char* said;
};

TEST(StudyCommand, WrongUsageOrConfig_IsCode2AndOneLineWithThePlace) {
  const TempFolder folder;
  folder.Write("study.yaml", kConfig);
  folder.Write("fit.yaml", "name: fit\ninput: {synthetic_leaf: 1}\nproblem: {type: leaf}\n");
  std::filesystem::create_directory(folder / "empty");
  const Case cases[] = {
      {{"study"}, 2, "usage: frond study CONFIG"},
      {{"report"}, 2, "usage: frond report FOLDER"},
      {{"report", "a", "b"}, 2, "usage: frond report FOLDER"},
      {{"report", "empty"}, 2, "empty: is not the folder of a study (it has no plan.csv)"},
      {{"report", "nowhere"}, 2, "nowhere: is not the folder of a study"},
      {{"study", "nowhere.yaml"}, 2, "nowhere.yaml: no such file"},
      {{"study", "fit.yaml"}, 2, "fit.yaml:"},
      {{"studi", "study.yaml"}, 2, "unknown command 'studi' (did you mean 'study'?)"},
      {{"study", "study.yaml", "--set=solvers.lm.type=ml"}, 2, "--set: unknown solver 'ml'"},
      {{"study", "study.yaml", "--set=problems.bowl.set=function"}, 2, "(did you mean 'functions'?)"},
      {{"study", "study.yaml", "--set=study.part=[3, 2]"}, 2, "--set: 'part' must be [k, n]"},
      {{"study", "study.yaml", "--threads=-1"}, 2, "'--threads' must be in [0, 1024]"},
      {{"check", "study.yaml", "--set=study.repetitions=0"}, 2, "'study.repetitions' must be at least 1"},
      {{"fit", "study.yaml"}, 2, "study.yaml"},
  };
  for (const Case& one : cases) {
    const ProgramResult result = RunFrond(one.arguments, folder.path());
    EXPECT_EQ(result.exit_code, one.code) << one.said;
    EXPECT_TRUE(IsOneErrorLine(result.err)) << result.err;
    EXPECT_TRUE(Holds(result.err, one.said));
    EXPECT_EQ(result.out, "");
  }
  EXPECT_EQ(NamesIn(folder.path()), (std::vector<std::string>{"empty", "fit.yaml", "study.yaml"}));
}

TEST(StudyCommand, Study_WritesItsFolderAndReportMakesTheSameBytes) {
  const TempFolder folder;
  folder.Write("study.yaml", kConfig);
  const ProgramResult study = RunFrond({"study", "study.yaml"}, folder.path());
  EXPECT_EQ(study.exit_code, 0) << study.err;
  EXPECT_EQ(study.err, "");
  EXPECT_TRUE(study.out.ends_with("\nruns/small\n")) << study.out;
  const std::vector<std::string> files = {"config.yaml", "jobs",        "lock",
                                          "plan.csv",    "report.html", "runs.csv",
                                          "summary.csv", "summary.md",  "traces"};
  EXPECT_EQ(NamesIn(folder / "runs/small"), files);
  std::vector<std::string> before;
  for (const char* file : {"report.html", "summary.md", "summary.csv", "runs.csv"}) {
    before.push_back(FileText(folder / "runs/small" / file));
    EXPECT_FALSE(before.back().empty());
    std::filesystem::remove(folder / "runs/small" / file);
  }
  const ProgramResult report = RunFrond({"report", "runs/small"}, folder.path());
  EXPECT_EQ(report.exit_code, 0) << report.err;
  EXPECT_EQ(report.out, study.out);
  std::size_t k = 0;
  for (const char* file : {"report.html", "summary.md", "summary.csv", "runs.csv"}) {
    EXPECT_EQ(FileText(folder / "runs/small" / file), before[k++]) << file;
  }
  EXPECT_EQ(NamesIn(folder / "runs/small"), files);
  const ProgramResult quiet = RunFrond({"study", "study.yaml", "--quiet"}, folder.path());
  EXPECT_EQ(quiet.exit_code, 0);
  EXPECT_EQ(quiet.out + quiet.err, "");
}

TEST(StudyCommand, Seed_OfTheFlagIsAnotherStudy) {
  const TempFolder folder;
  folder.Write("study.yaml", kConfig);
  ASSERT_EQ(RunFrond({"study", "study.yaml", "--quiet"}, folder.path()).exit_code, 0);
  const ProgramResult refused = RunFrond({"study", "study.yaml", "--quiet", "--seed=2"}, folder.path());
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_TRUE(IsOneErrorLine(refused.err)) << refused.err;
  EXPECT_TRUE(Holds(refused.err, "runs/small: holds another study"));
  const ProgramResult anew =
      RunFrond({"study", "study.yaml", "--quiet", "--seed=2", "--overwrite"}, folder.path());
  EXPECT_EQ(anew.exit_code, 0) << anew.err;
}

TEST(StudyCommand, Parts_SayWhatIsMissingAndMergeToTheWhole) {
  const TempFolder folder;
  folder.Write("study.yaml", kConfig);
  for (const std::string part : {"1", "2"}) {
    const ProgramResult result = RunFrond(
        {"study", "study.yaml", "--out=part" + part, "--set=study.part=[" + part + ", 2]"}, folder.path());
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.err,
              "frond: part" + part +
                  ": 2 of 4 jobs have no result yet; run the other parts, then the study with their "
                  "folders\n");
    EXPECT_EQ(result.out, "part" + part + "\n");
  }
  const ProgramResult report = RunFrond({"report", "part1"}, folder.path());
  EXPECT_EQ(report.exit_code, 3);
  EXPECT_TRUE(IsOneErrorLine(report.err)) << report.err;
  const ProgramResult whole =
      RunFrond({"study", "study.yaml", "part1", "part2", "--out=whole"}, folder.path());
  EXPECT_EQ(whole.exit_code, 0) << whole.err;
  EXPECT_EQ(whole.err, "");
  EXPECT_TRUE(std::filesystem::exists(folder / "whole/report.html"));
  const ProgramResult foreign =
      RunFrond({"study", "study.yaml", "whole/traces", "--out=other"}, folder.path());
  EXPECT_EQ(foreign.exit_code, 2);
  EXPECT_TRUE(Holds(foreign.err, "whole/traces: is not the folder of a study"));
}

TEST(StudyCommand, Check_CountsTheJobs) {
  const TempFolder folder;
  folder.Write("study.yaml", kConfig);
  const ProgramResult check = RunFrond({"check", "study.yaml"}, folder.path());
  EXPECT_EQ(check.exit_code, 0);
  EXPECT_EQ(check.out, "study.yaml: right, 4 runs\n");
  const std::string nist = std::string(FROND_SOURCE_DIR) + "/configs/study/nist.yaml";
  EXPECT_EQ(RunFrond({"check", nist}, folder.path()).out, nist + ": right, 162 runs\n");
  EXPECT_EQ(NamesIn(folder.path()), std::vector<std::string>{"study.yaml"});
}

TEST(StudyCommand, List_NamesTheSetsAndTheOptionsOfEach) {
  const TempFolder folder;
  const ProgramResult all = RunFrond({"list"}, folder.path());
  const ProgramResult sets = RunFrond({"list", "sets"}, folder.path());
  EXPECT_EQ(sets.exit_code, 0) << sets.err;
  for (const char* set : {"functions", "leaf_weights", "more_wild", "nist", "sheet", "stereo_windows"}) {
    EXPECT_TRUE(Holds(all.out, set));
    EXPECT_TRUE(Holds(sets.out, set));
  }
  const ProgramResult one = RunFrond({"list", "functions"}, folder.path());
  EXPECT_EQ(one.exit_code, 0) << one.err;
  EXPECT_TRUE(Holds(one.out, "dimension"));
  EXPECT_TRUE(Holds(one.out, "rosenbrock"));
}

}  // namespace
}  // namespace frond
