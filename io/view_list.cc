// SPDX-License-Identifier: BSD-3-Clause
#include "io/view_list.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "base/errors.h"
#include "base/options.h"
#include "io/file_bytes.h"
#include "io/number_text.h"

namespace frond {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kSameAngle = 1e-6;  // degrees

std::string_view Trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\"";  // quotes about a name too
  while (!text.empty() && kBlanks.find(text.front()) != std::string_view::npos) text.remove_prefix(1);
  while (!text.empty() && kBlanks.find(text.back()) != std::string_view::npos) text.remove_suffix(1);
  return text;
}

std::vector<std::string> Fields(std::string_view line) {
  std::vector<std::string> fields;
  for (;;) {
    const std::size_t end = line.find(',');
    fields.emplace_back(Trimmed(line.substr(0, end)));
    if (end == std::string_view::npos) return fields;
    line.remove_prefix(end + 1);
  }
}

std::string PlaceOf(const std::filesystem::path& file, std::size_t line) {
  return file.string() + ":" + std::to_string(line);
}

// The rows of a list by its columns' names.
class ListReader {
 public:
  // `optional` columns may be missing.
  ListReader(const std::filesystem::path& path, const std::vector<std::string>& columns,
             const std::vector<std::string>& optional)
      : path_(path) {
    std::vector<std::string> known = columns;
    known.insert(known.end(), optional.begin(), optional.end());
    const std::string bytes = ReadFileBytes(path);
    std::string_view rest = bytes;
    if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);  // UTF-8 byte order mark
    for (std::size_t line = 1; !rest.empty(); ++line) {
      const std::size_t end = rest.find('\n');
      const std::string_view text = Trimmed(rest.substr(0, end));
      rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
      if (text.empty() || text.starts_with('#')) continue;
      if (names_.empty()) {
        names_ = Fields(text);
        CheckNames(line, columns, known);
        continue;
      }
      std::vector<std::string> fields = Fields(text);
      if (fields.size() != names_.size()) {
        Fail(line, "has " + std::to_string(fields.size()) + " values under a header of " +
                       std::to_string(names_.size()) + "; separate them by commas");
      }
      rows_.push_back({std::move(fields), line});
    }
    if (names_.empty()) FailFile(path, "is empty; its first line is '" + Joined(columns) + "'");
    if (rows_.empty()) FailFile(path, "lists no image below its header");
  }

  std::size_t size() const { return rows_.size(); }
  std::size_t Line(std::size_t row) const { return rows_[row].line; }

  [[noreturn]] void Fail(std::size_t line, const std::string& message) const {
    throw InputError(PlaceOf(path_, line) + ": " + message);
  }

  // "" where the column is missing.
  std::string Text(std::size_t row, const std::string& column) const {
    const auto found = std::find(names_.begin(), names_.end(), column);
    if (found == names_.end()) return "";
    return rows_[row].fields[static_cast<std::size_t>(found - names_.begin())];
  }

  // Of a file that is there; empty where the field is and may be.
  std::filesystem::path File(std::size_t row, const std::string& column, bool required) const {
    const std::string text = Text(row, column);
    if (text.empty()) {
      if (required) Fail(Line(row), "names no file under '" + column + "'");
      return {};
    }
    const std::filesystem::path file = path_.parent_path() / text;  // an absolute path stays
    std::error_code error;
    if (!std::filesystem::exists(file, error)) {
      Fail(Line(row), "no such file: " + file.string() + "; paths start at the list's folder");
    }
    return file;
  }

 private:
  struct Row {
    std::vector<std::string> fields;
    std::size_t line = 0;
  };

  static std::string Joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ",") + word;
    return text;
  }

  void CheckNames(std::size_t line, const std::vector<std::string>& required,
                  const std::vector<std::string>& known) const {
    for (const std::string& name : names_) {
      if (std::find(known.begin(), known.end(), name) != known.end()) continue;
      const std::string nearest = NearestWord(name, known);
      Fail(line, "unknown column '" + name + "'" +
                     (nearest.empty() ? "" : " (did you mean '" + nearest + "'?)") + "; the columns are " +
                     Joined(known));
    }
    for (const std::string& name : required) {
      if (std::find(names_.begin(), names_.end(), name) == names_.end()) {
        Fail(line, "has no column '" + name + "'; the columns are " + Joined(known));
      }
    }
  }

  std::filesystem::path path_;
  std::vector<std::string> names_;
  std::vector<Row> rows_;
};

// Radians.
std::optional<double> Angle(const ListReader& list, std::size_t row) {
  const std::string text = list.Text(row, "angle");
  if (text.empty()) return std::nullopt;
  double degrees = 0;
  if (ParseNumber(text, &degrees) != text.size() || !std::isfinite(degrees)) {
    list.Fail(list.Line(row), "the angle '" + text + "' is not a number of degrees");
  }
  return degrees * kDegree;
}

void RefuseRepeatedAngles(const ViewList& views, const ListReader& list) {
  for (std::size_t i = 0; i < views.views.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const double turn = std::remainder((*views.views[i].angle - *views.views[k].angle) / kDegree, 360);
      if (std::abs(turn) < kSameAngle) {
        list.Fail(views.views[i].line, "the same angle as in line " + std::to_string(views.views[k].line) +
                                           " (modulo 360); keep one of the two");
      }
    }
  }
}

}  // namespace

std::string ViewList::Place(std::size_t view) const { return PlaceOf(file, views[view].line); }

std::string ImagePairList::Place(std::size_t pair) const { return PlaceOf(file, pairs[pair].line); }

ViewList ReadViewList(const std::filesystem::path& path) {
  const ListReader list(path, {"image", "angle"}, {"mask"});
  ViewList views{path, {}};
  for (std::size_t row = 0; row < list.size(); ++row) {
    views.views.push_back(
        {list.File(row, "image", true), Angle(list, row), list.File(row, "mask", false), list.Line(row)});
    if (!views.views.back().angle) {
      list.Fail(list.Line(row), "a view of the object needs its angle, in degrees");
    }
  }
  RefuseRepeatedAngles(views, list);
  return views;
}

ViewList ReadBoardViews(const std::filesystem::path& path) {
  const ListReader list(path, {"image"}, {"angle"});
  ViewList views{path, {}};
  for (std::size_t row = 0; row < list.size(); ++row) {
    views.views.push_back({list.File(row, "image", true), Angle(list, row), {}, list.Line(row)});
  }
  return views;
}

ImagePairList ReadImagePairs(const std::filesystem::path& path) {
  const ListReader list(path, {"left", "right"}, {});
  ImagePairList pairs{path, {}};
  for (std::size_t row = 0; row < list.size(); ++row) {
    pairs.pairs.push_back({list.File(row, "left", true), list.File(row, "right", true), list.Line(row)});
  }
  return pairs;
}

}  // namespace frond
