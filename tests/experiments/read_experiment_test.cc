// SPDX-License-Identifier: BSD-3-Clause
#include "base/errors.h"
#include "tests/experiments/leaf_files.h"

namespace frond {
namespace {

const std::string kHead = "input: {cloud: scan.ply}\n";

std::string Complaint(const std::string& yaml) {
  return MessageOf<ConfigError>([&] { (void)ReadText(yaml); });
}

TEST(ReadExperiment, ShortestConfig_HasTheDocumentedDefaults) {
  const Experiment experiment = ReadText(kHead + "problem: {type: leaf}\n");
  EXPECT_EQ(experiment.name, "fit");
  EXPECT_EQ(experiment.seed, 0U);
  EXPECT_EQ(experiment.input.unit, "mm");
  EXPECT_EQ(experiment.solver_type, "lm");
  EXPECT_EQ(experiment.formats, (std::vector<std::string>{"json", "step", "ply"}));
  EXPECT_EQ(experiment.problem.Text("method"), "distance");
  EXPECT_EQ(experiment.problem.Integers("surface.control_points"), (std::vector<int>{20, 20}));
  EXPECT_EQ(experiment.problem.Integers("surface.degree"), (std::vector<int>{3, 3}));
  EXPECT_EQ(experiment.problem.Text("point_set.petiole_width"), "auto");
  EXPECT_EQ(experiment.problem.Integer("point_set.slices"), 50);
  EXPECT_EQ(experiment.problem.Integer("point_set.selected"), 7);
  EXPECT_EQ(experiment.problem.Numbers("paper.alpha"), (std::vector<double>{0.8, 0.2}));
}

TEST(ReadExperiment, PapersMethod_HasThePapersNetUnlessToldOtherwise) {
  const Experiment paper = ReadText(kHead + "problem: {type: leaf, method: paper}\n");
  EXPECT_EQ(paper.problem.Integers("surface.degree"), (std::vector<int>{2, 2}));
  EXPECT_EQ(paper.problem.Integers("surface.control_points"), (std::vector<int>{5, 5}));
  const Experiment own =
      ReadText(kHead + "problem: {type: leaf, method: paper, surface: {control_points: [6, 4]}}\n");
  EXPECT_EQ(own.problem.Integers("surface.control_points"), (std::vector<int>{6, 4}));
}

TEST(ReadExperiment, UnknownKeys_AreNamedWithPlaceAndNearestKey) {
  EXPECT_TRUE(
      Holds(Complaint(kHead + "problem: {type: leaf}\nslover: {type: lm}\n"), "fit.yaml:3:1: unknown key"));
  EXPECT_TRUE(
      Holds(Complaint(kHead + "problem: {type: leaf}\nslover: {type: lm}\n"), "(did you mean 'solver'?)"));
  EXPECT_TRUE(Holds(Complaint(kHead + "problem:\n  type: leaf\n  point_set:\n    slcies: 3\n"),
                    "fit.yaml:5:5: unknown key 'slcies' in 'point_set' (did you mean 'slices'?)"));
  EXPECT_TRUE(Holds(Complaint(kHead + "problem: {type: surface, point_set: {slices: 3}}\n"), "'point_set'"));
  EXPECT_TRUE(
      Holds(Complaint(kHead + "problem: {type: leaf}\nsolver: {type: lm, swarm_size: 3}\n"), "'swarm_size'"));
  EXPECT_TRUE(Holds(Complaint("input: {cluod: a.ply}\nproblem: {type: leaf}\n"), "(did you mean 'cloud'?)"));
  EXPECT_TRUE(Holds(Complaint(kHead + "problem: {type: leaf}\noutput: {format: [json]}\n"),
                    "(did you mean 'formats'?)"));
  EXPECT_TRUE(Holds(Complaint(kHead + "problem: {type: leaf}\nbudget: {evalutions: 3}\n"),
                    "(did you mean 'evaluations'?)"));
}

TEST(ReadExperiment, WrongTypes_AreRefusedWithWhatIsAccepted) {
  EXPECT_TRUE(Holds(Complaint(kHead + "problem: {type: leaf, point_set: {slices: many}}\n"),
                    "'slices' in 'point_set' is many, expected an integer"));
  EXPECT_TRUE(
      Holds(Complaint(kHead + "problem: {type: leaf, point_set: {slices: 2.5}}\n"), "expected an integer"));
  EXPECT_TRUE(Holds(Complaint(kHead + "problem: {type: leaf, point_set: 3}\n"), "expected a section"));
  EXPECT_TRUE(
      Holds(Complaint(kHead + "problem: {type: leaf, fit: {tie_tip: 3}}\n"), "expected true or false"));
  EXPECT_TRUE(Holds(Complaint(kHead + "problem: {type: leaf}\nseed: one\n"), "fit.yaml:3:7: "));
  EXPECT_TRUE(Holds(Complaint(kHead + "problem: {type: leaf}\noutput: {formats: [docx]}\n"),
                    "unknown format 'docx'"));
  EXPECT_TRUE(
      Holds(Complaint("input: {cloud: a.ply, unit: parsec}\nproblem: {type: leaf}\n"), "expected one of"));
}

TEST(ReadExperiment, ValuesOutOfRange_AreRefused) {
  const std::string leaf = kHead + "problem: {type: leaf, surface: ";
  EXPECT_TRUE(Holds(Complaint(leaf + "{degree: 0}}\n"), "integers in [1, 12]"));
  EXPECT_TRUE(Holds(Complaint(leaf + "{degree: [3, 13]}}\n"), "integers in [1, 12]"));
  EXPECT_TRUE(Holds(Complaint(leaf + "{degree: [3, 3, 3]}}\n"), "a list of 1 to 2 integers"));
  EXPECT_TRUE(
      Holds(Complaint(leaf + "{degree: [5, 3], control_points: [5, 20]}}\n"), "degree 5 needs at least 6"));
  EXPECT_TRUE(Holds(Complaint(kHead + "problem: {type: leaf}\nseed: -1\n"), "'seed' must not be negative"));
  EXPECT_TRUE(
      Holds(Complaint(kHead + "problem: {type: leaf}\nbudget: {seconds: 0}\n"), "'seconds' must be above 0"));
  EXPECT_TRUE(Holds(Complaint(kHead + "problem: {type: leaf}\nbudget: {evaluations: 0}\n"), "at least 1"));
}

TEST(ReadExperiment, WhatIsMissingOrDoubled_IsSaid) {
  EXPECT_TRUE(Holds(Complaint(kHead), "'problem.type' is missing"));
  EXPECT_TRUE(Holds(Complaint("problem: {type: leaf}\n"), "no input"));
  EXPECT_TRUE(
      Holds(Complaint("input: {cloud: a.ply, synthetic_leaf: 1}\nproblem: {type: leaf}\n"), "not several"));
  EXPECT_TRUE(Holds(Complaint(kHead + "problem: {type: leef}\n"),
                    "unknown problem type 'leef' (did you mean 'leaf'?)"));
  EXPECT_TRUE(
      Holds(Complaint(kHead + "problem: {type: leaf}\nsolver: {type: psoo}\n"), "(did you mean 'pso'?)"));
  EXPECT_TRUE(Holds(Complaint(kHead + "problem: {type: leaf}\nname: a/b\n"), "without '/'"));
  EXPECT_TRUE(
      Holds(Complaint(kHead + "problem: {type: leaf, method: paper, surface: {control_points: auto}}\n"),
            "'method: paper' does not know"));
}

TEST(ReadExperiment, OverridesAndFlags_WinOverTheFile) {
  ConfigFile config = ConfigFile::Parse(kHead + "seed: 3\nproblem: {type: leaf}\n", "fit.yaml", "/data");
  config.Override("problem.surface.control_points=[7, 9]; problem.fit.loss=huber; name=other; input.unit=cm");
  const Experiment experiment = ReadExperiment(config, {.set = "", .seed = 11, .threads = 1});
  EXPECT_EQ(experiment.problem.Integers("surface.control_points"), (std::vector<int>{7, 9}));
  EXPECT_EQ(experiment.problem.Text("fit.loss"), "huber");
  EXPECT_EQ(experiment.name, "other");
  EXPECT_EQ(experiment.input.unit, "cm");
  EXPECT_EQ(experiment.seed, 11U);
  config.Override("problem.fit.lsos=huber");
  EXPECT_TRUE(Holds(MessageOf<ConfigError>([&] { (void)ReadExperiment(config, {}); }),
                    "--set: unknown key 'lsos' in 'fit' (did you mean 'loss'?)"));
}

TEST(ReadExperiment, RelativePaths_StartAtTheConfigOrForSetAtTheWorkingFolder) {
  ConfigFile config = ConfigFile::Parse(kHead + "problem: {type: leaf}\n", "fit.yaml", "/data/leaves");
  EXPECT_EQ(ReadExperiment(config, {}).input.cloud, "/data/leaves/scan.ply");
  config.Override("input.cloud=mine.ply");
  EXPECT_EQ(ReadExperiment(config, {}).input.cloud, std::filesystem::current_path() / "mine.ply");
}

TEST(ReadExperiment, ResolvedConfig_ReadsBackToItself) {
  const Experiment first =
      ReadText(kHead + "seed: 5\nproblem: {type: leaf, surface: {control_points: auto}}\n" +
               "solver: {type: pso_lm}\nbudget: {evaluations: 900, seconds: 2.5, target: 0.1}\n");
  const std::string yaml = first.Resolved().Yaml();
  EXPECT_EQ(ReadText(yaml).Resolved().Yaml(), yaml);
  EXPECT_EQ(ReadText(yaml).budget.max_evaluations, 900);
  EXPECT_EQ(ReadText(yaml).budget.max_seconds, 2.5);
  EXPECT_EQ(ReadText(yaml).budget.target_objective, 0.1);
}

TEST(ReadExperiment, ResolvedConfigOfEverySwarm_ReadsBackToItself) {
  for (const char* swarm :
       {"topology: gbest", "method: fips", "method: spso2011", "topology: random, informed: 4"}) {
    const std::string yaml =
        ReadText(kHead +
                 "problem: {type: leaf, paper: {weights: free}, method: paper}\nsolver: {type: pso, " +
                 swarm + "}\n")
            .Resolved()
            .Yaml();
    EXPECT_EQ(ReadText(yaml).Resolved().Yaml(), yaml);
  }
}

TEST(ReadExperiment, ResolvedConfigOfEveryStandardSet_ReadsBackToItself) {
  for (const char* set :
       {"set: functions, functions: {function: sphere}", "set: nist, nist: {problem: misra1a, start: 1}",
        "set: more_wild, more_wild: {problem: mw07_rosenbrock_2}"}) {
    const std::string yaml =
        ReadText("problem: {type: standard, " + std::string(set) + "}").Resolved().Yaml();
    EXPECT_EQ(ReadText(yaml).Resolved().Yaml(), yaml);
  }
}

}  // namespace
}  // namespace frond
