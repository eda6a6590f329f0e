// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace frond {

enum class PlyFormat { kAscii, kLittleEndian, kBigEndian };
enum class PlyType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

std::size_t PlySize(PlyType type);  // in bytes

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::kFloat;          // of the value, or of a list's values
  std::optional<PlyType> list_count = {};  // the type of a list's length; none: not a list
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  // The position of a property, or properties.size() if there is none of that name.
  std::size_t Find(std::string_view property) const;
};

// What stands before "end_header" (Turk 1994).
struct PlyHeader {
  PlyFormat format = PlyFormat::kAscii;
  std::vector<PlyElement> elements;
  std::size_t body = 0;       // byte offset of the first value
  std::size_t body_line = 1;  // its line, counted from 1
};

// Throws InputError naming `path` and the line. An element that could not fit into the file even if every
// list were empty is refused here, before anything is allocated for it, with the number that the file has
// room for.
PlyHeader ParsePlyHeader(const std::filesystem::path& path, std::string_view bytes);

}  // namespace frond
