// SPDX-License-Identifier: BSD-3-Clause
#include "io/glb_file.h"

#include <bit>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

namespace frond {
namespace {

using Json = nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "glTF buffers are little endian");

// Constants of the glTF 2.0 specification.
constexpr int kFloat = 5126, kUnsignedInt = 5125;
constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;
constexpr int kTriangles = 4;
constexpr std::uint32_t kMagic = 0x46546C67, kVersion = 2, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;

template <typename T>
void Append(T value, std::string* bytes) {
  bytes->append(reinterpret_cast<const char*>(&value), sizeof(value));
}

Json List(const Eigen::Vector3d& v) { return Json::array({v.x(), v.y(), v.z()}); }

// Adds a view over the last bytes of `buffer`, from `begin`, and an accessor of it; returns the accessor's
// number.
std::size_t AddAccessor(std::size_t begin, std::size_t end, int target, int component, std::size_t count,
                        const char* type, Json* gltf) {
  Json view;
  view["buffer"] = 0;
  view["byteOffset"] = begin;
  view["byteLength"] = end - begin;
  view["target"] = target;
  (*gltf)["bufferViews"].push_back(view);
  Json accessor;
  accessor["bufferView"] = (*gltf)["bufferViews"].size() - 1;
  accessor["componentType"] = component;
  accessor["count"] = count;
  accessor["type"] = type;
  (*gltf)["accessors"].push_back(accessor);
  return (*gltf)["accessors"].size() - 1;
}

std::size_t AddPositions(const SurfaceMesh& mesh, double scale, const Eigen::Vector3d& centre, Json* gltf,
                         std::string* buffer) {
  Eigen::Vector3f low = Eigen::Vector3f::Constant(std::numeric_limits<float>::max()), high = -low;
  const std::size_t begin = buffer->size();
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    const Eigen::Vector3f position = ((vertex - centre) * scale).cast<float>();
    low = low.cwiseMin(position);
    high = high.cwiseMax(position);
    for (int axis = 0; axis < 3; ++axis) Append(position[axis], buffer);
  }
  const std::size_t accessor =
      AddAccessor(begin, buffer->size(), kArrayBuffer, kFloat, mesh.vertices.size(), "VEC3", gltf);
  (*gltf)["accessors"][accessor]["min"] = List(low.cast<double>());
  (*gltf)["accessors"][accessor]["max"] = List(high.cast<double>());
  return accessor;
}

// Normals must have length 1: a vanished one (at a collapsed tip) points along z.
std::size_t AddNormals(const SurfaceMesh& mesh, Json* gltf, std::string* buffer) {
  const std::size_t begin = buffer->size();
  for (const Eigen::Vector3d& normal : mesh.normals) {
    const double length = normal.norm();
    const Eigen::Vector3d unit = length > 0 ? Eigen::Vector3d(normal / length) : Eigen::Vector3d::UnitZ();
    for (int axis = 0; axis < 3; ++axis) Append(static_cast<float>(unit[axis]), buffer);
  }
  return AddAccessor(begin, buffer->size(), kArrayBuffer, kFloat, mesh.normals.size(), "VEC3", gltf);
}

std::size_t AddTriangles(const SurfaceMesh& mesh, Json* gltf, std::string* buffer) {
  const std::size_t begin = buffer->size();
  for (const auto& triangle : mesh.triangles) {
    for (const int corner : triangle) Append(static_cast<std::uint32_t>(corner), buffer);
  }
  return AddAccessor(begin, buffer->size(), kElementArrayBuffer, kUnsignedInt, 3 * mesh.triangles.size(),
                     "SCALAR", gltf);
}

void AppendChunk(std::uint32_t type, std::string chunk, char padding, std::string* bytes) {
  chunk.resize((chunk.size() + 3) / 4 * 4, padding);
  Append(static_cast<std::uint32_t>(chunk.size()), bytes);
  Append(type, bytes);
  *bytes += chunk;
}

}  // namespace

std::string FormatGlb(const SurfaceMesh& mesh, double metres_per_unit) {
  Eigen::Vector3d low = mesh.vertices.at(0), high = low;
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  const Eigen::Vector3d centre = 0.5 * (low + high);
  Json gltf;
  gltf["asset"] = {{"version", "2.0"}, {"generator", "frond"}};
  gltf["scene"] = 0;
  gltf["scenes"] = Json::array({{{"nodes", {0}}}});
  gltf["nodes"] = Json::array({{{"mesh", 0}, {"translation", List(centre * metres_per_unit)}}});
  gltf["meshes"] = Json::array();
  gltf["materials"] = Json::array(
      {{{"pbrMetallicRoughness",
         {{"baseColorFactor", {0.35, 0.55, 0.25, 1.0}}, {"metallicFactor", 0.0}, {"roughnessFactor", 0.8}}},
        {"doubleSided", true}}});
  gltf["bufferViews"] = Json::array();
  gltf["accessors"] = Json::array();
  std::string buffer;
  Json primitive;
  primitive["attributes"]["POSITION"] = AddPositions(mesh, metres_per_unit, centre, &gltf, &buffer);
  if (!mesh.normals.empty()) primitive["attributes"]["NORMAL"] = AddNormals(mesh, &gltf, &buffer);
  primitive["indices"] = AddTriangles(mesh, &gltf, &buffer);
  primitive["material"] = 0;
  primitive["mode"] = kTriangles;
  gltf["meshes"].push_back({{"primitives", Json::array({primitive})}});
  gltf["buffers"] = Json::array({{{"byteLength", buffer.size()}}});

  std::string chunks;
  AppendChunk(kJsonChunk, gltf.dump(), ' ', &chunks);
  AppendChunk(kBinaryChunk, std::move(buffer), '\0', &chunks);
  std::string bytes;
  Append(kMagic, &bytes);
  Append(kVersion, &bytes);
  Append(static_cast<std::uint32_t>(12 + chunks.size()), &bytes);
  return bytes + chunks;
}

}  // namespace frond
