// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/job_result.h"

#include <unistd.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <system_error>

#include "base/errors.h"
#include "io/file_bytes.h"

namespace frond {
namespace {

using Json = nlohmann::ordered_json;

constexpr char kSchema[] = "frond.job/1";

double NumberOf(const Json& json) {
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

Json ToJson(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Termination TerminationOf(const std::string& name) {
  for (const Termination t :
       {Termination::kConverged, Termination::kTarget, Termination::kEvaluationBudget,
        Termination::kTimeBudget, Termination::kIterationLimit, Termination::kStalled}) {
    if (name == TerminationName(t)) return t;
  }
  return Termination::kFailed;
}

JobResult Parse(const std::string& text) {
  const Json json = Json::parse(text);
  if (json.at("schema") != kSchema) throw std::runtime_error("another schema");
  JobResult result;
  result.key = json.at("key");
  result.problem = json.at("problem");
  result.contender = json.at("contender");
  result.repetition = json.at("repetition");
  result.status = json.at("status");
  result.reason = json.at("reason");
  result.start_objective = NumberOf(json.at("start_objective"));
  result.free_parameters = json.at("free_parameters");
  SolverReport& report = result.report;
  report.termination = TerminationOf(json.at("termination"));
  report.message = json.at("message");
  report.objective = NumberOf(json.at("objective"));
  report.evaluations = json.at("evaluations");
  report.residual_evaluations = json.at("residual_evaluations");
  report.jacobian_evaluations = json.at("jacobian_evaluations");
  report.iterations = json.at("iterations");
  report.seconds = json.at("seconds");
  for (const Json& x : json.at("x")) report.x.push_back(NumberOf(x));
  for (const auto& [name, value] : json.at("metrics").items()) result.metrics.Set(name, NumberOf(value));
  for (const Json& point : json.at("trace")) {
    report.trace.push_back({point.at(0), point.at(1), NumberOf(point.at(2))});
  }
  return result;
}

}  // namespace

std::string FormatJobResult(const JobResult& result) {
  const SolverReport& report = result.report;
  Json x = Json::array(), metrics = Json::object(), trace = Json::array();
  for (const double value : report.x) x.push_back(ToJson(value));
  for (const auto& [name, value] : result.metrics.entries())
    metrics[name] = ToJson(result.metrics.Number(name));
  for (const TracePoint& point : report.trace) {
    trace.push_back(Json::array({point.evaluations, point.seconds, ToJson(point.best_objective)}));
  }
  const Json json = {{"schema", kSchema},
                     {"key", result.key},
                     {"problem", result.problem},
                     {"contender", result.contender},
                     {"repetition", result.repetition},
                     {"status", result.status},
                     {"reason", result.reason},
                     {"start_objective", ToJson(result.start_objective)},
                     {"free_parameters", result.free_parameters},
                     {"termination", TerminationName(report.termination)},
                     {"message", report.message},
                     {"objective", ToJson(report.objective)},
                     {"evaluations", report.evaluations},
                     {"residual_evaluations", report.residual_evaluations},
                     {"jacobian_evaluations", report.jacobian_evaluations},
                     {"iterations", report.iterations},
                     {"seconds", report.seconds},
                     {"x", x},
                     {"metrics", metrics},
                     {"trace", trace}};
  // Text of exceptions may be no UTF-8.
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::optional<JobResult> ReadJobResult(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) return std::nullopt;
  const std::string text = ReadFileBytes(path);
  try {
    return Parse(text);
  } catch (const std::exception&) {
    FailFile(path, "is not a whole result of a job; delete it, and the study makes it again");
  }
}

void WriteJobResult(const std::filesystem::path& path, const JobResult& result) {
  std::filesystem::path partial = path;
  partial += ".partial-" + std::to_string(::getpid());
  WriteFileBytes(partial, FormatJobResult(result));
  std::error_code error;
  std::filesystem::rename(partial, path, error);
  if (error) FailFile(path, "cannot be written: " + error.message());
}

}  // namespace frond
