// SPDX-License-Identifier: BSD-3-Clause
// The inner loops of the distance fit, a point at a time: surface evaluation, foot points from near and from
// nowhere, and the moments of a cell. Prints a Markdown table; Google Benchmark's flags work
// (--benchmark_filter=Foot).
#include <benchmark/benchmark.h>

#include <Eigen/Core>
#include <cstdio>
#include <vector>

#include "base/random.h"
#include "models/foot_point_search.h"
#include "models/knot_vector.h"
#include "models/surface_cells.h"
#include "problems/surface/cell_moments.h"
#include "problems/surface/linear_start.h"
#include "problems/surface/sheet_start.h"
#include "tests/problems/surface/leaf_case.h"

namespace frond {
namespace {

// A leaf scan of 40,000 points in the file's (random) order, and a bicubic 20 × 20 surface near it.
struct Scene {
  std::vector<Eigen::Vector3d> points;
  NurbsSurface surface;
  std::vector<Eigen::Vector2d> feet;
};

const Scene& TheScene() {
  static const Scene scene = [] {
    LeafScanOptions options;
    options.dense_points = 1000;
    std::vector<Eigen::Vector3d> points = MakeLeafCase(1, options).points;
    NurbsSurface surface = FitAtParameters(points, RectangleParameters(points, points, 0.02),
                                           UniformBasis(3, 20), UniformBasis(3, 20), 1e-7);
    std::vector<Eigen::Vector2d> feet = FootParameters(points, surface, 1);
    return Scene{std::move(points), std::move(surface), std::move(feet)};
  }();
  return scene;
}

NurbsSurface WithUnevenWeights(const NurbsSurface& surface) {
  Random random(7);
  std::vector<double> weights;
  for (std::size_t k = 0; k < surface.control_points().size(); ++k)
    weights.push_back(random.Uniform(0.8, 1.25));
  return NurbsSurface(surface.u(), surface.v(), surface.control_points(), std::move(weights));
}

template <int kOrder>
void EvaluateSurface(benchmark::State& state, const NurbsSurface& surface) {
  const SurfaceCells cells(surface);
  const Scene& scene = TheScene();
  std::size_t i = 0;
  for (auto _ : state) {
    const Eigen::Vector2d& uv = scene.feet[i];
    if constexpr (kOrder == 0) benchmark::DoNotOptimize(cells.Evaluate(uv[0], uv[1]));
    if constexpr (kOrder == 1) benchmark::DoNotOptimize(cells.Evaluate1(uv[0], uv[1]));
    if constexpr (kOrder == 2) benchmark::DoNotOptimize(cells.Evaluate2(uv[0], uv[1]));
    if (++i == scene.feet.size()) i = 0;
  }
}

// From the foot of a surface a little away, as in an iteration of the fit.
void FindFootFromNear(benchmark::State& state) {
  const Scene& scene = TheScene();
  std::vector<Eigen::Vector3d> moved = scene.surface.control_points();
  Random random(3);
  for (Eigen::Vector3d& point : moved)
    point += 0.05 * Eigen::Vector3d(random.Normal(), random.Normal(), random.Normal());
  const SurfaceCells cells(NurbsSurface(scene.surface.u(), scene.surface.v(), moved));
  FootPointOptions options;
  options.step_tolerance = 1e-6 * scene.surface.Size();
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        RefineFootPoint(cells, scene.points[i], scene.feet[i][0], scene.feet[i][1], options));
    if (++i == scene.points.size()) i = 0;
  }
}

void FindFootFromNowhere(benchmark::State& state, int seeds) {
  const Scene& scene = TheScene();
  const SurfaceCells cells(scene.surface);
  const FootPointSearch search(cells);
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(search.Find(scene.points[i], seeds));
    if (++i == scene.points.size()) i = 0;
  }
}

void AddToMoments(benchmark::State& state, int components) {
  CellMoments moments(3, 3, components, components);
  const double matrix[10] = {1, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9},
               vector[4] = {0.1, 0.2, 0.3, 0.4};
  double s = 0;
  for (auto _ : state) {
    moments.Add(s, 1 - s, matrix, vector);
    s = s < 0.9 ? s + 0.01 : 0;
  }
  benchmark::DoNotOptimize(moments);
}

// The cell's matrix from its moments: once a cell and iteration.
void MomentsToMatrix(benchmark::State& state, int components) {
  const SurfaceCells cells(TheScene().surface);
  CellMoments moments(3, 3, components, components);
  Eigen::MatrixXd h = Eigen::MatrixXd::Zero(16 * components, 16 * components);
  Eigen::VectorXd g = Eigen::VectorXd::Zero(16 * components);
  for (auto _ : state) {
    moments.AddTo(cells.u().coefficients(5), cells.v().coefficients(5), &h, &g);
    benchmark::DoNotOptimize(h.data());
  }
}

class MarkdownReporter : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context& /*context*/) override {
    std::printf("Bicubic 20 × 20 leaf surface, 40,000 points in random order, one thread.\n\n");
    std::printf("| kernel | ns a call |\n|---|---|\n");
    return true;
  }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs)
      std::printf("| %s | %.0f |\n", run.benchmark_name().c_str(), run.GetAdjustedCPUTime());
    std::fflush(stdout);
  }
};

void RegisterKernels() {
  const auto add = [](const char* name, auto kernel) { benchmark::RegisterBenchmark(name, kernel); };
  const NurbsSurface plain = TheScene().surface, rational = WithUnevenWeights(plain);
  add("surface point", [=](benchmark::State& s) { EvaluateSurface<0>(s, plain); });
  add("point and first derivatives", [=](benchmark::State& s) { EvaluateSurface<1>(s, plain); });
  add("point, first and second derivatives", [=](benchmark::State& s) { EvaluateSurface<2>(s, plain); });
  add("rational point and first derivatives", [=](benchmark::State& s) { EvaluateSurface<1>(s, rational); });
  add("rational, first and second derivatives",
      [=](benchmark::State& s) { EvaluateSurface<2>(s, rational); });
  add("foot point, warm", FindFootFromNear);
  add("foot point, cold, 1 seed", [](benchmark::State& s) { FindFootFromNowhere(s, 1); });
  add("foot point, cold, 3 seeds", [](benchmark::State& s) { FindFootFromNowhere(s, 3); });
  add("moments of a point, 3 components", [](benchmark::State& s) { AddToMoments(s, 3); });
  add("moments of a point, 4 components", [](benchmark::State& s) { AddToMoments(s, 4); });
  add("matrix of a cell, 3 components", [](benchmark::State& s) { MomentsToMatrix(s, 3); });
  add("matrix of a cell, 4 components", [](benchmark::State& s) { MomentsToMatrix(s, 4); });
}

}  // namespace
}  // namespace frond

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  frond::RegisterKernels();
  frond::MarkdownReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
}
