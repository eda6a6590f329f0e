// SPDX-License-Identifier: BSD-3-Clause
#include "io/ply_header.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "io/file_bytes.h"

namespace frond {
namespace {

constexpr std::size_t kMaxHeader = std::size_t{1} << 20;

constexpr std::array<std::pair<std::string_view, PlyType>, 16> kTypeNames = {{{"char", PlyType::kInt8},
                                                                              {"uchar", PlyType::kUint8},
                                                                              {"short", PlyType::kInt16},
                                                                              {"ushort", PlyType::kUint16},
                                                                              {"int", PlyType::kInt32},
                                                                              {"uint", PlyType::kUint32},
                                                                              {"float", PlyType::kFloat},
                                                                              {"double", PlyType::kDouble},
                                                                              {"int8", PlyType::kInt8},
                                                                              {"uint8", PlyType::kUint8},
                                                                              {"int16", PlyType::kInt16},
                                                                              {"uint16", PlyType::kUint16},
                                                                              {"int32", PlyType::kInt32},
                                                                              {"uint32", PlyType::kUint32},
                                                                              {"float32", PlyType::kFloat},
                                                                              {"float64", PlyType::kDouble}}};

std::vector<std::string_view> Words(std::string_view line) {
  std::vector<std::string_view> words;
  std::size_t at = 0;
  while ((at = line.find_first_not_of(" \t", at)) != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(" \t", at), line.size());
    words.push_back(line.substr(at, end - at));
    at = end;
  }
  return words;
}

// A word of a damaged file, safe to print in one line.
std::string Printable(std::string_view word) {
  std::string text;
  for (const char c : word.substr(0, 40)) text += c >= ' ' && c <= '~' ? c : '?';
  return text;
}

class HeaderParser {
 public:
  HeaderParser(const std::filesystem::path& path, std::string_view bytes) : path_(path), bytes_(bytes) {}

  PlyHeader Parse() {
    if (NextLine() != "ply") FailFile(path_, "is not a PLY file (its first line is not 'ply')");
    bool has_format = false;
    for (;;) {
      const std::vector<std::string_view> words = Words(NextLine());
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
      if (words[0] == "end_header") break;
      if (words[0] == "format") {
        ParseFormat(words);
        has_format = true;
      } else if (words[0] == "element") {
        ParseElement(words);
      } else if (words[0] == "property") {
        ParseProperty(words);
      } else {
        Fail("unknown PLY header line '" + Printable(words[0]) + "'");
      }
    }
    if (!has_format) FailFile(path_, "the PLY header has no format line");
    header_.body = at_;
    header_.body_line = line_ + 1;
    return std::move(header_);
  }

 private:
  [[noreturn]] void Fail(const std::string& message) const {
    FailFile(path_, "line " + std::to_string(line_) + ": " + message);
  }

  std::string_view NextLine() {
    const std::size_t end = bytes_.find('\n', at_);
    if (at_ >= bytes_.size() || end == std::string_view::npos || end > kMaxHeader) {
      if (line_ == 0) FailFile(path_, "is not a PLY file (its first line is not 'ply')");
      FailFile(path_, "the PLY header has no end_header line");
    }
    std::string_view line = bytes_.substr(at_, end - at_);
    if (line.ends_with('\r')) line.remove_suffix(1);
    at_ = end + 1;
    ++line_;
    return line;
  }

  void ParseFormat(const std::vector<std::string_view>& words) {
    if (words.size() < 2) Fail("the format line names no format");
    if (words[1] == "ascii") {
      header_.format = PlyFormat::kAscii;
    } else if (words[1] == "binary_little_endian") {
      header_.format = PlyFormat::kLittleEndian;
    } else if (words[1] == "binary_big_endian") {
      header_.format = PlyFormat::kBigEndian;
    } else {
      Fail("unknown PLY format '" + Printable(words[1]) + "'");
    }
  }

  void ParseElement(const std::vector<std::string_view>& words) {
    PlyElement element;
    if (words.size() == 3) {
      const char* const last = words[2].data() + words[2].size();
      const auto result = std::from_chars(words[2].data(), last, element.count);
      if (result.ec == std::errc() && result.ptr == last) {
        element.name = words[1];
        header_.elements.push_back(std::move(element));
        return;
      }
    }
    Fail("expected 'element NAME COUNT' with a whole, not negative COUNT");
  }

  PlyType ParseType(std::string_view word) const {
    for (const auto& [name, type] : kTypeNames) {
      if (word == name) return type;
    }
    Fail("unknown PLY type '" + Printable(word) + "'");
  }

  void ParseProperty(const std::vector<std::string_view>& words) {
    if (header_.elements.empty()) Fail("a property before any element");
    PlyProperty property;
    if (words.size() == 5 && words[1] == "list") {
      property.list_count = ParseType(words[2]);
      property.type = ParseType(words[3]);
      if (*property.list_count >= PlyType::kFloat) Fail("the length of a list must be a whole number");
    } else if (words.size() == 3) {
      property.type = ParseType(words[1]);
    } else {
      Fail("expected 'property TYPE NAME' or 'property list TYPE TYPE NAME'");
    }
    property.name = words.back();
    PlyElement& element = header_.elements.back();
    if (element.Find(property.name) < element.properties.size()) {
      Fail("property '" + Printable(property.name) + "' stands twice in one element");
    }
    element.properties.push_back(std::move(property));
  }

  const std::filesystem::path& path_;
  std::string_view bytes_;
  std::size_t at_ = 0, line_ = 0;
  PlyHeader header_;
};

// The fewest bytes of one row: lists empty; in text a digit and a separator for each value.
std::size_t SmallestRow(const PlyElement& element, PlyFormat format) {
  std::size_t size = 0;
  for (const PlyProperty& property : element.properties) {
    size += format == PlyFormat::kAscii ? 2 : PlySize(property.list_count.value_or(property.type));
  }
  return std::max<std::size_t>(size, 1);
}

}  // namespace

std::size_t PlySize(PlyType type) {
  constexpr std::array<std::size_t, 8> kSizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

std::size_t PlyElement::Find(std::string_view property) const {
  const auto found = std::find_if(properties.begin(), properties.end(),
                                  [&](const PlyProperty& p) { return p.name == property; });
  return static_cast<std::size_t>(found - properties.begin());
}

PlyHeader ParsePlyHeader(const std::filesystem::path& path, std::string_view bytes) {
  PlyHeader header = HeaderParser(path, bytes).Parse();
  std::uint64_t room = bytes.size() - header.body + 1;  // + 1: text may lack its last line end
  for (const PlyElement& element : header.elements) {
    const std::uint64_t row = SmallestRow(element, header.format);
    if (element.count > room / row) {
      const std::string what = element.name == "vertex" ? "points" : "'" + Printable(element.name) + "' rows";
      FailFile(path, "is truncated: its header promises " + std::to_string(element.count) + " " + what +
                         ", the file has room for at most " + std::to_string(room / row) +
                         "; copy or export it again");
    }
    room -= element.count * row;
  }
  return header;
}

}  // namespace frond
