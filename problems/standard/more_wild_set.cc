// SPDX-License-Identifier: BSD-3-Clause
#include "problems/standard/more_wild_set.h"

#include <cmath>

#include "problems/standard/problem_choice.h"
#include "problems/standard/rounding_floor.h"

namespace frond {
namespace {

constexpr const char* kFunctionNames[22] = {"linear_full_rank",
                                            "linear_rank_1",
                                            "linear_rank_1_zeros",
                                            "rosenbrock",
                                            "helical_valley",
                                            "powell_singular",
                                            "freudenstein_roth",
                                            "bard",
                                            "kowalik_osborne",
                                            "meyer",
                                            "watson",
                                            "box_3d",
                                            "jennrich_sampson",
                                            "brown_dennis",
                                            "chebyquad",
                                            "brown_almost_linear",
                                            "osborne_1",
                                            "osborne_2",
                                            "bdqrtic",
                                            "cube",
                                            "mancino",
                                            "heart8ls"};

// clang-format off
constexpr MoreWildRow kRows[] = {
    {1, 9, 45, 0},   {1, 9, 45, 1},   {2, 7, 35, 0},   {2, 7, 35, 1},   {3, 7, 35, 0},   {3, 7, 35, 1},
    {4, 2, 2, 0},    {4, 2, 2, 1},    {5, 3, 3, 0},    {5, 3, 3, 1},    {6, 4, 4, 0},    {6, 4, 4, 1},
    {7, 2, 2, 0},    {7, 2, 2, 1},    {8, 3, 15, 0},   {8, 3, 15, 1},   {9, 4, 11, 0},   {10, 3, 16, 0},
    {11, 6, 31, 0},  {11, 6, 31, 1},  {11, 9, 31, 0},  {11, 9, 31, 1},  {11, 12, 31, 0}, {11, 12, 31, 1},
    {12, 3, 10, 0},  {13, 2, 10, 0},  {14, 4, 20, 0},  {14, 4, 20, 1},
    {15, 6, 6, 0},   {15, 7, 7, 0},   {15, 8, 8, 0},   {15, 9, 9, 0},   {15, 10, 10, 0}, {15, 11, 11, 0},
    {16, 10, 10, 0}, {17, 5, 33, 0},  {18, 11, 65, 0}, {18, 11, 65, 1},
    {19, 8, 8, 0},   {19, 10, 12, 0}, {19, 11, 14, 0}, {19, 12, 16, 0},
    {20, 5, 5, 0},   {20, 6, 6, 0},   {20, 8, 8, 0},
    {21, 5, 5, 0},   {21, 5, 5, 1},   {21, 8, 8, 0},   {21, 10, 10, 0}, {21, 12, 12, 0}, {21, 12, 12, 1},
    {22, 8, 8, 0},   {22, 8, 8, 1}};
// clang-format on

// The least Σ r² of a row's function.
std::optional<double> LeastSumOfSquares(const MoreWildRow& row) {
  const double n = row.n, m = row.m;
  switch (row.function) {
    case 1:
      return m - n;  // MGH 32
    case 2:
      return m * (m - 1) / (2 * (2 * m + 1));  // MGH 33
    case 3:
      return (m * m + 3 * m - 6) / (2 * (2 * m - 3));  // MGH 34
    case 8:
      return 8.2148773065789748e-3;  // MGH: 8.21487e-3
    case 9:
      return 3.0750560384923743e-4;  // 3.07505e-4
    case 10:
      return 87.945855170851121;  // 87.9458
    case 11:                      // 2.28767e-3, 1.39976e-6, 4.72238e-10
      return row.n == 6 ? 2.2876700535524362e-3 : row.n == 9 ? 1.3997601380990199e-6 : 4.7223811058917574e-10;
    case 13:
      return 124.36218235561485;  // 124.362
    case 14:
      return 85822.201626356345;  // 85822.2
    case 15:                      // 3.51687e-3 (n = 8), 6.50395e-3 (10), 0 for n ≤ 7 and 9
      if (row.n == 11) return std::nullopt;
      return row.n == 8 ? 3.5168737256779317e-3 : row.n == 10 ? 6.5039548008823061e-3 : 0;
    case 17:
      return 5.4648946974829064e-5;  // 5.46489e-5
    case 18:
      return 4.0137736293547738e-2;  // 4.01377e-2
    case 19:
      return row.n == 8    ? 10.238973421317435
             : row.n == 10 ? 18.281161753593536
             : row.n == 11 ? 22.260591734883758
                           : 26.272766396793963;
    default:
      return 0;  // n equations in n unknowns that have a solution, and Box (MGH 12)
  }
}

std::vector<double> Minimiser(const MoreWildRow& row) {
  switch (row.function) {
    case 1:
      return std::vector<double>(row.n, -1.0);
    case 4:
    case 20:
      return std::vector<double>(row.n, 1.0);
    case 5:
      return {1, 0, 0};
    case 6:
      return {0, 0, 0, 0};
    case 7:
      return {5, 4};
    default:
      return {};
  }
}

// Terms are taken to be as large as the residuals at the standard start, where they have not cancelled yet.
double Resolution(const MoreWildRow& row, double least) {
  const MoreWildFit standard({row.function, row.n, row.m, 0});
  return RoundingFloor(std::sqrt(least), std::sqrt(2 * standard.Objective(standard.StartVector())));
}

TestProblem MakeProblem(const MoreWildRow& row, const std::string& name) {
  const std::optional<double> least = LeastSumOfSquares(row);
  TestProblem problem{.name = name,
                      .make = [row] { return std::make_shared<MoreWildFit>(row); },
                      .resolution = Resolution(row, least.value_or(0)),
                      .best_x = Minimiser(row)};
  if (least.has_value()) problem.best_objective = *least / 2;
  return problem;
}

std::string RowName(std::size_t index) {
  const MoreWildRow& row = kRows[index];
  const std::string number = std::to_string(index + 1);
  return (number.size() == 1 ? "mw0" : "mw") + number + "_" + kFunctionNames[row.function - 1] + "_" +
         std::to_string(row.n) + (row.start_exponent == 1 ? "_x10" : "");
}

std::vector<TestProblem> MoreWildProblems(const Options& options) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::size(kRows); ++i) names.push_back(RowName(i));
  std::vector<TestProblem> problems;
  for (const std::size_t i : ChosenProblems(options, names)) {
    problems.push_back(MakeProblem(kRows[i], names[i]));
  }
  return problems;
}

}  // namespace

std::span<const MoreWildRow> MoreWildRows() { return kRows; }

ProblemSetType MoreWildSetType() {
  return {.name = "more_wild",
          .help = "Moré and Wild's 53 problems of 22 functions, 2 to 12 parameters (SIAM J. Optim. 2009)",
          .options = {ProblemChoiceSpec("all, or one by name: mw07_rosenbrock_2, mw38_osborne_2_11_x10, …")},
          .problems = MoreWildProblems};
}

}  // namespace frond
