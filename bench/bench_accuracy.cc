// SPDX-License-Identifier: BSD-3-Clause
// Accuracy of the sheet fit against clean truth on eight synthetic leaves, beside SciPy's LSQBivariateSpline
// with the same number of coefficients on the same points. A bicubic height field z = f(x, y) is a B-spline
// surface exactly (x and y of its control points are the Greville abscissae), so both are judged by the same
// orthogonal distances from the dense clean truth to the surface.
//
//   bench_accuracy [net = 20] [points = 40000] [threads = 1]
#include <unistd.h>

#include <Eigen/Core>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iostream>
#include <numeric>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "solvers/stopwatch.h"
#include "tests/problems/surface/leaf_case.h"

namespace frond {
namespace {

constexpr int kSeeds = 8;
constexpr int kDegree = 3;

std::vector<double> NumbersOfLine(std::istream& in) {
  std::string line;
  std::getline(in, line);
  std::istringstream stream(line);
  std::vector<double> numbers;
  for (double number = 0; stream >> number;) numbers.push_back(number);
  return numbers;
}

double Greville(const std::vector<double>& knots, int i) {
  return std::accumulate(knots.begin() + i + 1, knots.begin() + i + 1 + kDegree, 0.0) / kDegree;
}

struct PeerFit {
  NurbsSurface surface;
  double seconds;
};

// Nothing where /usr/bin/python3 has no scipy.
std::optional<PeerFit> FitWithSciPy(const std::vector<Eigen::Vector3d>& points, int net) {
  const std::string stem = "/tmp/frond_bench_accuracy." + std::to_string(getpid());
  const std::string cloud = stem + ".xyz", spline = stem + ".spline";
  std::ofstream(cloud, std::ios::binary)
      .write(reinterpret_cast<const char*>(points.data()), static_cast<std::streamsize>(points.size() * 24));
  const std::string command = "/usr/bin/python3 " FROND_SOURCE_DIR "/bench/peers/scipy_spline.py " + cloud +
                              " " + std::to_string(net) + " > " + spline + " 2> /dev/null";
  const int status = std::system(command.c_str());
  std::ifstream in(spline);
  std::vector<double> x = NumbersOfLine(in), y = NumbersOfLine(in), z = NumbersOfLine(in);
  const std::vector<double> seconds = NumbersOfLine(in);
  in.close();
  std::remove(cloud.c_str());
  std::remove(spline.c_str());
  const auto wanted = static_cast<std::size_t>(net * net);
  if (status != 0 || seconds.size() != 1 || z.size() != wanted) return std::nullopt;
  std::vector<Eigen::Vector3d> control_points;
  for (int i = 0; i < net; ++i) {
    for (int j = 0; j < net; ++j) {
      control_points.emplace_back(Greville(x, i), Greville(y, j), z[static_cast<std::size_t>(i * net + j)]);
    }
  }
  return PeerFit{{BSplineBasis(kDegree, x), BSplineBasis(kDegree, y), std::move(control_points)}, seconds[0]};
}

void RunSeed(std::uint64_t seed, int net, int points, int threads) {
  LeafScanOptions scan_options;
  scan_options.points = points;
  const LeafCase leaf = MakeLeafCase(seed, scan_options);
  SurfaceFitOptions options;
  options.control_points = {net, net};
  const Stopwatch stopwatch;
  const std::clock_t clock = std::clock();
  const SurfaceFit fit = FitLeaf(leaf.points, options, threads);
  const double seconds = stopwatch.Seconds();
  const double processor_seconds = static_cast<double>(std::clock() - clock) / CLOCKS_PER_SEC;
  const TruthErrors ours = ErrorsAgainst(leaf.dense_clean, fit.surface.surface);
  const SurfaceQuality& quality = fit.quality;
  std::printf("| %d %s | %.4f | %.3f | %.3f | %+.2f | %d | %.4f | %.2f | %.2f |", static_cast<int>(seed),
              LeafCharacterName(leaf.character), ours.rmse, ours.max, quality.max,
              100 * (quality.area / leaf.scan.measures.area - 1), quality.flipped_normals,
              quality.data_coverage, seconds, processor_seconds);
  if (const auto peer = FitWithSciPy(leaf.points, net)) {
    const TruthErrors theirs = ErrorsAgainst(leaf.dense_clean, peer->surface);
    std::printf(" %.4f | %.3f | %.2f | %.2f |\n", theirs.rmse, theirs.max, peer->seconds,
                ours.rmse / theirs.rmse);
  } else {
    std::printf(" – | – | – | – |\n");
  }
  std::fflush(stdout);
}

}  // namespace
}  // namespace frond

int main(int argc, char** argv) {
  const int net = argc > 1 ? std::atoi(argv[1]) : 20, points = argc > 2 ? std::atoi(argv[2]) : 40000;
  const int threads = argc > 3 ? std::atoi(argv[3]) : 1;
  std::printf("%d points, noise 0.05 mm, bicubic %d × %d, threads: %d. Lengths in mm.\n\n", points, net, net,
              threads);
  std::printf(
      "| leaf | RMSE | max | max over noisy | area %% | flipped | coverage | s | processor s | SciPy RMSE | "
      "max | s | RMSE "
      "ratio "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (int seed = 1; seed <= frond::kSeeds; ++seed) {
    frond::RunSeed(static_cast<std::uint64_t>(seed), net, points, threads);
  }
}
