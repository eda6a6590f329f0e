// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <map>

#include "base/errors.h"
#include "problems/surface/surface_fit.h"
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

std::vector<OptionSpec> SurfaceFitSpecs() {
  using List = std::vector<double>;
  return {
      Pair(Bounded(
          Spec("surface.degree", OptionType::kIntegers, List{3, 3}, "Degree along u (across) and v (along)"),
          1, kMaxDegree)),
      OrWord(Pair(Bounded(Spec("surface.control_points", OptionType::kIntegers, List{20, 20},
                               "Control points along u and v; auto: the smallest net within 1 % of the least "
                               "held-out error"),
                          2, 1000)),
             "auto"),
      Choice("fit.method", "distance", {"distance", "parametric", "ma"},
             "distance: least orthogonal distances; parametric: least squares at fixed parameters, the base "
             "surface repeated; ma: the same with weights by Ma's two steps"),
      Bounded(Spec("fit.repetitions", OptionType::kInteger, std::int64_t{5},
                   "parametric, ma: repetitions of the base surface, at most"),
              0, 1000),
      Choice("fit.base", "auto", {"auto", "plane", "cylinder", "sphere", "centre_line"},
             "Base surface of the first parameters: plane (sheet), cylinder (tube), sphere (sphere), "
             "centre_line "
             "(tube, cup, sphere); auto: plane, sphere where star-shaped, else centre_line"),
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
                       "and number of points (of a mesh by none), at least 1e-10 (conforming 1e-8, "
                       "tube and cup 2e-9, sphere 3e-10)"),
                  0, 1),
          "auto"),
      Bounded(
          Spec("fit.hinge", OptionType::kNumber, 1.0, "Weight of the term that keeps folds away; 0: none"), 0,
          1e6),
      OrWord(
          Bounded(Spec("fit.hinge_limit", OptionType::kNumber, std::string("auto"),
                       "Share of the start's area density kept everywhere; auto: 0.3, where u is closed 0.1"),
                  0, 1),
          "auto"),
      Choice("fit.loss", "none", RobustLossNames(), "Robust loss of each point's distance"),
      Bounded(Spec("fit.loss_scale", OptionType::kNumber, 3.0,
                   "Where the loss takes hold, in robust standard deviations of the start's distances"),
              1e-3, 1e3),
      Bounded(
          Spec("fit.peak_emphasis", OptionType::kNumber, 0.0,
               "Counts a distance d as d^2 (1 + this * d^2 / RMS^2): lowers the maximum, raises the RMSE; 0: "
               "least squares"),
          0, 1e3),
      OrWord(Bounded(Spec("fit.outlier_threshold", OptionType::kNumber, std::string("auto"),
                          "Points further off than this many standard deviations of the local noise, or not "
                          "connected with the scan, are outliers; 0: keep all; auto: 6, of a mesh 0"),
                     0, 1e6),
             "auto"),
      Bounded(Spec("fit.margin_weight", OptionType::kNumber, 0.1,
                   "Weight of the conforming margin, against the "
                   "points together"),
              0, 1e3),
      Spec("fit.uncertainty", OptionType::kFlag, false,
           "Estimate the surface's standard deviation along its normal: writes uncertainty.ply"),
      Bounded(Spec("fit.subset", OptionType::kInteger, std::int64_t{10000}, "Points of the first stages"),
              100, 1e9),
  };
}

SurfaceFitOptions SurfaceFitOptionsFrom(const Options& options) {
  SurfaceFitOptions fit;
  const auto pair = [&](const std::string& name) {
    const std::vector<int> values = options.Integers(name);
    return std::array<int, 2>{values.front(), values.back()};
  };
  fit.degree = pair("surface.degree");
  fit.control_points =
      options.HoldsWord("surface.control_points") ? std::array<int, 2>{0, 0} : pair("surface.control_points");
  const std::map<std::string, SurfaceMethod> methods = {{"distance", SurfaceMethod::kDistance},
                                                        {"parametric", SurfaceMethod::kParametric},
                                                        {"ma", SurfaceMethod::kMa}};
  fit.method = methods.at(options.Text("fit.method"));
  fit.repetitions = options.Integer("fit.repetitions");
  const std::map<std::string, BaseSurface> bases = {{"auto", BaseSurface::kAuto},
                                                    {"plane", BaseSurface::kPlane},
                                                    {"cylinder", BaseSurface::kCylinder},
                                                    {"sphere", BaseSurface::kSphere},
                                                    {"centre_line", BaseSurface::kCentreLine}};
  fit.base = bases.at(options.Text("fit.base"));
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
  if (!options.HoldsWord("fit.hinge_limit")) fit.hinge_limit = options.Number("fit.hinge_limit");
  fit.loss = options.Text("fit.loss");
  fit.loss_scale = options.Number("fit.loss_scale");
  fit.peak_emphasis = options.Number("fit.peak_emphasis");
  if (!options.HoldsWord("fit.outlier_threshold")) {
    fit.outlier_threshold = options.Number("fit.outlier_threshold");
  }
  fit.margin_weight = options.Number("fit.margin_weight");
  fit.uncertainty = options.Flag("fit.uncertainty");
  fit.subset = options.Integer("fit.subset");
  return fit;
}

void CheckSurfaceFitOptions(const Options& options) {
  const SurfaceFitOptions fit = SurfaceFitOptionsFrom(options);
  if (fit.peak_emphasis > 0 && fit.loss != "none") {
    throw ConfigError("option 'fit.peak_emphasis' does not go with 'fit.loss': set one of them");
  }
  if (fit.uncertainty && (fit.peak_emphasis > 0 || fit.loss != "none")) {
    throw ConfigError(
        "option 'fit.uncertainty' needs points that count alike: leave 'fit.loss' and "
        "'fit.peak_emphasis' out");
  }
  if (fit.method != SurfaceMethod::kDistance) {
    const std::string with = "option 'fit.method: " + options.Text("fit.method") + "'";
    if (fit.uncertainty) throw ConfigError(with + " has no 'fit.uncertainty': use fit.method: distance");
    if (fit.peak_emphasis > 0 || fit.loss != "none") {
      throw ConfigError(with + " is least squares: leave 'fit.loss' and 'fit.peak_emphasis' out");
    }
    if (fit.unknowns != SurfaceUnknowns::kControlPoints) {
      throw ConfigError(with +
                        " does not go with 'fit.unknowns': leave that out (ma frees the weights itself)");
    }
  }
  for (std::size_t k = 0; k < 2 && fit.control_points[0] > 0; ++k) {
    if (fit.control_points[k] > fit.degree[k]) continue;
    throw ConfigError("option 'surface.control_points' is " + std::to_string(fit.control_points[k]) +
                      (k == 0 ? " along u" : " along v") + ", degree " + std::to_string(fit.degree[k]) +
                      " needs at least " + std::to_string(fit.degree[k] + 1));
  }
}

void CheckTopologyOptions(const SurfaceFitOptions& options) {
  const SurfaceTopology topology = options.topology;
  const std::string name = SurfaceTopologyName(topology);
  bool suits = true;
  switch (options.base) {
    case BaseSurface::kAuto:
      break;
    case BaseSurface::kPlane:
      suits = topology == SurfaceTopology::kSheet;
      break;
    case BaseSurface::kCylinder:
      suits = topology == SurfaceTopology::kTube;
      break;
    case BaseSurface::kSphere:
      suits = topology == SurfaceTopology::kSphere;
      break;
    case BaseSurface::kCentreLine:
      suits = topology != SurfaceTopology::kSheet;
      break;
  }
  if (!suits) throw ConfigError("option 'fit.base' does not suit a " + name + "; leave it at auto");
  if (options.uncertainty && topology == SurfaceTopology::kSheet &&
      MarginFor(options, options.control_points) == MarginMode::kConforming) {
    throw ConfigError(
        "option 'fit.uncertainty' does not go with a conforming margin, whose points count more: set "
        "'fit.margin' to trim or none");
  }
  if (topology == SurfaceTopology::kSheet) return;
  if (topology == SurfaceTopology::kSphere && options.margin == MarginMode::kConforming) {
    throw ConfigError("option 'fit.margin' is conforming, but a sphere has no edges: leave it at auto");
  }
  if (options.margin == MarginMode::kTrim) {
    throw ConfigError("option 'fit.margin' is trim, but a " + name +
                      " has no edges to trim: leave it at auto");
  }
  const auto [nu, nv] = options.control_points;
  if (!PolesOf(topology).any()) return;
  if (options.unknowns != SurfaceUnknowns::kControlPoints || options.method == SurfaceMethod::kMa ||
      options.start_from_ma) {
    throw ConfigError("a " + name +
                      " has poles, where weights are fixed: set 'fit.unknowns: control_points' and " +
                      "neither 'fit.method' nor 'fit.start' to ma");
  }
  constexpr int kLeastAlong = 4;  // two rows at each end
  if (nu > 0 && nu < 3) {
    throw ConfigError("option 'surface.control_points' is " + std::to_string(nu) +
                      " along u; round the poles of a " + name + " at least 3 are needed");
  }
  if (nu > 0 && nv < kLeastAlong) {
    throw ConfigError("option 'surface.control_points' is " + std::to_string(nv) + " along v; a " + name +
                      ", which has poles, needs at least " + std::to_string(kLeastAlong));
  }
}

MarginMode MarginFor(const SurfaceFitOptions& options, std::array<int, 2> control_points) {
  if (options.topology == SurfaceTopology::kSphere) return MarginMode::kNone;
  if (options.topology != SurfaceTopology::kSheet) return options.margin.value_or(MarginMode::kConforming);
  if (options.margin) return *options.margin;
  if (control_points[0] == 0) return MarginMode::kTrim;  // chosen by held-out error: one margin for all nets
  return std::max(control_points[0], control_points[1]) <= kConformingUpTo ? MarginMode::kConforming
                                                                           : MarginMode::kTrim;
}

std::vector<std::pair<std::string, OptionValue>> SurfaceFitSolverDefaults(const std::string& solver,
                                                                          const SurfaceFitOptions& options) {
  const std::string prefix = solver == "pso_lm" ? "lm." : "";
  if (solver != "lm" && solver != "dogleg" && solver != "pso_lm") return {};
  // Of each stage. Small nets, and those whose margin moves too, take longer to come to rest.
  std::int64_t iterations = options.control_points[0] > 0 ? 4 : 6;  // nets are compared at rest
  if (options.topology != SurfaceTopology::kSheet) {
    const int net = options.control_points[0] * options.control_points[1];
    const bool asked_to_conform = options.margin == MarginMode::kConforming;
    iterations = asked_to_conform || (0 < net && net <= 256) ? 25 : 8;
  } else if (MarginFor(options, options.control_points) == MarginMode::kConforming) {
    iterations = 25;
  }
  return {{prefix + "max_iterations", iterations},
          {prefix + "initial_trust_region_radius", 1.0},  // MATH.md §1: few steps are rejected then
          {prefix + "linear_solver", std::string("sparse_normal_cholesky")},
          {prefix + "function_tolerance", 1e-5},
          {prefix + "gradient_tolerance", 0.0},
          {prefix + "parameter_tolerance", 1e-12}};
}

}  // namespace frond
