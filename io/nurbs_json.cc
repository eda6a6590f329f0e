// SPDX-License-Identifier: BSD-3-Clause
#include "io/nurbs_json.h"

#include <array>
#include <cmath>
#include <utility>

#include "base/errors.h"
#include "io/length_unit.h"
#include "io/number_text.h"

namespace frond {

using nlohmann::json;

JsonPlace::JsonPlace(const json& value, const std::string& file, std::string path)
    : value_(value), file_(file), path_(std::move(path)) {}

void JsonPlace::Fail(const std::string& message) const {
  throw InputError(file_ + ": " + (path_.empty() ? "" : path_ + ": ") + message);
}

JsonPlace JsonPlace::Member(const std::string& key) const {
  const auto found = value_.find(key);
  if (found == value_.end()) Fail("has no '" + key + "'");
  return {*found, file_, path_.empty() ? key : path_ + "." + key};
}

JsonPlace JsonPlace::Item(std::size_t index) const {
  return {value_[index], file_, path_ + "[" + std::to_string(index) + "]"};
}

std::size_t JsonPlace::ListSize(std::optional<std::size_t> expected) const {
  if (!value_.is_array()) Fail("expected a list");
  if (expected && value_.size() != *expected) {
    Fail("has " + std::to_string(value_.size()) + " values, expected " + std::to_string(*expected));
  }
  return value_.size();
}

double JsonPlace::Number() const {
  if (!value_.is_number()) Fail("expected a number");
  const double number = value_.get<double>();
  if (!std::isfinite(number)) Fail("is not finite");
  return number;
}

std::vector<double> JsonPlace::Numbers() const {
  std::vector<double> numbers(ListSize());
  for (std::size_t k = 0; k < numbers.size(); ++k) numbers[k] = Item(k).Number();
  return numbers;
}

json ParseJsonText(std::string_view text, const std::string& name) {
  try {
    return json::parse(text);
  } catch (const json::parse_error& error) {
    throw InputError(name + ": byte " + std::to_string(error.byte) +
                     ": is not valid JSON (cut short or damaged?)");
  } catch (const json::exception&) {  // a number beyond the range of a double
    throw InputError(name + ": is not valid JSON (a number is out of range)");
  }
}

void CheckSchema(const JsonPlace& root, const std::string& schema) {
  if (!root.value().is_object()) root.Fail("expected a JSON object");
  const JsonPlace found = root.Member("schema");
  if (found.value() != schema) found.Fail("expected \"" + schema + "\"");
}

std::string ParseUnit(const JsonPlace& root) {
  const JsonPlace unit = root.Member("unit");
  if (!unit.value().is_string()) unit.Fail("expected text");
  auto name = unit.value().get<std::string>();
  try {
    MetresPerUnit(name);
  } catch (const ConfigError& error) {
    unit.Fail(error.what());
  }
  return name;
}

BSplineBasis ParseBasis(const JsonPlace& degree, const JsonPlace& knots, const JsonPlace& periodic) {
  if (!degree.value().is_number_integer()) degree.Fail("expected an integer");
  const double value = degree.Number();
  if (value < 1 || value > kMaxDegree) {
    degree.Fail("is " + FormatNumber(value) + ", expected an integer in [1, " + std::to_string(kMaxDegree) +
                "]");
  }
  if (!periodic.value().is_boolean()) periodic.Fail("expected true or false");
  std::vector<double> numbers = knots.Numbers();
  try {
    return BSplineBasis(static_cast<int>(value), std::move(numbers), periodic.value().get<bool>());
  } catch (const InputError& error) {
    knots.Fail(error.what());
  }
}

Eigen::Vector3d ParsePoint(const JsonPlace& place) {
  place.ListSize(3);
  return {place.Item(0).Number(), place.Item(1).Number(), place.Item(2).Number()};
}

double ParseWeight(const JsonPlace& place) {
  const double weight = place.Number();
  if (!(weight > 0)) place.Fail("a weight must be positive");
  return weight;
}

void AppendNumbers(std::span<const double> numbers, std::string* text) {
  *text += '[';
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    if (k > 0) *text += ", ";
    AppendNumber(numbers[k], text);
  }
  *text += ']';
}

void AppendPoint(const Eigen::Vector3d& point, std::string* text) {
  AppendNumbers(std::array<double, 3>{point.x(), point.y(), point.z()}, text);
}

}  // namespace frond
