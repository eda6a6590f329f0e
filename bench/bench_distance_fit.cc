// SPDX-License-Identifier: BSD-3-Clause
// Time per Levenberg–Marquardt iteration of the compressed distance fit against the same fit written as one
// auto-diff residual block per point, in two ways:
//
//   free feet   residual S(u, v) − Q; 17 parameter blocks a point: 16 control points and its own (u, v),
//   which is
//               eliminated first (the Schur complement, faster here than the whole normal equations);
//   fixed feet  residual d·(S − Q) at a foot that is held for all iterations (no foot points are sought,
//   which
//               flatters it); 16 parameter blocks.
//
// Neither has fairness or hinge, which the compressed fit does. Runs are interleaved; the median iteration
// counts.
//
//   bench_distance_fit [points = 40000] [net = 20] [rounds = 3]
#include <ceres/autodiff_cost_function.h>
#include <ceres/iteration_callback.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <utility>
#include <vector>

#include "models/foot_point_search.h"
#include "models/knot_vector.h"
#include "problems/surface/distance_fit.h"
#include "problems/surface/distance_residual.h"
#include "problems/surface/linear_start.h"
#include "problems/surface/sheet_start.h"
#include "tests/problems/surface/leaf_case.h"

namespace frond {
namespace {

constexpr int kDegree = 3;
constexpr int kLocal = 16;  // control points under a bicubic cell

// residual = S(u, v) − Q over 16 control points (3 each) and (u, v). The spans are those of the start: beyond
// them their polynomials go on.
struct FreeFootResidual {
  const BSplineBasis* basis_u;
  const BSplineBasis* basis_v;
  int span_u, span_v;
  Eigen::Vector3d point;

  template <typename T>
  bool operator()(T const* const* blocks, T* residual) const {
    std::array<T, kDegree + 1> fu, fv;
    basis_u->Evaluate(span_u, blocks[kLocal][0], 0, fu.data());
    basis_v->Evaluate(span_v, blocks[kLocal][1], 0, fv.data());
    for (int x = 0; x < 3; ++x) residual[x] = T(-point[x]);
    for (std::size_t a = 0; a <= kDegree; ++a) {
      for (std::size_t b = 0; b <= kDegree; ++b) {
        const T factor = fu[a] * fv[b];
        for (int x = 0; x < 3; ++x) residual[x] += factor * blocks[a * (kDegree + 1) + b][x];
      }
    }
    return true;
  }
};

// Ceres gives a fixed-size functor each parameter block, and last the residual, as arguments of their own.
template <typename Functor>
struct Unpacked {
  Functor functor;

  template <typename T, typename... Rest>
  bool operator()(const T* first, Rest... rest) const {
    const std::array<const T*, 1 + sizeof...(Rest)> all{first, rest...};
    return functor(all.data(), const_cast<T*>(all.back()));
  }
};

struct Case {
  std::vector<Eigen::Vector3d> points;
  NurbsSurface start;
  std::vector<Eigen::Vector2d> feet;
};

Case MakeCase(int points, int net) {
  LeafScanOptions options;
  options.points = points;
  options.dense_points = 1000;
  std::vector<Eigen::Vector3d> cloud = MakeLeafCase(1, options).points;
  const std::vector<Eigen::Vector2d> parameters = RectangleParameters(cloud, cloud, 0.02);
  NurbsSurface start =
      FitAtParameters(cloud, parameters, UniformBasis(kDegree, net), UniformBasis(kDegree, net), 1e-7);
  std::vector<Eigen::Vector2d> feet = FootParameters(cloud, start, 1);
  return {std::move(cloud), std::move(start), std::move(feet)};
}

double Median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Notes the processor time at the end of each iteration.
struct IterationClock : ceres::IterationCallback {
  std::vector<double> seconds;
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& /*summary*/) override {
    seconds.push_back(static_cast<double>(std::clock()) / CLOCKS_PER_SEC);
    return ceres::SOLVER_CONTINUE;
  }
};

// Of the median iteration; the first evaluation is left out.
double SecondsPerIteration(ceres::Problem* problem, int iterations) {
  IterationClock clock;
  ceres::Solver::Options options;
  options.callbacks.push_back(&clock);
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.sparse_linear_algebra_library_type = ceres::SUITE_SPARSE;
  options.max_num_iterations = iterations;
  options.initial_trust_region_radius = 1;
  options.function_tolerance = options.gradient_tolerance = options.parameter_tolerance = 0;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, problem, &summary);
  std::vector<double> seconds;
  for (std::size_t k = 1; k < clock.seconds.size(); ++k)
    seconds.push_back(clock.seconds[k] - clock.seconds[k - 1]);
  return Median(std::move(seconds));
}

double TimeCompressed(const Case& data) {
  const SurfaceDistanceFit fit(data.points, data.start, data.start, {}, 1, data.feet);
  LeastSquares least_squares(fit, 1);
  return SecondsPerIteration(&least_squares.problem(), 10);
}

double TimeFreeFeet(const Case& data) {
  std::vector<Eigen::Vector3d> net = data.start.control_points();
  std::vector<Eigen::Vector2d> feet = data.feet;
  const BSplineBasis &bu = data.start.u(), &bv = data.start.v();
  ceres::Problem problem;
  for (std::size_t i = 0; i < feet.size(); ++i) {
    const int su = bu.FindSpan(feet[i][0]), sv = bv.FindSpan(feet[i][1]);
    std::vector<double*> blocks;
    for (int a = su - kDegree; a <= su; ++a) {
      for (int b = sv - kDegree; b <= sv; ++b) {
        blocks.push_back(net[static_cast<std::size_t>(a * bv.num_control_points() + b)].data());
      }
    }
    blocks.push_back(feet[i].data());
    using Functor = Unpacked<FreeFootResidual>;
    using Cost = ceres::AutoDiffCostFunction<Functor, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 2>;
    problem.AddResidualBlock(new Cost(new Functor{{&bu, &bv, su, sv, data.points[i]}}), nullptr, blocks);
  }
  return SecondsPerIteration(&problem, 3);
}

double TimeFixedFeet(const Case& data) {
  std::vector<Eigen::Vector3d> net = data.start.control_points();
  const SurfaceCells cells(data.start);
  const ControlNet control_net(data.start, SurfaceUnknowns::kControlPoints);
  const std::vector<CellBlocks> layout = BlocksOfCells(cells, control_net);
  std::vector<std::array<double, kLocal>> bases(data.points.size());
  ceres::Problem problem;
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    const double u = data.feet[i][0], v = data.feet[i][1];
    std::array<double, kDegree + 1> fu, fv;
    cells.u().Evaluate(cells.u().SpanOf(u), u, 0, fu.data());
    cells.v().Evaluate(cells.v().SpanOf(v), v, 0, fv.data());
    for (std::size_t k = 0; k < kLocal; ++k) bases[i][k] = fu[k / 4] * fv[k % 4];
    const CellBlocks& cell = layout[static_cast<std::size_t>(cells.CellOf(u, v))];
    std::vector<double*> blocks;
    for (const int block : cell.blocks) blocks.push_back(net[static_cast<std::size_t>(block)].data());
    using Functor = Unpacked<DistanceResidual>;
    using Cost = ceres::AutoDiffCostFunction<Functor, 1, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3>;
    const Eigen::Vector3d normal = data.start.EvaluateWithDerivatives(u, v).Normal();
    problem.AddResidualBlock(
        new Cost(new Functor{{bases[i], &cell, &control_net, data.points[i], normal.transpose()}}), nullptr,
        blocks);
  }
  return SecondsPerIteration(&problem, 3);
}

}  // namespace
}  // namespace frond

int main(int argc, char** argv) {
  const int points = argc > 1 ? std::atoi(argv[1]) : 40000, net = argc > 2 ? std::atoi(argv[2]) : 20;
  const int rounds = argc > 3 ? std::atoi(argv[3]) : 3;
  const frond::Case data = frond::MakeCase(points, net);
  std::printf("%d points, bicubic %d × %d, one thread; processor ms per LM iteration, runs interleaved.\n\n",
              points, net, net);
  std::printf(
      "| round | compressed | a block per point, free feet | ratio | a block per point, fixed feet | ratio "
      "|\n"
      "|---|---|---|---|---|---|\n");
  std::vector<double> free_ratio, fixed_ratio;
  for (int round = 1; round <= rounds; ++round) {
    const double compressed = frond::TimeCompressed(data), free_feet = frond::TimeFreeFeet(data);
    const double again = frond::TimeCompressed(data), fixed_feet = frond::TimeFixedFeet(data);
    free_ratio.push_back(2 * free_feet / (compressed + again));
    fixed_ratio.push_back(2 * fixed_feet / (compressed + again));
    std::printf("| %d | %.1f, %.1f | %.0f | %.1f | %.0f | %.1f |\n", round, 1e3 * compressed, 1e3 * again,
                1e3 * free_feet, free_ratio.back(), 1e3 * fixed_feet, fixed_ratio.back());
    std::fflush(stdout);
  }
  std::printf("| median | | | %.1f | | %.1f |\n", frond::Median(free_ratio), frond::Median(fixed_ratio));
}
