// SPDX-License-Identifier: BSD-3-Clause
// The NIST/ITL Statistical Reference Datasets for non-linear regression (NIST StRD 1999,
// https://www.itl.nist.gov/div898/strd/nls/nls_main.shtml): 27 regressions with two starts each and results
// certified to 11 digits, computed by NIST in 128 bits. Observations to the digits that NIST prints.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace frond {

struct NistParameter {
  double start_1, start_2;  // the far one and the near one
  double certified;
  double deviation;  // certified standard deviation of the estimate
};

struct NistDataset {
  std::string name;           // as NIST writes it: "Misra1a"
  int predictors = 1;         // per observation
  std::span<const double> y;  // m observations
  std::span<const double> x;  // m × predictors, those of one observation side by side
  std::span<const NistParameter> parameters;
  double rss = 0;             // certified residual sum of squares
  bool log_response = false;  // the model is of log y (Nelson)
};

// All 27, by name, case apart. The spans view static tables.
const std::vector<NistDataset>& NistDatasets();

std::vector<NistDataset> NistDatasetsAToG();  // Bennett5 … Gauss3
std::vector<NistDataset> NistDatasetsHToT();  // Hahn1 … Thurber

// The responses that the model is fitted to: y, or log y.
std::vector<double> NistResponses(const NistDataset& dataset);

}  // namespace frond
