// SPDX-License-Identifier: BSD-3-Clause
#include "io/pcd_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <string>

#include "io/file_bytes.h"
#include "io/number_text.h"

namespace frond {
namespace {

struct Field {
  std::string name;
  std::size_t size = 4;  // bytes of one value
  char type = 'F';       // F floating, I signed, U unsigned
  std::size_t count = 1;
  std::size_t offset = 0;  // bytes before it in a row
};

struct Header {
  std::vector<Field> fields;
  std::size_t points = 0;
  std::size_t row_bytes = 0, row_values = 0;
  std::string data;           // "ascii", "binary" or "binary_compressed"
  std::size_t body = 0;       // byte offset
  std::size_t body_line = 0;  // from 1
};

std::vector<std::string_view> Words(std::string_view line) {
  std::vector<std::string_view> words;
  std::size_t at = 0;
  while ((at = line.find_first_not_of(" \t\r", at)) != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(" \t\r", at), line.size());
    words.push_back(line.substr(at, end - at));
    at = end;
  }
  return words;
}

class HeaderParser {
 public:
  HeaderParser(const std::filesystem::path& path, std::string_view bytes) : path_(path), bytes_(bytes) {}

  Header Parse() {
    while (header_.data.empty()) {
      const std::size_t end = bytes_.find('\n', header_.body);
      if (end == std::string_view::npos) FailFile(path_, "is not a PCD file (its header has no DATA line)");
      ++line_;
      const auto words = Words(bytes_.substr(header_.body, end - header_.body));
      header_.body = end + 1;
      if (!words.empty() && !words[0].starts_with('#')) ParseLine(words);
    }
    header_.body_line = line_ + 1;
    Finish();
    return header_;
  }

 private:
  [[noreturn]] void Fail(const std::string& message) const {
    FailFile(path_, "line " + std::to_string(line_) + ": " + message);
  }

  std::size_t Whole(std::string_view word) const {
    std::size_t value = 0;
    const char* const last = word.data() + word.size();
    const auto result = std::from_chars(word.data(), last, value);
    if (result.ec != std::errc() || result.ptr != last) Fail("expected a whole, not negative number");
    return value;
  }

  void ParseLine(const std::vector<std::string_view>& words) {
    const std::string_view key = words[0];
    if (key == "FIELDS" || key == "COLUMNS") {
      for (std::size_t k = 1; k < words.size(); ++k)
        header_.fields.push_back({.name = std::string(words[k])});
    } else if (key == "SIZE" || key == "TYPE" || key == "COUNT") {
      if (words.size() != header_.fields.size() + 1) Fail("expected one value for each of the FIELDS");
      for (std::size_t k = 1; k < words.size(); ++k) ParseFieldValue(key, words[k], &header_.fields[k - 1]);
    } else if (key == "POINTS" || key == "WIDTH" || key == "HEIGHT") {
      if (words.size() != 2) Fail("expected one number");
      if (key == "POINTS") has_points_ = true, header_.points = Whole(words[1]);
      if (key == "WIDTH") width_ = Whole(words[1]);
      if (key == "HEIGHT") height_ = Whole(words[1]);
    } else if (key == "DATA") {
      if (words.size() != 2) Fail("expected one word");
      header_.data = words[1];
    } else if (key != "VERSION" && key != "VIEWPOINT") {
      FailFile(path_, "is not a PCD file (line " + std::to_string(line_) + " is no PCD header line)");
    }
  }

  void ParseFieldValue(std::string_view key, std::string_view word, Field* field) const {
    constexpr std::size_t kMaxCount = 1 << 20;
    if (key == "SIZE") {
      field->size = Whole(word);
      if (field->size != 1 && field->size != 2 && field->size != 4 && field->size != 8)
        Fail("SIZE is not 1, 2, 4 or 8");
    } else if (key == "TYPE") {
      if (word != "F" && word != "I" && word != "U") Fail("TYPE is not F, I or U");
      field->type = word[0];
    } else {
      field->count = Whole(word);
      if (field->count > kMaxCount) Fail("COUNT is absurd");
    }
  }

  void Finish() {
    for (Field& field : header_.fields) {
      field.offset = header_.row_bytes;
      header_.row_bytes += field.size * field.count;
      header_.row_values += field.count;
      if (field.type == 'F' && field.size < 4)
        FailFile(path_, "a field of TYPE F has SIZE " + std::to_string(field.size));
    }
    if (!has_points_) {
      if (height_ != 0 && width_ > bytes_.size() / height_) FailTooMany(width_, height_);
      header_.points = width_ * height_;
    }
  }

  [[noreturn]] void FailTooMany(std::size_t width, std::size_t height) const {
    FailFile(path_, "is truncated: its header promises " + std::to_string(width) + " x " +
                        std::to_string(height) + " points");
  }

  const std::filesystem::path& path_;
  std::string_view bytes_;
  Header header_;
  std::size_t line_ = 0, width_ = 0, height_ = 1;
  bool has_points_ = false;
};

static_assert(std::endian::native == std::endian::little, "PCD's binary data is little endian");

template <typename T>
double Decode(const char* data) {
  T value;
  std::memcpy(&value, data, sizeof(T));
  return static_cast<double>(value);
}

double Decode(const Field& field, const char* data) {
  switch (field.size) {
    case 1:
      return field.type == 'I' ? Decode<std::int8_t>(data) : Decode<std::uint8_t>(data);
    case 2:
      return field.type == 'I' ? Decode<std::int16_t>(data) : Decode<std::uint16_t>(data);
    case 4:
      if (field.type == 'F') return Decode<float>(data);
      return field.type == 'I' ? Decode<std::int32_t>(data) : Decode<std::uint32_t>(data);
    default:
      if (field.type == 'F') return Decode<double>(data);
      return field.type == 'I' ? Decode<std::int64_t>(data) : Decode<std::uint64_t>(data);
  }
}

// LZF (Lehmann): a control byte below 32 copies control + 1 literals; others repeat control / 32 + 2 earlier
// bytes (7: plus the next byte) from a distance of 13 bits. False where the data does not make `size` bytes.
bool DecompressLzf(std::string_view in, std::size_t size, std::string* out) {
  out->reserve(size);
  std::size_t at = 0;
  const auto byte = [&] { return static_cast<std::size_t>(static_cast<unsigned char>(in[at++])); };
  while (at < in.size()) {
    const std::size_t control = byte();
    if (control < 32) {
      if (in.size() - at < control + 1 || size - out->size() < control + 1) return false;
      out->append(in.substr(at, control + 1));
      at += control + 1;
      continue;
    }
    std::size_t length = control >> 5;
    if (length == 7) {
      if (at >= in.size()) return false;
      length += byte();
    }
    if (at >= in.size()) return false;
    const std::size_t distance = ((control & 31) << 8) + byte() + 1;
    if (distance > out->size() || size - out->size() < length + 2) return false;
    for (std::size_t k = 0; k < length + 2; ++k) out->push_back((*out)[out->size() - distance]);
  }
  return out->size() == size;
}

class BodyReader {
 public:
  BodyReader(const std::filesystem::path& path, std::string_view bytes, const Header& header)
      : path_(path), body_(bytes.substr(header.body)), header_(header) {
    const std::array<std::string, 3> names = {"x", "y", "z"};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto found = std::find_if(header.fields.begin(), header.fields.end(),
                                      [&](const Field& field) { return field.name == names[axis]; });
      if (found == header.fields.end() || found->count == 0)
        FailFile(path_, "has no field '" + names[axis] + "'");
      axes_[axis] = static_cast<std::size_t>(found - header.fields.begin());
    }
  }

  std::vector<Eigen::Vector3d> Read() const {
    if (header_.data == "ascii") return ReadText();
    if (header_.data == "binary") return ReadRows(body_);
    if (header_.data == "binary_compressed") return ReadCompressed();
    FailFile(path_, "DATA is not ascii, binary or binary_compressed");
  }

 private:
  [[noreturn]] void FailTruncated(std::size_t found) const {
    FailFile(path_, "is truncated: its header promises " + std::to_string(header_.points) + " points, " +
                        std::to_string(found) + " are there; copy or export it again");
  }

  std::vector<Eigen::Vector3d> ReadRows(std::string_view rows) const {
    if (header_.points > rows.size() / header_.row_bytes) FailTruncated(rows.size() / header_.row_bytes);
    std::vector<Eigen::Vector3d> points(header_.points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const Field& field = header_.fields[axes_[axis]];
        points[i][static_cast<Eigen::Index>(axis)] =
            Decode(field, rows.data() + i * header_.row_bytes + field.offset);
      }
    }
    return points;
  }

  // Two lengths of 4 bytes, then, compressed, all values of the first field, all of the second, and so on.
  std::vector<Eigen::Vector3d> ReadCompressed() const {
    if (header_.points == 0) return {};
    if (body_.size() < 8) FailTruncated(0);
    const auto packed = static_cast<std::size_t>(Decode<std::uint32_t>(body_.data()));
    const auto size = static_cast<std::size_t>(Decode<std::uint32_t>(body_.data() + 4));
    constexpr std::size_t kBestRatio = 132;  // LZF's: 264 bytes from 2 to 3
    std::string columns;
    if (packed > body_.size() - 8 || header_.points > size / header_.row_bytes ||
        size > packed * kBestRatio) {
      FailFile(path_, "is truncated or damaged: the lengths of its compressed data do not fit its " +
                          std::to_string(header_.points) + " points and its size; copy or export it again");
    }
    if (!DecompressLzf(body_.substr(8, packed), size, &columns))
      FailFile(path_, "its compressed data is damaged");
    std::vector<Eigen::Vector3d> points(header_.points);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Field& field = header_.fields[axes_[axis]];
      const char* const first = columns.data() + field.offset * header_.points;
      for (std::size_t i = 0; i < points.size(); ++i) {
        points[i][static_cast<Eigen::Index>(axis)] = Decode(field, first + i * field.size * field.count);
      }
    }
    return points;
  }

  std::vector<Eigen::Vector3d> ReadText() const {
    const std::size_t room = (body_.size() + 1) / (2 * header_.row_values);
    if (header_.points > room)
      FailFile(path_, "is truncated: its header promises " + std::to_string(header_.points) +
                          " points, the file has room for at most " + std::to_string(room) +
                          "; copy or export it again");
    std::vector<Eigen::Vector3d> points;
    points.reserve(header_.points);
    std::vector<double> values(header_.row_values);
    std::size_t at = 0, line = header_.body_line;
    while (points.size() < header_.points) {
      if (at >= body_.size()) FailTruncated(points.size());
      const std::size_t end = std::min(body_.find('\n', at), body_.size());
      const auto words = Words(body_.substr(at, end - at));
      at = end + 1;
      if (!words.empty()) points.push_back(ParseTextRow(words, line, &values));
      ++line;
    }
    return points;
  }

  Eigen::Vector3d ParseTextRow(const std::vector<std::string_view>& words, std::size_t line,
                               std::vector<double>* values) const {
    const std::string place = "line " + std::to_string(line) + ": ";
    if (words.size() < values->size()) {
      FailFile(path_, place + "has " + std::to_string(words.size()) + " values, expected " +
                          std::to_string(values->size()));
    }
    for (std::size_t k = 0; k < values->size(); ++k) {
      if (ParseNumber(words[k], &(*values)[k]) != words[k].size())
        FailFile(path_, place + "value " + std::to_string(k + 1) + " is not a number");
    }
    Eigen::Vector3d point;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::size_t column = 0;
      for (std::size_t k = 0; k < axes_[axis]; ++k) column += header_.fields[k].count;
      point[static_cast<Eigen::Index>(axis)] = (*values)[column];
    }
    return point;
  }

  const std::filesystem::path& path_;
  std::string_view body_;
  const Header& header_;
  std::array<std::size_t, 3> axes_ = {};  // the fields that hold x, y, z
};

}  // namespace

std::vector<Eigen::Vector3d> ParsePcd(const std::filesystem::path& path, std::string_view bytes) {
  const Header header = HeaderParser(path, bytes).Parse();
  return BodyReader(path, bytes, header).Read();
}

}  // namespace frond
