// SPDX-License-Identifier: BSD-3-Clause
// The tables of a study's report, each number one of its analysis.
#pragma once

#include <string>
#include <vector>

#include "experiments/study/report_document.h"
#include "experiments/study/study_analysis.h"
#include "experiments/study/study_plan.h"
#include "io/metrics_json.h"

namespace frond {

// Solvers as rows, best mean rank first. Columns: solver, reached, rate, its interval, ERT, its interval,
// median evaluations, median seconds, mean rank, failed.
Table ContenderTable(const StudyAnalysis& analysis);

// What was compared: solver, type, options that were set, budgets.
Table BudgetTable(const StudyPlan& plan);

// Problems as rows, solvers as columns; a table each for success (with f_L), ERT, objectives, digits where
// measured.
std::vector<Table> ProblemTables(const StudyAnalysis& analysis);

// Runs with at least 4, 6 and 9 digits. No rows where no fit measures them.
Table DigitsTable(const StudyAnalysis& analysis);

// What the column's solver reached at its end, the row's needed so many times fewer evaluations for.
Table SpeedUpTable(const StudyAnalysis& analysis);

// Each pair of solvers: wins, and Wilcoxon's p before and after Holm's correction.
Table PairTable(const StudyAnalysis& analysis);

// summary.csv, for WriteCsv: a row for each solver over all problems (`problem` empty), then one for each
// problem and solver; what has no value there is an empty text.
struct CsvTable {
  std::vector<std::string> columns;
  std::vector<std::vector<MetricValue>> rows;
};
CsvTable StudyCsv(const StudyAnalysis& analysis);

}  // namespace frond
