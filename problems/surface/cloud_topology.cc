// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/cloud_topology.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "base/errors.h"
#include "base/random.h"
#include "models/mesh_sampling.h"
#include "problems/surface/outliers.h"
#include "problems/surface/principal_axes.h"
#include "problems/surface/voxel_topology.h"
#include "problems/surface/wrapping.h"

namespace frond {
namespace {

constexpr double kStep = 1.2;           // of the radius
constexpr int kSteadySteps = 3;         // 1.2³ = 1.7
constexpr double kFirstSpacings = 1.3;  // radius of the first balls
constexpr double kMostCubes = 2e6;
constexpr double kFilledShare = 0.05;  // of cubes deeper than balls about a surface make them
constexpr double kStrayShare = 0.03, kKeptShare = 0.97;
constexpr std::size_t kLeastCavity = 27;  // cubes

constexpr std::size_t kMeshSamples = 8000;
constexpr double kHoleShare = 0.1;  // of the longest rim

constexpr char kWayOut[] =
    ": frond fits sheets, tubes, cups and spheres; cut a part out with input.region, for example "
    "[[0, 0, 0, 0, 0, 1]] to keep z >= 0";

std::string Counted(int count, const char* one, const char* many) {
  const char* const words[] = {"no", "one", "two", "three", "four", "five", "six"};
  const std::string number = count <= 6 ? words[count] : std::to_string(count);
  return number + " " + (count == 1 ? one : many);
}

std::string ClosedWithGenus(const std::string& what, int genus) {
  return what + " is closed with genus " + std::to_string(genus) + " (" +
         Counted(genus, "handle", "handles") + ")" + kWayOut;
}

// The points but strays, in their principal axes, which makes the box of voxels small.
std::vector<Eigen::Vector3d> InAxes(std::span<const Eigen::Vector3d> points) {
  const PrincipalAxes axes = FindPrincipalAxes(points, std::vector<std::uint8_t>(points.size(), 0));
  std::vector<Eigen::Vector3d> local;
  local.reserve(points.size());
  for (const auto& point : points) local.push_back(axes.axes.transpose() * (point - axes.origin));
  const std::vector<std::uint8_t> stray = StrayPoints(local);
  const auto strays = static_cast<double>(std::count(stray.begin(), stray.end(), 1));
  if (strays > 0.1 * static_cast<double>(points.size())) return local;  // not strays but parts
  std::size_t kept = 0;
  for (std::size_t i = 0; i < local.size(); ++i) {
    if (!stray[i]) local[kept++] = Eigen::Vector3d(local[i]);
  }
  local.resize(kept);
  return local;
}

struct Scale {
  double radius = 0;
  BettiNumbers numbers;
};

// The first answer that stays for kSteadySteps steps, else that which stays longest, where it begins. Ends
// where the balls fill what the surface wraps round.
Scale SteadyScale(const std::vector<Eigen::Vector3d>& points, double first) {
  Scale start, longest;
  int steps = 0, most = -1;
  double deep_before = 1;
  for (double radius = first; most < kSteadySteps; radius *= kStep) {
    VoxelSet voxels = UnionOfBalls(points, radius);
    // Noise wider than the balls is deep too, but less so the wider they are.
    const double deep = DeepShare(voxels, 3);
    if (deep > kFilledShare && deep > deep_before) break;
    deep_before = deep;
    const std::size_t kept = DropSmallComponents(points, kStrayShare, &voxels);
    if (static_cast<double>(kept) < kKeptShare * static_cast<double>(points.size())) {
      steps = 0;  // sparse parts are still dust at this radius
      start.numbers.components = 0;
      continue;
    }
    const BettiNumbers numbers = FindBettiNumbers(&voxels, kLeastCavity);
    steps = most >= 0 && numbers == start.numbers ? steps + 1 : 0;
    if (steps == 0) start = {radius, numbers};
    if (steps > most) {
      most = steps;
      longest = start;
    }
  }
  return longest;
}

// For a cloud and a mesh alike, by what it is called.
void DecideOpen(const std::string& what, int holes, int rims, bool round, TopologyFinding* finding) {
  if (!round) {
    finding->topology = SurfaceTopology::kSheet;
    finding->message =
        what + " is an open sheet" + (holes > 0 ? " with " + Counted(holes, "hole", "holes") : std::string());
  } else if (rims == 1) {
    finding->topology = SurfaceTopology::kCup;
    finding->message = what + " is a cup: open at one rim";
  } else if (rims == 2) {
    finding->topology = SurfaceTopology::kTube;
    finding->message = what + " is a tube: open at two rims";
  } else {
    finding->message = what + " wraps round with " + Counted(rims, "rim or hole", "rims or holes") + kWayOut;
  }
}

void DecideClosed(const BettiNumbers& numbers, TopologyFinding* finding) {
  if (numbers.cavities > 1) {
    finding->message = "the cloud encloses " + Counted(numbers.cavities, "cavity", "cavities") + kWayOut;
  } else if (numbers.loops == 0) {
    finding->topology = SurfaceTopology::kSphere;
    finding->genus = 0;
    finding->message = "the cloud is closed, without handles";
  } else if (numbers.loops % 2 == 0) {
    finding->genus = numbers.loops / 2;
    finding->message = ClosedWithGenus("the cloud", *finding->genus);
  } else {
    finding->message = "the cloud encloses a cavity, with " +
                       Counted(numbers.loops, "further loop", "further loops") + kWayOut;
  }
}

int RimsOf(const SurfaceMesh& mesh, const MeshTopology& topology) {
  const auto length = [&](const std::vector<int>& loop) {
    double sum = 0;
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const int from = loop[k], to = loop[(k + 1) % loop.size()];
      sum += (mesh.vertices[static_cast<std::size_t>(to)] - mesh.vertices[static_cast<std::size_t>(from)])
                 .norm();
    }
    return sum;
  };
  const double longest = length(topology.boundary_loops.front());
  return static_cast<int>(
      std::count_if(topology.boundary_loops.begin(), topology.boundary_loops.end(),
                    [&](const auto& loop) { return length(loop) >= kHoleShare * longest; }));
}

bool MeshWrapsRound(const SurfaceMesh& mesh) {
  Random random(0);
  const double spacing = std::sqrt(MeshArea(mesh) / static_cast<double>(kMeshSamples));
  return FindWrapping(SampleMesh(mesh, kMeshSamples, &random), 2.5 * spacing).round();
}

// Why the mesh is no surface to fit, or "".
std::string MeshObstacle(const MeshTopology& topology) {
  if (!topology.manifold) {
    return "the mesh is not a manifold (edges with more than two faces: " +
           std::to_string(topology.non_manifold_edges) +
           ", vertices where faces only touch: " + std::to_string(topology.non_manifold_vertices) +
           "): set input.repair to true";
  }
  if (topology.components.size() != 1)
    return "the mesh falls into " + std::to_string(topology.components.size()) + " parts" + kWayOut;
  if (!topology.orientable) return std::string("the mesh is one-sided, as a Moebius strip is") + kWayOut;
  if (*topology.genus == 0) return "";
  if (topology.closed) return ClosedWithGenus("the mesh", *topology.genus);
  return "the mesh is open with genus " + std::to_string(*topology.genus) + " (" +
         Counted(*topology.genus, "handle", "handles") + ")" + kWayOut;
}

}  // namespace

const char* SurfaceTopologyName(SurfaceTopology topology) {
  switch (topology) {
    case SurfaceTopology::kSheet:
      return "sheet";
    case SurfaceTopology::kTube:
      return "tube";
    case SurfaceTopology::kCup:
      return "cup";
    case SurfaceTopology::kSphere:
      return "sphere";
  }
  return "";
}

TopologyFinding FindSurfaceTopology(std::span<const Eigen::Vector3d> points) {
  if (points.size() < 10) {
    throw InputError(std::to_string(points.size()) +
                     " points are too few to tell what they lie on: set "
                     "problem.topology");
  }
  const std::vector<Eigen::Vector3d> local = InAxes(points);
  Eigen::AlignedBox3d box;
  for (const auto& point : local) box.extend(point);
  const double extent = box.sizes().maxCoeff();
  if (!(extent > 0)) throw InputError("the points have no extent");
  const double spacing = PointSpacing(local, KdTree(local));
  const double volume = box.sizes().cwiseMax(extent / 50).prod();
  const Scale scale =
      SteadyScale(local, std::max(kFirstSpacings * spacing, 2 * std::cbrt(volume / kMostCubes)));
  TopologyFinding finding;
  finding.components = scale.numbers.components;
  finding.loops = scale.numbers.loops;
  finding.cavities = scale.numbers.cavities;
  finding.resolution = scale.radius;
  if (finding.components != 1) {
    finding.message = "the cloud falls into " + std::to_string(finding.components) + " parts" + kWayOut;
  } else if (finding.cavities > 0) {
    DecideClosed(scale.numbers, &finding);
  } else {
    const bool round = FindWrapping(local, scale.radius).round();
    DecideOpen("the cloud", finding.loops, finding.loops + 1, round, &finding);
  }
  return finding;
}

TopologyFinding FindSurfaceTopology(const SurfaceMesh& mesh, const MeshTopology& topology) {
  TopologyFinding finding;
  finding.exact = true;
  finding.components = static_cast<int>(topology.components.size());
  finding.genus = topology.genus;
  finding.cavities = 0;
  for (const MeshComponent& part : topology.components) finding.cavities += part.rims == 0;
  finding.loops = finding.components + finding.cavities - topology.euler_characteristic;
  finding.message = MeshObstacle(topology);
  if (!finding.message.empty()) return finding;
  if (topology.closed) {
    finding.topology = SurfaceTopology::kSphere;
    finding.message = "the mesh is closed, without handles";
  } else {
    DecideOpen("the mesh", static_cast<int>(topology.boundary_loops.size()) - 1, RimsOf(mesh, topology),
               MeshWrapsRound(mesh), &finding);
  }
  return finding;
}

SurfaceTopology ChooseTopology(const TopologyFinding& found, std::optional<SurfaceTopology> asked) {
  if (!asked) {
    if (!found.topology) throw FitError(found.message);
    return *found.topology;
  }
  if (!found.exact) return *asked;
  if (!found.topology) throw FitError(found.message);
  // How far a surface wraps round is a judgement, which the user may see otherwise; the rims are a fact.
  const auto is = [&](SurfaceTopology from, SurfaceTopology to) {
    return found.topology == from && *asked == to;
  };
  const bool one_rim = found.loops == 0 && (is(SurfaceTopology::kSheet, SurfaceTopology::kCup) ||
                                            is(SurfaceTopology::kCup, SurfaceTopology::kSheet));
  const bool two_rims = found.loops == 1 && is(SurfaceTopology::kSheet, SurfaceTopology::kTube);
  if (*asked != *found.topology && !one_rim && !two_rims) {
    throw FitError(std::string("problem.topology is '") + SurfaceTopologyName(*asked) + "', but " +
                   found.message + ": set it to 'auto', or cut a part out with input.region");
  }
  return *asked;
}

}  // namespace frond
