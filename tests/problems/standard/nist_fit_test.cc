// SPDX-License-Identifier: BSD-3-Clause
#include "problems/standard/nist_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>

#include "base/errors.h"
#include "problems/standard/nist_models.h"
#include "tests/problems/standard/fit_checks.h"

namespace frond {
namespace {

const NistDataset& Dataset(const std::string& name) {
  for (const NistDataset& dataset : NistDatasets()) {
    if (dataset.name == name) return dataset;
  }
  throw std::invalid_argument(name);
}

std::vector<double> Certified(const NistDataset& dataset) {
  std::vector<double> certified;
  for (const NistParameter& parameter : dataset.parameters) certified.push_back(parameter.certified);
  return certified;
}

TEST(NistFit, Objective_IsTheCeresCost) {
  for (const NistDataset& dataset : NistDatasets()) {
    SCOPED_TRACE(dataset.name);
    const NistFit far(dataset, 1), near(dataset, 2);
    ExpectObjectiveIsCeresCost(far, far.StartVector());
    ExpectObjectiveIsCeresCost(near, near.StartVector());
    // Where terms cancel, another order of the sum may differ by rounding.
    ExpectObjectiveIsCeresCost(near, Certified(dataset), 1e-13, NistResolution(dataset));
  }
}

TEST(NistFit, Gradient_AtStarts_MatchesDifferences) {
  for (const NistDataset& dataset : NistDatasets()) {
    for (const int start : {1, 2}) {
      SCOPED_TRACE(dataset.name + " " + std::to_string(start));
      const NistFit fit(dataset, start);
      ExpectGradientMatchesDifferences(fit, fit.StartVector());
    }
  }
}

TEST(NistFit, Objective_AtCertified_IsWithinResolutionOfLongDouble) {
  for (const NistDataset& dataset : NistDatasets()) {
    SCOPED_TRACE(dataset.name);
    const std::vector<double> responses = NistResponses(dataset), certified = Certified(dataset);
    const std::vector<long double> b(certified.begin(), certified.end());
    const long double exact = WithNistModel(dataset.name, [&]<typename Model>(Model) {
      long double sum = 0;
      for (std::size_t i = 0; i < responses.size(); ++i) {
        const long double residual =
            responses[i] - Model()(b.data(), &dataset.x[i * static_cast<std::size_t>(dataset.predictors)]);
        sum += residual * residual;
      }
      return sum / 2;
    });
    const double error = std::abs(NistFit(dataset, 1).Objective(certified) - static_cast<double>(exact));
    EXPECT_LE(error, NistResolution(dataset));
    EXPECT_LT(NistResolution(dataset), 1e-7 * dataset.rss + 1e-23);
  }
}

TEST(NistFit, StartBox_OfMisra1a_IsMadeOfItsTwoStarts) {
  const NistFit fit(Dataset("Misra1a"), 2);  // starts 500, 250 and 0.0001, 0.0005
  const ParameterBlock& b = fit.parameters().at(0);
  EXPECT_EQ(b.start, (std::vector<double>{250, 0.0005}));
  EXPECT_EQ(b.start_lower, (std::vector<double>{-250, 0.0001 - 0.0005}));
  EXPECT_EQ(b.start_upper, (std::vector<double>{1000, 0.001}));
  EXPECT_TRUE(b.lower.empty() && b.upper.empty());
  EXPECT_EQ(NistFit(Dataset("Misra1a"), 1).parameters()[0].start_lower, b.start_lower);
}

TEST(NistFit, StartBox_OfEveryDataset_HoldsBothStarts) {
  int holding_answer = 0;
  for (const NistDataset& dataset : NistDatasets()) {
    const NistFit fit(dataset, 1);
    const ParameterBlock& b = fit.parameters().at(0);
    bool holds = true;
    for (std::size_t j = 0; j < b.start.size(); ++j) {
      const NistParameter& p = dataset.parameters[j];
      for (const double start : {p.start_1, p.start_2}) {
        EXPECT_LT(b.start_lower[j], start + 1e-300);
        EXPECT_GT(b.start_upper[j], start - 1e-300);
      }
      holds = holds && b.start_lower[j] <= p.certified && p.certified <= b.start_upper[j];
    }
    holding_answer += holds;
    if (!holds) std::cout << "box without the answer: " << dataset.name << "\n";
  }
  std::cout << holding_answer << " of 27 boxes hold the certified parameters\n";
}

TEST(NistFit, Metrics_CountDigitsOfTheWorstParameter) {
  const NistDataset& misra = Dataset("Misra1a");
  const NistFit fit(misra, 1);
  std::vector<double> x = Certified(misra);
  EXPECT_EQ(fit.Metrics(x).at("digits"), 11);
  EXPECT_GT(fit.Metrics(x).at("cost_digits"), 10);
  EXPECT_NEAR(fit.Metrics(x).at("rss"), 1.2455138894e-01, 1e-11);
  x[1] *= 1 + 1e-4;
  EXPECT_NEAR(fit.Metrics(x).at("digits"), 4, 1e-6);
  x[0] *= 1 - 1e-2;
  EXPECT_NEAR(fit.Metrics(x).at("digits"), 2, 1e-6);
  x[0] = -1000 * misra.parameters[0].certified;
  EXPECT_EQ(fit.Metrics(x).at("digits"), 0);
}

TEST(NistFit, Metrics_OfNan_AreZeroDigits) {
  const NistFit fit(Dataset("Misra1a"), 1);
  const std::vector<double> x = {std::numeric_limits<double>::quiet_NaN(), 5e-4};
  EXPECT_EQ(fit.Metrics(x).at("digits"), 0);
  EXPECT_EQ(fit.Metrics(x).at("cost_digits"), 0);
  EXPECT_TRUE(std::isnan(fit.Objective(x)));
  EXPECT_TRUE(std::isnan(fit.Objective(std::vector<double>{1, -1e6})));  // overflows
}

// MATH.md §7: 53 of 54 at 6 digits with dense QR and auto-diff, all but BoxBOD from start 1. The last steps
// change the cost by less than its rounding, so that 9 digits (29 times here, 30 there) are a matter of luck.
TEST(NistFit, Lm_FromBothStarts_ReachesCertifiedDigits) {
  int at_least_6 = 0, at_least_9 = 0;
  for (const TestProblem& problem : Problems("nist")) {
    const auto fit = problem.make();
    const SolverReport report = SolveWith("lm", *fit, TightestTolerances());
    const auto metrics = fit->Metrics(report.x);
    const double digits = metrics.at("digits");
    at_least_6 += digits >= 6;
    at_least_9 += digits >= 9;
    if (digits < 6) {
      std::cout << problem.name << ": " << digits << " digits, rss " << metrics.at("rss") << " after "
                << report.iterations << " iterations\n";
    }
    EXPECT_GE(report.objective, *problem.best_objective * (1 - 1e-9) - problem.resolution) << problem.name;
  }
  std::cout << at_least_6 << " of 54 at 6 digits, " << at_least_9 << " at 9\n";
  EXPECT_GE(at_least_6, 53);
  EXPECT_GE(at_least_9, 25);
}

// "Converged" is not "solved": a published trap (MATH.md §7).
TEST(NistFit, Lm_OnBoxBodFromStart1_ConvergesWithoutADigit) {
  const NistFit fit(Dataset("BoxBOD"), 1);
  const SolverReport report = SolveWith("lm", fit);
  EXPECT_EQ(report.termination, Termination::kConverged);
  EXPECT_NEAR(report.objective, 4885, 1);
  EXPECT_EQ(fit.Metrics(report.x).at("digits"), 0);
}

}  // namespace
}  // namespace frond
