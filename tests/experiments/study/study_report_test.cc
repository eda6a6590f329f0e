// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/study_report.h"

#include <gtest/gtest.h>

#include "experiments/study/study_tables.h"
#include "sample_study.h"

namespace frond {
namespace {

bool Holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::size_t Count(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(StudyReport, NeedsNoNetworkAndNoScript) {
  const SampleStudy study = MadeStudy();
  const std::string html = StudyReportHtml(study.plan, study.analysis);
  EXPECT_EQ(Count(html, "http"), Count(html, "xmlns='http://www.w3.org/2000/svg'"));
  for (const char* part : {"<script", "<link", "url(", "@import", "src="})
    EXPECT_FALSE(Holds(html, part)) << part;
}

TEST(StudyReport, IsWellFormed_WithNamesEscaped) {
  for (const SampleStudy& study : {MadeStudy(), LoneStudy(), HopelessStudy(false), HopelessStudy(true)}) {
    const std::string html = StudyReportHtml(study.plan, study.analysis);
    EXPECT_TRUE(IsWellFormed(html));
    EXPECT_FALSE(Holds(html, "<b>"));
    EXPECT_FALSE(Holds(html, "nan") || Holds(html, ">inf<"));
  }
  const SampleStudy study = MadeStudy();
  EXPECT_TRUE(Holds(StudyReportHtml(study.plan, study.analysis), "&lt;b&gt;&amp;&quot;|"));
}

TEST(StudyReport, HoldsEveryTable_AndItsFigures) {
  const SampleStudy study = MadeStudy();
  const std::string html = StudyReportHtml(study.plan, study.analysis);
  EXPECT_TRUE(Holds(html, TableHtml(ContenderTable(study.analysis))));
  EXPECT_TRUE(Holds(html, TableHtml(SpeedUpTable(study.analysis))));
  for (const Table& table : ProblemTables(study.analysis)) EXPECT_TRUE(Holds(html, TableHtml(table)));
  // 4 profiles, the critical difference, 2 problems by evaluations and by seconds.
  EXPECT_EQ(Count(html, "<figure>"), 9U);
  EXPECT_EQ(Count(html, "<figcaption>"), 9U);
}

TEST(StudyReport, RunLengths_StandWhereTheDataAre) {
  // From 1 to the smallest budget, 20,000, and 3 % more decades, on 376 pixels from 62; 0 to 1.02 on 250 up
  // from 284. 10 evaluations are at 62 + 376/(1.03 log10(20000)) = 146.9, 100 at 231.7; a quarter is at 284 −
  // 250 · 0.25/1.02 = 222.7, half at 161.5.
  const SampleStudy study = MadeStudy();
  const std::string html = StudyReportHtml(study.plan, study.analysis);
  EXPECT_TRUE(Holds(html, "M62 284H146.9V222.7H231.7V161.5H")) << html.substr(html.find("d='M62 284"), 60);
}

TEST(StudyReport, ManyProblems_AreFolded) {
  SampleStudy study = MadeStudy();
  for (int k = 0; k < 70; ++k) study.analysis.problems.push_back(study.analysis.problems[0]);
  const std::string html = StudyReportHtml(study.plan, study.analysis);
  EXPECT_TRUE(Holds(html, "The first 12 of 72 problems; those up to the 60th are folded below"));
  EXPECT_EQ(Count(html, "<figure>"), 5U + 2 * 60);
  EXPECT_TRUE(IsWellFormed(html));
}

TEST(StudyReport, IsTheSameBytesTwice) {
  const SampleStudy study = MadeStudy();
  EXPECT_EQ(StudyReportHtml(study.plan, study.analysis), StudyReportHtml(study.plan, study.analysis));
}

}  // namespace
}  // namespace frond
