// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

namespace frond {

// Finite elements of one kind: triangles (dimension 2) or tetrahedra (3), of order 1 or 2. Nodes of an
// element in Gmsh's order: corners, then mid-edge nodes on 01 12 20, and of tetrahedra 03 23 13.
struct FeMesh {
  int dimension = 2;
  int order = 1;
  std::vector<Eigen::Vector3d> nodes;
  std::vector<std::size_t> elements;  // NodesPerElement() indices each

  std::size_t NodesPerElement() const;
  std::size_t NumElements() const { return elements.size() / NodesPerElement(); }
};

// The triangles or tetrahedra, whichever has the higher dimension, of a file in Gmsh's format 2.2, ASCII;
// `name` is how messages call it. Throws InputError where there are none, or of different orders.
FeMesh ParseMsh2(std::string_view text, const std::string& name);

// Area or volume, in the square or cube of the unit, of the curved elements: Gauss points that are exact for
// the volume. Elements inside out count negative.
double Measure(const FeMesh& mesh);

}  // namespace frond
