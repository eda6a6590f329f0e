// SPDX-License-Identifier: BSD-3-Clause
// A window as a fit for every registered solver: one auto-diff cost over its pixels, in compressed rows.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "problems/stereo/window_model.h"
#include "problems/stereo/window_pixels.h"
#include "solvers/fit_problem.h"
#include "solvers/solver.h"

namespace frond {

struct WindowFitOptions {
  // Half the width of the box about the start in which solvers search (pso) or draw their starts: the
  // disparity (affine: and the vertical shift), px. The slopes get ±kSlopeBox. 0: no box, no bounds.
  double start_box = 0;
};

// Parameter blocks: "warp" (1, 3 or 6 values), "radiometry" (2 or 4; absent for none).
class WindowFit final : public FitProblem {
 public:
  // The pixels that WindowPixels finds at `start`. The images must outlive the fit.
  WindowFit(const WindowImages& images, const WindowModel& model, int x, int y, const WarpValues& start,
            const WindowFitOptions& options = {});

  const std::vector<ParameterBlock>& parameters() const override { return parameters_; }
  void AddResiduals(const std::vector<double*>& blocks, ceres::EvaluationCallback* state,
                    ceres::Problem* problem) const override;
  double Objective(std::span<const double> x) const override;
  // disparity, sigma, noise, correlation, and disparity_error where SetTruth was called.
  std::map<std::string, double> Metrics(std::span<const double> x) const override;

  void SetTruth(double disparity);
  const WindowPixels& pixels() const { return pixels_; }
  WindowMatch MatchAt(std::span<const double> x) const;

 private:
  WindowImages images_;
  WindowModel model_;
  WindowPixels pixels_;
  std::vector<ParameterBlock> parameters_;
  double truth_ = 0;
  bool has_truth_ = false;
};

// One window by any solver: as WindowMatcher::Match, same cost and same fields.
WindowMatch SolveWindow(const WindowImages& images, const WindowModel& model, int x, int y,
                        const WarpValues& start, const WindowFitOptions& options, const Solver& solver,
                        const Budget& budget, const SolveContext& context);

// The same by Ceres's small solver (ceres::TinySolver) over the same auto-diff rows, without the set-up of a
// ceres::Problem, which costs more than the solution of a window.
WindowMatch SolveWindowAutoDiff(const WindowImages& images, const WindowModel& model, int x, int y,
                                const WarpValues& start);

}  // namespace frond
