// SPDX-License-Identifier: BSD-3-Clause
#include "io/surface_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/errors.h"
#include "io/file_bytes.h"
#include "io/length_unit.h"
#include "io/number_text.h"

namespace frond {
namespace {

using nlohmann::json;

constexpr const char* kSchema = "frond.nurbs_surface/1";
constexpr std::size_t kMaxCount = 100000;  // control points in one direction

void AppendNumbers(std::span<const double> numbers, std::string* text) {
  *text += '[';
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    if (k > 0) *text += ", ";
    AppendNumber(numbers[k], text);
  }
  *text += ']';
}

// "[[item, item, …],\n [item, …]]": one row of the net (all j of one i) a line.
template <typename AppendItem>
void AppendNet(const NurbsSurface& surface, const AppendItem& append_item, std::string* text) {
  *text += '[';
  for (int i = 0; i < surface.count_u(); ++i) {
    *text += i > 0 ? ",\n    [" : "\n    [";
    for (int j = 0; j < surface.count_v(); ++j) {
      if (j > 0) *text += ", ";
      append_item(i, j);
    }
    *text += ']';
  }
  *text += ']';
}

void AppendTrim(const std::vector<TrimLoop>& trim, std::string* text) {
  if (trim.empty()) {
    *text += "null";
    return;
  }
  *text += '[';
  for (std::size_t k = 0; k < trim.size(); ++k) {
    *text += k > 0 ? ",\n    [" : "\n    [";
    for (std::size_t i = 0; i < trim[k].size(); ++i) {
      if (i > 0) *text += ", ";
      AppendNumbers(std::array<double, 2>{trim[k][i].x(), trim[k][i].y()}, text);
    }
    *text += ']';
  }
  *text += ']';
}

// A value of the document and its JSON path, for messages.
class Place {
 public:
  Place(const json& value, const std::string& file, std::string path)
      : value_(value), file_(file), path_(std::move(path)) {}

  [[noreturn]] void Fail(const std::string& message) const {
    throw InputError(file_ + ": " + (path_.empty() ? "" : path_ + ": ") + message);
  }

  const json& value() const { return value_; }

  Place Member(const std::string& key) const {
    const auto found = value_.find(key);
    if (found == value_.end()) Fail("has no '" + key + "'");
    return {*found, file_, path_.empty() ? key : path_ + "." + key};
  }

  Place Item(std::size_t index) const {
    return {value_[index], file_, path_ + "[" + std::to_string(index) + "]"};
  }

  std::size_t ListSize(std::optional<std::size_t> expected = {}) const {
    if (!value_.is_array()) Fail("expected a list");
    if (expected && value_.size() != *expected) {
      Fail("has " + std::to_string(value_.size()) + " values, expected " + std::to_string(*expected));
    }
    return value_.size();
  }

  double Number() const {
    if (!value_.is_number()) Fail("expected a number");
    const double number = value_.get<double>();
    if (!std::isfinite(number)) Fail("is not finite");
    return number;
  }

  std::vector<double> Numbers(std::optional<std::size_t> expected = {}) const {
    std::vector<double> numbers(ListSize(expected));
    for (std::size_t k = 0; k < numbers.size(); ++k) numbers[k] = Item(k).Number();
    return numbers;
  }

 private:
  const json& value_;
  const std::string& file_;
  std::string path_;
};

BSplineBasis ParseBasis(const Place& root, std::size_t direction) {
  root.Member("degree").ListSize(2);
  root.Member("knots").ListSize(2);
  root.Member("periodic").ListSize(2);
  const Place degree = root.Member("degree").Item(direction);
  if (!degree.value().is_number_integer()) degree.Fail("expected an integer");
  const double value = degree.Number();
  if (value < 1 || value > kMaxDegree) {
    degree.Fail("is " + FormatNumber(value) + ", expected an integer in [1, " + std::to_string(kMaxDegree) +
                "]");
  }
  const Place periodic = root.Member("periodic").Item(direction);
  if (!periodic.value().is_boolean()) periodic.Fail("expected true or false");
  const Place knots = root.Member("knots").Item(direction);
  try {
    return BSplineBasis(static_cast<int>(value), knots.Numbers(), periodic.value().get<bool>());
  } catch (const InputError& error) {
    const std::string message = error.what();
    if (message.find(": knots[") != std::string::npos) throw;  // has its place already
    knots.Fail(message);
  }
}

std::vector<Eigen::Vector3d> ParseControlPoints(const Place& net, std::size_t count_u, std::size_t count_v) {
  std::vector<Eigen::Vector3d> points;
  net.ListSize(count_u);
  for (std::size_t i = 0; i < count_u; ++i) {
    const Place row = net.Item(i);
    row.ListSize(count_v);
    for (std::size_t j = 0; j < count_v; ++j) {
      const Place point = row.Item(j);
      point.ListSize(3);
      points.emplace_back(point.Item(0).Number(), point.Item(1).Number(), point.Item(2).Number());
    }
  }
  return points;
}

std::vector<double> ParseWeights(const Place& net, std::size_t count_u, std::size_t count_v) {
  std::vector<double> weights;
  net.ListSize(count_u);
  for (std::size_t i = 0; i < count_u; ++i) {
    const Place row = net.Item(i);
    for (std::size_t j = 0; j < row.ListSize(count_v); ++j) {
      weights.push_back(row.Item(j).Number());
      if (!(weights.back() > 0)) row.Item(j).Fail("a weight must be positive");
    }
  }
  return weights;
}

std::vector<TrimLoop> ParseTrim(const Place& trim) {
  std::vector<TrimLoop> loops;
  if (trim.value().is_null()) return loops;
  if (trim.ListSize() == 0) trim.Fail("has no loops; write null where the whole surface counts");
  for (std::size_t k = 0; k < trim.value().size(); ++k) {
    const Place loop = trim.Item(k);
    TrimLoop points;
    for (std::size_t i = 0; i < loop.ListSize(); ++i) {
      const Place point = loop.Item(i);
      point.ListSize(2);
      points.emplace_back(point.Item(0).Number(), point.Item(1).Number());
    }
    if (points.size() < 3) loop.Fail("a loop needs at least 3 points");
    loops.push_back(std::move(points));
  }
  return loops;
}

SurfaceDocument ParseDocument(const Place& root, const std::string& name) {
  if (!root.value().is_object()) root.Fail("expected a JSON object");
  const Place schema = root.Member("schema");
  if (schema.value() != kSchema) schema.Fail(std::string("expected \"") + kSchema + "\"");
  const Place unit = root.Member("unit");
  if (!unit.value().is_string()) unit.Fail("expected text");
  try {
    MetresPerUnit(unit.value().get<std::string>());
  } catch (const ConfigError& error) {
    unit.Fail(error.what());
  }
  BSplineBasis u = ParseBasis(root, 0), v = ParseBasis(root, 1);
  const auto count_u = static_cast<std::size_t>(u.num_control_points());
  const auto count_v = static_cast<std::size_t>(v.num_control_points());
  if (count_u > kMaxCount || count_v > kMaxCount) root.Member("knots").Fail("are too many");
  auto points = ParseControlPoints(root.Member("control_points"), count_u, count_v);
  auto weights = ParseWeights(root.Member("weights"), count_u, count_v);
  auto trim = ParseTrim(root.Member("trim"));
  try {
    NurbsSurface surface(std::move(u), std::move(v), std::move(points), std::move(weights));
    return {{std::move(surface), std::move(trim)}, unit.value().get<std::string>()};
  } catch (const InputError& error) {
    throw InputError(name + ": control_points: " + error.what());
  }
}

}  // namespace

std::string FormatSurfaceJson(const SurfaceDocument& document) {
  const NurbsSurface& s = document.trimmed.surface;
  MetresPerUnit(document.unit);  // throws unless known, hence plain text
  const auto flag = [](bool value) { return value ? "true" : "false"; };
  std::string text =
      std::string("{\n  \"schema\": \"") + kSchema + "\",\n  \"unit\": \"" + document.unit + "\",\n";
  text += "  \"degree\": [" + std::to_string(s.u().degree()) + ", " + std::to_string(s.v().degree()) + "],\n";
  text += std::string("  \"periodic\": [") + flag(s.u().periodic()) + ", " + flag(s.v().periodic()) + "],\n";
  text += "  \"knots\": [\n    ";
  AppendNumbers(s.u().knots(), &text);
  text += ",\n    ";
  AppendNumbers(s.v().knots(), &text);
  text += "],\n  \"control_points\": ";
  AppendNet(
      s,
      [&](int i, int j) {
        const Eigen::Vector3d& p = s.control_point(i, j);
        AppendNumbers(std::array<double, 3>{p.x(), p.y(), p.z()}, &text);
      },
      &text);
  text += ",\n  \"weights\": ";
  AppendNet(
      s, [&](int i, int j) { AppendNumber(s.weight(i, j), &text); }, &text);
  text += ",\n  \"trim\": ";
  AppendTrim(document.trimmed.trim, &text);
  return text + "\n}\n";
}

void WriteSurfaceJson(const std::filesystem::path& path, const SurfaceDocument& document) {
  WriteFileBytes(path, FormatSurfaceJson(document));
}

SurfaceDocument ParseSurfaceJson(std::string_view text, const std::string& name) {
  json document;
  try {
    document = json::parse(text);
  } catch (const json::parse_error& error) {
    throw InputError(name + ": byte " + std::to_string(error.byte) +
                     ": is not valid JSON (cut short or damaged?)");
  } catch (const json::exception&) {  // a number beyond the range of a double
    throw InputError(name + ": is not valid JSON (a number is out of range)");
  }
  return ParseDocument(Place(document, name, ""), name);
}

SurfaceDocument ReadSurfaceJson(const std::filesystem::path& path) {
  return ParseSurfaceJson(ReadFileBytes(path), path.string());
}

}  // namespace frond
