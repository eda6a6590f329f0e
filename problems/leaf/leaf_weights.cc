// SPDX-License-Identifier: BSD-3-Clause
#include "problems/leaf/leaf_weights.h"

#include <ceres/dynamic_autodiff_cost_function.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>

#include "base/errors.h"
#include "base/parallel.h"
#include "models/newton_projection.h"

namespace frond {
namespace {

// While no weight is this many times another one, a point's foot on the start surface leads to its foot.
constexpr double kNear = 1.4;
// While none is this many times another one, the nearest of a few hundred samples does; beyond, the surface
// may pass a point in several places.
constexpr double kSpread = 3;

// Where starts are drawn.
constexpr double kStartLower = 0.9, kStartUpper = 1.1;

// The rows R of LeafWeightResidual at a converged foot.
Eigen::Matrix3d RowsAt(const SurfaceCells::Jet1& s, const FootPoint& foot) {
  Eigen::Matrix3d rows = Eigen::Matrix3d::Zero();
  if (foot.at_edge_u && foot.at_edge_v) return Eigen::Matrix3d::Identity();
  if (foot.at_edge_u || foot.at_edge_v) {
    const Eigen::Vector3d tangent = foot.at_edge_u ? s.dv : s.du;
    if (!(tangent.squaredNorm() > 0)) return Eigen::Matrix3d::Identity();
    const Eigen::Vector3d first = tangent.unitOrthogonal();
    rows.row(0) = first.transpose();
    rows.row(1) = tangent.normalized().cross(first).transpose();
    return rows;
  }
  const Eigen::Vector3d normal = s.du.cross(s.dv);
  if (!(normal.norm() > 1e-12 * s.du.norm() * s.dv.norm())) return Eigen::Matrix3d::Identity();
  rows.row(0) = normal.normalized().transpose();
  return rows;
}

// The rows of all points of one ceres::Problem, brought up to date at each new point.
class WeightsState final : public ceres::EvaluationCallback {
 public:
  WeightsState(const LeafWeightsFit& fit, const double* weights, int threads)
      : fit_(fit), weights_(weights), threads_(threads), cells_(fit.start_cells()) {
    residuals.resize(fit.points().size());
    Update();
  }

  void PrepareForEvaluation(bool /*evaluate_jacobians*/, bool new_evaluation_point) override {
    if (new_evaluation_point) Update();
  }

  std::vector<LeafWeightResidual> residuals;

 private:
  void Update() {
    const auto count = static_cast<std::size_t>(fit_.NumParameters());
    fit_.FindFeet({weights_, count}, &cells_, &feet_, threads_);
    for (std::size_t i = 0; i < feet_.size(); ++i) SetRows(feet_[i], fit_.points()[i], &residuals[i]);
  }

  void SetRows(const FootPoint& foot, const Eigen::Vector3d& point, LeafWeightResidual* r) const {
    const SpanPolynomials &u = cells_.u(), &v = cells_.v();
    const int ku = u.SpanOf(foot.u), kv = v.SpanOf(foot.v);
    std::array<double, kMaxDegree + 1> nu, nv;
    u.Evaluate(ku, foot.u, 0, nu.data());
    v.Evaluate(kv, foot.v, 0, nv.data());
    r->point = point;
    r->rows = RowsAt(cells_.Evaluate1(foot.u, foot.v), foot);
    r->active.clear();
    r->values.clear();
    r->control.clear();
    const NurbsSurface& surface = fit_.surface();
    for (int a = 0; a <= u.degree(); ++a) {
      for (int b = 0; b <= v.degree(); ++b) {
        const int i = u.first(ku) + a, j = v.first(kv) + b;
        r->active.push_back(i * surface.count_v() + j);
        r->values.push_back(nu[static_cast<std::size_t>(a)] * nv[static_cast<std::size_t>(b)]);
        r->control.push_back(surface.control_point(i, j));
      }
    }
  }

  const LeafWeightsFit& fit_;
  const double* weights_;
  int threads_;
  SurfaceCells cells_;
  std::vector<FootPoint> feet_;
};

// Samples of a surface at evenly spaced parameters, to be searched whole: cheaper than a tree for the few
// hundred that a small net needs, which have to be made anew for every x.
class SampleGrid {
 public:
  SampleGrid() = default;
  explicit SampleGrid(const SurfaceCells& cells)
      : u_(Lines<kLinesU>(cells.basis_u())), v_(Lines<kLinesV>(cells.basis_v())) {
    for (std::size_t k = 0; k < kSize; ++k) {
      const Eigen::Vector3f sample = cells.Evaluate(u_[k / kLinesV], v_[k % kLinesV]).cast<float>();
      x_[k] = sample.x();
      y_[k] = sample.y();
      z_[k] = sample.z();
    }
  }

  // The parameters of the sample nearest to `point`, if nearer than by the root of `squared_distance`; of
  // samples equally near to 1 in 10,000 the first.
  std::optional<Eigen::Vector2d> NearerThan(double squared_distance, const Eigen::Vector3d& point) const {
    // Floats above 0 are ordered like their bits. The sample's number takes the place of the last ones, so
    // that a plain minimum, which the compiler makes vectors of, finds distance and sample together.
    constexpr std::int32_t kNumber = 511;
    static_assert(kSize <= kNumber + 1);
    const Eigen::Vector3f p = point.cast<float>();
    std::int32_t least = std::numeric_limits<std::int32_t>::max();
    for (std::size_t k = 0; k < kSize; ++k) {
      const float dx = x_[k] - p[0], dy = y_[k] - p[1], dz = z_[k] - p[2];
      const float squared = dx * dx + dy * dy + dz * dz;
      least =
          std::min(least, (std::bit_cast<std::int32_t>(squared) & ~kNumber) | static_cast<std::int32_t>(k));
    }
    const auto squared = static_cast<double>(std::bit_cast<float>(least & ~kNumber));
    if (!(squared < squared_distance)) return std::nullopt;
    const auto k = static_cast<std::size_t>(least & kNumber);
    return Eigen::Vector2d(u_[k / kLinesV], v_[k % kLinesV]);
  }

 private:
  static constexpr std::size_t kLinesU = 14, kLinesV = 22, kSize = kLinesU * kLinesV;  // leaves are long in v

  template <std::size_t kCount>
  static std::array<double, kCount> Lines(const BSplineBasis& basis) {
    std::array<double, kCount> lines;
    for (std::size_t i = 0; i < kCount; ++i) {
      lines[i] = basis.begin() + (basis.end() - basis.begin()) * static_cast<double>(i) / (kCount - 1);
    }
    return lines;
  }

  std::array<double, kLinesU> u_{};
  std::array<double, kLinesV> v_{};
  std::array<float, kSize> x_{}, y_{}, z_{};
};

struct StateResidual {
  const LeafWeightResidual* residual;

  template <typename T>
  bool operator()(T const* const* blocks, T* out) const {
    residual->Evaluate(blocks[0], out);
    return true;
  }
};

void CheckOptions(const LeafWeightsOptions& o) {
  const LeafObjective& f = o.objective;
  if (!(f.rmse_share >= 0 && f.max_share >= 0 && std::abs(f.rmse_share + f.max_share - 1) < 1e-9)) {
    throw ConfigError("paper.alpha must be two numbers from 0 to 1 whose sum is 1");
  }
  if (!(o.lower > 0 && o.lower <= 1 && o.upper >= 1 && std::isfinite(o.upper))) {
    throw ConfigError("paper.weight_bounds must be two positive numbers with 1 between them");
  }
}

}  // namespace

LeafWeightsFit::LeafWeightsFit(NurbsSurface surface, std::vector<Eigen::Vector3d> points,
                               const LeafWeightsOptions& options)
    : surface_(std::move(surface)), points_(std::move(points)), options_(options), start_cells_(surface_) {
  CheckOptions(options);
  if (points_.empty()) throw InputError("no points to fit the leaf's weights to");
  const std::size_t count = surface_.control_points().size();
  parameters_.push_back({.name = "weights",
                         .start = std::vector<double>(count, 1.0),
                         .lower = std::vector<double>(count, options.lower),
                         .upper = std::vector<double>(count, options.upper),
                         .start_lower = std::vector<double>(count, std::max(options.lower, kStartLower)),
                         .start_upper = std::vector<double>(count, std::min(options.upper, kStartUpper))});
  start_cells_.Update(surface_.control_points(), parameters_[0].start);
  const FootPointSearch search(start_cells_);
  foot_options_ = search.options();
  for (const Eigen::Vector3d& p : points_) start_feet_.push_back(search.Find(p, FootPointSearch::kThorough));
}

void LeafWeightsFit::FindFeet(std::span<const double> x, SurfaceCells* cells, std::vector<FootPoint>* feet,
                              int threads) const {
  cells->Update(surface_.control_points(), x);
  feet->resize(points_.size());
  const auto [least, largest] = std::minmax_element(x.begin(), x.end());
  const double ratio = *largest / *least;
  const bool sampled = ratio > kNear && ratio <= kSpread;
  const SampleGrid grid = sampled ? SampleGrid(*cells) : SampleGrid();
  std::optional<FootPointSearch> search;
  if (ratio > kSpread) search.emplace(*cells, 2000);
  ParallelFor(points_.size(), 256, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Eigen::Vector2d start(start_feet_[i].u, start_feet_[i].v);
      if (search) {
        (*feet)[i] = search->FindFrom(points_[i], start[0], start[1], FootPointSearch::kThorough);
        continue;
      }
      if (sampled) {
        const double tracked = (cells->Evaluate(start[0], start[1]) - points_[i]).squaredNorm();
        start = grid.NearerThan(tracked, points_[i]).value_or(start);
      }
      (*feet)[i] = RefineFootPoint(*cells, points_[i], start[0], start[1], foot_options_);
    }
  });
}

std::shared_ptr<ceres::EvaluationCallback> LeafWeightsFit::CreateState(const std::vector<double*>& blocks,
                                                                       int threads) const {
  return std::make_shared<WeightsState>(*this, blocks[0], threads);
}

void LeafWeightsFit::AddResiduals(const std::vector<double*>& blocks, ceres::EvaluationCallback* state,
                                  ceres::Problem* problem) const {
  for (const LeafWeightResidual& residual : static_cast<WeightsState*>(state)->residuals) {
    auto* cost = new ceres::DynamicAutoDiffCostFunction<StateResidual>(new StateResidual{&residual});
    cost->AddParameterBlock(NumParameters());
    cost->SetNumResiduals(3);
    problem->AddResidualBlock(cost, nullptr, blocks[0]);
  }
}

double LeafWeightsFit::Objective(std::span<const double> x) const {
  for (const double w : x) {
    if (!(w > 0) || !std::isfinite(w)) return std::numeric_limits<double>::infinity();
  }
  std::vector<double> squared;
  squared.reserve(points_.size());
  if (options_.projection == WeightProjection::kPaper) {
    const NurbsSurface surface = SurfaceAt(x);
    for (const Eigen::Vector3d& p : points_) {
      const double distance = ProjectByNewton(surface, p).distance;
      squared.push_back(distance * distance);
    }
  } else {
    SurfaceCells cells = start_cells_;
    std::vector<FootPoint> feet;
    FindFeet(x, &cells, &feet, 1);
    for (const FootPoint& foot : feet) squared.push_back(foot.squared_distance);
  }
  if (options_.sum_of_squares) return std::accumulate(squared.begin(), squared.end(), 0.0) / 2;
  return ErrorOf(squared, options_.objective).objective;
}

std::map<std::string, double> LeafWeightsFit::Metrics(std::span<const double> x) const {
  const LeafError error = MeasureLeaf(SurfaceAt(x), points_, options_.objective);
  return {{"rmse", error.rmse}, {"max", error.max}, {"objective", error.objective}};
}

NurbsSurface LeafWeightsFit::SurfaceAt(std::span<const double> x) const {
  return NurbsSurface(surface_.u(), surface_.v(), surface_.control_points(), {x.begin(), x.end()});
}

}  // namespace frond
