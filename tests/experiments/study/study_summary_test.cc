// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/study_summary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <sstream>

#include "experiments/study/display_number.h"
#include "experiments/study/markup_text.h"
#include "experiments/study/study_tables.h"
#include "experiments/study/study_texts.h"
#include "sample_study.h"

namespace frond {
namespace {

bool Holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::vector<std::string> RowTexts(const Table& table, std::size_t row) {
  std::vector<std::string> texts;
  for (const TableCell& cell : table.rows.at(row)) texts.push_back(cell.text);
  return texts;
}

using Texts = std::vector<std::string>;

TEST(DisplayNumber, HasThreeDigitsOrAWord) {
  EXPECT_EQ(ThreeDigits(12.345), "12.3");
  EXPECT_EQ(ThreeDigits(7), "7");
  EXPECT_EQ(ThreeDigits(0.0012345), "0.00123");
  EXPECT_EQ(ThreeDigits(12345), "12300");
  EXPECT_EQ(ThreeDigits(999.9), "1000");
  EXPECT_EQ(ThreeDigits(-1.5e-9), "-1.50e-9");
  EXPECT_EQ(ThreeDigits(1e7), "1.00e7");
  EXPECT_EQ(ThreeDigits(std::numeric_limits<double>::infinity()), "∞");
  EXPECT_EQ(ThreeDigits(std::numeric_limits<double>::quiet_NaN()), "—");
  EXPECT_EQ(UntilText(std::numeric_limits<double>::infinity()), "never");
  EXPECT_EQ(InFull(1e-5), "1e-5");
  EXPECT_EQ(InFull(0.1), "0.1");
  EXPECT_EQ(Percent(14.0 / 15), "93.3 %");
  EXPECT_EQ(Significance(1e-9), "< 0.001");
  EXPECT_EQ(WholeNumber(1234567), "1,234,567");
}

TEST(MarkupText, Wrapped_KeepsEveryWordWithinTheWidth) {
  EXPECT_EQ(Wrapped("one two three", 7), "one two\nthree\n");
  EXPECT_EQ(Wrapped("one two", 5, 2), "one\n  two\n");
  EXPECT_EQ(Wrapped("abcdefgh", 3), "abc\ndef\ngh\n");
  EXPECT_EQ(Wrapped("", 3), "");
  EXPECT_EQ(Shortened("f₀ − f_L", 4), "f₀ …");
}

TEST(StudyTables, Contenders_HaveTheNumbersOfTheAnalysis) {
  const Table table = ContenderTable(MadeStudy().analysis);
  ASSERT_EQ(table.rows.size(), 3U);
  EXPECT_EQ(RowTexts(table, 0), (Texts{"lm", "26/30", "86.7 %", "70.3–94.7 %", "46.1", "40.2–53.3", "36.5",
                                       "0.0123", "1.25", "0"}));
  EXPECT_EQ(RowTexts(table, 2), (Texts{kOddName, "2/30", "6.7 %", "1.8–21.3 %", "142000", "51000–never",
                                       "never", "never", "3", "6"}));
}

TEST(StudyTables, Problems_HaveTheNumbersOfTheAnalysis) {
  const auto tables = ProblemTables(MadeStudy().analysis);
  ASSERT_EQ(tables.size(), 4U);
  EXPECT_EQ(RowTexts(tables[0], 0), (Texts{"misra1a", "0.0623", "published", "15/15", "9/15", "0/15"}));
  EXPECT_EQ(RowTexts(tables[0], 1), (Texts{"boxbod", "584", "best seen", "11/15", "13/15", "2/15"}));
  EXPECT_EQ(RowTexts(tables[1], 0), (Texts{"misra1a", "31.5", "8120", "never"}));
  EXPECT_EQ(RowTexts(tables[2], 1), (Texts{"boxbod", "585 (586)", "587 (588)", "4890 (589)"}));
  EXPECT_EQ(RowTexts(tables[3], 0), (Texts{"misra1a", "9.25", "4.75", "—"}));
  EXPECT_EQ(RowTexts(tables[3], 1), (Texts{"boxbod", "—", "—", "—"}));
  EXPECT_TRUE(tables[0].rows[1][4].strong);  // 13/15
  EXPECT_FALSE(tables[0].rows[1][3].strong);
}

TEST(StudyTables, SpeedUpsPairsAndDigits_HaveTheNumbersOfTheAnalysis) {
  const StudyAnalysis analysis = MadeStudy().analysis;
  const Table speed_ups = SpeedUpTable(analysis);
  EXPECT_EQ(RowTexts(speed_ups, 0), (Texts{"lm", "—", "12.3 (10.1–15.2), 23/30", "99.5 (0.500–200), 28/28"}));
  EXPECT_EQ(RowTexts(speed_ups, 1), (Texts{"paper_pso", "never, 8/30", "—", "1.50 (1.10–1.90), 25/28"}));
  EXPECT_EQ(RowTexts(speed_ups, 2), (Texts{kOddName, "never, 0/28", "—", "—"}));
  EXPECT_EQ(RowTexts(PairTable(analysis), 0),
            (Texts{"lm", "paper_pso", "17", "12", "0.034", "0.068", "< 0.001", "< 0.001"}));
  EXPECT_EQ(RowTexts(DigitsTable(analysis), 1), (Texts{"paper_pso", "8/30", "7/30", "6/30"}));
}

TEST(StudyTables, Csv_HasEveryNumberInFull) {
  const CsvTable csv = StudyCsv(MadeStudy().analysis);
  ASSERT_EQ(csv.rows.size(), 3U + 2 * 3);
  for (const auto& row : csv.rows) EXPECT_EQ(row.size(), csv.columns.size());
  const auto at = [&](std::size_t row, const std::string& column) {
    const auto found = std::find(csv.columns.begin(), csv.columns.end(), column);
    return csv.rows.at(row).at(static_cast<std::size_t>(found - csv.columns.begin()));
  };
  EXPECT_EQ(at(1, "expected_running_time"), MetricValue(8670.0));
  EXPECT_EQ(at(0, "success_rate"), MetricValue(26.0 / 30));
  EXPECT_EQ(at(3, "problem"), MetricValue(std::string("misra1a")));
  EXPECT_EQ(at(4, "median_digits"), MetricValue(4.75));
  EXPECT_EQ(at(8, "median_objective"), MetricValue(4886.0));
  EXPECT_EQ(at(8, "least_is_published"), MetricValue(false));
}

TEST(StudyTexts, SpeedUps_ReadAsSentences_SureOnesFirst) {
  const auto texts = SpeedUpSentences(MadeStudy().plan, MadeStudy().analysis);
  ASSERT_EQ(texts.size(), 3U);
  EXPECT_EQ(texts[0],
            "lm reaches the best objective of paper_pso with 12.3 (10.1–15.2) times fewer evaluations; in 7 "
            "of 30 runs "
            "it never does: there paper_pso wins.");
  EXPECT_TRUE(texts[2].ends_with("it does in all 28 runs (not sure: the interval holds 1).")) << texts[2];
  EXPECT_EQ(SpeedUpSentences(MadeStudy().plan, MadeStudy().analysis, 1).back(),
            "2 more pairs in the table of speed-ups.");
}

TEST(StudyTexts, Answer_NamesTheBestAndWhatItCannotBeToldFrom) {
  const SampleStudy study = MadeStudy();
  const auto texts = AnswerSentences(study.plan, study.analysis);
  EXPECT_EQ(texts[0],
            "Use lm. Of 3 solvers it ranks best (mean rank 1.25); it reached the target in 26 of 30 runs "
            "(86.7 %, 95 % "
            "interval 70.3–94.7 %), at 46.1 evaluations per success (95 % interval 40.2–53.3).");
  EXPECT_TRUE(Holds(texts[1], "better than " + kOddName)) << texts[1];
  EXPECT_TRUE(Holds(texts[1], "ranks cannot tell it from paper_pso")) << texts[1];
  EXPECT_TRUE(Holds(texts.back(), "smallest budget, 20,000 evaluations"));
}

TEST(StudyTexts, WithoutSuccessOrResult_SaySo) {
  SampleStudy study = HopelessStudy(false);
  EXPECT_TRUE(
      Holds(AnswerSentences(study.plan, study.analysis)[0], "No solver reached the target in any run."));
  EXPECT_TRUE(Holds(AnswerSentences(study.plan, study.analysis)[1], "Over 1 problem the ranks do not tell"));
  study = HopelessStudy(true);
  EXPECT_TRUE(Holds(SpeedUpSentences(study.plan, study.analysis)[0], "No two runs"));
  EXPECT_TRUE(Holds(AnswerSentences(study.plan, study.analysis)[0], "no run gave a result"));
  study = LoneStudy();
  EXPECT_TRUE(Holds(AnswerSentences(study.plan, study.analysis)[0], "nothing to compare"));
}

TEST(StudyMarkdown, EscapesNames_AndKeepsTablesWhole) {
  const SampleStudy study = MadeStudy();
  const std::string text = StudyMarkdown(study.plan, study.analysis);
  EXPECT_FALSE(Holds(text, "<b>"));
  std::istringstream lines(text);
  std::size_t columns = 0;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("|")) {
      columns = 0;
      continue;
    }
    std::size_t bars = 0;
    for (std::size_t k = 0; k < line.size(); ++k)
      bars += line[k] == '|' && (k == 0 || line[k - 1] != '\\') ? 1 : 0;
    if (columns == 0) columns = bars;
    EXPECT_EQ(bars, columns) << line;
  }
  EXPECT_TRUE(Holds(text, "- boxbod lm: 0.3 digits\n"));
  EXPECT_EQ(text, StudyMarkdown(study.plan, study.analysis));
}

TEST(TerminalReport, FitsIntoAHundredColumns) {
  SampleStudy long_names = MadeStudy();
  for (ContenderSummary& c : long_names.analysis.contenders) c.name += std::string(60, 'x');
  for (const SampleStudy& study :
       {MadeStudy(), LoneStudy(), HopelessStudy(false), HopelessStudy(true), long_names}) {
    std::istringstream lines(TerminalReport(study.plan, study.analysis));
    for (std::string line; std::getline(lines, line);) {
      EXPECT_LE(TextWidth(line), 100U) << line;
      EXPECT_FALSE(Holds(line, "nan") || Holds(line, "inf ")) << line;
    }
  }
}

TEST(TerminalReport, DrawsTheRunLengths) {
  const SampleStudy study = MadeStudy();
  const std::string text = TerminalReport(study.plan, study.analysis);
  // 10 is at 79/4 = column 20 of four decades: left of it nothing is there, from there on a quarter.
  EXPECT_TRUE(Holds(text, " 25 % |" + std::string(20, ' ') + std::string(20, 'a'))) << text;
  EXPECT_TRUE(Holds(text, "a = lm, b = paper_pso"));
  const SampleStudy none = HopelessStudy(true);
  EXPECT_TRUE(Holds(TerminalReport(none.plan, none.analysis), "No run reached any target"));
}

}  // namespace
}  // namespace frond
