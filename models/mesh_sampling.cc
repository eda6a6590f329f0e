// SPDX-License-Identifier: BSD-3-Clause
#include "models/mesh_sampling.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace frond {

std::vector<Eigen::Vector3d> SampleMesh(const SurfaceMesh& mesh, std::size_t count, Random* random) {
  const auto corner = [&](std::size_t face, std::size_t k) -> const Eigen::Vector3d& {
    return mesh.vertices[static_cast<std::size_t>(mesh.triangles[face][k])];
  };
  std::vector<double> area_up_to;
  area_up_to.reserve(mesh.triangles.size());
  double area = 0;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    area += 0.5 * (corner(f, 1) - corner(f, 0)).cross(corner(f, 2) - corner(f, 0)).norm();
    area_up_to.push_back(area);
  }
  if (!(area > 0)) throw std::invalid_argument("a mesh without area is sampled");
  std::vector<Eigen::Vector3d> points;
  points.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double place = random->Uniform() * area;  // below area: some face ends above it
    const auto found = std::upper_bound(area_up_to.begin(), area_up_to.end(), place);
    const auto face = static_cast<std::size_t>(std::min(found, area_up_to.end() - 1) - area_up_to.begin());
    const double root = std::sqrt(random->Uniform()), along = random->Uniform();
    points.push_back((1 - root) * corner(face, 0) + root * (1 - along) * corner(face, 1) +
                     root * along * corner(face, 2));
  }
  return points;
}

}  // namespace frond
