// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "models/mesh_topology.h"
#include "problems/surface/surface_topology.h"

namespace frond {

// What a surface is. `topology` is none where it is nothing that frond fits a NURBS surface to; `message`
// then says why and what to do, else what was found.
struct TopologyFinding {
  std::optional<SurfaceTopology> topology;
  int components = 1;        // b₀
  int loops = 0;             // b₁: independent loops that no part of the surface fills
  int cavities = 0;          // b₂: closed shells
  std::optional<int> genus;  // handles; none where it is not known
  bool exact = false;        // of a mesh, not of a cloud
  double resolution = 0;     // of a cloud: the distance within which points were taken to be connected
  std::string message;
};

// Of a mesh, exactly, but for one judgement: an open mesh without handles is a cup (one rim) or a tube (two)
// where it wraps round (Wrapping::round), else a sheet, with holes where there are more rims. Rims shorter
// than a tenth of the longest are holes and do not count.
TopologyFinding FindSurfaceTopology(const SurfaceMesh& mesh, const MeshTopology& topology);

// Of a cloud without faces: the Betti numbers of the union of balls of growing radius about the points, as a
// cubical complex; taken is the first answer that holds while the radius grows by 1.7 (persistence:
// Edelsbrunner, Letscher and Zomorodian 2002), or, where none does before the balls fill what the surface
// wraps round, the one that holds longest. StrayPoints are left out where they are less than a tenth, and
// parts with less than 3 % of the points. What is narrower than about three spacings of the points is not
// seen, nor what is small against the whole (about 1/60): handles of a bone ask for a mesh. Depends on the
// points alone. Throws InputError where there are fewer than 10 points or they have no extent.
TopologyFinding FindSurfaceTopology(std::span<const Eigen::Vector3d> points);

// The topology to fit: `asked` or, where none is, what was found. Throws FitError where none was found, and
// where a mesh is not what is asked for: closed against open, handles, too few rims for a tube. A cloud is
// taken to be what the user says.
SurfaceTopology ChooseTopology(const TopologyFinding& found, std::optional<SurfaceTopology> asked);

}  // namespace frond
