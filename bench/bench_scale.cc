// SPDX-License-Identifier: BSD-3-Clause
// Time and memory of the sheet fit from 10⁴ to 10⁶ points, 20 × 20 bicubic, 1 and 2 threads. Each run is a
// child process of its own, whose peak memory is counted from the moment the input stands in memory.
//
//   bench_scale [largest = 1000000]
#include <malloc.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "solvers/stopwatch.h"
#include "tests/problems/surface/leaf_case.h"

namespace frond {
namespace {

struct Result {
  double seconds = 0, processor_seconds = 0, bytes = 0, rmse = 0;
};

// A line of /proc/self/status such as VmRSS, in bytes.
double StatusBytes(const std::string& name) {
  std::ifstream status("/proc/self/status");
  std::string word;
  while (status >> word) {
    double kilobytes = 0;
    if (word == name + ":" && status >> kilobytes) return 1024 * kilobytes;
  }
  return 0;
}

Result FitOnce(int points, int threads) {
  std::vector<Eigen::Vector3d> cloud;
  {
    LeafScanOptions options;
    options.points = points;
    options.dense_points = 1000;
    cloud = std::move(MakeLeafCase(1, options).points);
    cloud.shrink_to_fit();
  }
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << 5;  // the peak begins anew at the present size
  const double before = StatusBytes("VmRSS");
  const Stopwatch stopwatch;
  const std::clock_t clock = std::clock();
  const SurfaceFit fit = FitLeaf(cloud, {}, threads);
  return {stopwatch.Seconds(), static_cast<double>(std::clock() - clock) / CLOCKS_PER_SEC,
          StatusBytes("VmHWM") - before, fit.quality.rmse};
}

Result FitInChild(int points, int threads) {
  int ends[2];
  if (pipe(ends) != 0) std::exit(1);
  Result result;
  const pid_t child = fork();
  if (child == 0) {
    result = FitOnce(points, threads);
    const bool written = write(ends[1], &result, sizeof result) == static_cast<ssize_t>(sizeof result);
    _exit(written ? 0 : 1);
  }
  close(ends[1]);
  const bool received = read(ends[0], &result, sizeof result) == static_cast<ssize_t>(sizeof result);
  close(ends[0]);
  waitpid(child, nullptr, 0);
  if (!received) {
    std::fprintf(stderr, "the fit of %d points failed\n", points);
    std::exit(1);
  }
  return result;
}

}  // namespace
}  // namespace frond

int main(int argc, char** argv) {
  const int largest = argc > 1 ? std::atoi(argv[1]) : 1000000;
  std::printf(
      "| points | s, 1 thread | s, 2 threads | faster | processor s, 1 thread | µs a point | MB above the "
      "input "
      "| bytes a point | bytes a further point | RMSE over noisy "
      "|\n|---|---|---|---|---|---|---|---|---|---|\n");
  double last_bytes = 0;
  for (int points = 10000; points <= largest; points *= 10) {
    const frond::Result one = frond::FitInChild(points, 1), two = frond::FitInChild(points, 2);
    std::printf("| %d | %.2f | %.2f | %.2f | %.2f | %.2f | %.0f | %.0f | %.0f | %.4f |\n", points,
                one.seconds, two.seconds, one.seconds / two.seconds, one.processor_seconds,
                1e6 * one.processor_seconds / points, 1e-6 * one.bytes, one.bytes / points,
                (one.bytes - last_bytes) / (0.9 * points), one.rmse);
    last_bytes = one.bytes;
    std::fflush(stdout);
  }
}
