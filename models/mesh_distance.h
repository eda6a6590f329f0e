// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "models/tessellation.h"

namespace frond {

// Exact distances to a triangle mesh, by a tree of bounding boxes; views the mesh. Queries are re-entrant.
class MeshDistance {
 public:
  explicit MeshDistance(const SurfaceMesh& mesh);  // at least one triangle

  double operator()(const Eigen::Vector3d& point) const;  // to the nearest point of any triangle

 private:
  struct Node {
    Eigen::AlignedBox3d box;
    int begin = 0, end = 0;  // of order_; a leaf where there are no children
    int left = -1, right = -1;
  };

  int Build(int begin, int end, const std::vector<Eigen::Vector3d>& centroids);
  void Search(int node, const Eigen::Vector3d& point, double* squared) const;

  const SurfaceMesh* mesh_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

// The nearest point of a triangle to p.
Eigen::Vector3d NearestOnTriangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                                  const Eigen::Vector3d& b, const Eigen::Vector3d& c);

}  // namespace frond
