// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <map>

#include "base/errors.h"
#include "problems/surface/sheet_fit.h"
#include "solvers/robust_loss.h"

namespace frond {
namespace {

constexpr int kConformingUpTo = 7;  // control points a direction

OptionSpec Spec(const std::string& name, OptionType type, OptionValue value, const std::string& help) {
  return {.name = name, .type = type, .default_value = std::move(value), .help = help};
}

OptionSpec Choice(const std::string& name, const std::string& value, std::vector<std::string> words,
                  const std::string& help) {
  OptionSpec spec = Spec(name, OptionType::kChoice, value, help);
  spec.words = std::move(words);
  return spec;
}

OptionSpec Bounded(OptionSpec spec, double minimum, double maximum) {
  spec.minimum = minimum;
  spec.maximum = maximum;
  return spec;
}

OptionSpec Pair(OptionSpec spec) {
  spec.min_size = 1;
  spec.max_size = 2;
  return spec;
}

OptionSpec OrWord(OptionSpec spec, const std::string& word) {
  spec.words = {word};
  return spec;
}

}  // namespace

std::vector<OptionSpec> SheetFitSpecs() {
  using List = std::vector<double>;
  return {
      Pair(Bounded(
          Spec("surface.degree", OptionType::kIntegers, List{3, 3}, "Degree along u (across) and v (along)"),
          1, kMaxDegree)),
      OrWord(Pair(Bounded(Spec("surface.control_points", OptionType::kIntegers, List{20, 20},
                               "Control points along u and v; auto: the smallest net within 2 % of the least "
                               "held-out error"),
                          2, 1000)),
             "auto"),
      Choice("fit.unknowns", "control_points", {"control_points", "weights", "both"},
             "What the solver moves"),
      Choice("fit.margin", "auto", {"auto", "trim", "conforming", "none"},
             "How the surface ends at the cloud's boundary; auto: conforming up to 7 x 7 control points, "
             "else trim"),
      Choice("fit.derivatives", "structured", {"structured", "autodiff"},
             "structured: rows from moments of the feet; autodiff: the same by Ceres's auto-diff, slow"),
      OrWord(
          Bounded(Spec("fit.fairness", OptionType::kNumber, std::string("auto"),
                       "Final weight of the thin-plate energy, as a share of the points; auto: by the noise "
                       "and number of points, at least 1e-10 (conforming 1e-8)"),
                  0, 1),
          "auto"),
      Bounded(
          Spec("fit.hinge", OptionType::kNumber, 1.0, "Weight of the term that keeps folds away; 0: none"), 0,
          1e6),
      Bounded(Spec("fit.hinge_limit", OptionType::kNumber, 0.3,
                   "Share of the start's area density kept everywhere"),
              0, 1),
      Choice("fit.loss", "none", RobustLossNames(), "Robust loss of each point's distance"),
      Bounded(Spec("fit.loss_scale", OptionType::kNumber, 3.0,
                   "Where the loss takes hold, in robust standard deviations of the start's distances"),
              1e-3, 1e3),
      Bounded(
          Spec("fit.peak_emphasis", OptionType::kNumber, 0.0,
               "Counts a distance d as d^2 (1 + this * d^2 / RMS^2): lowers the maximum, raises the RMSE; 0: "
               "least squares"),
          0, 1e3),
      Bounded(
          Spec("fit.outlier_threshold", OptionType::kNumber, 6.0,
               "Points further off than this many standard deviations of the local noise, or not connected "
               "with the scan, are outliers; 0: keep all"),
          0, 1e6),
      Bounded(Spec("fit.margin_weight", OptionType::kNumber, 0.1,
                   "Weight of the conforming margin, against the "
                   "points together"),
              0, 1e3),
      Bounded(Spec("fit.subset", OptionType::kInteger, std::int64_t{10000}, "Points of the first stages"),
              100, 1e9),
  };
}

SheetFitOptions SheetFitOptionsFrom(const Options& options) {
  SheetFitOptions fit;
  const auto pair = [&](const std::string& name) {
    const std::vector<int> values = options.Integers(name);
    return std::array<int, 2>{values.front(), values.back()};
  };
  fit.degree = pair("surface.degree");
  fit.control_points =
      options.HoldsWord("surface.control_points") ? std::array<int, 2>{0, 0} : pair("surface.control_points");
  const std::map<std::string, SurfaceUnknowns> unknowns = {
      {"control_points", SurfaceUnknowns::kControlPoints},
      {"weights", SurfaceUnknowns::kWeights},
      {"both", SurfaceUnknowns::kBoth}};
  fit.unknowns = unknowns.at(options.Text("fit.unknowns"));
  const std::map<std::string, MarginMode> margins = {
      {"trim", MarginMode::kTrim}, {"conforming", MarginMode::kConforming}, {"none", MarginMode::kNone}};
  if (const auto margin = margins.find(options.Text("fit.margin")); margin != margins.end()) {
    fit.margin = margin->second;
  }
  fit.derivatives = options.Text("fit.derivatives") == "autodiff" ? DistanceDerivatives::kAutodiff
                                                                  : DistanceDerivatives::kStructured;
  if (!options.HoldsWord("fit.fairness")) fit.fairness = options.Number("fit.fairness");
  fit.hinge = options.Number("fit.hinge");
  fit.hinge_limit = options.Number("fit.hinge_limit");
  fit.loss = options.Text("fit.loss");
  fit.loss_scale = options.Number("fit.loss_scale");
  fit.peak_emphasis = options.Number("fit.peak_emphasis");
  fit.outlier_threshold = options.Number("fit.outlier_threshold");
  fit.margin_weight = options.Number("fit.margin_weight");
  fit.subset = options.Integer("fit.subset");
  return fit;
}

void CheckSheetOptions(const Options& options) {
  const SheetFitOptions fit = SheetFitOptionsFrom(options);
  if (fit.peak_emphasis > 0 && fit.loss != "none") {
    throw ConfigError("option 'fit.peak_emphasis' does not go with 'fit.loss': set one of them");
  }
  for (std::size_t k = 0; k < 2 && fit.control_points[0] > 0; ++k) {
    if (fit.control_points[k] > fit.degree[k]) continue;
    throw ConfigError("option 'surface.control_points' is " + std::to_string(fit.control_points[k]) +
                      (k == 0 ? " along u" : " along v") + ", degree " + std::to_string(fit.degree[k]) +
                      " needs at least " + std::to_string(fit.degree[k] + 1));
  }
}

MarginMode MarginFor(const SheetFitOptions& options, std::array<int, 2> control_points) {
  if (options.margin) return *options.margin;
  if (control_points[0] == 0) return MarginMode::kTrim;  // chosen by held-out error: one margin for all nets
  return std::max(control_points[0], control_points[1]) <= kConformingUpTo ? MarginMode::kConforming
                                                                           : MarginMode::kTrim;
}

std::vector<std::pair<std::string, OptionValue>> SheetFitSolverDefaults(const std::string& solver,
                                                                        const SheetFitOptions& options) {
  const std::string prefix = solver == "pso_lm" ? "lm." : "";
  if (solver != "lm" && solver != "dogleg" && solver != "pso_lm") return {};
  const bool conforming = MarginFor(options, options.control_points) == MarginMode::kConforming;
  return {{prefix + "max_iterations", std::int64_t{conforming ? 25 : 4}},  // of each stage
          {prefix + "initial_trust_region_radius", 1.0},  // MATH.md §1: few steps are rejected then
          {prefix + "linear_solver", std::string("sparse_normal_cholesky")},
          {prefix + "function_tolerance", 1e-5},
          {prefix + "gradient_tolerance", 0.0},
          {prefix + "parameter_tolerance", 1e-12}};
}

}  // namespace frond
