// SPDX-License-Identifier: BSD-3-Clause
// GLB files as tinygltf reads them.
#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <cstring>

#include "io/mesh_file.h"
#include "tests/io/temp_folder.h"

namespace frond {
namespace {

TEST(GlbFile, Tinygltf_ReadsPositionsInMetresAtSurveyCoordinates) {
  const TempFolder folder;
  const Eigen::Vector3d offset(476773.25, 5429145.5, 263.0);
  SurfaceMesh mesh;
  mesh.vertices = {{0, 0, 0}, {0.05, 0, 0}, {0.05, 0.03, 0.01}, {0, 0.03, 0}};
  for (auto& vertex : mesh.vertices) vertex += offset;
  mesh.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  for (const auto& [unit, metres] : {std::pair{"m", 1.0}, std::pair{"mm", 1e-3}, std::pair{"in", 0.0254}}) {
    WriteMesh(folder / "a.glb", mesh, unit);
    tinygltf::TinyGLTF loader;
    tinygltf::Model model;
    std::string error, warning;
    ASSERT_TRUE(loader.LoadBinaryFromFile(&model, &error, &warning, (folder / "a.glb").string())) << error;
    EXPECT_EQ(error + warning, "");
    ASSERT_EQ(model.meshes.size(), 1u);
    const tinygltf::Primitive& primitive = model.meshes[0].primitives.at(0);
    const tinygltf::Accessor& positions =
        model.accessors.at(static_cast<std::size_t>(primitive.attributes.at("POSITION")));
    const tinygltf::Accessor& indices = model.accessors.at(static_cast<std::size_t>(primitive.indices));
    const tinygltf::Accessor& normals =
        model.accessors.at(static_cast<std::size_t>(primitive.attributes.at("NORMAL")));
    ASSERT_EQ(positions.count, 4u);
    ASSERT_EQ(indices.count, 6u);
    const auto data = [&](const tinygltf::Accessor& accessor) {
      const auto& view = model.bufferViews.at(static_cast<std::size_t>(accessor.bufferView));
      return model.buffers.at(0).data.data() + view.byteOffset + accessor.byteOffset;
    };
    const std::vector<double>& translation = model.nodes.at(0).translation;
    for (std::size_t i = 0; i < 4; ++i) {
      float xyz[3], normal[3];
      std::memcpy(xyz, data(positions) + 12 * i, 12);
      std::memcpy(normal, data(normals) + 12 * i, 12);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double metre = translation[axis] + static_cast<double>(xyz[axis]);
        EXPECT_NEAR(metre, mesh.vertices[i][static_cast<Eigen::Index>(axis)] * metres, 3e-9);
        EXPECT_GE(static_cast<double>(xyz[axis]), positions.minValues[axis]);
        EXPECT_LE(static_cast<double>(xyz[axis]), positions.maxValues[axis]);
      }
      EXPECT_NEAR(std::hypot(normal[0], normal[1], normal[2]), 1, 1e-6);
    }
    std::uint32_t corners[6];
    std::memcpy(corners, data(indices), sizeof(corners));
    EXPECT_EQ(corners[4], 2u);
  }
}

}  // namespace
}  // namespace frond
