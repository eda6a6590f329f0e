// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/job_result.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/errors.h"
#include "tests/io/temp_folder.h"

namespace frond {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

JobResult MadeResult() {
  JobResult result;
  result.key = "0123456789abcdef01234567";
  result.problem = "nist.misra1a_1";
  result.contender = "lm@10000";
  result.repetition = 14;
  result.start_objective = 0.1;
  result.free_parameters = 2;
  SolverReport& report = result.report;
  report.x = {1.0 / 3, -1e-300, 5e-324, std::numeric_limits<double>::max()};
  report.objective = 0.1 + 0.2;
  report.termination = Termination::kStalled;
  report.message = "no better best in 50 evaluations";
  report.evaluations = std::int64_t{1} << 60;
  report.residual_evaluations = 17;
  report.jacobian_evaluations = 3;
  report.iterations = 12;
  report.seconds = 0.125;
  report.trace = {{1, 0, 7}, {40, 1e-7, 0.1 + 0.2}};
  result.metrics.Set("digits", 9.25);
  result.metrics.Set("a_first", 1.0);
  return result;
}

JobResult RoundTrip(const JobResult& result) {
  const TempFolder folder;
  WriteJobResult(folder / "job.json", result);
  const std::optional<JobResult> back = ReadJobResult(folder / "job.json");
  EXPECT_TRUE(back.has_value());
  return back.value_or(JobResult());
}

TEST(JobResult, ReadBack_IsTheSameToTheLastBit) {
  const JobResult made = MadeResult(), back = RoundTrip(made);
  EXPECT_EQ(back.key, made.key);
  EXPECT_EQ(back.problem, made.problem);
  EXPECT_EQ(back.contender, made.contender);
  EXPECT_EQ(back.repetition, 14);
  EXPECT_TRUE(back.ok());
  EXPECT_EQ(back.start_objective, 0.1);
  EXPECT_EQ(back.free_parameters, 2);
  EXPECT_EQ(back.report.x, made.report.x);
  EXPECT_EQ(back.report.objective, made.report.objective);
  EXPECT_EQ(back.report.message, made.report.message);
  EXPECT_EQ(back.report.evaluations, std::int64_t{1} << 60);
  EXPECT_EQ(back.report.residual_evaluations, 17);
  EXPECT_EQ(back.report.jacobian_evaluations, 3);
  EXPECT_EQ(back.report.iterations, 12);
  EXPECT_EQ(back.report.seconds, 0.125);
  ASSERT_EQ(back.report.trace.size(), 2U);
  EXPECT_EQ(back.report.trace[1].evaluations, 40);
  EXPECT_EQ(back.report.trace[1].seconds, 1e-7);
  EXPECT_EQ(back.report.trace[1].best_objective, 0.1 + 0.2);
  ASSERT_EQ(back.metrics.entries().size(), 2U);
  EXPECT_EQ(back.metrics.entries()[0].first, "digits");
  EXPECT_EQ(back.metrics.Number("digits"), 9.25);
  EXPECT_EQ(FormatJobResult(back), FormatJobResult(made));
}

TEST(JobResult, OfEveryTermination_ComesBack) {
  for (const Termination termination :
       {Termination::kConverged, Termination::kTarget, Termination::kEvaluationBudget,
        Termination::kTimeBudget, Termination::kIterationLimit, Termination::kStalled,
        Termination::kFailed}) {
    JobResult result = MadeResult();
    result.report.termination = termination;
    EXPECT_EQ(RoundTrip(result).report.termination, termination) << TerminationName(termination);
  }
}

TEST(JobResult, NumbersThatAreNotFinite_ComeBackAsNone) {
  JobResult result = MadeResult();
  result.start_objective = kInfinity;
  result.report.objective = kNone;
  result.report.x = {kNone, 1, -kInfinity};
  result.report.trace = {{1, 0, kInfinity}, {2, 0, 3}};
  result.metrics.Set("digits", kNone);
  const JobResult back = RoundTrip(result);
  EXPECT_TRUE(std::isnan(back.start_objective));
  EXPECT_TRUE(std::isnan(back.report.objective));
  ASSERT_EQ(back.report.x.size(), 3U);
  EXPECT_TRUE(std::isnan(back.report.x[0]));
  EXPECT_EQ(back.report.x[1], 1);
  EXPECT_TRUE(std::isnan(back.report.x[2]));
  EXPECT_TRUE(std::isnan(back.report.trace[0].best_objective));
  EXPECT_EQ(back.report.trace[1].best_objective, 3);
  EXPECT_NE(back.metrics.Find("digits"), nullptr);
  EXPECT_TRUE(std::isnan(back.metrics.Number("digits")));
}

TEST(JobResult, ReasonsOfAnyBytes_AreKeptAsFarAsTheyAreUnicode) {
  JobResult result = MadeResult();
  result.status = "crashed";
  for (const char* reason : {"Blätter, 葉, \xF0\x9F\x8C\xBF", "\"quoted\", \\ and\ttabs\nlines", ""}) {
    result.reason = reason;
    EXPECT_EQ(RoundTrip(result).reason, reason);
    EXPECT_FALSE(RoundTrip(result).ok());
  }
  result.reason = "caf\xE9 \xFF\xFE \xC3";
  EXPECT_EQ(RoundTrip(result).reason, "caf\xEF\xBF\xBD \xEF\xBF\xBD\xEF\xBF\xBD \xEF\xBF\xBD");
  result.reason = std::string("a\0b", 3);
  EXPECT_EQ(RoundTrip(result).reason, result.reason);
}

TEST(JobResult, CutOffAnywhere_IsRefusedByName) {
  const TempFolder folder;
  const std::string whole = FormatJobResult(MadeResult());
  ASSERT_EQ(whole.back(), '\n');
  for (std::size_t size = 0; size + 1 < whole.size(); size += 13) {
    const auto path = folder.Write("cut.json", whole.substr(0, size));
    const std::string message = MessageOf<InputError>([&] { (void)ReadJobResult(path); });
    EXPECT_TRUE(Holds(message, path.string() + ": is not a whole result of a job")) << size;
  }
}

TEST(JobResult, OfAnotherSchema_IsRefused) {
  const TempFolder folder;
  std::string text = FormatJobResult(MadeResult());
  text.replace(text.find("frond.job/1"), 11, "frond.job/9");
  for (const std::string& wrong : {text, std::string("[]"), std::string("{}"), std::string("null")}) {
    const auto path = folder.Write("other.json", wrong);
    EXPECT_THROW((void)ReadJobResult(path), InputError) << wrong;
  }
}

TEST(JobResult, ThatIsAbsent_IsNone) {
  const TempFolder folder;
  EXPECT_FALSE(ReadJobResult(folder / "nothing.json").has_value());
}

TEST(JobResult, Written_LeavesNoOtherFile) {
  const TempFolder folder;
  WriteJobResult(folder / "job.json", MadeResult());
  WriteJobResult(folder / "job.json", MadeResult());
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path())) ++files;
  EXPECT_EQ(files, 1U);
  EXPECT_THROW(WriteJobResult(folder / "nowhere/job.json", MadeResult()), InputError);
}

}  // namespace
}  // namespace frond
