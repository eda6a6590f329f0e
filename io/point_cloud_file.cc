// SPDX-License-Identifier: BSD-3-Clause
#include "io/point_cloud_file.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <stdexcept>

#include "base/errors.h"
#include "io/file_bytes.h"
#include "io/mesh_parsers.h"
#include "io/number_text.h"
#include "io/pcd_file.h"
#include "io/sha256.h"
#include "io/text_cloud.h"

namespace frond {
namespace {

std::string Joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::vector<Eigen::Vector3d> ParseRows(const std::filesystem::path& path, std::string_view bytes,
                                       std::string* format) {
  const std::string extension = Extension(path);
  *format = extension;
  if (extension == "ply") return ParsePlyPoints(path, bytes);
  if (extension == "pcd") return ParsePcd(path, bytes);
  if (extension == "obj") return ParseObjMesh(path, bytes).vertices;
  if (extension == "off") return ParseOffMesh(path, bytes).vertices;
  if (extension == "stl") return ParseStlMesh(path, bytes).vertices;
  *format = "text";
  return ParseTextCloud(path, bytes);
}

std::uint64_t HashBits(const Eigen::Vector3d& point) {
  std::uint64_t hash = 0;
  for (int axis = 0; axis < 3; ++axis) {  // splitmix64's finaliser over the coordinates in turn
    hash = (hash + 0x9e3779b97f4a7c15u) ^ std::bit_cast<std::uint64_t>(point[axis] + 0.0);  // −0 as 0
    hash = (hash ^ (hash >> 30)) * 0xbf58476d1ce4e5b9u;
    hash = (hash ^ (hash >> 27)) * 0x94d049bb133111ebu;
    hash ^= hash >> 31;
  }
  return hash;
}

// Keeps the first of equal points, in order, in place. An open-addressing table of indices: 16 to 32 bytes a
// point for the time of the call.
void MergeDuplicates(std::vector<Eigen::Vector3d>* points) {
  constexpr std::size_t kFree = static_cast<std::size_t>(-1);
  const std::size_t size = std::bit_ceil(2 * points->size() + 1);
  std::vector<std::size_t> table(size, kFree);
  std::size_t kept = 0;
  for (const Eigen::Vector3d& point : *points) {
    std::size_t slot = HashBits(point) & (size - 1);
    while (table[slot] != kFree && (*points)[table[slot]] != point) slot = (slot + 1) & (size - 1);
    if (table[slot] != kFree) continue;
    table[slot] = kept;
    (*points)[kept++] = Eigen::Vector3d(point);
  }
  points->resize(kept);
}

void CheckSizes(const PointCloud& cloud, const CloudAttributes& attributes) {
  const auto fits = [&](std::size_t size) { return size == 0 || size == cloud.points.size(); };
  if (!fits(attributes.deviation.size()) || !fits(attributes.colours.size()) ||
      !fits(attributes.normals.size()) || !fits(attributes.standard_deviation.size())) {
    throw std::invalid_argument("a cloud's attributes are not as many as its points");
  }
}

template <typename Value>
void AppendBytes(Value value, std::string* bytes) {
  static_assert(std::endian::native == std::endian::little);
  bytes->append(reinterpret_cast<const char*>(&value), sizeof(value));
}

std::string FormatPly(const PointCloud& cloud, const CloudAttributes& attributes) {
  std::string bytes = "ply\nformat binary_little_endian 1.0\ncomment frond\nelement vertex " +
                      std::to_string(cloud.points.size()) +
                      "\nproperty double x\nproperty double y\nproperty double z\n";
  if (!attributes.deviation.empty()) bytes += "property double deviation\n";
  if (!attributes.normals.empty()) bytes += "property float nx\nproperty float ny\nproperty float nz\n";
  if (!attributes.standard_deviation.empty()) bytes += "property float standard_deviation\n";
  if (!attributes.colours.empty()) bytes += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  bytes += "end_header\n";
  bytes.reserve(bytes.size() + cloud.points.size() * 51);  // with all of them
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    for (const double value : cloud.points[i]) AppendBytes(value, &bytes);
    if (!attributes.deviation.empty()) AppendBytes(attributes.deviation[i], &bytes);
    if (!attributes.normals.empty()) {
      for (const double value : attributes.normals[i]) AppendBytes(static_cast<float>(value), &bytes);
    }
    if (!attributes.standard_deviation.empty()) {
      AppendBytes(static_cast<float>(attributes.standard_deviation[i]), &bytes);
    }
    if (attributes.colours.empty()) continue;
    for (const std::uint8_t channel : attributes.colours[i]) bytes += static_cast<char>(channel);
  }
  return bytes;
}

std::string FormatText(const PointCloud& cloud, const CloudAttributes& attributes, bool csv) {
  const char separator = csv ? ',' : ' ';
  std::string text;
  if (csv) {
    text = std::string("x,y,z") + (attributes.deviation.empty() ? "" : ",deviation") +
           (attributes.normals.empty() ? "" : ",nx,ny,nz") +
           (attributes.standard_deviation.empty() ? "" : ",standard_deviation") +
           (attributes.colours.empty() ? "" : ",red,green,blue") + "\n";
  }
  const auto append = [&](double value) {
    text += separator;
    AppendNumber(value, &text);
  };
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    AppendNumber(cloud.points[i].x(), &text);
    append(cloud.points[i].y());
    append(cloud.points[i].z());
    if (!attributes.deviation.empty()) append(attributes.deviation[i]);
    if (!attributes.normals.empty()) {
      for (const double value : attributes.normals[i]) append(value);
    }
    if (!attributes.standard_deviation.empty()) append(attributes.standard_deviation[i]);
    if (!attributes.colours.empty()) {
      for (const std::uint8_t channel : attributes.colours[i]) text += separator + std::to_string(channel);
    }
    text += '\n';
  }
  return text;
}

}  // namespace

const std::vector<std::string>& CloudExtensions() {
  static const std::vector<std::string> extensions = {"ply", "pcd", "xyz", "asc", "csv",
                                                      "txt", "pts", "obj", "stl", "off"};
  return extensions;
}

PointCloud ReadPointCloud(const std::filesystem::path& path, CloudReport* report) {
  const std::string extension = Extension(path);
  const auto& known = CloudExtensions();
  const std::string bytes = ReadFileBytes(path);
  if (std::find(known.begin(), known.end(), extension) == known.end()) {
    FailFile(path, "unknown kind of cloud '." + extension + "' (known: " + Joined(known) + ")");
  }
  if (bytes.empty()) FailFile(path, "is empty");
  CloudReport done;
  PointCloud cloud;
  cloud.points = ParseRows(path, bytes, &done.format);
  done.sha256 = Sha256(bytes);
  done.rows = cloud.points.size();
  if (done.rows == 0) FailFile(path, "holds no points");
  std::erase_if(cloud.points, [](const Eigen::Vector3d& point) { return !point.allFinite(); });
  done.dropped_not_finite = done.rows - cloud.points.size();
  if (cloud.points.empty()) {
    FailFile(path,
             "no usable points: all " + std::to_string(done.rows) + " rows hold NaN or infinite values");
  }
  MergeDuplicates(&cloud.points);
  done.merged_duplicates = done.rows - done.dropped_not_finite - cloud.points.size();
  if (report != nullptr) *report = done;
  return cloud;
}

void WritePointCloud(const std::filesystem::path& path, const PointCloud& cloud,
                     const CloudAttributes& attributes) {
  CheckSizes(cloud, attributes);
  const std::string extension = Extension(path);
  if (extension == "ply") {
    WriteFileBytes(path, FormatPly(cloud, attributes));
  } else if (extension == "xyz" || extension == "asc" || extension == "txt" || extension == "csv") {
    WriteFileBytes(path, FormatText(cloud, attributes, extension == "csv"));
  } else {
    FailFile(path, "clouds are not written as '." + extension + "' (known: ply, xyz, asc, txt, csv)");
  }
}

}  // namespace frond
