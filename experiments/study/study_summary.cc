// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/study_summary.h"

#include <algorithm>
#include <cmath>

#include "experiments/study/display_number.h"
#include "experiments/study/markup_text.h"
#include "experiments/study/plot_axis.h"
#include "experiments/study/study_figures.h"
#include "experiments/study/study_tables.h"
#include "experiments/study/study_texts.h"

namespace frond {
namespace {

constexpr std::size_t kTerminalWidth = 100;
constexpr std::size_t kPlotColumns = 80, kPlotRows = 13;  // a row each 1/12 of the share
constexpr std::size_t kMargin = 7;                        // "100 % |"

char Letter(std::size_t contender) {
  constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
  return contender < kLetters.size() ? kLetters[contender] : '#';
}

// The first paragraph of a section, then a list of the others.
void AddSentences(std::vector<std::string> sentences, ReportSection* section) {
  if (sentences.empty()) return;
  section->blocks.emplace_back(sentences.front());
  sentences.erase(sentences.begin());
  if (!sentences.empty()) section->blocks.emplace_back(std::move(sentences));
}

ReportSection DigitsSection(const StudyAnalysis& analysis, Table digits) {
  ReportSection section{"digits", "Digits", {}};
  section.blocks.emplace_back(std::move(digits));
  if (analysis.digit_misses.empty()) {
    section.blocks.emplace_back(Paragraph("No run has fewer than 6 digits."));
  } else {
    section.blocks.emplace_back(Paragraph(
        "Runs with fewer than 6 digits: " + std::to_string(analysis.digit_misses.size()) + ", by name."));
    section.blocks.emplace_back(BulletList(analysis.digit_misses));
  }
  return section;
}

// The columns of a plot's x axis: the largest exponent is at the last.
struct CharacterAxis {
  double decades = 1;
  double At(std::size_t column) const {
    return std::pow(10, decades * static_cast<double>(column) / static_cast<double>(kPlotColumns - 1));
  }
  std::size_t ColumnOf(double x) const {
    return static_cast<std::size_t>(
        std::lround(std::log10(x) / decades * static_cast<double>(kPlotColumns - 1)));
  }
};

std::string AxisLines(const CharacterAxis& axis) {
  std::string rule(kPlotColumns, '-'), labels(kMargin + kPlotColumns + 8, ' ');
  for (const AxisTick& tick : Ticks({1, std::pow(10, axis.decades), AxisScale::kLogarithmic}, false)) {
    const double exponent = std::log10(tick.value);
    if (tick.label.empty() || std::abs(exponent - std::round(exponent)) > 1e-9) continue;
    rule[axis.ColumnOf(tick.value)] = '+';
    const std::string label = exponent < 5 ? ThreeDigits(tick.value)
                                           : "1e" + std::to_string(static_cast<int>(std::lround(exponent)));
    labels.replace(kMargin + axis.ColumnOf(tick.value), label.size(), label);
  }
  labels.erase(labels.find_last_not_of(' ') + 1);
  return std::string(kMargin - 1, ' ') + "+" + rule + "\n" + labels + "\n";
}

std::string RunLengthCharacters(const StudyAnalysis& analysis) {
  double last = 0;
  for (const ContenderSummary& c : analysis.contenders) {
    for (const double x : c.run_lengths.x) last = std::isfinite(x) ? std::max(last, x) : last;
  }
  if (last <= 0) return "No run reached any target: there is no run-length distribution to draw.\n";
  const CharacterAxis axis{std::max(1.0, std::ceil(std::log10(last) - 1e-9))};
  std::vector<std::string> rows(kPlotRows, std::string(kPlotColumns, ' '));
  for (std::size_t k = 0; k < analysis.contenders.size(); ++k) {
    for (std::size_t column = 0; column < kPlotColumns; ++column) {
      // A hair to the right, so that a step at a tick is there.
      const double share = StepValueAt(analysis.contenders[k].run_lengths, axis.At(column) * (1 + 1e-9), 0);
      const double height = std::clamp(share, 0.0, 1.0) * static_cast<double>(kPlotRows - 1);
      char& cell = rows[kPlotRows - 1 - static_cast<std::size_t>(std::lround(height))][column];
      cell = cell == ' ' ? Letter(k) : '*';
    }
  }
  std::string text =
      "Share of all pairs of a run and a target reached within so many evaluations (* where several are):\n";
  for (std::size_t row = 0; row < kPlotRows; ++row) {
    const std::size_t percent = 100 - 100 * row / (kPlotRows - 1);
    std::string margin = row % 3 == 0 ? std::to_string(percent) + " % |" : "|";
    margin.insert(0, kMargin - margin.size(), ' ');
    std::string line = margin + rows[row];
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  std::string legend;
  for (std::size_t k = 0; k < analysis.contenders.size(); ++k) {
    legend += (k > 0 ? ", " : "") + std::string(1, Letter(k)) + " = " + analysis.contenders[k].name;
  }
  return text + AxisLines(axis) + Wrapped(legend, kTerminalWidth);
}

}  // namespace

std::vector<ReportSection> StudySections(const StudyPlan& plan, const StudyAnalysis& analysis) {
  std::vector<ReportSection> sections;
  ReportSection answer{"answer", "Which solver?", {}};
  AddSentences(AnswerSentences(plan, analysis), &answer);
  sections.push_back(std::move(answer));
  sections.push_back({"solvers", "Solvers", {ContenderTable(analysis)}});
  ReportSection setup{"setup", "What was run", {}};
  setup.blocks.emplace_back(SetupSentences(plan, analysis));
  setup.blocks.emplace_back(BudgetTable(plan));
  sections.push_back(std::move(setup));
  if (analysis.contenders.size() > 1) {
    sections.push_back(
        {"speed-ups", "Speed-ups", {SpeedUpSentences(plan, analysis), SpeedUpTable(analysis)}});
    sections.push_back({"pairs", "Pairs", {PairTable(analysis)}});
    ReportSection ranks{"ranks", "Ranks", {}};
    AddSentences(RankSentences(analysis), &ranks);
    sections.push_back(std::move(ranks));
  }
  Table digits = DigitsTable(analysis);
  if (!digits.rows.empty()) sections.push_back(DigitsSection(analysis, std::move(digits)));
  ReportSection problems{"problems", "Problems", {}};
  for (Table& table : ProblemTables(analysis)) problems.blocks.emplace_back(std::move(table));
  sections.push_back(std::move(problems));
  return sections;
}

std::string StudyMarkdown(const StudyPlan& plan, const StudyAnalysis& analysis) {
  std::string text = "# " + EscapeMarkdown(plan.name) + "\n";
  for (const ReportSection& section : StudySections(plan, analysis)) text += "\n" + SectionMarkdown(section);
  return text;
}

std::string TerminalReport(const StudyPlan& plan, const StudyAnalysis& analysis) {
  std::string text =
      Wrapped(plan.name + ": " + SetupSentences(plan, analysis).front(), kTerminalWidth) + "\n";
  for (const std::string& sentence : AnswerSentences(plan, analysis))
    text += Wrapped(sentence, kTerminalWidth);
  text += "\n" + TableText(ContenderTable(analysis), {0, 1, 2, 3, 4, 6, 7, 8, 9}, kTerminalWidth) + "\n";
  for (const std::string& sentence : SpeedUpSentences(plan, analysis, 5))
    text += Wrapped(sentence, kTerminalWidth, 2);
  return text + "\n" + RunLengthCharacters(analysis);
}

}  // namespace frond
