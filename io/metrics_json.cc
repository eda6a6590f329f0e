// SPDX-License-Identifier: BSD-3-Clause
#include "io/metrics_json.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "io/file_bytes.h"
#include "io/number_text.h"

namespace frond {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kSchema = "frond.metrics/1";

Json ToJson(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json ToJson(const MetricValue& value) {
  if (const auto* number = std::get_if<double>(&value)) return ToJson(*number);
  if (const auto* list = std::get_if<std::vector<double>>(&value)) {
    Json array = Json::array();
    for (const double x : *list) array.push_back(ToJson(x));
    return array;
  }
  return std::visit([](const auto& other) { return Json(other); }, value);
}

Json ToJson(const MetricTable& table) {
  Json object = Json::object();
  for (const auto& [name, value] : table.entries()) object[name] = ToJson(value);
  return object;
}

double NumberOf(const Json& value) {
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

MetricValue ListOf(const Json& value) {
  const auto all = [&](auto test) { return std::all_of(value.begin(), value.end(), test); };
  if (all([](const Json& x) { return x.is_number_integer(); })) return value.get<std::vector<std::int64_t>>();
  if (all([](const Json& x) { return x.is_string(); })) return value.get<std::vector<std::string>>();
  std::vector<double> numbers;
  for (const Json& x : value) numbers.push_back(NumberOf(x));
  return numbers;
}

MetricTable TableOf(const Json& object) {
  MetricTable table;
  for (const auto& [name, value] : object.items()) {
    if (value.is_boolean()) {
      table.Set(name, value.get<bool>());
    } else if (value.is_number_integer()) {
      table.Set(name, value.get<std::int64_t>());
    } else if (value.is_string()) {
      table.Set(name, value.get<std::string>());
    } else if (value.is_array()) {
      table.Set(name, ListOf(value));
    } else {
      table.Set(name, NumberOf(value));
    }
  }
  return table;
}

RunMetrics MetricsOf(const Json& json) {
  if (json.at("schema") != kSchema) throw InputError(std::string("schema: expected \"") + kSchema + "\"");
  RunMetrics m;
  m.problem = json.at("problem");
  m.status = json.at("status");
  if (!json.at("error").is_null()) m.error = json.at("error").get<std::string>();
  m.unit = json.at("unit");
  const Json& input = json.at("input");
  m.input = {input.at("path"), input.at("sha256"), input.at("points")};
  m.metrics = TableOf(json.at("metrics"));
  const Json& solver = json.at("solver");
  m.solver.name = solver.at("name");
  m.solver.termination = solver.at("termination");
  m.solver.objective = NumberOf(solver.at("objective"));
  m.solver.evaluations = solver.at("evaluations");
  m.solver.residual_evaluations = solver.at("residual_evaluations");
  m.solver.jacobian_evaluations = solver.at("jacobian_evaluations");
  m.solver.iterations = solver.at("iterations");
  m.solver.seconds = NumberOf(solver.at("seconds"));
  for (const Json& stage : json.at("stages"))
    m.stages.push_back({stage.at("name"), NumberOf(stage.at("seconds"))});
  m.seconds = NumberOf(json.at("seconds"));
  m.peak_rss_bytes = json.at("peak_rss_bytes");
  m.threads = json.at("threads");
  m.seed = json.at("seed");
  m.versions = TableOf(json.at("versions"));
  return m;
}

std::string CsvField(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string CsvField(const MetricValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return CsvField(*text);
  if (const auto* number = std::get_if<double>(&value)) return FormatNumber(*number);
  return CsvField(ToJson(value).dump());
}

}  // namespace

void MetricTable::Set(const std::string& name, MetricValue value) {
  const auto found =
      std::find_if(entries_.begin(), entries_.end(), [&](const auto& entry) { return entry.first == name; });
  if (found == entries_.end()) {
    entries_.emplace_back(name, std::move(value));
  } else {
    found->second = std::move(value);
  }
}

const MetricValue* MetricTable::Find(const std::string& name) const {
  const auto found =
      std::find_if(entries_.begin(), entries_.end(), [&](const auto& entry) { return entry.first == name; });
  return found == entries_.end() ? nullptr : &found->second;
}

double MetricTable::Number(const std::string& name) const {
  const MetricValue* const value = Find(name);
  if (value != nullptr) {
    if (const auto* number = std::get_if<double>(value)) return *number;
    if (const auto* whole = std::get_if<std::int64_t>(value)) return static_cast<double>(*whole);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

std::string FormatMetricsJson(const RunMetrics& m) {
  Json json;
  json["schema"] = kSchema;
  json["problem"] = m.problem;
  json["status"] = m.status;
  json["error"] = m.error ? Json(*m.error) : Json(nullptr);
  json["unit"] = m.unit;
  json["input"]["path"] = m.input.path;
  json["input"]["sha256"] = m.input.sha256;
  json["input"]["points"] = m.input.points;
  json["metrics"] = ToJson(m.metrics);
  Json& solver = json["solver"];
  solver["name"] = m.solver.name;
  solver["termination"] = m.solver.termination;
  solver["objective"] = ToJson(m.solver.objective);
  solver["evaluations"] = m.solver.evaluations;
  solver["residual_evaluations"] = m.solver.residual_evaluations;
  solver["jacobian_evaluations"] = m.solver.jacobian_evaluations;
  solver["iterations"] = m.solver.iterations;
  solver["seconds"] = ToJson(m.solver.seconds);
  json["stages"] = Json::array();
  for (const RunMetrics::Stage& stage : m.stages) {
    Json entry;
    entry["name"] = stage.name;
    entry["seconds"] = ToJson(stage.seconds);
    json["stages"].push_back(std::move(entry));
  }
  json["seconds"] = ToJson(m.seconds);
  json["peak_rss_bytes"] = m.peak_rss_bytes;
  json["threads"] = m.threads;
  json["seed"] = m.seed;
  json["versions"] = ToJson(m.versions);
  // Paths may hold bytes that are not UTF-8: they become U+FFFD rather than an exception at a run's end.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void WriteMetricsJson(const std::filesystem::path& path, const RunMetrics& metrics) {
  WriteFileBytes(path, FormatMetricsJson(metrics));
}

RunMetrics ReadMetricsJson(const std::filesystem::path& path) {
  const std::string text = ReadFileBytes(path);
  try {
    return MetricsOf(Json::parse(text));
  } catch (const Json::parse_error& error) {
    FailFile(path, "byte " + std::to_string(error.byte) + ": is not valid JSON (cut short or damaged?)");
  } catch (const Json::exception& error) {
    FailFile(path, std::string("is not a metrics.json of frond: ") + error.what());
  } catch (const InputError& error) {
    FailFile(path, error.what());
  }
}

void WriteCsv(const std::filesystem::path& path, std::span<const std::string> columns,
              std::span<const std::vector<MetricValue>> rows) {
  std::string text;
  for (std::size_t k = 0; k < columns.size(); ++k) text += (k > 0 ? "," : "") + CsvField(columns[k]);
  text += '\n';
  for (const std::vector<MetricValue>& row : rows) {
    for (std::size_t k = 0; k < row.size(); ++k) text += (k > 0 ? "," : "") + CsvField(row[k]);
    text += '\n';
  }
  WriteFileBytes(path, text);
}

void WriteTrace(const std::filesystem::path& path, std::span<const TraceRow> rows) {
  std::string text = "evaluations,seconds,best_objective\n";
  for (const TraceRow& row : rows) {
    text += std::to_string(row.evaluations) + "," + FormatNumber(row.seconds) + "," +
            FormatNumber(row.best_objective) + "\n";
  }
  WriteFileBytes(path, text);
}

}  // namespace frond
