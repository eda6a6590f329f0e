// SPDX-License-Identifier: BSD-3-Clause
// A window as a fit for every registered solver: one auto-diff cost over its pixels, in compressed rows.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "problems/stereo/window_model.h"
#include "problems/stereo/window_residual.h"
#include "solvers/fit_problem.h"
#include "solvers/solver.h"

namespace frond {

struct WindowFitOptions {
  // Half the side of the box about the start in which solvers search (pso) or draw starts: disparity and
  // vertical shift, px. Slopes, curvatures and radiometry get boxes of fixed size (window_fit.cc). 0: no
  // bounds.
  double start_box = 0;
  std::optional<double> true_disparity = {};  // for Metrics
};

// Parameter blocks: "warp" (1, 3 or 6 values), "radiometry" (2 or 4; absent for none).
class WindowFit final : public FitProblem {
 public:
  // Over the pixels that take part at `start`. The images must outlive the fit. Throws FitError where fewer
  // than a third of the window's pixels do.
  WindowFit(const WindowImages& images, const WindowModel& model, int x, int y, const WarpValues& start,
            const WindowFitOptions& options = {});

  const std::vector<ParameterBlock>& parameters() const override { return parameters_; }
  void AddResiduals(const std::vector<double*>& blocks, ceres::EvaluationCallback* state,
                    ceres::Problem* problem) const override;
  double Objective(std::span<const double> x) const override;

  // disparity, sigma (px), noise (grey levels), correlation; disparity_error (px, absolute) and within_sigma
  // where the truth is known.
  std::map<std::string, double> Metrics(std::span<const double> x) const override;

  // The match that the parameters x stand for.
  WindowMatch MatchAt(std::span<const double> x) const;

 private:
  WindowImages images_;
  WindowModel model_;
  WindowFitOptions options_;
  int x_, y_;
  std::vector<WindowPixel> pixels_;
  std::vector<ParameterBlock> parameters_;
};

// One window by any solver, with the result of WindowMatcher::Match: the same cost, pixels, statistics.
WindowMatch SolveWindow(const WindowImages& images, const WindowModel& model, int x, int y,
                        const WarpValues& start, const WindowFitOptions& options, const Solver& solver,
                        const Budget& budget, const SolveContext& context);

}  // namespace frond
