// SPDX-License-Identifier: BSD-3-Clause
#include "io/text_cloud.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "io/file_bytes.h"
#include "io/number_text.h"

namespace frond {
namespace {

constexpr char kBlanks = ' ';  // stands for any run of spaces and tabs
constexpr std::array<char, 4> kSeparators = {';', ',', '\t', kBlanks};
constexpr std::size_t kMaxHeaderLines = 1000;

std::string_view Trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

// Takes the next field off the front of `line`; false where there is none left.
bool TakeField(char separator, std::string_view* line, std::string_view* field) {
  if (line->data() == nullptr) return false;
  if (separator == kBlanks) {
    while (!line->empty() && (line->front() == ' ' || line->front() == '\t')) line->remove_prefix(1);
    if (line->empty()) return false;
    const std::size_t end = std::min(line->find_first_of(" \t"), line->size());
    *field = line->substr(0, end);
    line->remove_prefix(end);
    return true;
  }
  const std::size_t end = line->find(separator);
  *field = Trimmed(line->substr(0, end));
  *line = end == std::string_view::npos ? std::string_view() : line->substr(end + 1);
  return true;
}

std::vector<std::string_view> Fields(std::string_view line, char separator) {
  std::vector<std::string_view> fields;
  std::string_view field;
  while (TakeField(separator, &line, &field)) fields.push_back(field);
  return fields;
}

bool IsComment(std::string_view line) { return line.starts_with('#') || line.starts_with("//"); }

// A field without a value, as spreadsheets and statistics programs write it.
bool IsMissing(std::string_view field) {
  return field.empty() || field == "NA" || field == "N/A" || field == "null" || field == "NULL" ||
         field == "-";
}

bool ParseField(std::string_view field, double* value) {
  if (!field.empty() && ParseNumber(field, value) == field.size()) return true;
  *value = std::numeric_limits<double>::quiet_NaN();
  return IsMissing(field);
}

bool IsNumber(std::string_view field) {
  double value = 0;
  return !field.empty() && ParseNumber(field, &value) == field.size();
}

// Columns of x, y, z, counted from 0.
using Columns = std::array<std::size_t, 3>;

struct Header {
  std::string_view line;  // without its comment sign
  std::size_t number = 0;
  bool comment = false;
};

std::string PlainName(std::string_view field) {
  std::string name;
  for (const char c : field) {
    if (c != '"' && c != '\'') name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return name;
}

// The columns that a header line names x, y and z, if it names all three.
std::optional<Columns> NamedColumns(const std::vector<std::string_view>& names) {
  Columns columns = {};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string wanted(1, static_cast<char>('x' + axis));
    const auto found = std::find_if(names.begin(), names.end(),
                                    [&](std::string_view name) { return PlainName(name) == wanted; });
    if (found == names.end()) return std::nullopt;
    columns[axis] = static_cast<std::size_t>(found - names.begin());
  }
  return columns;
}

class TextCloudParser {
 public:
  TextCloudParser(const std::filesystem::path& path, std::string_view bytes)
      : path_(path), bytes_(bytes), rest_(bytes) {}

  std::vector<Eigen::Vector3d> Parse() {
    std::string_view line;
    if (!FindFirstRow(&line)) return ParsePlanar();
    std::vector<Eigen::Vector3d> rows;
    rows.reserve(rest_.size() / (line.size() + 1) + 16);
    const std::size_t last_column = *std::max_element(columns_.begin(), columns_.end());
    do {
      line = Trimmed(line);
      if (!line.empty() && !IsComment(line)) rows.push_back(ParseRow(line, last_column));
    } while (NextLine(&line));
    return rows;
  }

 private:
  [[noreturn]] void Fail(const std::string& message) const {
    FailFile(path_, "line " + std::to_string(line_) + ": " + message);
  }

  // Line ends are \n, \r\n or \r.
  bool NextLine(std::string_view* line) {
    if (rest_.empty()) return false;
    std::size_t end = 0;
    while (end < rest_.size() && rest_[end] != '\n' && rest_[end] != '\r') ++end;
    const std::size_t next = end + (rest_.substr(end).starts_with("\r\n") ? 2 : 1);
    *line = rest_.substr(0, end);
    rest_.remove_prefix(std::min(next, rest_.size()));
    ++line_;
    return true;
  }

  bool FindFirstRow(std::string_view* line) {
    while (NextLine(line)) {
      const std::string_view text = Trimmed(*line);
      if (text.empty()) continue;
      if (!IsComment(text) && DetectColumns(text)) return true;
      if (!IsComment(text)) RefuseDamagedRow(text);
      Header header{text, line_, IsComment(text)};
      while (header.line.starts_with('#') || header.line.starts_with('/')) header.line.remove_prefix(1);
      for (const char separator : kSeparators) {
        if (NamedColumns(Fields(header.line, separator))) header_ = header;
      }
      if (line_ > kMaxHeaderLines && !IsComment(text)) return false;
    }
    return false;
  }

  // Points of a plane: below the headers, every line holds x and y alone; z is 0.
  std::vector<Eigen::Vector3d> ParsePlanar() {
    rest_ = bytes_;
    line_ = 0;
    std::vector<Eigen::Vector3d> rows;
    std::string_view line;
    bool swapped = false;  // a header says y, x
    while (NextLine(&line)) {
      line = Trimmed(line);
      if (line.empty()) continue;
      Eigen::Vector3d point = Eigen::Vector3d::Zero();
      if (!IsComment(line) && ParsePlanarRow(line, rows.empty(), &point)) {
        if (swapped) std::swap(point.x(), point.y());
        rows.push_back(point);
      } else if (rows.empty()) {
        while (line.starts_with('#') || line.starts_with('/')) line.remove_prefix(1);
        for (const char separator : kSeparators) {
          const std::vector<std::string_view> names = Fields(line, separator);
          if (names.size() == 2 && PlainName(names[0]) == "y" && PlainName(names[1]) == "x") swapped = true;
        }
      } else if (!IsComment(line)) {
        Fail("does not hold two numbers as the lines above do; expected x, y in every line, or x, y, z");
      }
      if (rows.empty() && line_ > kMaxHeaderLines && !IsComment(line)) break;
    }
    if (rows.empty()) FailWithoutRows();
    return rows;
  }

  bool ParsePlanarRow(std::string_view line, bool first, Eigen::Vector3d* point) {
    for (const char separator : kSeparators) {
      if (!first && separator != separator_) continue;
      const std::vector<std::string_view> fields = Fields(line, separator);
      if (fields.size() != 2 || (first && !IsNumber(fields[0]))) continue;
      if (!ParseField(fields[0], &point->x()) || !ParseField(fields[1], &point->y())) continue;
      separator_ = separator;
      return true;
    }
    return false;
  }

  // A line above the first row is a header, unless it starts like a row: that is damage, not a name.
  void RefuseDamagedRow(std::string_view line) const {
    for (const char separator : kSeparators) {
      const std::vector<std::string_view> fields = Fields(line, separator);
      if (fields.size() < 3 || !IsNumber(fields[0])) continue;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        double value = 0;
        if (!ParseField(fields[axis], &value)) FailNotANumber(fields[axis], axis);
      }
    }
  }

  // Whether `line` is the first row of numbers, by some separator.
  bool DetectColumns(std::string_view line) {
    for (const char separator : kSeparators) {
      const std::vector<std::string_view> fields = Fields(line, separator);
      if (fields.size() < 3) continue;
      const Columns columns = header_ ? ColumnsFromHeader(fields.size(), separator) : Columns{0, 1, 2};
      double value = 0;
      if (!std::all_of(columns.begin(), columns.end(),
                       [&](std::size_t c) { return ParseField(fields[c], &value); }) ||
          std::none_of(fields.begin(), fields.end(), IsNumber)) {
        continue;
      }
      separator_ = separator;
      columns_ = columns;
      return true;
    }
    return false;
  }

  // A header names the columns if it has as many as the rows. One that starts with x, y, z needs not: the
  // rest may be unnamed. A comment that happens to hold the three words in other places says nothing.
  Columns ColumnsFromHeader(std::size_t row_fields, char separator) const {
    std::vector<std::string_view> names = Fields(header_->line, separator);
    std::optional<Columns> columns = NamedColumns(names);
    if (!columns) {  // "# x y z" above rows with commas
      names = Fields(header_->line, kBlanks);
      columns = NamedColumns(names);
    }
    const Columns first_three = {0, 1, 2};
    if (!columns || *columns == first_three) return first_three;
    if (names.size() == row_fields) return *columns;
    if (header_->comment) return first_three;
    Fail("has " + std::to_string(row_fields) + " values under the " + std::to_string(names.size()) +
         " column names of line " + std::to_string(header_->number) + "; remove or complete the header");
  }

  Eigen::Vector3d ParseRow(std::string_view line, std::size_t last_column) const {
    Eigen::Vector3d point;
    std::string_view field;
    for (std::size_t column = 0; column <= last_column; ++column) {
      if (!TakeField(separator_, &line, &field)) {
        Fail("has " + std::to_string(column) + " values, expected at least " +
             std::to_string(last_column + 1));
      }
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (columns_[axis] != column) continue;
        double value = 0;
        if (!ParseField(field, &value)) FailNotANumber(field, axis);
        point[static_cast<Eigen::Index>(axis)] = value;
      }
    }
    return point;
  }

  [[noreturn]] void FailNotANumber(std::string_view field, std::size_t axis) const {
    std::string word;
    for (const char c : field.substr(0, 40)) word += c >= ' ' && c <= '~' ? c : '?';
    const bool decimal_comma = field.find(',') != std::string_view::npos;
    Fail("'" + word + "' is not a number (" + static_cast<char>('x' + axis) + ")" +
         (decimal_comma ? "; write decimal points, not commas" : "; comments start with # or //"));
  }

  [[noreturn]] void FailWithoutRows() const {
    FailFile(
        path_,
        "no line holds three numbers, nor do all hold two; expected x, y, z or x, y with decimal points, "
        "separated by blanks, tabs, commas or semicolons");
  }

  const std::filesystem::path& path_;
  std::string_view bytes_, rest_;
  std::size_t line_ = 0;
  std::optional<Header> header_;
  char separator_ = kBlanks;
  Columns columns_ = {0, 1, 2};
};

}  // namespace

std::vector<Eigen::Vector3d> ParseTextCloud(const std::filesystem::path& path, std::string_view bytes) {
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);  // UTF-8 byte order mark
  const std::size_t zero = bytes.find('\0');
  if (zero != std::string_view::npos) {
    FailFile(path, "byte " + std::to_string(zero) + " is zero: a binary file, not text; check its extension");
  }
  return TextCloudParser(path, bytes).Parse();
}

}  // namespace frond
