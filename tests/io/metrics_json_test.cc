// SPDX-License-Identifier: BSD-3-Clause
#include "io/metrics_json.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/errors.h"
#include "io/length_unit.h"
#include "io/number_text.h"
#include "io/sha256.h"
#include "tests/io/temp_folder.h"

namespace frond {
namespace {

RunMetrics SampleMetrics() {
  RunMetrics m;
  m.problem = "leaf";
  m.input = {"/data/a \"leaf\".ply", Sha256("abc"), 40000};
  m.metrics.Set("rmse", 0.1);
  m.metrics.Set("max", 1.0 / 3);
  m.metrics.Set("reverse_max", NAN);
  m.metrics.Set("flipped_normals", std::int64_t{0});
  m.metrics.Set("control_points", std::vector<std::int64_t>{20, 20});
  m.metrics.Set("outliers", std::vector<std::int64_t>{});
  m.metrics.Set("rmse", 0.2);  // replaces, in place
  m.solver = {"lm", "converged", 12.5, 100, 60, 20, 15, 0.75};
  m.stages = {{"foot_points", 0.25}, {"fit", 0.5}};
  m.seed = 18446744073709551615u;
  m.versions.Set("frond", std::string("0.1.0"));
  m.versions.Set("dirty", false);
  return m;
}

TEST(MetricsJson, WhatIsWritten_ReadsBackAndWritesTheSameBytes) {
  const TempFolder folder;
  WriteMetricsJson(folder / "metrics.json", SampleMetrics());
  const RunMetrics read = ReadMetricsJson(folder / "metrics.json");
  EXPECT_EQ(FormatMetricsJson(read), FileText(folder / "metrics.json"));
  EXPECT_EQ(read.metrics.Number("max"), 1.0 / 3);
  EXPECT_EQ(read.metrics.Number("rmse"), 0.2);
  EXPECT_TRUE(std::isnan(read.metrics.Number("reverse_max")));
  EXPECT_TRUE(std::isnan(read.metrics.Number("absent")));
  EXPECT_EQ(read.seed, 18446744073709551615u);
  EXPECT_EQ(read.error, std::nullopt);
}

TEST(MetricsJson, Keys_StandInTheOrderOfTheDesign) {
  const std::string text = FormatMetricsJson(SampleMetrics());
  std::size_t at = 0;
  for (const char* key : {"schema",
                          "problem",
                          "status",
                          "error",
                          "unit",
                          "input",
                          "path",
                          "sha256",
                          "points",
                          "metrics",
                          "rmse",
                          "solver",
                          "name",
                          "termination",
                          "objective",
                          "evaluations",
                          "residual_evaluations",
                          "jacobian_evaluations",
                          "iterations",
                          "seconds",
                          "stages",
                          "seconds",
                          "peak_rss_bytes",
                          "threads",
                          "seed",
                          "versions"}) {
    const std::size_t found = text.find("\"" + std::string(key) + "\":", at);
    ASSERT_NE(found, std::string::npos) << key;
    at = found + 1;
  }
  EXPECT_TRUE(Holds(text, "\"error\": null"));
  EXPECT_TRUE(Holds(text, "\"reverse_max\": null"));
}

TEST(MetricsJson, BadFiles_AreRefusedInOneLine) {
  const TempFolder folder;
  for (const char* text : {"", "{", "[]", "{\"schema\": \"other\"}", "{\"schema\": \"frond.metrics/1\"}"}) {
    const auto path = folder.Write("metrics.json", text);
    EXPECT_TRUE(Holds(MessageOf<InputError>([&] { ReadMetricsJson(path); }), "metrics.json: ")) << text;
  }
}

TEST(Csv, Fields_AreQuotedWhereTheyMust) {
  const TempFolder folder;
  const std::vector<std::string> columns = {"name", "value"};
  const std::vector<std::vector<MetricValue>> rows = {{std::string("a,\"b\""), 0.1},
                                                      {std::string("c"), std::vector<std::int64_t>{1, 2}}};
  WriteCsv(folder / "a.csv", columns, rows);
  EXPECT_EQ(FileText(folder / "a.csv"), "name,value\n\"a,\"\"b\"\"\",0.1\nc,\"[1,2]\"\n");
  WriteTrace(folder / "trace.csv", std::vector<TraceRow>{{1, 0.5, 10}, {20, 1, 0.1}});
  EXPECT_EQ(FileText(folder / "trace.csv"), "evaluations,seconds,best_objective\n1,0.5,10\n20,1,0.1\n");
}

// FIPS 180-4's examples, and the lengths around a block's end.
TEST(Sha256, KnownMessages_HaveTheirPublishedDigests) {
  EXPECT_EQ(Sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(Sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(Sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(Sha256(std::string(1000000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(NumberText, Numbers_AreReadWholeAndWrittenShortest) {
  double value = 0;
  EXPECT_EQ(ParseNumber("+1.5e3,", &value), 6u);
  EXPECT_EQ(value, 1500);
  EXPECT_EQ(ParseNumber("1e-400", &value), 6u);
  EXPECT_EQ(value, 0);
  EXPECT_EQ(ParseNumber("-1e400", &value), 6u);
  EXPECT_EQ(value, -INFINITY);
  for (const char* bad : {"", "+", "-", "+-1", "e5", "abc", " 1"})
    EXPECT_EQ(ParseNumber(bad, &value), 0u) << bad;
  EXPECT_EQ(FormatNumber(0.1), "0.1");
  EXPECT_EQ(FormatNumber(-0.0), "-0.0");
}

TEST(LengthUnit, Metres_AreExact) {
  EXPECT_EQ(MetresPerUnit("mm"), 1e-3);
  EXPECT_EQ(MetresPerUnit("in"), 0.0254);
  EXPECT_TRUE(Holds(MessageOf<ConfigError>([] { MetresPerUnit("furlong"); }),
                    "'furlong' (known: um, mm, cm, m, km, in, ft)"));
}

}  // namespace
}  // namespace frond
