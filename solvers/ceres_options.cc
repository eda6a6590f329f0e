// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/ceres_options.h"

#include <stdexcept>
#include <string>

#include "base/option_specs.h"

namespace frond {
namespace {

constexpr int kMostIterations = 1'000'000'000;

std::vector<OptionSpec> CommonSpecs() {
  return {
      {.name = "max_iterations",
       .type = OptionType::kInteger,
       .default_value = 1000,
       .help = "Steps tried, accepted or not; 0 evaluates the start only",
       .minimum = 0,
       .maximum = kMostIterations},
      // Tighter than Ceres's 1e-6, which leaves few digits on slowly converging fits (MATH.md §7).
      NumberSpec("function_tolerance", 1e-12, 0, 1,
                 "Stop where |change of cost| < tolerance * cost; 0 never"),
      NumberSpec("gradient_tolerance", 1e-10, 0, 1e300,
                 "Stop where the largest |gradient| <= tolerance; 0 never"),
      NumberSpec("parameter_tolerance", 1e-12, 0, 1,
                 "Stop where |step| <= tolerance * (|x| + tolerance); 0 never"),
  };
}

std::vector<OptionSpec> TrustRegionSpecs() {
  return {
      NumberSpec("initial_trust_region_radius", 1e4, 1e-16, 1e16,
                 "Start of the trust region (LM: 1/damping); small values keep first steps short"),
      ChoiceSpec(
          "linear_solver", {"dense_qr", "dense_normal_cholesky", "sparse_normal_cholesky"},
          "dense_qr: most accurate; dense_normal_cholesky: faster; sparse_normal_cholesky: many parameters "
          "of which each residual touches few"),
      {.name = "nonmonotonic_steps",
       .type = OptionType::kFlag,
       .default_value = false,
       .help = "Accept steps uphill on the way (at most five in a row); the best is returned"},
      {.name = "refine",
       .type = OptionType::kFlag,
       .default_value = false,
       .help =
           "After convergence take Gauss-Newton steps while they shorten, for the digits below the cost's "
           "rounding; small unbounded fits"},
  };
}

ceres::LinearSolverType LinearSolver(const std::string& name) {
  if (name == "dense_qr") return ceres::DENSE_QR;
  if (name == "dense_normal_cholesky") return ceres::DENSE_NORMAL_CHOLESKY;
  if (name == "sparse_normal_cholesky") return ceres::SPARSE_NORMAL_CHOLESKY;
  throw std::logic_error("no linear solver is named '" + name + "'");
}

void SetTrustRegion(const Options& options, CeresMethod method, ceres::Solver::Options* ceres_options) {
  ceres_options->minimizer_type = ceres::TRUST_REGION;
  ceres_options->initial_trust_region_radius = options.Number("initial_trust_region_radius");
  ceres_options->linear_solver_type = LinearSolver(options.Text("linear_solver"));
  ceres_options->sparse_linear_algebra_library_type = ceres::SUITE_SPARSE;
  ceres_options->use_nonmonotonic_steps = options.Flag("nonmonotonic_steps");
  // With bounds Ceres searches along each step. By cubic interpolation that costs Jacobians, two an
  // iteration; halving costs residuals alone.
  ceres_options->line_search_interpolation_type = ceres::BISECTION;
  ceres_options->trust_region_strategy_type = ceres::LEVENBERG_MARQUARDT;
  if (method == CeresMethod::kDogleg) {
    ceres_options->trust_region_strategy_type = ceres::DOGLEG;
    ceres_options->dogleg_type =
        options.Text("dogleg_type") == "subspace" ? ceres::SUBSPACE_DOGLEG : ceres::TRADITIONAL_DOGLEG;
  }
}

void SetLineSearch(const Options& options, CeresMethod method, ceres::Solver::Options* ceres_options) {
  ceres_options->minimizer_type = ceres::LINE_SEARCH;
  ceres_options->line_search_type = ceres::WOLFE;  // Armijo would not keep the inverse Hessian positive
  ceres_options->line_search_direction_type = ceres::BFGS;
  if (method == CeresMethod::kLbfgs) {
    ceres_options->line_search_direction_type = ceres::LBFGS;
    ceres_options->max_lbfgs_rank = options.Integer("lbfgs_rank");
  }
}

}  // namespace

std::vector<OptionSpec> CeresOptionSpecs(CeresMethod method) {
  std::vector<OptionSpec> specs = CommonSpecs();
  if (method == CeresMethod::kBfgs) return specs;
  if (method == CeresMethod::kLbfgs) {
    specs.push_back({.name = "lbfgs_rank",
                     .type = OptionType::kInteger,
                     .default_value = 20,
                     .help = "Past steps kept to model the curvature",
                     .minimum = 1,
                     .maximum = 1000});
    return specs;
  }
  for (OptionSpec& spec : TrustRegionSpecs()) specs.push_back(std::move(spec));
  if (method == CeresMethod::kDogleg) {
    specs.push_back(ChoiceSpec("dogleg_type", {"traditional", "subspace"},
                               "traditional: two straight legs; subspace: the best of the plane they span"));
  }
  return specs;
}

ceres::Solver::Options CeresOptionsFrom(const Options& options, int threads, CeresMethod method) {
  ceres::Solver::Options ceres_options;
  ceres_options.max_num_iterations = options.Integer("max_iterations");
  ceres_options.function_tolerance = options.Number("function_tolerance");
  ceres_options.gradient_tolerance = options.Number("gradient_tolerance");
  ceres_options.parameter_tolerance = options.Number("parameter_tolerance");
  ceres_options.num_threads = threads;
  ceres_options.logging_type = ceres::SILENT;
  ceres_options.update_state_every_iteration = true;
  if (IsLineSearch(method)) {
    SetLineSearch(options, method, &ceres_options);
  } else {
    SetTrustRegion(options, method, &ceres_options);
  }
  return ceres_options;
}

}  // namespace frond
