// SPDX-License-Identifier: BSD-3-Clause
#include "models/tessellation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <string>
#include <unordered_map>

#include "base/errors.h"
#include "models/nurbs_operations.h"
#include "models/trim_grid.h"

namespace frond {
namespace {

std::size_t At(int i) { return static_cast<std::size_t>(i); }

// A closed direction needs three cells to be a manifold.
int SegmentsFor(const BSplineBasis& basis, int segments_per_span) {
  const int spans = static_cast<int>(basis.spans().size());
  return basis.periodic() ? std::max(segments_per_span, (3 + spans - 1) / spans) : segments_per_span;
}

// The domain's edge where `fixed` = t is one point in space (to 1e-9 of the surface's size).
bool IsCollapsed(const NurbsSurface& surface, Direction fixed, double t) {
  const BSplineBasis& basis = fixed == Direction::kU ? surface.u() : surface.v();
  if (basis.periodic()) return false;
  return BoundingBox(IsoCurve(surface, fixed, t)).diagonal().norm() <= 1e-9 * surface.Size();
}

// Which vertices are one: those across a seam, and those on a collapsed edge.
class Welding {
 public:
  Welding(const NurbsSurface& surface, const TrimGrid& grid)
      : grid_(&grid),
        end_u_(grid.u().lattice_lines.back()),
        end_v_(grid.v().lattice_lines.back()),
        collapsed_{IsCollapsed(surface, Direction::kU, surface.u().begin()),
                   IsCollapsed(surface, Direction::kU, surface.u().end()),
                   IsCollapsed(surface, Direction::kV, surface.v().begin()),
                   IsCollapsed(surface, Direction::kV, surface.v().end())} {}

  // Equal for vertices that are one.
  LatticePoint KeyOf(int vertex) const {
    LatticePoint at = grid_->lattice_point(vertex);
    if (grid_->u().periodic && at.u == end_u_) at.u = 0;
    if (grid_->v().periodic && at.v == end_v_) at.v = 0;
    if (collapsed_[0] && at.u == 0) return {0, -1};
    if (collapsed_[1] && at.u == end_u_) return {end_u_, -1};
    if (collapsed_[2] && at.v == 0) return {-1, 0};
    if (collapsed_[3] && at.v == end_v_) return {-1, end_v_};
    return at;
  }

  static bool IsTip(const LatticePoint& key) { return key.u < 0 || key.v < 0; }

 private:
  const TrimGrid* grid_;
  std::int64_t end_u_, end_v_;
  std::array<bool, 4> collapsed_;
};

class MeshBuilder {
 public:
  MeshBuilder(const NurbsSurface& surface, const TrimGrid& grid)
      : surface_(surface), grid_(grid), welding_(surface, grid) {}

  // The mesh's vertex for one of the grid's.
  int VertexOf(int grid_vertex) {
    if (At(grid_vertex) >= of_grid_.size())
      of_grid_.resize(std::max(At(grid_vertex) + 1, 2 * of_grid_.size()), -1);
    int& known = of_grid_[At(grid_vertex)];
    if (known >= 0) return known;
    const LatticePoint key = welding_.KeyOf(grid_vertex);
    const auto [it, is_new] = of_key_.try_emplace(key, static_cast<int>(mesh_.vertices.size()));
    known = it->second;
    if (!is_new) return known;
    const Eigen::Vector2d uv = grid_.vertices()[At(grid_vertex)];
    const SurfacePoint point = surface_.EvaluateWithDerivatives(uv.x(), uv.y());
    mesh_.vertices.push_back(point.position);
    mesh_.normals.push_back(Welding::IsTip(key) ? Eigen::Vector3d::Zero() : point.Normal());
    mesh_.parameters.push_back(uv);
    return known;
  }

  void AddTriangle(int a, int b, int c) {  // the mesh's vertices
    if (a != b && b != c && c != a) mesh_.triangles.push_back({a, b, c});
  }

  // Two triangles over the shorter diagonal.
  void AddQuad(const std::array<int, 4>& corners) {
    const int a = VertexOf(corners[0]), b = VertexOf(corners[1]), c = VertexOf(corners[2]),
              d = VertexOf(corners[3]);
    const auto& points = mesh_.vertices;
    if ((points[At(a)] - points[At(c)]).squaredNorm() <= (points[At(b)] - points[At(d)]).squaredNorm()) {
      AddTriangle(a, b, c);
      AddTriangle(a, c, d);
    } else {
      AddTriangle(a, b, d);
      AddTriangle(b, c, d);
    }
  }

  SurfaceMesh Take() {
    SplitPinchedVertices();
    FillNormals();
    return std::move(mesh_);
  }

 private:
  struct KeyHash {
    std::size_t operator()(const LatticePoint& p) const {
      return std::hash<std::int64_t>()(p.u) * 0x9E3779B97F4A7C15u ^ std::hash<std::int64_t>()(p.v);
    }
  };

  // A vertex where several fans of triangles touch, without a common edge, becomes one vertex for each fan.
  void SplitPinchedVertices() {
    std::vector<std::vector<int>> around(mesh_.vertices.size());
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      for (const int vertex : mesh_.triangles[t]) around[At(vertex)].push_back(static_cast<int>(t));
    }
    for (std::size_t vertex = 0; vertex < around.size(); ++vertex) {
      std::vector<int> left = around[vertex];
      for (bool first = true; !left.empty(); first = false) {
        const std::vector<int> fan = TakeFan(static_cast<int>(vertex), left);
        if (!first) GiveOwnVertex(static_cast<int>(vertex), fan);
      }
    }
  }

  // Moves the triangles joined to left.back() by edges at `vertex` from `left` to the result.
  std::vector<int> TakeFan(int vertex, std::vector<int>& left) const {
    std::vector<int> fan{left.back()};
    left.pop_back();
    for (std::size_t k = 0; k < fan.size() && !left.empty(); ++k) {
      const auto& inside = mesh_.triangles[At(fan[k])];
      const auto joined = std::partition(left.begin(), left.end(), [&](int t) {
        return std::none_of(inside.begin(), inside.end(), [&](int other) {
          const auto& triangle = mesh_.triangles[At(t)];
          return other != vertex && std::find(triangle.begin(), triangle.end(), other) != triangle.end();
        });
      });
      fan.insert(fan.end(), joined, left.end());
      left.erase(joined, left.end());
    }
    return fan;
  }

  void GiveOwnVertex(int vertex, const std::vector<int>& fan) {
    const int copy = static_cast<int>(mesh_.vertices.size());
    const Eigen::Vector3d position = mesh_.vertices[At(vertex)], normal = mesh_.normals[At(vertex)];
    const Eigen::Vector2d parameters = mesh_.parameters[At(vertex)];
    mesh_.vertices.push_back(position);
    mesh_.normals.push_back(normal);
    mesh_.parameters.push_back(parameters);
    for (const int t : fan)
      std::replace(mesh_.triangles[At(t)].begin(), mesh_.triangles[At(t)].end(), vertex, copy);
  }

  // Where the surface has no normal: the mean of the incident triangles', by area.
  void FillNormals() {
    std::map<int, Eigen::Vector3d> sums;
    for (const auto& triangle : mesh_.triangles) {
      for (const int vertex : triangle) {
        if (!mesh_.normals[At(vertex)].isZero(0)) continue;
        const auto& p = mesh_.vertices;
        const Eigen::Vector3d edge1 = p[At(triangle[1])] - p[At(triangle[0])];
        const Eigen::Vector3d edge2 = p[At(triangle[2])] - p[At(triangle[0])];
        sums.try_emplace(vertex, Eigen::Vector3d::Zero()).first->second += edge1.cross(edge2);
      }
    }
    for (const auto& [vertex, sum] : sums) mesh_.normals[At(vertex)] = sum.normalized();
  }

  const NurbsSurface& surface_;
  const TrimGrid& grid_;
  Welding welding_;
  SurfaceMesh mesh_;
  std::vector<int> of_grid_;
  std::unordered_map<LatticePoint, int, KeyHash> of_key_;
};

}  // namespace

SurfaceMesh Tessellate(const TrimmedSurface& surface, int segments_per_span) {
  if (segments_per_span < 1) {
    throw InputError("segments per span must be at least 1, not " + std::to_string(segments_per_span));
  }
  const NurbsSurface& s = surface.surface;
  TrimGrid grid(GridAxis(s.u(), SegmentsFor(s.u(), segments_per_span)),
                GridAxis(s.v(), SegmentsFor(s.v(), segments_per_span)), surface.trim);
  MeshBuilder mesh(s, grid);
  for (int i = 0; i < grid.u().cells(); ++i) {
    for (int j = 0; j < grid.v().cells(); ++j) {
      const TrimGrid::Inside state = grid.StateOf(i, j);
      if (state == TrimGrid::Inside::kWhole) mesh.AddQuad(grid.CornersOf(i, j));
      if (state != TrimGrid::Inside::kCut) continue;
      for (const auto& [a, b, c] : grid.TrianglesOf(i, j)) {
        mesh.AddTriangle(mesh.VertexOf(a), mesh.VertexOf(b), mesh.VertexOf(c));
      }
    }
  }
  return mesh.Take();
}

}  // namespace frond
