// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/study_figures.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/study/critical_difference_plot.h"
#include "experiments/study/display_number.h"
#include "experiments/study/study_texts.h"
#include "experiments/study/svg_plot.h"

namespace frond {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kSecondsShown = 1e-5;  // of the longest: sooner is drawn at the left end

using CurveOf = Curve ContenderSummary::*;

std::vector<double> AllX(const std::vector<const Curve*>& curves) {
  std::vector<double> x;
  for (const Curve* curve : curves) x.insert(x.end(), curve->x.begin(), curve->x.end());
  return x;
}

// Rows of series, columns of the axis's labelled ticks.
Table DataTable(const std::string& caption, const AxisRange& range, const std::vector<std::string>& labels,
                const std::vector<const Curve*>& curves, double before, bool percent) {
  Table table{caption, {{"solver", false}}, {}};
  std::vector<double> at;
  for (const AxisTick& tick : Ticks(range, false)) {
    if (tick.label.empty()) continue;
    at.push_back(tick.value);
    table.columns.push_back({tick.label});
  }
  for (std::size_t k = 0; k < curves.size(); ++k) {
    std::vector<TableCell> row = {{labels[k]}};
    for (const double x : at) {
      const double value = StepValueAt(*curves[k], x, before);
      row.push_back({percent ? Percent(value) : ThreeDigits(value)});
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

struct ProfileKind {
  CurveOf curve;
  const char* title;
  const char* x_label;
  const char* y_label;
  const char* caption;
  bool starts_at_one;
};

ReportFigure ProfileFigure(const ProfileKind& kind, const StudyAnalysis& analysis,
                           std::optional<std::int64_t> comparable) {
  PlotPanel panel{
      .title = kind.title,
      .x = {.label = kind.x_label, .scale = AxisScale::kLogarithmic},
      .y = {.label = kind.y_label, .scale = AxisScale::kLinear, .lower = 0, .upper = 1.02, .percent = true},
      .series = {}};
  std::vector<const Curve*> curves;
  std::vector<std::string> labels;
  for (const ContenderSummary& c : analysis.contenders) {
    const Curve& curve = c.*kind.curve;
    PlotSeries series{c.name, {{0}, {0}}};
    series.line.x.insert(series.line.x.end(), curve.x.begin(), curve.x.end());
    series.line.y.insert(series.line.y.end(), curve.y.begin(), curve.y.end());
    panel.series.push_back(std::move(series));
    curves.push_back(&curve);
    labels.push_back(c.name);
  }
  std::vector<double> x = AllX(curves);
  if (kind.starts_at_one) panel.x.lower = 1;
  if (comparable) {
    const double budget = static_cast<double>(*comparable);
    x.push_back(budget);
    panel.references.push_back({budget});
  }
  AxisRange range = RangeOf(panel.x, x);
  // Room for the first and the last step to be seen.
  const double room = std::pow(range.upper / range.lower, 0.03);
  range.upper *= room;
  if (!kind.starts_at_one) range.lower /= room;
  panel.x.lower = range.lower;
  panel.x.upper = range.upper;
  return {
      PlotSvg(kind.title, {panel}), std::string(kind.title) + ". " + kind.caption,
      DataTable(std::string(kind.title) + " at the ticks: " + kind.x_label, range, labels, curves, 0, true)};
}

// Positive over more than a decade, zeros aside: those lie at the lower end.
AxisScale ObjectiveScale(const std::vector<double>& values) {
  double least = kInfinity, high = 0;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    if (value < 0) return AxisScale::kLinear;
    if (value > 0) least = std::min(least, value);
    high = std::max(high, value);
  }
  return high > 10 * least ? AxisScale::kLogarithmic : AxisScale::kLinear;
}

PlotPoints PointsOf(const Curve& curve) { return {curve.x, curve.y}; }

ReportFigure ConvergenceFigure(const StudyAnalysis& analysis, const ProblemSummary& problem,
                               const std::vector<ProblemSummary::Band>& bands, bool by_seconds) {
  const std::string unit = by_seconds ? "seconds" : "evaluations";
  PlotPanel panel{.title = problem.name,
                  .x = {.label = unit, .scale = AxisScale::kLogarithmic},
                  .y = {.label = "best objective so far"},
                  .series = {}};
  std::vector<const Curve*> medians, all;
  std::vector<std::string> labels;
  std::vector<double> y;
  for (std::size_t k = 0; k < bands.size(); ++k) {
    const ProblemSummary::Band& band = bands[k];
    panel.series.push_back({analysis.contenders[k].name, PointsOf(band.median),
                            PlotBand{PointsOf(band.lower), PointsOf(band.upper)}});
    labels.push_back(analysis.contenders[k].name);
    medians.push_back(&band.median);
    for (const Curve* curve : {&band.lower, &band.median, &band.upper}) {
      all.push_back(curve);
      y.insert(y.end(), curve->y.begin(), curve->y.end());
    }
  }
  panel.y.scale = ObjectiveScale(y);
  AxisRange range = RangeOf(panel.x, AllX(all));
  if (by_seconds) range.lower = std::max(range.lower, kSecondsShown * range.upper);
  panel.x.lower = range.lower;
  panel.x.upper = range.upper;
  panel.references.push_back({problem.least, false});
  const std::string title = problem.name + ": best objective so far by " + unit;
  return {
      PlotSvg(title, {panel}),
      title +
          ". Median over the runs; the band holds the middle half of them. Lower and further left is better. "
          "Dashed, where it is in range: f_L = " +
          ThreeDigits(problem.least) + (problem.least_is_known ? " (published)." : " (best seen)."),
      DataTable("Medians at the ticks: " + unit, range, labels, medians, kNone, false)};
}

}  // namespace

double StepValueAt(const Curve& curve, double x, double before) {
  const auto next = std::upper_bound(curve.x.begin(), curve.x.end(), x);
  if (next == curve.x.begin()) return before;
  return curve.y[static_cast<std::size_t>(next - curve.x.begin()) - 1];
}

std::vector<ReportFigure> ProfileFigures(const StudyPlan& plan, const StudyAnalysis& analysis) {
  std::vector<std::string> targets;
  for (const double tau : plan.settings.profile_targets) targets.push_back(InFull(tau));
  const std::string lengths =
      "The share of all pairs of a run and a target (τ = " + Joined(targets) +
      ") reached within so many evaluations. Higher and further left is better; the right end is the share "
      "that was "
      "reached at all. Beyond the dashed line, the smallest budget, solvers with different budgets cannot be "
      "compared.";
  const std::string target = InFull(plan.settings.target);
  const std::string data =
      "The share of runs solved (τ = " + target +
      ") within so many times n + 1 evaluations, n the parameters of the problem: as many as a "
      "gradient by differences costs. Higher and further left is better (Moré and Wild 2009).";
  const std::string ratio =
      "The share of runs that reached the target within so many times the %s of the fastest solver "
      "on the same run. The left end is how often a solver was the fastest, the right end how "
      "often it got there. It tells the best, not the second (Dolan and Moré 2002).";
  const auto with = [&](const std::string& word) {
    std::string text = ratio;
    return text.replace(text.find("%s"), 2, word);
  };
  const std::string by_evaluations = with("evaluations"), by_seconds = with("seconds");
  const std::vector<ProfileKind> kinds = {
      {&ContenderSummary::run_lengths, "Run-length distributions", "evaluations", "targets reached",
       lengths.c_str(), true},
      {&ContenderSummary::data_profile, "Data profiles", "evaluations / (n + 1)", "runs solved", data.c_str(),
       false},
      {&ContenderSummary::performance_evaluations, "Performance profiles by evaluations",
       "times the fewest evaluations", "runs solved", by_evaluations.c_str(), true},
      {&ContenderSummary::performance_seconds, "Performance profiles by seconds", "times the fewest seconds",
       "runs solved", by_seconds.c_str(), true}};
  std::vector<ReportFigure> figures;
  for (const ProfileKind& kind : kinds) {
    const bool lengths_kind = kind.curve == &ContenderSummary::run_lengths && analysis.contenders.size() > 1;
    figures.push_back(
        ProfileFigure(kind, analysis, lengths_kind ? ComparableEvaluations(plan) : std::nullopt));
  }
  return figures;
}

std::vector<ReportFigure> RankFigures(const StudyAnalysis& analysis) {
  std::vector<RankedSeries> solvers;
  Table data{"Mean ranks.", {{"solver", false}, {"mean rank"}}, {}};
  for (const ContenderSummary& c : analysis.contenders) {
    solvers.push_back({c.name, c.mean_rank});
    data.rows.push_back({{c.name}, {ThreeDigits(c.mean_rank)}});
  }
  const std::string svg = CriticalDifferenceSvg(solvers, analysis.critical_difference, analysis.equal_groups);
  if (svg.empty()) return {};
  return {{svg,
           "Critical-difference diagram. Each solver stands at its mean rank, the best to the left; solvers "
           "under one "
           "thick bar cannot be told apart (Demšar 2006).",
           data}};
}

std::vector<ReportFigure> ConvergenceFigures(const StudyAnalysis& analysis, std::size_t problem) {
  const ProblemSummary& p = analysis.problems[problem];
  return {ConvergenceFigure(analysis, p, p.by_evaluations, false),
          ConvergenceFigure(analysis, p, p.by_seconds, true)};
}

}  // namespace frond
