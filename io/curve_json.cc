// SPDX-License-Identifier: BSD-3-Clause
#include "io/curve_json.h"

#include <utility>
#include <vector>

#include "base/errors.h"
#include "io/file_bytes.h"
#include "io/length_unit.h"
#include "io/nurbs_json.h"

namespace frond {
namespace {

constexpr const char* kSchema = "frond.nurbs_curve/1";

CurveDocument ParseDocument(const JsonPlace& root, const std::string& name) {
  CheckSchema(root, kSchema);
  std::string unit = ParseUnit(root);
  BSplineBasis basis = ParseBasis(root.Member("degree"), root.Member("knots"), root.Member("periodic"));
  const auto count = static_cast<std::size_t>(basis.num_control_points());
  const JsonPlace points = root.Member("control_points"), weights = root.Member("weights");
  points.ListSize(count);
  weights.ListSize(count);
  std::vector<Eigen::Vector3d> control_points;
  std::vector<double> numbers;
  for (std::size_t i = 0; i < count; ++i) {
    control_points.push_back(ParsePoint(points.Item(i)));
    numbers.push_back(ParseWeight(weights.Item(i)));
  }
  try {
    return {NurbsCurve(std::move(basis), std::move(control_points), std::move(numbers)), std::move(unit)};
  } catch (const InputError& error) {
    throw InputError(name + ": control_points: " + error.what());
  }
}

}  // namespace

std::string FormatCurveJson(const CurveDocument& document) {
  const NurbsCurve& curve = document.curve;
  MetresPerUnit(document.unit);  // throws unless known, hence plain text
  std::string text =
      std::string("{\n  \"schema\": \"") + kSchema + "\",\n  \"unit\": \"" + document.unit + "\",\n";
  text += "  \"degree\": " + std::to_string(curve.basis().degree()) + ",\n";
  text += std::string("  \"periodic\": ") + (curve.basis().periodic() ? "true" : "false") + ",\n";
  text += "  \"knots\": ";
  AppendNumbers(curve.basis().knots(), &text);
  text += ",\n  \"control_points\": [";
  for (std::size_t i = 0; i < curve.control_points().size(); ++i) {
    text += i > 0 ? ",\n    " : "\n    ";
    AppendPoint(curve.control_points()[i], &text);
  }
  text += "],\n  \"weights\": ";
  AppendNumbers(curve.weights(), &text);
  return text + "\n}\n";
}

void WriteCurveJson(const std::filesystem::path& path, const CurveDocument& document) {
  WriteFileBytes(path, FormatCurveJson(document));
}

CurveDocument ParseCurveJson(std::string_view text, const std::string& name) {
  const nlohmann::json document = ParseJsonText(text, name);
  return ParseDocument(JsonPlace(document, name), name);
}

bool IsCurveJson(const std::filesystem::path& path) {
  const nlohmann::json document = ParseJsonText(ReadFileBytes(path), path.string());
  return document.is_object() && document.contains("schema") && document["schema"] == kSchema;
}

CurveDocument ReadCurveJson(const std::filesystem::path& path) {
  return ParseCurveJson(ReadFileBytes(path), path.string());
}

}  // namespace frond
