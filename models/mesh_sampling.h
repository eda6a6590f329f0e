// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "base/random.h"
#include "models/tessellation.h"

namespace frond {

// `count` independent points, uniform by area over the faces (Osada et al. 2002, eq. 1). Throws
// std::invalid_argument where the mesh has no area.
std::vector<Eigen::Vector3d> SampleMesh(const SurfaceMesh& mesh, std::size_t count, Random* random);

}  // namespace frond
