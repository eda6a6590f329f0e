// SPDX-License-Identifier: BSD-3-Clause
#include "sample_study.h"

#include <limits>
#include <regex>

namespace frond {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

StudyPlan MadePlan(const std::vector<std::string>& contenders, const std::vector<std::string>& problems) {
  StudyPlan plan;
  plan.name = "nist_" + std::to_string(contenders.size());
  plan.seed = 4711;
  for (const std::string& name : problems) plan.problems.push_back({name, "nist", Options({}), {name, {}}});
  for (std::size_t k = 0; k < contenders.size(); ++k) {
    plan.solvers.push_back({contenders[k], "ceres_lm", Options({})});
    plan.contenders.push_back({contenders[k], k, {.max_evaluations = 20000 + 10000 * static_cast<int>(k)}});
  }
  return plan;
}

ProblemSummary::Band MadeBand(double scale) {
  return {{{1, 10, 100}, {50 * scale, 5 * scale, scale}},
          {{1, 10, 100}, {90 * scale, 9 * scale, 2 * scale}},
          {{1, 10, 100}, {kInfinity, 20 * scale, 3 * scale}}};
}

void FillRuns(SampleStudy* study) {
  const StudyPlan& plan = study->plan;
  for (std::size_t p = 0; p < plan.problems.size(); ++p) {
    for (int r = 0; r < plan.settings.repetitions; ++r) {
      for (std::size_t c = 0; c < plan.contenders.size(); ++c) study->analysis.runs.push_back({p, c, r});
    }
  }
}

void AddComparisons(StudyAnalysis* a) {
  a->pairs = {{0, 1, 17, 12, 0.034, 0.068, 1e-6, 3e-6},
              {0, 2, 29, 1, 1e-5, 3e-5, 0.011, 0.022},
              {1, 2, 24, 5, 0.021, 0.042, 0.23, 0.24}};
  a->speed_ups = {{0, 1, 30, 23, 12.3, {10.1, 15.2}}, {0, 2, 28, 28, 99.5, {0.5, 200}},
                  {1, 0, 30, 8, 0, {0, 0.0041}},      {1, 2, 28, 25, 1.5, {1.1, 1.9}},
                  {2, 0, 28, 0, 0, {0, 0}},           {2, 1, 0, 0, kNone, {kNone, kNone}}};
  a->rank_blocks = "problems × repetitions";
  a->rank_block_count = 30;
  a->friedman_p = 0.0004;
  a->critical_difference = 0.605;
  a->equal_groups = {{0, 1}};
  a->digit_misses = {"boxbod lm: 0.3 digits"};
}

}  // namespace

SampleStudy MadeStudy() {
  SampleStudy study{MadePlan({"lm", "paper_pso", kOddName}, {"misra1a", "boxbod"}), {}};
  StudyAnalysis& a = study.analysis;
  FillRuns(&study);
  a.problems = {{"misra1a",
                 0.0623,
                 true,
                 {{15, 0, 15, 31.5, 30, 0.0624, 0.0625, 9.25},
                  {15, 1, 9, 8120, 4050, 0.0711, 0.0626, 4.75},
                  {15, 2, 0, kInfinity, kInfinity, 0.998, 0.876, kNone}},
                 {MadeBand(1), MadeBand(2), MadeBand(4)},
                 {MadeBand(1), MadeBand(2), MadeBand(4)}},
                {"boxbod",
                 584,
                 false,
                 {{15, 0, 11, 61.5, 44, 585, 586, {}},
                  {15, 3, 13, 9130, 5060, 587, 588, {}},
                  {15, 4, 2, 71200, kInfinity, 4886, 589, {}}},
                 {MadeBand(600), MadeBand(700), MadeBand(800)},
                 {MadeBand(600), MadeBand(700), MadeBand(800)}}};
  const Curve ecdf = {{10, 100, 1000}, {0.25, 0.5, 0.75}};
  const Curve slow = {{1000, 10000}, {0.125, 0.375}};
  a.contenders = {{"lm",
                   30,
                   0,
                   26,
                   {0.703, 0.947},
                   46.1,
                   {40.2, 53.3},
                   36.5,
                   0.0123,
                   1.25,
                   ecdf,
                   ecdf,
                   ecdf,
                   ecdf,
                   std::vector<int>{14, 13, 12}},
                  {"paper_pso",
                   30,
                   4,
                   22,
                   {0.556, 0.858},
                   8670,
                   {7010, 10400},
                   4440,
                   1.23,
                   1.75,
                   slow,
                   slow,
                   slow,
                   slow,
                   std::vector<int>{8, 7, 6}},
                  {kOddName,
                   30,
                   6,
                   2,
                   {0.018, 0.213},
                   142000,
                   {51000, kInfinity},
                   kInfinity,
                   kInfinity,
                   3,
                   {},
                   {},
                   {},
                   {},
                   std::vector<int>{3, 2, 1}}};
  AddComparisons(&a);
  for (ContenderSummary& c : study.analysis.contenders) c.digit_runs = c.runs;
  return study;
}

SampleStudy LoneStudy() {
  SampleStudy study{MadePlan({"lm"}, {"misra1a"}), {}};
  FillRuns(&study);
  const Curve curve = {{31}, {1}};
  study.analysis.problems = {
      {"misra1a", 0.0623, true, {{15, 0, 15, 31, 31, 0.0623, 0.0623, {}}}, {MadeBand(1)}, {MadeBand(1)}}};
  study.analysis.contenders = {
      {"lm", 15, 0, 15, {0.796, 1}, 31, {31, 31}, 31, 0.002, 1, curve, curve, curve, curve, {}}};
  study.analysis.rank_blocks = "problems";
  study.analysis.rank_block_count = 1;
  for (ContenderSummary& c : study.analysis.contenders) c.digit_runs = c.runs;
  return study;
}

SampleStudy HopelessStudy(bool failed) {
  SampleStudy study{MadePlan({"lm", "pso"}, {"misra1a"}), {}};
  FillRuns(&study);
  const int failures = failed ? 15 : 0;
  const double objective = failed ? kNone : 0.8;
  ProblemCell cell{15, failures, 0, kInfinity, kInfinity, objective, objective, {}};
  study.analysis.problems = {{"misra1a", failed ? kNone : 0.0623, true, {cell, cell}, {{}, {}}, {{}, {}}}};
  for (const char* name : {"lm", "pso"}) {
    ContenderSummary c;
    c.name = name;
    c.runs = 15;
    c.failed = failures;
    c.success_interval = {0, 0.204};
    c.expected_running_time = c.median_run_length = c.median_seconds = kInfinity;
    c.expected_running_time_interval = {kInfinity, kInfinity};
    c.mean_rank = 1.5;
    study.analysis.contenders.push_back(c);
  }
  study.analysis.pairs = {{0, 1, 0, 0, 1, 1, kNone, kNone}};
  study.analysis.speed_ups = {{0, 1, failed ? 0 : 15, 0, 0, {0, 0}}, {1, 0, failed ? 0 : 15, 0, 0, {0, 0}}};
  study.analysis.rank_blocks = "problems";
  study.analysis.rank_block_count = 1;
  study.analysis.equal_groups = {{0, 1}};
  study.analysis.critical_difference = 1.96;
  for (ContenderSummary& c : study.analysis.contenders) c.digit_runs = c.runs;
  return study;
}

bool IsWellFormed(const std::string& markup) {
  static const std::regex tag(R"re(<(/?)([a-zA-Z][\w]*)((?:\s+[\w:-]+=(?:"[^"<]*"|'[^'<]*'))*)\s*(/?)>)re");
  static const std::regex entity("&(lt|gt|amp|quot|#39);");
  std::vector<std::string> open;
  std::size_t at = 0;
  while ((at = markup.find_first_of("<&", at)) != std::string::npos) {
    std::match_results<std::string::const_iterator> match;
    const auto begin = markup.begin() + static_cast<std::ptrdiff_t>(at);
    if (markup.compare(at, 15, "<!DOCTYPE html>") == 0) {
      at += 15;
      continue;
    }
    const bool is_tag = markup[at] == '<';
    // Only this tag is looked at: paths are too long for a regular expression to pass by.
    const auto end =
        is_tag ? markup.begin() +
                     static_cast<std::ptrdiff_t>(std::min(markup.find('>', at), markup.size() - 1)) + 1
               : begin + static_cast<std::ptrdiff_t>(std::min<std::size_t>(6, markup.size() - at));
    if (!std::regex_search(begin, end, match, is_tag ? tag : entity, std::regex_constants::match_continuous))
      return false;
    at += static_cast<std::size_t>(match.length(0));
    if (!is_tag || match[4].length() > 0) continue;
    if (match[1].length() == 0) {
      open.push_back(match[2]);
    } else if (open.empty() || open.back() != match[2]) {
      return false;
    } else {
      open.pop_back();
    }
  }
  return open.empty();
}

}  // namespace frond
