// SPDX-License-Identifier: BSD-3-Clause
#include "io/mesh_file.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cstdint>
#include <stdexcept>

#include "io/file_bytes.h"
#include "io/glb_file.h"
#include "io/length_unit.h"
#include "io/mesh_parsers.h"
#include "io/number_text.h"
#include "io/sha256.h"

namespace frond {
namespace {

std::string Joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

template <typename T>
void Append(T value, std::string* bytes) {
  static_assert(std::endian::native == std::endian::little);
  bytes->append(reinterpret_cast<const char*>(&value), sizeof(value));
}

template <typename T, typename Vector>
void AppendVector(const Vector& vector, std::string* bytes) {
  for (Eigen::Index k = 0; k < vector.size(); ++k) Append(static_cast<T>(vector[k]), bytes);
}

std::string FormatPly(const SurfaceMesh& mesh, const VertexScalar& scalar = {}) {
  std::string bytes = "ply\nformat binary_little_endian 1.0\ncomment frond\nelement vertex " +
                      std::to_string(mesh.vertices.size()) +
                      "\nproperty double x\nproperty double y\nproperty double z\n";
  if (!mesh.normals.empty()) bytes += "property float nx\nproperty float ny\nproperty float nz\n";
  if (!mesh.parameters.empty()) bytes += "property double s\nproperty double t\n";
  if (!scalar.values.empty()) bytes += "property double " + scalar.name + "\n";
  bytes += "element face " + std::to_string(mesh.triangles.size()) +
           "\nproperty list uchar int vertex_indices\nend_header\n";
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    AppendVector<double>(mesh.vertices[i], &bytes);
    if (!mesh.normals.empty()) AppendVector<float>(mesh.normals[i], &bytes);
    if (!mesh.parameters.empty()) AppendVector<double>(mesh.parameters[i], &bytes);
    if (!scalar.values.empty()) Append(scalar.values[i], &bytes);
  }
  for (const auto& triangle : mesh.triangles) {
    Append(std::uint8_t{3}, &bytes);
    for (const int corner : triangle) Append(static_cast<std::int32_t>(corner), &bytes);
  }
  return bytes;
}

template <typename Vector>
void AppendLine(const char* key, const Vector& vector, std::string* text) {
  *text += key;
  for (Eigen::Index k = 0; k < vector.size(); ++k) {
    *text += ' ';
    AppendNumber(vector[k], text);
  }
  *text += '\n';
}

std::string FormatObj(const SurfaceMesh& mesh) {
  std::string text = "# frond\n";
  for (const auto& vertex : mesh.vertices) AppendLine("v", vertex, &text);
  for (const auto& parameter : mesh.parameters) AppendLine("vt", parameter, &text);
  for (const auto& normal : mesh.normals) AppendLine("vn", normal, &text);
  for (const auto& triangle : mesh.triangles) {
    text += 'f';
    for (const int corner : triangle) {
      const std::string index = std::to_string(corner + 1);  // position/texture/normal, from 1
      text += " " + index;
      if (!mesh.parameters.empty() || !mesh.normals.empty()) text += "/";
      if (!mesh.parameters.empty()) text += index;
      if (!mesh.normals.empty()) text += "/" + index;
    }
    text += '\n';
  }
  return text;
}

std::string FormatStl(const SurfaceMesh& mesh) {
  std::string bytes = "frond";
  bytes.resize(80, ' ');
  Append(static_cast<std::uint32_t>(mesh.triangles.size()), &bytes);
  for (const auto& triangle : mesh.triangles) {
    std::array<Eigen::Vector3d, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = mesh.vertices[static_cast<std::size_t>(triangle[k])];
    const Eigen::Vector3d normal =
        (corners[1] - corners[0]).cross(corners[2] - corners[0]).stableNormalized();
    AppendVector<float>(normal, &bytes);
    for (const auto& corner : corners) AppendVector<float>(corner, &bytes);
    Append(std::uint16_t{0}, &bytes);
  }
  return bytes;
}

void CheckMesh(const SurfaceMesh& mesh) {
  const std::size_t count = mesh.vertices.size();
  if (count == 0 || mesh.triangles.empty())
    throw std::invalid_argument("a mesh without triangles is written");
  if ((!mesh.normals.empty() && mesh.normals.size() != count) ||
      (!mesh.parameters.empty() && mesh.parameters.size() != count)) {
    throw std::invalid_argument("a mesh's normals or parameters are not as many as its vertices");
  }
}

}  // namespace

const std::vector<std::string>& MeshWriteExtensions() {
  static const std::vector<std::string> extensions = {"ply", "obj", "stl", "glb"};
  return extensions;
}

const std::vector<std::string>& MeshReadExtensions() {
  static const std::vector<std::string> extensions = {"ply", "obj", "stl", "off"};
  return extensions;
}

void WriteMesh(const std::filesystem::path& path, const SurfaceMesh& mesh, std::string_view unit) {
  CheckMesh(mesh);
  const double metres = MetresPerUnit(unit);
  const std::string extension = Extension(path);
  if (extension == "ply") {
    WriteFileBytes(path, FormatPly(mesh));
  } else if (extension == "obj") {
    WriteFileBytes(path, FormatObj(mesh));
  } else if (extension == "stl") {
    WriteFileBytes(path, FormatStl(mesh));
  } else if (extension == "glb") {
    WriteFileBytes(path, FormatGlb(mesh, metres));
  } else {
    FailFile(path,
             "meshes are not written as '." + extension + "' (known: " + Joined(MeshWriteExtensions()) + ")");
  }
}

void WritePlyMesh(const std::filesystem::path& path, const SurfaceMesh& mesh, const VertexScalar& scalar) {
  CheckMesh(mesh);
  if (scalar.values.size() != mesh.vertices.size()) {
    throw std::invalid_argument("a mesh's scalar is not as long as its vertices");
  }
  WriteFileBytes(path, FormatPly(mesh, scalar));
}

SurfaceMesh ReadMesh(const std::filesystem::path& path, CloudReport* report) {
  const std::string extension = Extension(path);
  const std::string bytes = ReadFileBytes(path);
  if (bytes.empty()) FailFile(path, "is empty");
  SurfaceMesh mesh;
  if (extension == "ply") {
    mesh = ParsePlyMesh(path, bytes);
  } else if (extension == "obj") {
    mesh = ParseObjMesh(path, bytes);
  } else if (extension == "stl") {
    mesh = ParseStlMesh(path, bytes);
  } else if (extension == "off") {
    mesh = ParseOffMesh(path, bytes);
  } else {
    FailFile(path, "unknown kind of mesh '." + extension + "' (known: " + Joined(MeshReadExtensions()) + ")");
  }
  if (mesh.triangles.empty()) FailFile(path, "holds no faces: it is a cloud, not a mesh");
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (!mesh.vertices[i].allFinite()) FailFile(path, "vertex " + std::to_string(i) + " is not finite");
  }
  if (report != nullptr) {
    *report = CloudReport();
    report->format = extension;
    report->rows = mesh.vertices.size();
    report->sha256 = Sha256(bytes);
  }
  return mesh;
}

}  // namespace frond
