// SPDX-License-Identifier: BSD-3-Clause
// The four scanned leaves of the shared data, by the configs as they are. Skipped where the data is not
// there.
#include <algorithm>

#include "io/cad_file.h"
#include "io/metrics_json.h"
#include "tests/apps/run_program.h"
#include "tests/io/temp_folder.h"

namespace frond {
namespace {

struct RealLeaf {
  const char* name;
  const char* file;
};

void PrintTo(const RealLeaf& leaf, std::ostream* out) { *out << leaf.file; }

const RealLeaf kLeaves[] = {
    {"clean_soybean", "soybean_11_20190508T043118_pot1_15.txt"},
    {"cut_soybean_with_far_outliers", "soybean_11_20190508T043118_pot1_17.txt"},
    {"bent_sugarbeet_with_petiole", "sugarbeet_f00012_20170904T033001_pot2_1.txt"},
    {"sugarbeet_with_stray_points", "sugarbeet_f00012_20170904T115033_pot1_7.txt"},
};

class RealLeafTest : public ::testing::TestWithParam<RealLeaf> {
 protected:
  void ExpectGoodFit(const std::string& config) {
    const std::filesystem::path scan = std::filesystem::path(FROND_SHARED_DATA) / "leaf" / GetParam().file;
    if (!std::filesystem::exists(scan)) GTEST_SKIP() << "no shared data: " << scan;
    const ProgramResult result =
        RunFrond({"fit", std::string(FROND_SOURCE_DIR) + "/configs/leaf/" + config,
                  "--set=input.cloud=" + scan.string() + "; output.formats=[step, json]", "--out=run"},
                 folder_.path());
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const MetricTable metrics = ReadMetricsJson(folder_ / "run/metrics.json").metrics;
    EXPECT_LE(metrics.Number("inlier_rmse"), 1.3 * metrics.Number("local_noise"));
    const std::string outliers = FileText(folder_ / "run/outliers.csv");
    EXPECT_EQ(static_cast<double>(std::count(outliers.begin(), outliers.end(), '\n') - 1),
              metrics.Number("outliers"));
    const CadCheck step = CheckCadFile(folder_ / "run/surface.step");
    EXPECT_TRUE(step.valid);
    EXPECT_EQ(step.faces, 1U);
    EXPECT_NEAR(step.area, metrics.Number("area"), 0.002 * metrics.Number("area"));
  }

  TempFolder folder_;
};

TEST_P(RealLeafTest, TwentyByTwenty_IsNearTheNoiseAndValid) { ExpectGoodFit("tea_leaf.yaml"); }

TEST_P(RealLeafTest, ChosenNet_IsNearTheNoiseAndValid) { ExpectGoodFit("auto.yaml"); }

INSTANTIATE_TEST_SUITE_P(Leaves, RealLeafTest, ::testing::ValuesIn(kLeaves),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace frond
