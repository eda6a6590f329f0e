// SPDX-License-Identifier: BSD-3-Clause
#include "io/fe_mesh.h"

#include <Eigen/Geometry>
#include <array>
#include <sstream>
#include <unordered_map>
#include <utility>

#include "base/errors.h"

namespace frond {
namespace {

constexpr std::array<std::pair<int, int>, 6> kEdges = {{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {2, 3}, {1, 3}}};

struct Kind {
  int type, dimension, order;
};
constexpr std::array<Kind, 4> kKinds = {{{2, 2, 1}, {9, 2, 2}, {4, 3, 1}, {11, 3, 2}}};  // Gmsh's numbers

// ∂N_n/∂L_k − ∂N_n/∂L_0 of node n, k = 1 … dimension, at barycentric coordinates L.
Eigen::Vector3d ShapeGradient(const FeMesh& mesh, std::size_t n, const Eigen::Vector4d& l) {
  const auto corners = static_cast<std::size_t>(mesh.dimension) + 1;
  Eigen::Vector4d by_l = Eigen::Vector4d::Zero();
  if (n < corners) {
    const auto k = static_cast<Eigen::Index>(n);
    by_l[k] = mesh.order == 1 ? 1 : 4 * l[k] - 1;
  } else {
    const auto [a, b] = kEdges[n - corners];
    by_l[a] = 4 * l[b];
    by_l[b] = 4 * l[a];
  }
  return by_l.tail<3>() - Eigen::Vector3d::Constant(by_l[0]);
}

struct GaussPoint {
  Eigen::Vector4d l;  // barycentric
  double weight;
};

// Gauss–Legendre with 4 points in each direction of a square or cube, collapsed to the simplex: exact to
// degree 5.
std::vector<GaussPoint> GaussPoints(int dimension) {
  const std::array<double, 4> x = {0.06943184420297371, 0.33000947820757187, 0.6699905217924281,
                                   0.9305681557970263};
  const std::array<double, 4> w = {0.17392742256872692, 0.32607257743127307, 0.32607257743127307,
                                   0.17392742256872692};
  std::vector<GaussPoint> points;
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = 0; b < 4; ++b) {
      const double l1 = x[a], rest = 1 - l1;
      if (dimension == 2) {
        const double l2 = rest * x[b];
        points.push_back({{1 - l1 - l2, l1, l2, 0}, w[a] * w[b] * rest});
        continue;
      }
      for (std::size_t c = 0; c < 4; ++c) {
        const double l2 = rest * x[b], l3 = (rest - l2) * x[c];
        points.push_back({{1 - l1 - l2 - l3, l1, l2, l3}, w[a] * w[b] * w[c] * rest * (rest - l2)});
      }
    }
  }
  return points;
}

[[noreturn]] void Fail(const std::string& name, const std::string& message) {
  throw InputError(name + ": " + message);
}

}  // namespace

std::size_t FeMesh::NodesPerElement() const {
  if (dimension == 2) return order == 1 ? 3 : 6;
  return order == 1 ? 4 : 10;
}

FeMesh ParseMsh2(std::string_view text, const std::string& name) {
  std::istringstream in{std::string(text)};
  std::string word;
  const auto seek = [&](const char* section) {
    while (in >> word) {
      if (word == section) return;
    }
    Fail(name, std::string("has no section ") + section);
  };
  FeMesh mesh;
  std::size_t count = 0, number = 0;
  seek("$Nodes");
  in >> count;
  std::unordered_map<std::size_t, std::size_t> index_of;
  for (std::size_t k = 0; k < count && in; ++k) {
    Eigen::Vector3d node;
    in >> number >> node[0] >> node[1] >> node[2];
    index_of[number] = k;
    mesh.nodes.push_back(node);
  }
  seek("$Elements");
  in >> count;
  mesh.dimension = 0;
  for (std::size_t k = 0; k < count && in; ++k) {
    int type = 0, tags = 0;
    in >> number >> type >> tags;
    for (int tag = 0; tag < tags; ++tag) in >> number;
    const Kind* kind = nullptr;
    for (const Kind& known : kKinds) {
      if (known.type == type) kind = &known;
    }
    if (kind == nullptr || kind->dimension < mesh.dimension) {
      std::getline(in, word);
      continue;
    }
    if (kind->dimension == mesh.dimension && kind->order != mesh.order) Fail(name, "mixes orders");
    if (kind->dimension > mesh.dimension) mesh.elements.clear();
    mesh.dimension = kind->dimension;
    mesh.order = kind->order;
    for (std::size_t n = 0; n < mesh.NodesPerElement(); ++n) {
      in >> number;
      const auto found = index_of.find(number);
      if (found == index_of.end()) Fail(name, "has an element with an unknown node");
      mesh.elements.push_back(found->second);
    }
  }
  if (!in) Fail(name, "is cut short");
  if (mesh.elements.empty()) Fail(name, "holds no triangles or tetrahedra");
  return mesh;
}

double Measure(const FeMesh& mesh) {
  const std::vector<GaussPoint> points = GaussPoints(mesh.dimension);
  const std::size_t per_element = mesh.NodesPerElement();
  std::vector<Eigen::Vector3d> gradients;  // of all nodes at all points: the same in every element
  for (const GaussPoint& point : points) {
    for (std::size_t n = 0; n < per_element; ++n) gradients.push_back(ShapeGradient(mesh, n, point.l));
  }
  double total = 0;
  for (std::size_t e = 0; e < mesh.elements.size(); e += per_element) {
    for (std::size_t g = 0; g < points.size(); ++g) {
      Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
      for (std::size_t n = 0; n < per_element; ++n) {
        jacobian += mesh.nodes[mesh.elements[e + n]] * gradients[g * per_element + n].transpose();
      }
      const Eigen::Vector3d normal = jacobian.col(0).cross(jacobian.col(1));
      total += points[g].weight * (mesh.dimension == 2 ? normal.norm() : normal.dot(jacobian.col(2)));
    }
  }
  return total;
}

}  // namespace frond
