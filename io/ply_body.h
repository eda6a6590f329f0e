// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/ply_header.h"

namespace frond {

// One row of an element: values[k] is property k, or the length of a list; lists[k] holds the list's values
// (empty for others).
struct PlyRow {
  std::vector<double> values;
  std::vector<std::vector<double>> lists;
};

// Reads the rows that follow a header, in order, in any of the three formats.
class PlyBody {
 public:
  PlyBody(const std::filesystem::path& path, std::string_view bytes, const PlyHeader& header);

  // Row `index` (from 0, for messages) of `element`. Throws InputError at a truncated or unreadable row.
  // Lists are stored only where `keep_lists`.
  void ReadRow(const PlyElement& element, std::uint64_t index, bool keep_lists, PlyRow* row);

 private:
  [[noreturn]] void FailTruncated(const PlyElement& element, std::uint64_t index) const;
  bool Next(PlyType type, double* value);
  bool NextText(double* value);
  bool NextBinary(PlyType type, double* value);
  std::string Place() const;

  const std::filesystem::path& path_;
  std::string_view bytes_;
  PlyFormat format_;
  std::size_t at_, line_;
};

}  // namespace frond
