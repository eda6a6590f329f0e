// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "models/tessellation.h"

namespace frond {

// The bytes of a binary glTF 2.0 file: one double-sided node, positions in metres (glTF's unit) as float32
// around the mesh's centre, which is the node's translation. Built with nlohmann-json; tests read it back
// with tinygltf.
std::string FormatGlb(const SurfaceMesh& mesh, double metres_per_unit);

}  // namespace frond
