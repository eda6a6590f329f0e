// SPDX-License-Identifier: BSD-3-Clause
#include "io/mesh_parsers.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "io/file_bytes.h"
#include "io/number_text.h"
#include "io/ply_body.h"
#include "io/ply_header.h"

namespace frond {
namespace {

[[noreturn]] void FailLine(const std::filesystem::path& path, std::size_t line, const std::string& message) {
  FailFile(path, "line " + std::to_string(line) + ": " + message);
}

// The lines of a text with their words, comments (#) removed, empty lines skipped.
class WordLines {
 public:
  explicit WordLines(std::string_view text) : rest_(text) {}

  bool Next() {
    words_.clear();
    while (words_.empty() && !rest_.empty()) {
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      std::string_view line = rest_.substr(0, end);
      line = line.substr(0, line.find('#'));
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      ++number_;
      std::size_t at = 0;
      while ((at = line.find_first_not_of(" \t\r", at)) != std::string_view::npos) {
        const std::size_t stop = std::min(line.find_first_of(" \t\r", at), line.size());
        words_.push_back(line.substr(at, stop - at));
        at = stop;
      }
    }
    return !words_.empty();
  }

  const std::vector<std::string_view>& words() const { return words_; }
  std::size_t number() const { return number_; }

 private:
  std::string_view rest_;
  std::vector<std::string_view> words_;
  std::size_t number_ = 0;
};

double NumberAt(const std::filesystem::path& path, const WordLines& lines, std::size_t word) {
  double value = 0;
  if (word >= lines.words().size()) FailLine(path, lines.number(), "a number is missing");
  const std::string_view text = lines.words()[word];
  if (ParseNumber(text, &value) != text.size()) FailLine(path, lines.number(), "a word is not a number");
  return value;
}

Eigen::Vector3d PointAt(const std::filesystem::path& path, const WordLines& lines, std::size_t word) {
  return {NumberAt(path, lines, word), NumberAt(path, lines, word + 1), NumberAt(path, lines, word + 2)};
}

// Adds a face as a fan about its first corner. `corners` count from 0.
void AddFan(const std::filesystem::path& path, const std::string& place, const std::vector<double>& corners,
            std::size_t vertices, SurfaceMesh* mesh) {
  if (corners.size() < 3) FailFile(path, place + ": a face has fewer than three corners");
  for (const double corner : corners) {
    if (!(corner >= 0) || corner != std::floor(corner) || corner >= static_cast<double>(vertices)) {
      FailFile(path, place + ": a face names a vertex that does not exist (there are " +
                         std::to_string(vertices) + ")");
    }
  }
  for (std::size_t k = 2; k < corners.size(); ++k) {
    mesh->triangles.push_back(
        {static_cast<int>(corners[0]), static_cast<int>(corners[k - 1]), static_cast<int>(corners[k])});
  }
}

void ReadPlyVertices(const std::filesystem::path& path, const PlyElement& element, PlyBody* body,
                     std::vector<Eigen::Vector3d>* vertices) {
  const std::size_t x = element.Find("x"), y = element.Find("y"), z = element.Find("z");
  const std::size_t count = element.properties.size();
  if (x >= count || y >= count || z >= count) FailFile(path, "its vertices have no properties x, y and z");
  for (const std::size_t axis : {x, y, z}) {
    if (element.properties[axis].list_count) FailFile(path, "x, y or z is a list");
  }
  vertices->reserve(element.count);
  PlyRow row;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    body->ReadRow(element, i, /*keep_lists=*/false, &row);
    vertices->emplace_back(row.values[x], row.values[y], row.values[z]);
  }
}

Eigen::Vector3d FloatsAt(const char* data) {
  float xyz[3];
  std::memcpy(xyz, data, sizeof(xyz));
  return {static_cast<double>(xyz[0]), static_cast<double>(xyz[1]), static_cast<double>(xyz[2])};
}

// Triangles from separate corners; corners with equal coordinates become one vertex.
class CornerJoiner {
 public:
  void Add(const Eigen::Vector3d& corner) {
    const auto [found, is_new] =
        index_.try_emplace({corner.x(), corner.y(), corner.z()}, static_cast<int>(mesh_.vertices.size()));
    if (is_new) mesh_.vertices.push_back(corner);
    triangle_[filled_++] = found->second;
    if (filled_ < 3) return;
    mesh_.triangles.push_back(triangle_);
    filled_ = 0;
  }

  bool InsideTriangle() const { return filled_ != 0; }
  SurfaceMesh Take() { return std::move(mesh_); }

 private:
  std::map<std::tuple<double, double, double>, int> index_;
  SurfaceMesh mesh_;
  std::array<int, 3> triangle_ = {};
  std::size_t filled_ = 0;
};

// 80 bytes of anything, the number of triangles, then 50 bytes each: normal, three corners, 2 spare bytes.
constexpr std::size_t kStlHeader = 84, kStlTriangle = 50;

std::size_t StlCount(std::string_view bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, sizeof(count));
  return count;
}

SurfaceMesh ParseStlText(const std::filesystem::path& path, std::string_view bytes) {
  CornerJoiner joiner;
  WordLines lines(bytes);
  bool ended = false;
  while (lines.Next()) {
    if (lines.words()[0] == "vertex") joiner.Add(PointAt(path, lines, 1));
    ended = lines.words()[0] == "endsolid";
  }
  if (!ended || joiner.InsideTriangle()) FailFile(path, "is truncated: it does not end with 'endsolid'");
  return joiner.Take();
}

}  // namespace

std::vector<Eigen::Vector3d> ParsePlyPoints(const std::filesystem::path& path, std::string_view bytes) {
  const PlyHeader header = ParsePlyHeader(path, bytes);
  PlyBody body(path, bytes, header);
  std::vector<Eigen::Vector3d> points;
  PlyRow row;
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex") {
      ReadPlyVertices(path, element, &body, &points);
      return points;
    }
    for (std::uint64_t i = 0; i < element.count; ++i) body.ReadRow(element, i, /*keep_lists=*/false, &row);
  }
  FailFile(path, "holds no points (no element 'vertex')");
}

SurfaceMesh ParsePlyMesh(const std::filesystem::path& path, std::string_view bytes) {
  const PlyHeader header = ParsePlyHeader(path, bytes);
  PlyBody body(path, bytes, header);
  SurfaceMesh mesh;
  bool has_vertices = false;
  PlyRow row;
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex" && !has_vertices) {
      ReadPlyVertices(path, element, &body, &mesh.vertices);
      has_vertices = true;
      continue;
    }
    std::size_t corners = element.Find("vertex_indices");
    if (corners == element.properties.size()) corners = element.Find("vertex_index");
    const bool is_face = element.name == "face" && corners < element.properties.size();
    for (std::uint64_t i = 0; i < element.count; ++i) {
      body.ReadRow(element, i, is_face, &row);
      if (is_face) AddFan(path, "face " + std::to_string(i), row.lists[corners], mesh.vertices.size(), &mesh);
    }
  }
  if (!has_vertices) FailFile(path, "holds no points (no element 'vertex')");
  return mesh;
}

SurfaceMesh ParseObjMesh(const std::filesystem::path& path, std::string_view bytes) {
  SurfaceMesh mesh;
  WordLines lines(bytes);
  std::vector<double> corners;
  while (lines.Next()) {
    const auto& words = lines.words();
    if (words[0] == "v") mesh.vertices.push_back(PointAt(path, lines, 1));
    if (words[0] != "f") continue;
    corners.clear();
    for (std::size_t k = 1; k < words.size(); ++k) {
      double index = 0;  // "7", "7/1", "7//3": the vertex stands first, from 1; negative counts from the last
      const std::size_t taken = ParseNumber(words[k], &index);
      if (taken == 0 || (taken < words[k].size() && words[k][taken] != '/') || index == 0) {
        FailLine(path, lines.number(), "a face's corner is not a vertex number");
      }
      corners.push_back(index < 0 ? index + static_cast<double>(mesh.vertices.size()) : index - 1);
    }
    AddFan(path, "line " + std::to_string(lines.number()), corners, mesh.vertices.size(), &mesh);
  }
  if (mesh.vertices.empty()) FailFile(path, "holds no points (no line 'v x y z')");
  return mesh;
}

SurfaceMesh ParseOffMesh(const std::filesystem::path& path, std::string_view bytes) {
  SurfaceMesh mesh;
  WordLines lines(bytes);
  if (!lines.Next() || !lines.words()[0].ends_with("OFF")) {
    FailFile(path, "is not an OFF file (its first line is not 'OFF')");
  }
  std::size_t first = 1;  // the counts may follow on the same line
  if (lines.words().size() < 3) {
    if (!lines.Next()) FailFile(path, "is truncated: the counts are missing");
    first = 0;
  }
  const double vertices = NumberAt(path, lines, first), faces = NumberAt(path, lines, first + 1);
  for (double i = 0; i < vertices; ++i) {
    if (!lines.Next()) {
      FailFile(path, "is truncated: its header promises " + FormatNumber(vertices) + " points, " +
                         FormatNumber(i) + " are there; copy or export it again");
    }
    mesh.vertices.push_back(PointAt(path, lines, 0));
  }
  std::vector<double> corners;
  for (double i = 0; i < faces; ++i) {
    if (!lines.Next()) {
      FailFile(path, "is truncated: its header promises " + FormatNumber(faces) + " faces, " +
                         FormatNumber(i) + " are there; copy or export it again");
    }
    const double size = NumberAt(path, lines, 0);
    corners.clear();
    for (std::size_t k = 1; static_cast<double>(k) <= size; ++k) corners.push_back(NumberAt(path, lines, k));
    AddFan(path, "line " + std::to_string(lines.number()), corners, mesh.vertices.size(), &mesh);
  }
  return mesh;
}

SurfaceMesh ParseStlMesh(const std::filesystem::path& path, std::string_view bytes) {
  // Binary files may start with "solid" too: the size decides.
  const bool sized =
      bytes.size() >= kStlHeader && bytes.size() == kStlHeader + kStlTriangle * StlCount(bytes);
  if (!sized && bytes.starts_with("solid") && bytes.find('\0') == std::string_view::npos)
    return ParseStlText(path, bytes);
  if (bytes.size() < kStlHeader) FailFile(path, "is not an STL file (too short)");
  const std::size_t there = (bytes.size() - kStlHeader) / kStlTriangle;
  if (StlCount(bytes) > there) {
    FailFile(path, "is truncated or no STL file: its header promises " + std::to_string(StlCount(bytes)) +
                       " triangles, the file has room for " + std::to_string(there) +
                       "; copy or export it again");
  }
  CornerJoiner joiner;
  for (std::size_t i = 0; i < StlCount(bytes); ++i) {
    const char* const triangle = bytes.data() + kStlHeader + kStlTriangle * i;
    for (std::size_t k = 1; k <= 3; ++k) joiner.Add(FloatsAt(triangle + 12 * k));
  }
  return joiner.Take();
}

}  // namespace frond
