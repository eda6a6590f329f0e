// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/fit_problem.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "base/errors.h"
#include "base/options.h"
#include "solvers/quiet_ceres_log.h"

namespace frond {

std::shared_ptr<ceres::EvaluationCallback> FitProblem::CreateState(const std::vector<double*>& /*blocks*/,
                                                                   int /*threads*/) const {
  return nullptr;
}

double FitProblem::Objective(std::span<const double> x) const {
  LeastSquares least_squares(*this, 1);
  least_squares.SetX(x);
  return least_squares.Cost();
}

std::map<std::string, double> FitProblem::Metrics(std::span<const double> /*x*/) const { return {}; }

int FitProblem::NumParameters() const {
  std::size_t count = 0;
  for (const ParameterBlock& block : parameters()) count += block.start.size();
  return static_cast<int>(count);
}

int FitProblem::NumFreeParameters() const {
  std::size_t count = 0;
  for (const ParameterBlock& block : parameters()) count += block.constant ? 0 : block.start.size();
  return static_cast<int>(count);
}

std::vector<double> FitProblem::StartVector() const {
  std::vector<double> x;
  for (const ParameterBlock& block : parameters()) {
    x.insert(x.end(), block.start.begin(), block.start.end());
  }
  return x;
}

namespace {

// A value of a block and its bounds, ± infinity where there are none.
struct BoundedValue {
  const ParameterBlock& block;
  std::size_t i;
  double lower, upper;

  [[noreturn]] void Refuse(const std::string& problem) const {
    throw FitError("parameter '" + block.name + "'[" + std::to_string(i) + "]: " + problem + " " +
                   FormatValue(std::vector<double>{lower, upper}));
  }

  void CheckStartBox(double start_lower, double start_upper) const {
    const std::string box = "its start box " + FormatValue(std::vector<double>{start_lower, start_upper});
    if (!std::isfinite(start_lower) || !std::isfinite(start_upper) || start_lower > start_upper) {
      Refuse(box + " is not a finite interval within the bounds");
    }
    if (start_lower < lower || start_upper > upper) Refuse(box + " is outside of its bounds");
  }

  void Check() const {
    if (!(lower <= upper)) Refuse("empty bounds");
    if (!block.constant && (block.start[i] < lower || block.start[i] > upper)) {
      Refuse("its start " + FormatValue(block.start[i]) + " is outside of its bounds");
    }
    if (!block.constant && !block.start_lower.empty())
      CheckStartBox(block.start_lower[i], block.start_upper[i]);
  }
};

}  // namespace

void CheckParameters(const FitProblem& fit) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const ParameterBlock& block : fit.parameters()) {
    const std::size_t size = block.start.size();
    if (block.start_lower.size() != block.start_upper.size() ||
        (!block.start_lower.empty() && block.start_lower.size() != size)) {
      throw FitError("parameter '" + block.name + "': a start box of the wrong length");
    }
    if ((!block.lower.empty() && block.lower.size() != size) ||
        (!block.upper.empty() && block.upper.size() != size)) {
      throw FitError("parameter '" + block.name + "': " + std::to_string(block.lower.size()) + " lower and " +
                     std::to_string(block.upper.size()) + " upper bounds for " + std::to_string(size) +
                     " values");
    }
    for (std::size_t i = 0; i < size; ++i) {
      BoundedValue{block, i, block.lower.empty() ? -kInfinity : block.lower[i],
                   block.upper.empty() ? kInfinity : block.upper[i]}
          .Check();
    }
  }
}

// Passes Ceres's notifications on to the fit's state and counts them: Ceres evaluates the whole problem once
// after each, in line searches too (which Solver::Summary does not count).
class LeastSquares::CountingCallback final : public ceres::EvaluationCallback {
 public:
  explicit CountingCallback(ceres::EvaluationCallback* state) : state_(state) {}

  void PrepareForEvaluation(bool evaluate_jacobians, bool new_evaluation_point) override {
    if (gate && !gate()) throw EvaluationRefused();
    ++(evaluate_jacobians ? counts_.jacobian_evaluations : counts_.residual_evaluations);
    if (state_ != nullptr) state_->PrepareForEvaluation(evaluate_jacobians, new_evaluation_point);
  }

  const Counts& counts() const { return counts_; }

  std::function<bool()> gate;

 private:
  ceres::EvaluationCallback* state_;
  Counts counts_;
};

LeastSquares::LeastSquares(const FitProblem& fit, int threads)
    : x_(fit.StartVector()),
      jacobian_charge_(fit.NumFreeParameters() *
                       std::int64_t{fit.derivatives() == Derivatives::kNumeric ? 2 : 1}) {
  CheckParameters(fit);
  double* values = x_.data();
  for (const ParameterBlock& block : fit.parameters()) {
    if (block.start.empty()) throw std::invalid_argument("parameter '" + block.name + "' has no values");
    blocks_.push_back(values);
    values += block.start.size();
  }
  state_ = fit.CreateState(blocks_, threads);
  counting_ = std::make_unique<CountingCallback>(state_.get());

  ceres::Problem::Options options;
  options.evaluation_callback = counting_.get();
  options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  problem_ = std::make_unique<ceres::Problem>(options);
  for (std::size_t b = 0; b < blocks_.size(); ++b) AddParameters(fit.parameters()[b], blocks_[b]);
  fit.AddResiduals(blocks_, state_.get(), problem_.get());
}

LeastSquares::~LeastSquares() = default;

void LeastSquares::AddParameters(const ParameterBlock& block, double* values) {
  problem_->AddParameterBlock(values, static_cast<int>(block.start.size()));
  if (block.manifold != nullptr) {
    manifolds_.push_back(block.manifold);
    problem_->SetManifold(values, block.manifold.get());
  }
  for (int i = 0; i < static_cast<int>(block.lower.size()); ++i) {
    if (std::isfinite(block.lower[i])) problem_->SetParameterLowerBound(values, i, block.lower[i]);
  }
  for (int i = 0; i < static_cast<int>(block.upper.size()); ++i) {
    if (std::isfinite(block.upper[i])) problem_->SetParameterUpperBound(values, i, block.upper[i]);
  }
  if (block.constant) problem_->SetParameterBlockConstant(values);
}

void LeastSquares::SetX(std::span<const double> x) {
  if (x.size() != x_.size()) {
    throw std::invalid_argument("x has " + std::to_string(x.size()) + " values, the fit " +
                                std::to_string(x_.size()));
  }
  std::copy(x.begin(), x.end(), x_.begin());
}

void LeastSquares::SetGate(std::function<bool()> may_begin) { counting_->gate = std::move(may_begin); }

const LeastSquares::Counts& LeastSquares::counts() const { return counting_->counts(); }

std::int64_t LeastSquares::ChargedEvaluations() const {
  return counts().residual_evaluations + jacobian_charge_ * counts().jacobian_evaluations;
}

double LeastSquares::Cost() {
  const QuietCeresLog quiet;
  ceres::Problem::EvaluateOptions options;
  options.num_threads = 1;  // Ceres adds costs up thread by thread: the last bits would depend on it
  double cost = 0;
  if (!problem_->Evaluate(options, &cost, nullptr, nullptr, nullptr)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return cost;
}

}  // namespace frond
