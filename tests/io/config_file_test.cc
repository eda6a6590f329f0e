// SPDX-License-Identifier: BSD-3-Clause
#include "io/config_file.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/errors.h"
#include "tests/io/temp_folder.h"

namespace frond {
namespace {

constexpr const char* kLeaf = R"(name: tea_leaf
seed: 42
input: {cloud: scan.ply, unit: mm}
problem:
  type: leaf
  surface:
    degree: [3, 3]
    control_points: auto
  point_set:
    slices: 50
    ordered: true
solver: {type: lm, tolerance: 1e-9}
output: {formats: [step, iges, json]}
)";

Options LeafOptions() {
  return Options(
      {{"surface.degree", OptionType::kIntegers, std::vector<double>{3, 3}, "", 1, 12, {}, 2, 2},
       {"surface.control_points", OptionType::kIntegers, std::string("auto"), "", 2, 1000, {"auto"}, 2, 2},
       {"point_set.slices", OptionType::kInteger, std::int64_t{40}, "", 2, 1000},
       {"point_set.ordered", OptionType::kFlag, true, ""},
       {"robust.scale", OptionType::kNumber, 2.5, "", 0},
       {"label", OptionType::kText, std::string(""), ""},
       {"start", OptionType::kChoice, std::string("paper"), "", 0, 0, {"paper", "rectangle"}},
       {"planes", OptionType::kRows, OptionRows{}, "", -1e9, 1e9, {}, 0, 9, 3}});
}

ConfigFile Leaf(const std::string& yaml = kLeaf) {
  return ConfigFile::Parse(yaml, "leaf.yaml", "/data/leaves");
}

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  text.replace(text.find(from), from.size(), to);
  return text;
}

std::string SectionError(const std::string& yaml) {
  return MessageOf<ConfigError>([&] {
    Options options = LeafOptions();
    Leaf(yaml).ReadSection("problem", &options, {"type"});
  });
}

TEST(ConfigFile, Values_HaveTheirTypes) {
  const ConfigFile config = Leaf();
  EXPECT_EQ(config.Text("name"), "tea_leaf");
  EXPECT_EQ(config.Integer("seed"), 42);
  EXPECT_EQ(config.Number("seed"), 42.0);
  EXPECT_EQ(config.Number("solver.tolerance"), 1e-9);
  EXPECT_TRUE(config.Flag("problem.point_set.ordered"));
  EXPECT_EQ(config.Numbers("problem.surface.degree"), (std::vector<double>{3, 3}));
  EXPECT_EQ(config.Texts("output.formats"), (std::vector<std::string>{"step", "iges", "json"}));
  EXPECT_EQ(config.Integer("threads", 1), 1);
  EXPECT_EQ(config.Keys(""),
            (std::vector<std::string>{"name", "seed", "input", "problem", "solver", "output"}));
  EXPECT_EQ(config.Place("problem.surface.degree"), "leaf.yaml:7:13");
  EXPECT_TRUE(config.IsSection("problem"));
  EXPECT_FALSE(config.Has("problem.surface.knots"));
  EXPECT_EQ(std::get<std::string>(ConfigFile::Parse("a: '12'", "a.yaml").Value("a")), "12");
}

TEST(ConfigFile, ReadSection_SetsRowsFromListsOfLists) {
  Options options = LeafOptions();
  ConfigFile config =
      Leaf(Replaced(kLeaf, "  type: leaf", "  type: leaf\n  planes: [[0, 0, 1], [0, 1.5, 0]]"));
  config.ReadSection("problem", &options, {"type"});
  EXPECT_EQ(options.Rows("planes"), (OptionRows{{0, 0, 1}, {0, 1.5, 0}}));
  config.Override("problem.planes=[[1, 2, 3]]");
  config.ReadSection("problem", &options, {"type"});
  EXPECT_EQ(options.Rows("planes"), (OptionRows{{1, 2, 3}}));
}

TEST(ConfigFile, RowsThatAreNone_AreRefusedWithWhatIsExpected) {
  for (const char* wrong : {"[[1, 2]]", "[[1, 2, x]]", "[1, [1, 2, 3]]", "[[1, 2, 3], 4]", "[[[1, 2, 3]]]"}) {
    EXPECT_EQ(SectionError(Replaced(kLeaf, "  type: leaf", std::string("  type: leaf\n  planes: ") + wrong)),
              std::string("leaf.yaml:6:11: 'planes' in 'problem' is ") + wrong +
                  ", expected a list of 0 to 9 lists of 3 numbers in [-1e+09, 1e+09]");
  }
}

TEST(ConfigFile, ReadSection_SetsNestedOptionsByDottedNames) {
  Options options = LeafOptions();
  Leaf(Replaced(kLeaf, "  type: leaf", "  type: leaf\n  label: 12\n  start: rectangle"))
      .ReadSection("problem", &options, {"type"});
  EXPECT_EQ(options.Integers("surface.degree"), (std::vector<int>{3, 3}));
  EXPECT_TRUE(options.HoldsWord("surface.control_points"));
  EXPECT_EQ(options.Integer("point_set.slices"), 50);
  EXPECT_EQ(options.Text("label"), "12");
  EXPECT_EQ(options.Text("start"), "rectangle");
  EXPECT_FALSE(options.IsSet("robust.scale"));
}

TEST(ConfigFile, UnknownKey_IsNamedWithItsPlaceSectionAndTheNearestKnown) {
  EXPECT_EQ(SectionError(Replaced(kLeaf, "slices", "slcies")),
            "leaf.yaml:10:5: unknown key 'slcies' in 'point_set' (did you mean 'slices'?)");
  EXPECT_EQ(SectionError(Replaced(kLeaf, "point_set", "pointset")),
            "leaf.yaml:9:3: unknown key 'pointset' in 'problem' (did you mean 'point_set'?)");
  EXPECT_TRUE(Holds(SectionError(Replaced(kLeaf, "ordered", "zebra")),
                    "unknown key 'zebra' in 'point_set' (known: slices, ordered)"));
  EXPECT_EQ(MessageOf<ConfigError>([] {
              Leaf(Replaced(kLeaf, "solver", "sovler"))
                  .CheckKeys("", {"name", "seed", "input", "problem", "solver", "output"});
            }),
            "leaf.yaml:12:1: unknown key 'sovler' at the top level (did you mean 'solver'?)");
  EXPECT_EQ(MessageOf<ConfigError>([] { Leaf().CheckKeys("input", {"cloud"}); }),
            "leaf.yaml:3:26: unknown key 'unit' in 'input' (known: cloud)");
}

TEST(ConfigFile, WrongValues_AreNamedWithTheirPlaceAndWhatIsAccepted) {
  EXPECT_EQ(SectionError(Replaced(kLeaf, "[3, 3]", "20")),
            "leaf.yaml:7:13: 'degree' in 'surface' is 20, expected a list of 2 integers in [1, 12]");
  EXPECT_EQ(SectionError(Replaced(kLeaf, "[3, 3]", "[3, x]")),
            "leaf.yaml:7:13: 'degree' in 'surface' is [3, x], expected a list of 2 integers in [1, 12]");
  EXPECT_EQ(SectionError(Replaced(kLeaf, "slices: 50", "slices: many")),
            "leaf.yaml:10:13: 'slices' in 'point_set' is many, expected an integer in [2, 1000]");
  EXPECT_EQ(SectionError(Replaced(kLeaf, "slices: 50", "slices: '50'")),
            "leaf.yaml:10:13: 'slices' in 'point_set' is \"50\", expected an integer in [2, 1000]");
  EXPECT_TRUE(Holds(SectionError(Replaced(kLeaf, "slices: 50", "slices: {a: 1}")),
                    "is a section, expected an integer"));
  EXPECT_TRUE(Holds(SectionError("problem: {point_set: 3}"),
                    "'point_set' in 'problem' is 3, expected a section with keys among slices, ordered"));
  EXPECT_TRUE(Holds(SectionError("problem: leaf"), "leaf.yaml:1:10: 'problem' is leaf, expected a section"));
  EXPECT_TRUE(Holds(SectionError("problem: {start: rectagle}"),
                    "'start' in 'problem' is rectagle, expected one of paper, rectangle"));
  EXPECT_EQ(MessageOf<ConfigError>([] { Leaf().Integer("name"); }),
            "leaf.yaml:1:7: 'name' is tea_leaf, expected an integer");
  EXPECT_EQ(MessageOf<ConfigError>([] { Leaf().Text("input.mesh"); }),
            "leaf.yaml:3:8: 'mesh' in 'input' is missing, expected text");
  EXPECT_EQ(MessageOf<ConfigError>([] { Leaf().Text("study"); }),
            "leaf.yaml: 'study' is missing, expected text");
}

TEST(ConfigFile, Overrides_ReplaceAndAddValuesPlacedAtTheCommandLine) {
  ConfigFile config = Leaf();
  config.Override(
      "problem.surface.degree=[2, 3]; solver.budget.max_seconds = 1e3 ;name=\"a; b\"; input.cloud=my "
      "scan.ply");
  EXPECT_EQ(config.Numbers("problem.surface.degree"), (std::vector<double>{2, 3}));
  EXPECT_EQ(config.Number("solver.budget.max_seconds"), 1000);
  EXPECT_EQ(config.Text("name"), "a; b");
  EXPECT_EQ(config.Text("input.cloud"), "my scan.ply");
  EXPECT_EQ(config.Place("name"), "--set");
  config.Override("problem.point_set.slcies=3");
  Options options = LeafOptions();
  EXPECT_EQ(MessageOf<ConfigError>([&] { config.ReadSection("problem", &options, {"type"}); }),
            "--set: unknown key 'slcies' in 'point_set' (did you mean 'slices'?)");
  for (const char* bad : {"oops", "=3", "a..b=3", "seed=", "seed=[1, 2", "name.x=1", ".a=1"}) {
    EXPECT_EQ(MessageOf<ConfigError>([&] { Leaf().Override(bad); }).rfind("--set: ", 0), 0u) << bad;
  }
}

TEST(ConfigFile, Paths_AreResolvedFromTheConfigOrTheWorkingFolder) {
  ConfigFile config = Leaf("input: {cloud: scan.ply, mesh: ../a.ply, truth: /abs/t.ply}");
  EXPECT_EQ(config.ResolvePath("input.cloud"), "/data/leaves/scan.ply");
  EXPECT_EQ(config.ResolvePath("input.mesh"), "/data/a.ply");
  EXPECT_EQ(config.ResolvePath("input.truth"), "/abs/t.ply");
  config.Override("input.cloud=mine.ply");
  EXPECT_EQ(config.ResolvePath("input.cloud"), std::filesystem::current_path() / "mine.ply");
}

TEST(ConfigFile, BadYaml_IsRefusedInOneLineWithThePlace) {
  const auto error = [](const std::string& yaml) { return MessageOf<ConfigError>([&] { Leaf(yaml); }); };
  EXPECT_EQ(error("a: 1\nb: [1, 2\nc: 3\n").rfind("leaf.yaml:", 0), 0u);
  EXPECT_EQ(error("a: 1\nb: 2\n a: 3\n").rfind("leaf.yaml:", 0), 0u);
  EXPECT_EQ(error("a: {b: 1, c: 2,\n  b: 3}\n"),
            "leaf.yaml:2:3: key 'b' stands twice (first at leaf.yaml:1:5)");
  EXPECT_TRUE(Holds(error(""), "leaf.yaml: is empty"));
  EXPECT_TRUE(Holds(error("# only\n"), "leaf.yaml: is empty"));
  EXPECT_TRUE(Holds(error("- 1\n- 2\n"), "leaf.yaml:1:1: expected keys at the top level"));
  EXPECT_TRUE(Holds(error("seed:\nname: a\n"), "'seed' has no value"));
  EXPECT_TRUE(Holds(error("a: {b: ~}\n"), "leaf.yaml:1:8: 'b' in 'a' has no value"));
  EXPECT_TRUE(Holds(error("a: 1\n---\nb: 2\n"), "more than one YAML document"));
  EXPECT_TRUE(Holds(error("a: &x [1, *x]\n"), "an alias stands inside its own anchor"));
  EXPECT_TRUE(Holds(error("? [1, 2]\n: 3\n"), "a key must be a word"));
  EXPECT_TRUE(Holds(error(std::string(200, '[')), "nested more than 64 deep"));
  EXPECT_TRUE(Holds(error("a: " + std::string(2000000, 'x')), "larger than 1 MB"));
  EXPECT_TRUE(Holds(error(std::string("a: 1\0\1", 6)), "is zero: not a YAML file"));
  std::string laughs = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int k = 1; k < 12; ++k) {
    const std::string alias = "*a" + std::to_string(k - 1);
    laughs += "a" + std::to_string(k) + ": &a" + std::to_string(k) + " [" + alias;
    for (int j = 0; j < 9; ++j) laughs += ", " + alias;
    laughs += "]\n";
  }
  EXPECT_TRUE(Holds(error(laughs), "more than 100000 values"));
}

TEST(ConfigFile, Aliases_AreUnfolded) {
  EXPECT_EQ(Leaf("a: &x [1, 2]\nb: *x\n").Numbers("b"), (std::vector<double>{1, 2}));
}

TEST(ConfigFile, Sweep_ListsItsAxesInOrder) {
  const auto axes =
      Leaf("sweep: {solver.type: [lm, pso], problem: {surface: {control_points: [[10, 10], 20]}}}").Sweep();
  ASSERT_EQ(axes.size(), 2u);
  EXPECT_EQ(axes[0].key, "solver.type");
  EXPECT_EQ(std::get<std::string>(axes[0].values[1]), "pso");
  EXPECT_EQ(axes[1].key, "problem.surface.control_points");
  EXPECT_EQ(std::get<std::vector<double>>(axes[1].values[0]), (std::vector<double>{10, 10}));
  ConfigFile config = Leaf();
  config.Set(axes[1].key, axes[1].values[0]);
  EXPECT_EQ(config.Numbers("problem.surface.control_points"), (std::vector<double>{10, 10}));
  EXPECT_TRUE(Holds(MessageOf<ConfigError>([] { Leaf("sweep: {a: 3}").Sweep(); }),
                    "'a' in 'sweep' is 3, expected a list of values"));
}

TEST(ConfigFile, Load_NamesTheFileAsItWasGiven) {
  const TempFolder folder;
  const auto path = folder.Write("leaf.yaml", "a: [\n");
  EXPECT_EQ(MessageOf<ConfigError>([&] { ConfigFile::Load(path); }).rfind(path.string() + ":", 0), 0u);
  MessageOf<ConfigError>([&] { ConfigFile::Load(folder / "none.yaml"); });
}

TEST(ResolvedConfig, ReadBack_GivesTheSameOptions) {
  Options options = LeafOptions();
  options.Set("label", std::string("yes: \"it\" is #1\n\\ 3"));
  options.Set("robust.scale", INFINITY);
  options.Set("surface.control_points", std::vector<double>{20, 21});
  options.Set("planes", OptionRows{{0, 0.1, 1}, {-1, 2, 3e-9}});
  ResolvedConfig resolved;
  resolved.Add("name", std::string("true"));
  resolved.Add("seed", std::int64_t{42});
  resolved.Add("input.cloud", std::string("/data/my scan.ply"));
  resolved.AddSection("problem", options);
  resolved.Add("problem.type", std::string("leaf"));
  resolved.Add("output.formats", std::vector<std::string>{"step", "json"});
  const ConfigFile config = ConfigFile::Parse(resolved.Yaml(), "config.yaml");
  Options read = LeafOptions();
  config.ReadSection("problem", &read, {"type"});
  for (const OptionSpec& spec : options.specs())
    EXPECT_EQ(read.Value(spec.name), options.Value(spec.name)) << spec.name;
  EXPECT_EQ(std::get<std::string>(config.Value("name")), "true");
  EXPECT_EQ(config.Integer("seed"), 42);
  EXPECT_EQ(config.ResolvePath("input.cloud"), "/data/my scan.ply");
  EXPECT_EQ(config.Texts("output.formats").size(), 2u);
  EXPECT_EQ(config.Keys("")[3], "problem");
}

}  // namespace
}  // namespace frond
