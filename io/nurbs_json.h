// SPDX-License-Identifier: BSD-3-Clause
// What surface.json and curve.json share; includes nlohmann's JSON: for io/*_json.cc only.
#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "models/bspline_basis.h"

namespace frond {

// A value of a document and its JSON path, for messages: "curve.json: control_points[3][1]: expected a
// number". All members throw InputError so.
class JsonPlace {
 public:
  JsonPlace(const nlohmann::json& value, const std::string& file, std::string path = "");

  [[noreturn]] void Fail(const std::string& message) const;
  const nlohmann::json& value() const { return value_; }

  JsonPlace Member(const std::string& key) const;
  JsonPlace Item(std::size_t index) const;
  std::size_t ListSize(std::optional<std::size_t> expected = {}) const;
  double Number() const;  // finite
  std::vector<double> Numbers() const;

 private:
  const nlohmann::json& value_;
  const std::string& file_;
  std::string path_;
};

// The document of a text; `name` is how messages call it. Throws InputError with the byte where it ends to be
// JSON.
nlohmann::json ParseJsonText(std::string_view text, const std::string& name);

// An object of this schema.
void CheckSchema(const JsonPlace& root, const std::string& schema);
// A known unit of length.
std::string ParseUnit(const JsonPlace& root);
BSplineBasis ParseBasis(const JsonPlace& degree, const JsonPlace& knots, const JsonPlace& periodic);
Eigen::Vector3d ParsePoint(const JsonPlace& place);
double ParseWeight(const JsonPlace& place);  // positive

// "[1, 2.5]", all digits.
void AppendNumbers(std::span<const double> numbers, std::string* text);
void AppendPoint(const Eigen::Vector3d& point, std::string* text);

}  // namespace frond
