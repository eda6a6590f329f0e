// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/study_tables.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "experiments/study/display_number.h"

namespace frond {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

double Share(int count, int all) { return all > 0 ? static_cast<double>(count) / all : kNone; }

// Marks the cells that read as the one with the least cost does, where not all read alike.
void MarkLeast(const std::vector<double>& costs, const std::vector<TableCell*>& cells) {
  std::size_t best = costs.size();
  for (std::size_t k = 0; k < costs.size(); ++k) {
    if (std::isfinite(costs[k]) && (best == costs.size() || costs[k] < costs[best])) best = k;
  }
  if (best == costs.size()) return;
  const std::string text = cells[best]->text;
  if (std::all_of(cells.begin(), cells.end(), [&](const TableCell* c) { return c->text == text; })) return;
  for (TableCell* cell : cells) cell->strong = cell->text == text;
}

// A table of problems × solvers, the best of each row marked.
Table ProblemMatrix(const StudyAnalysis& analysis, std::string caption,
                    const std::function<std::string(const ProblemCell&)>& text,
                    const std::function<double(const ProblemCell&)>& cost) {
  Table table{std::move(caption), {{"problem", false}}, {}};
  for (const ContenderSummary& contender : analysis.contenders) table.columns.push_back({contender.name});
  for (const ProblemSummary& problem : analysis.problems) {
    std::vector<TableCell> row = {{problem.name}};
    std::vector<double> costs;
    for (const ProblemCell& cell : problem.cells) {
      row.push_back({text(cell)});
      costs.push_back(cost(cell));
    }
    std::vector<TableCell*> cells;
    for (std::size_t k = 1; k < row.size(); ++k) cells.push_back(&row[k]);
    MarkLeast(costs, cells);
    table.rows.push_back(std::move(row));
  }
  return table;
}

bool MeasuresDigits(const StudyAnalysis& analysis) {
  for (const ProblemSummary& problem : analysis.problems) {
    for (const ProblemCell& cell : problem.cells) {
      if (cell.median_digits) return true;
    }
  }
  return false;
}

std::string SpeedUpText(const SpeedUp& s) {
  if (s.pairs == 0) return "—";
  const std::string reached = ", " + CountOf(s.reached, s.pairs);
  if (s.reached == 0 || !(s.median > 0)) return "never" + reached;
  // A ratio of 0 stands for a pair that never gets there.
  const std::string lower = s.interval.lower > 0 ? ThreeDigits(s.interval.lower) : "never";
  return ThreeDigits(s.median) + " (" + lower + "–" + ThreeDigits(s.interval.upper) + ")" + reached;
}

std::string BudgetText(const Budget& budget) {
  std::string text;
  if (budget.LimitsEvaluations()) text = WholeNumber(budget.max_evaluations) + " evaluations";
  if (std::isfinite(budget.max_seconds)) {
    text += (text.empty() ? "" : ", ") + InFull(budget.max_seconds) + " s";
  }
  if (budget.stall_evaluations != std::numeric_limits<std::int64_t>::max()) {
    text += (text.empty() ? "" : ", ") + WholeNumber(budget.stall_evaluations) + " without progress";
  }
  return text.empty() ? "none" : text;
}

}  // namespace

Table ContenderTable(const StudyAnalysis& analysis) {
  Table table{
      "Solvers over all runs, best mean rank first. reached: runs that came to the target, of all; rate: "
      "their "
      "share, with Wilson's 95 % interval; ERT: evaluations of all runs per success (of a problem: expected "
      "when restarting), with a "
      "bootstrap 95 % interval; medians are over runs, “never” where most do not get there.",
      {{"solver", false},
       {"reached"},
       {"rate"},
       {"95 % interval"},
       {"ERT"},
       {"95 % interval"},
       {"median evaluations"},
       {"median seconds"},
       {"mean rank"},
       {"failed"}},
      {}};
  const auto& all = analysis.contenders;
  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto rank = [&](std::size_t k) {
    return std::isnan(all[k].mean_rank) ? kInfinity : all[k].mean_rank;
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
  std::vector<std::vector<double>> costs(table.columns.size());
  for (const std::size_t k : order) {
    const ContenderSummary& c = all[k];
    table.rows.push_back({{c.name},
                          {CountOf(c.successes, c.runs)},
                          {Percent(Share(c.successes, c.runs))},
                          {PercentInterval(c.success_interval)},
                          {UntilText(c.expected_running_time)},
                          {UntilText(c.expected_running_time_interval)},
                          {UntilText(c.median_run_length)},
                          {UntilText(c.median_seconds)},
                          {ThreeDigits(c.mean_rank)},
                          {std::to_string(c.failed)}});
    costs[2].push_back(-Share(c.successes, c.runs));
    costs[4].push_back(c.expected_running_time);
    costs[6].push_back(c.median_run_length);
    costs[7].push_back(c.median_seconds);
    costs[8].push_back(c.mean_rank);
  }
  for (std::size_t column = 0; column < costs.size(); ++column) {
    if (costs[column].empty()) continue;
    std::vector<TableCell*> cells;
    for (auto& row : table.rows) cells.push_back(&row[column]);
    MarkLeast(costs[column], cells);
  }
  return table;
}

Table BudgetTable(const StudyPlan& plan) {
  Table table{"What was compared: options that are not named are at their defaults.",
              {{"solver", false}, {"type", false}, {"options", false}, {"budget of a run", false}},
              {}};
  for (const Contender& contender : plan.contenders) {
    const StudySolver& solver = plan.solvers[contender.solver];
    std::string options;
    for (const OptionSpec& spec : solver.options.specs()) {
      if (!solver.options.IsSet(spec.name)) continue;
      options +=
          (options.empty() ? "" : ", ") + spec.name + ": " + FormatValue(solver.options.Value(spec.name));
    }
    table.rows.push_back(
        {{contender.name}, {solver.type}, {options.empty() ? "—" : options}, {BudgetText(contender.budget)}});
  }
  return table;
}

std::vector<Table> ProblemTables(const StudyAnalysis& analysis) {
  std::vector<Table> tables;
  tables.push_back(ProblemMatrix(
      analysis,
      "Success by problem: runs that reached the target, of all. f_L: the least objective, published or the "
      "best of this study.",
      [](const ProblemCell& c) { return CountOf(c.successes, c.runs); },
      [](const ProblemCell& c) { return -Share(c.successes, c.runs); }));
  Table& success = tables.back();
  success.columns.insert(success.columns.begin() + 1, {{"f_L"}, {"f_L is", false}});
  for (std::size_t p = 0; p < analysis.problems.size(); ++p) {
    const ProblemSummary& problem = analysis.problems[p];
    success.rows[p].insert(
        success.rows[p].begin() + 1,
        {{ThreeDigits(problem.least)}, {problem.least_is_known ? "published" : "best seen"}});
  }
  tables.push_back(ProblemMatrix(
      analysis, "Expected evaluations until a success (ERT) by problem.",
      [](const ProblemCell& c) { return UntilText(c.expected_running_time); },
      [](const ProblemCell& c) { return c.expected_running_time; }));
  tables.push_back(ProblemMatrix(
      analysis, "Final objective by problem: median (best) over the runs.",
      [](const ProblemCell& c) {
        return ThreeDigits(c.median_objective) + " (" + ThreeDigits(c.best_objective) + ")";
      },
      [](const ProblemCell& c) { return c.median_objective; }));
  if (MeasuresDigits(analysis)) {
    tables.push_back(ProblemMatrix(
        analysis, "Correct digits by problem: median over the runs, against the published minimiser.",
        [](const ProblemCell& c) { return ThreeDigits(c.median_digits.value_or(kNone)); },
        [](const ProblemCell& c) { return -c.median_digits.value_or(kNone); }));
  }
  return tables;
}

Table DigitsTable(const StudyAnalysis& analysis) {
  Table table{
      "Runs by the digits that all their parameters share with the published ones, of all runs of "
      "problems that publish them.",
      {{"solver", false}, {"≥ 4 digits"}, {"≥ 6 digits"}, {"≥ 9 digits"}},
      {}};
  for (const ContenderSummary& c : analysis.contenders) {
    if (!c.digits_at_least) continue;
    std::vector<TableCell> row = {{c.name}};
    for (const int count : *c.digits_at_least) row.push_back({CountOf(count, c.digit_runs)});
    row.resize(table.columns.size(), {"—"});
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table SpeedUpTable(const StudyAnalysis& analysis) {
  const std::size_t n = analysis.contenders.size();
  Table table{
      "Speed-ups: to reach what COLUMN reached at its end (where runs end on the target: the target), ROW "
      "needed that many times fewer evaluations "
      "(below 1: "
      "more). Median over pairs of runs with the same start, its bootstrap 95 % interval, and in how many of "
      "the pairs it got there at all.",
      {{"solver", false}},
      {}};
  for (const ContenderSummary& c : analysis.contenders) {
    table.columns.push_back({c.name});
    table.rows.emplace_back(n + 1, TableCell{"—"})[0].text = c.name;
  }
  for (const SpeedUp& s : analysis.speed_ups) {
    table.rows[s.solver][s.reference + 1] = {SpeedUpText(s), s.pairs > 0 && s.interval.lower > 1};
  }
  return table;
}

Table PairTable(const StudyAnalysis& analysis) {
  Table table{
      "Pairs of solvers, run by run from the same start: how often either ended lower; Wilcoxon's "
      "signed-rank p for "
      "the final gap to f_L (0 for runs that end on the target) and for the evaluations until success, each "
      "with Holm's correction for all "
      "pairs.",
      {{"first", false},
       {"second", false},
       {"first better"},
       {"second better"},
       {"gap p"},
       {"gap p, Holm"},
       {"evaluations p"},
       {"evaluations p, Holm"}},
      {}};
  for (const PairComparison& pair : analysis.pairs) {
    table.rows.push_back({{analysis.contenders[pair.first].name},
                          {analysis.contenders[pair.second].name},
                          {std::to_string(pair.first_better)},
                          {std::to_string(pair.second_better)},
                          {Significance(pair.gap_p)},
                          {Significance(pair.gap_p_holm), pair.gap_p_holm < 0.05},
                          {Significance(pair.length_p)},
                          {Significance(pair.length_p_holm), pair.length_p_holm < 0.05}});
  }
  return table;
}

CsvTable StudyCsv(const StudyAnalysis& analysis) {
  CsvTable csv;
  csv.columns = {"problem",
                 "solver",
                 "runs",
                 "failed",
                 "successes",
                 "success_rate",
                 "success_rate_lower",
                 "success_rate_upper",
                 "expected_running_time",
                 "expected_running_time_lower",
                 "expected_running_time_upper",
                 "median_run_length",
                 "median_seconds",
                 "mean_rank",
                 "median_objective",
                 "best_objective",
                 "median_digits",
                 "least_objective",
                 "least_is_published"};
  const auto count = [](int value) { return static_cast<std::int64_t>(value); };
  const std::string none;
  for (const ContenderSummary& c : analysis.contenders) {
    csv.rows.push_back({none, c.name, count(c.runs), count(c.failed), count(c.successes),
                        Share(c.successes, c.runs), c.success_interval.lower, c.success_interval.upper,
                        c.expected_running_time, c.expected_running_time_interval.lower,
                        c.expected_running_time_interval.upper, c.median_run_length, c.median_seconds,
                        c.mean_rank, none, none, none, none, none});
  }
  for (const ProblemSummary& problem : analysis.problems) {
    for (std::size_t k = 0; k < problem.cells.size(); ++k) {
      const ProblemCell& c = problem.cells[k];
      csv.rows.push_back({problem.name, analysis.contenders[k].name, count(c.runs), count(c.failed),
                          count(c.successes), Share(c.successes, c.runs), none, none, c.expected_running_time,
                          none, none, c.median_run_length, none, none, c.median_objective, c.best_objective,
                          c.median_digits ? MetricValue(*c.median_digits) : MetricValue(none), problem.least,
                          problem.least_is_known});
    }
  }
  return csv;
}

}  // namespace frond
