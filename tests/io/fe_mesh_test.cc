// SPDX-License-Identifier: BSD-3-Clause
#include "io/fe_mesh.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/errors.h"
#include "io/shell_section.h"
#include "tests/io/temp_folder.h"

namespace frond {
namespace {

FeMesh QuadraticTetrahedron() {
  FeMesh mesh{.dimension = 3, .order = 2, .nodes = {}, .elements = {}};
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const auto& [a, b] : {std::pair<int, int>{0, 1}, {1, 2}, {2, 0}, {0, 3}, {2, 3}, {1, 3}}) {
    mesh.nodes.push_back((mesh.nodes[static_cast<std::size_t>(a)] + mesh.nodes[static_cast<std::size_t>(b)]) /
                         2);
  }
  for (std::size_t k = 0; k < 10; ++k) mesh.elements.push_back(k);
  return mesh;
}

TEST(FeMesh, VolumeOfStraightTetrahedra_IsOneSixthOfTheBox) {
  FeMesh mesh = QuadraticTetrahedron();
  EXPECT_NEAR(Measure(mesh), 1.0 / 6, 1e-15);
  std::swap(mesh.elements[1], mesh.elements[2]);  // and the mid-edge nodes with them
  std::swap(mesh.elements[4], mesh.elements[6]);
  std::swap(mesh.elements[8], mesh.elements[9]);
  EXPECT_NEAR(Measure(mesh), -1.0 / 6, 1e-15);
}

TEST(FeMesh, VolumeOfACurvedTetrahedron_IsThatOfItsMap) {
  // The quadratic map x ↦ (x, y, z + x (1 − x)) keeps volumes and is the element's own.
  FeMesh mesh = QuadraticTetrahedron();
  for (Eigen::Vector3d& node : mesh.nodes) node.z() += node.x() * (1 - node.x());
  EXPECT_NEAR(Measure(mesh), 1.0 / 6, 1e-15);
  // x ↦ x + 2 x y: the determinant is 1 + 2 y; over the simplex 1/6 + 2/24.
  mesh = QuadraticTetrahedron();
  for (Eigen::Vector3d& node : mesh.nodes) node.x() += 2 * node.x() * node.y();
  EXPECT_NEAR(Measure(mesh), 1.0 / 4, 1e-15);
}

TEST(FeMesh, AreaOfACurvedTriangle_IsThatOfTheParabola) {
  FeMesh mesh{.dimension = 2, .order = 2, .nodes = {}, .elements = {0, 1, 2, 3, 4, 5}};
  for (const auto& [x, y] :
       {std::pair{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {0.5, 0.0}, {0.5, 0.5}, {0.0, 0.5}}) {
    mesh.nodes.emplace_back(x, y, 0.3 * x * x);
  }
  double area = 0;  // ∫ (1 − x) √(1 + 0.36 x²) dx
  constexpr int kSteps = 20000;
  for (int k = 0; k < kSteps; ++k) {
    const double x = (k + 0.5) / kSteps;
    area += (1 - x) * std::sqrt(1 + 0.36 * x * x) / kSteps;
  }
  EXPECT_NEAR(Measure(mesh), area, 1e-7);
}

TEST(FeMesh, Msh2_IsReadWithGapsInItsNumbersAndLowerElementsLeftOut) {
  const FeMesh mesh = ParseMsh2(
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n10 0 0 0\n20 1 0 0\n30 0 1 0\n7 0 0 1\n$EndNodes\n"
      "$Elements\n3\n1 15 2 1 1 10\n2 2 2 1 1 10 20 30\n3 4 2 1 1 10 20 30 7\n$EndElements\n",
      "a.msh");
  EXPECT_EQ(mesh.dimension, 3);
  EXPECT_EQ(mesh.NumElements(), 1u);
  EXPECT_NEAR(Measure(mesh), 1.0 / 6, 1e-15);
}

TEST(FeMesh, DamagedMsh2_IsRefused) {
  const auto message = [](const std::string& text) {
    return MessageOf<InputError>([&] { ParseMsh2(text, "a.msh"); });
  };
  EXPECT_TRUE(Holds(message(""), "a.msh: has no section $Nodes"));
  EXPECT_TRUE(Holds(message("$Nodes 1 1 0 0 0 $EndNodes $Elements 0 $EndElements"), "holds no triangles"));
  EXPECT_TRUE(Holds(message("$Nodes 1 1 0 0 0 $EndNodes $Elements 1 1 2 0 1 1 9"), "unknown node"));
  EXPECT_TRUE(Holds(message("$Nodes 3 1 0 0"), "has no section $Elements"));
}

TEST(ShellSection, IsAddedWhereTheFormatHasOne) {
  EXPECT_EQ(WithShellElements("*ELEMENT, type=CPS3, ELSET=a\n1,2\n*ELEMENT, type=CPS6, ELSET=b\n"),
            "*ELEMENT, type=S3, ELSET=a\n1,2\n*ELEMENT, type=S6, ELSET=b\n");
  EXPECT_EQ(WithShellSection("x\n", "inp", 0.25),
            "x\n*SHELL SECTION, ELSET=surface, MATERIAL=material\n0.25\n");
  EXPECT_EQ(WithShellSection("x\nENDDATA\n", "bdf", 2),
            "x\n"
            "PSHELL* 1               1               2.000000000E+00 1               \n"
            "*                       1               \n"
            "ENDDATA\n");
  EXPECT_TRUE(Holds(MessageOf<ConfigError>([] { WithShellSection("", "vtk", 1); }), "no shell sections"));
}

}  // namespace
}  // namespace frond
