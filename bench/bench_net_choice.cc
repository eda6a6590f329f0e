// SPDX-License-Identifier: BSD-3-Clause
// `control_points: auto` against a full grid of nets, on the same held-out points.
//   bench_net_choice sheet|cup|sphere [MESH]   (without a mesh: synthetic leaf 1)
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "io/mesh_file.h"
#include "models/mesh_repair.h"
#include "models/mesh_topology.h"
#include "problems/leaf/synthetic_leaf_scan.h"
#include "problems/surface/net_choice.h"
#include "problems/surface/principal_axes.h"
#include "problems/surface/scan_cloud.h"

namespace frond {
namespace {

int Main(int argc, char** argv) {
  const std::string topology = argc > 1 ? argv[1] : "sheet";
  SurfaceFitOptions options;
  options.control_points = {0, 0};
  std::vector<Eigen::Vector3d> points;
  std::vector<int> rim;
  if (argc > 2) {
    const SurfaceMesh mesh = RepairMesh(ReadMesh(argv[2]));
    points = mesh.vertices;
    if (topology == "cup") rim = FindMeshTopology(mesh).boundary_loops.at(0);
  } else {
    LeafScanOptions scan;
    scan.seed = 1;
    points = ScanLeaf(RandomLeaf(1), scan).points;
  }
  if (topology == "cup") options.topology = SurfaceTopology::kCup;
  if (topology == "sphere") options.topology = SurfaceTopology::kSphere;
  const PrincipalAxes axes = FindPrincipalAxes(points, std::vector<std::uint8_t>(points.size(), 0));
  for (auto& point : points) point = axes.axes.transpose() * (point - axes.origin);
  if (!rim.empty()) options.rims.emplace_back();
  for (const int k : rim) options.rims[0].push_back(points[static_cast<std::size_t>(k)]);
  const ScanCloud cloud(points, {});
  Options solver_options(FindSolverType("lm").options);
  for (auto& [name, value] : SurfaceFitSolverDefaults("lm", options)) solver_options.Set(name, value);
  const auto solver = FindSolverType("lm").create(solver_options);
  const SolveContext context{.threads = 1, .seed = 1};

  const NetChoice choice =
      ChooseNet(cloud.inliers(), std::nullopt, options, cloud.resolution(), *solver, Budget{}, context);
  double least = std::numeric_limits<double>::infinity(), chosen = 0;
  std::array<int, 2> best{};
  for (const int nu : {5, 7, 10, 14, 20, 28}) {
    for (const int nv : {5, 7, 10, 14, 20, 28}) {
      if (static_cast<std::size_t>(3 * nu * nv) > cloud.inliers().size() * 4 / 5) {
        std::printf("%12s", "-");
        continue;
      }
      const double error = TryNet(cloud.inliers(), std::nullopt, options, {nu, nv}, cloud.resolution(),
                                  *solver, Budget{}, context)
                               .held_out_rmse;
      std::printf("%12.4g", error);
      if (choice.net == std::array<int, 2>{nu, nv}) chosen = error;
      if (error < least) {
        least = error;
        best = {nu, nv};
      }
    }
    std::printf("\n");
  }
  std::printf(
      "best of the grid %d x %d: %.4g; chosen %d x %d: %.4g, %.2f times the error, %.2f of the points\n",
      best[0], best[1], least, choice.net[0], choice.net[1], chosen, chosen / least,
      static_cast<double>(choice.net[0] * choice.net[1]) / (best[0] * best[1]));
  return 0;
}

}  // namespace
}  // namespace frond

int main(int argc, char** argv) { return frond::Main(argc, argv); }
