// SPDX-License-Identifier: BSD-3-Clause
#include "io/surface_json.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "base/errors.h"
#include "io/file_bytes.h"
#include "io/length_unit.h"
#include "io/number_text.h"
#include "io/nurbs_json.h"

namespace frond {
namespace {

constexpr const char* kSchema = "frond.nurbs_surface/1";
constexpr std::size_t kMaxCount = 100000;  // control points in one direction

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

BSplineBasis ParseBasis(const JsonPlace& root, std::size_t direction) {
  const JsonPlace degree = root.Member("degree"), knots = root.Member("knots"),
                  periodic = root.Member("periodic");
  degree.ListSize(2);
  knots.ListSize(2);
  periodic.ListSize(2);
  return ParseBasis(degree.Item(direction), knots.Item(direction), periodic.Item(direction));
}

std::vector<Eigen::Vector3d> ParseControlPoints(const JsonPlace& net, std::size_t count_u,
                                                std::size_t count_v) {
  std::vector<Eigen::Vector3d> points;
  net.ListSize(count_u);
  for (std::size_t i = 0; i < count_u; ++i) {
    const JsonPlace row = net.Item(i);
    row.ListSize(count_v);
    for (std::size_t j = 0; j < count_v; ++j) {
      points.push_back(ParsePoint(row.Item(j)));
    }
  }
  return points;
}

std::vector<double> ParseWeights(const JsonPlace& net, std::size_t count_u, std::size_t count_v) {
  std::vector<double> weights;
  net.ListSize(count_u);
  for (std::size_t i = 0; i < count_u; ++i) {
    const JsonPlace row = net.Item(i);
    for (std::size_t j = 0; j < row.ListSize(count_v); ++j) {
      weights.push_back(ParseWeight(row.Item(j)));
    }
  }
  return weights;
}

std::vector<TrimLoop> ParseTrim(const JsonPlace& trim) {
  std::vector<TrimLoop> loops;
  if (trim.value().is_null()) return loops;
  if (trim.ListSize() == 0) trim.Fail("has no loops; write null where the whole surface counts");
  for (std::size_t k = 0; k < trim.value().size(); ++k) {
    const JsonPlace loop = trim.Item(k);
    TrimLoop points;
    for (std::size_t i = 0; i < loop.ListSize(); ++i) {
      const JsonPlace point = loop.Item(i);
      point.ListSize(2);
      points.emplace_back(point.Item(0).Number(), point.Item(1).Number());
    }
    if (points.size() < 3) loop.Fail("a loop needs at least 3 points");
    loops.push_back(std::move(points));
  }
  return loops;
}

SurfaceDocument ParseDocument(const JsonPlace& root, const std::string& name) {
  CheckSchema(root, kSchema);
  std::string unit = ParseUnit(root);
  BSplineBasis u = ParseBasis(root, 0), v = ParseBasis(root, 1);
  const auto count_u = static_cast<std::size_t>(u.num_control_points());
  const auto count_v = static_cast<std::size_t>(v.num_control_points());
  if (count_u > kMaxCount || count_v > kMaxCount) root.Member("knots").Fail("are too many");
  auto points = ParseControlPoints(root.Member("control_points"), count_u, count_v);
  auto weights = ParseWeights(root.Member("weights"), count_u, count_v);
  auto trim = ParseTrim(root.Member("trim"));
  try {
    NurbsSurface surface(std::move(u), std::move(v), std::move(points), std::move(weights));
    return {{std::move(surface), std::move(trim)}, std::move(unit)};
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
      s, [&](int i, int j) { AppendPoint(s.control_point(i, j), &text); }, &text);
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
  const nlohmann::json document = ParseJsonText(text, name);
  return ParseDocument(JsonPlace(document, name), name);
}

SurfaceDocument ReadSurfaceJson(const std::filesystem::path& path) {
  return ParseSurfaceJson(ReadFileBytes(path), path.string());
}

}  // namespace frond
