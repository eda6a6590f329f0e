// SPDX-License-Identifier: BSD-3-Clause
#include "io/ply_body.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "io/file_bytes.h"
#include "io/number_text.h"

namespace frond {
namespace {

// The bytes at `data` as a T, in the machine's order (which is little endian on everything we build for) or
// swapped.
template <typename T>
double Decode(const char* data, bool swap) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, data, sizeof(T));
  if (swap) std::reverse(bytes, bytes + sizeof(T));
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return static_cast<double>(value);
}

double Decode(PlyType type, const char* data, bool swap) {
  switch (type) {
    case PlyType::kInt8:
      return Decode<std::int8_t>(data, swap);
    case PlyType::kUint8:
      return Decode<std::uint8_t>(data, swap);
    case PlyType::kInt16:
      return Decode<std::int16_t>(data, swap);
    case PlyType::kUint16:
      return Decode<std::uint16_t>(data, swap);
    case PlyType::kInt32:
      return Decode<std::int32_t>(data, swap);
    case PlyType::kUint32:
      return Decode<std::uint32_t>(data, swap);
    case PlyType::kFloat:
      return Decode<float>(data, swap);
    case PlyType::kDouble:
      return Decode<double>(data, swap);
  }
  return 0;
}

}  // namespace

PlyBody::PlyBody(const std::filesystem::path& path, std::string_view bytes, const PlyHeader& header)
    : path_(path), bytes_(bytes), format_(header.format), at_(header.body), line_(header.body_line) {}

std::string PlyBody::Place() const {
  return format_ == PlyFormat::kAscii ? "line " + std::to_string(line_) : "byte " + std::to_string(at_);
}

void PlyBody::FailTruncated(const PlyElement& element, std::uint64_t index) const {
  const bool points = element.name == "vertex";
  const std::string what = points ? "points" : "'" + element.name + "' rows";
  FailFile(path_, "is truncated at " + Place() + ": its header promises " + std::to_string(element.count) +
                      " " + what + ", " + std::to_string(index) + " are there; copy or export it again");
}

bool PlyBody::NextBinary(PlyType type, double* value) {
  const std::size_t size = PlySize(type);
  if (bytes_.size() - at_ < size) return false;
  const bool file_is_little = format_ == PlyFormat::kLittleEndian;
  *value = Decode(type, bytes_.data() + at_, file_is_little != (std::endian::native == std::endian::little));
  at_ += size;
  return true;
}

bool PlyBody::NextText(double* value) {
  for (; at_ < bytes_.size(); ++at_) {
    const char c = bytes_[at_];
    if (c == '\n') ++line_;
    if (c != ' ' && c != '\t' && c != '\r' && c != '\n') break;
  }
  if (at_ >= bytes_.size()) return false;
  const std::size_t taken = ParseNumber(bytes_.substr(at_), value);
  const std::size_t end = at_ + taken;
  const bool ends = end >= bytes_.size() || std::strchr(" \t\r\n", bytes_[end]) != nullptr;
  if (taken == 0 || !ends) {
    std::string word(
        bytes_.substr(at_, std::min<std::size_t>(bytes_.find_first_of(" \t\r\n", at_) - at_, 40)));
    for (char& c : word) c = c >= ' ' && c <= '~' ? c : '?';
    FailFile(path_, Place() + ": '" + word + "' is not a number");
  }
  at_ = end;
  return true;
}

bool PlyBody::Next(PlyType type, double* value) {
  return format_ == PlyFormat::kAscii ? NextText(value) : NextBinary(type, value);
}

void PlyBody::ReadRow(const PlyElement& element, std::uint64_t index, bool keep_lists, PlyRow* row) {
  row->values.resize(element.properties.size());
  row->lists.resize(element.properties.size());
  for (std::size_t k = 0; k < element.properties.size(); ++k) {
    const PlyProperty& property = element.properties[k];
    double& value = row->values[k];
    if (!Next(property.list_count.value_or(property.type), &value)) FailTruncated(element, index);
    row->lists[k].clear();
    if (!property.list_count) continue;
    if (!(value >= 0) || value != std::floor(value) || value > static_cast<double>(bytes_.size())) {
      FailFile(path_, Place() + ": a list's length is " + FormatNumber(value));
    }
    const auto length = static_cast<std::size_t>(value);
    for (std::size_t j = 0; j < length; ++j) {
      double item = 0;
      if (!Next(property.type, &item)) FailTruncated(element, index);
      if (keep_lists) row->lists[k].push_back(item);
    }
  }
}

}  // namespace frond
