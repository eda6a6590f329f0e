// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace frond {

// A measured point near a place of a surface, in the place's frame: height over (x, y).
struct HeightSample {
  double x = 0, y = 0, height = 0;
  double sigma = 1;   // standard deviation of the height, > 0
  double weight = 1;  // before the residual has its say
};

// height = c₀ + c₁x + c₂y (+ c₃x² + c₄xy + c₅y²) by weighted least squares, samples far off left out.
struct HeightFit {
  bool solved = false;
  Eigen::Matrix<double, 6, 1> coefficients = Eigen::Matrix<double, 6, 1>::Zero();
  std::vector<double> share = {};     // by sample: c₀ = Σ share · height
  std::vector<double> residual = {};  // by sample: height − fit
};

// The quadratic where there are at least 12 samples, a plane where fewer. Tukey's weights, of the residual
// over outlier_sigmas times the larger of the sample's σ and the robust scatter of all.
HeightFit FitHeight(std::span<const HeightSample> samples, double outlier_sigmas);

}  // namespace frond
