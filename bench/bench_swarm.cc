// SPDX-License-Identifier: BSD-3-Clause
// Evaluations a second of the leaf paper's F (90 test points, 5 × 5 weights) by our particle swarm and by
// pagmo's pso_gen, side by side on the same objective, box, swarm size and number of evaluations; and ours on
// 2 threads. Processor seconds for one thread, wall-clock seconds for the ratio of threads; the median of
// `rounds`.
//
//   bench_swarm [rounds = 9]
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

#include "problems/leaf/leaf_paper_fit.h"
#include "problems/leaf/synthetic_leaf_scan.h"
#include "solvers/solver.h"
#include "solvers/stopwatch.h"

namespace frond {
namespace {

constexpr int kSwarm = 40, kIterations = 200;

struct Contestant {
  const char* label;
  const char* solver;
  const char* size_option;
  int threads;
  std::vector<double> per_processor_second = {}, per_second = {};
};

double Middle(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

void RunOnce(const LeafWeightsFit& fit, std::uint64_t seed, Contestant* contestant) {
  const SolverType& type = FindSolverType(contestant->solver);
  Options options(type.options);
  options.Set(contestant->size_option, std::int64_t{kSwarm});
  const auto solver = type.create(options);
  const Stopwatch stopwatch;
  const std::clock_t clock = std::clock();
  const SolverReport report = solver->Solve(fit, {.max_evaluations = kSwarm * (kIterations + 1)},
                                            {.threads = contestant->threads, .seed = seed});
  const auto evaluations = static_cast<double>(report.evaluations);
  contestant->per_second.push_back(evaluations / stopwatch.Seconds());
  contestant->per_processor_second.push_back(evaluations * CLOCKS_PER_SEC /
                                             static_cast<double>(std::clock() - clock));
}

void Compare(const char* title, const LeafWeightsFit& fit, int rounds) {
  Contestant contestants[] = {{"pso", "pso", "swarm_size", 1},
                              {"pagmo.pso_gen", "pagmo.pso_gen", "population_size", 1},
                              {"pso, 2 threads", "pso", "swarm_size", 2}};
  for (int round = 0; round < rounds; ++round) {
    for (Contestant& contestant : contestants) RunOnce(fit, static_cast<std::uint64_t>(round), &contestant);
  }
  for (const Contestant& c : contestants) {
    std::vector<double> ratio;  // to ours on one thread, round by round
    for (int round = 0; round < rounds; ++round) {
      const auto r = static_cast<std::size_t>(round);
      ratio.push_back(c.threads > 1 ? c.per_second[r] / contestants[0].per_second[r]
                                    : c.per_processor_second[r] / contestants[0].per_processor_second[r]);
    }
    std::printf("| %s | %s | %.0f | %.0f | %.2f |\n", title, c.label, Middle(c.per_processor_second),
                Middle(c.per_second), Middle(ratio));
  }
}

}  // namespace
}  // namespace frond

int main(int argc, char** argv) {
  using namespace frond;
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 9;
  LeafScanOptions options;
  options.seed = 1;
  const LeafScan scan = ScanLeaf(RandomLeaf(1), options);
  const LeafPaperFit start = FitLeafAsInPaper(scan.points, {});
  std::printf(
      "| weights | solver | evaluations a processor second | a second | ratio to pso "
      "|\n|---|---|---|---|---|\n");
  // Bounds as near as the paper's short runs stay, a ratio of 3, and those of the fit, which the feet get
  // slow in.
  Compare("in [0.9, 1.1]",
          LeafWeightsFit(start.surface, start.test_points, {.objective = {}, .lower = 0.9, .upper = 1.1}),
          rounds);
  Compare("in [0.6, 1.7]",
          LeafWeightsFit(start.surface, start.test_points, {.objective = {}, .lower = 0.6, .upper = 1.7}),
          rounds);
  Compare("in [0.1, 10]", LeafWeightsFit(start.surface, start.test_points, {}), rounds);
}
