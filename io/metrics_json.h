// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace frond {

// A metric as JSON holds it. A number that is not finite is written as null and read back as NaN.
using MetricValue = std::variant<bool, std::int64_t, double, std::string, std::vector<std::int64_t>,
                                 std::vector<double>, std::vector<std::string>>;

// Named values in the order they were first set.
class MetricTable {
 public:
  void Set(const std::string& name, MetricValue value);
  const MetricValue* Find(const std::string& name) const;  // null if absent
  double Number(const std::string& name) const;  // an integer's too; NaN if absent or something else
  const std::vector<std::pair<std::string, MetricValue>>& entries() const { return entries_; }

 private:
  std::vector<std::pair<std::string, MetricValue>> entries_;
};

// metrics.json, schema frond.metrics/1, in the order in which it is written.
struct RunMetrics {
  struct Input {
    std::string path, sha256;
    std::int64_t points = 0;
  };
  struct Solver {
    std::string name, termination;
    double objective = 0;
    std::int64_t evaluations = 0, residual_evaluations = 0, jacobian_evaluations = 0, iterations = 0;
    double seconds = 0;
  };
  struct Stage {
    std::string name;
    double seconds = 0;
  };

  std::string problem;
  std::string status = "ok";         // or "failed"
  std::optional<std::string> error;  // set where failed
  std::string unit = "mm";
  Input input;
  MetricTable metrics;
  Solver solver;
  std::vector<Stage> stages;
  double seconds = 0;
  std::int64_t peak_rss_bytes = 0;
  int threads = 1;
  std::uint64_t seed = 0;
  MetricTable versions;  // frond, ceres, git, dirty
};

std::string FormatMetricsJson(const RunMetrics& metrics);
void WriteMetricsJson(const std::filesystem::path& path, const RunMetrics& metrics);  // throws InputError
RunMetrics ReadMetricsJson(const std::filesystem::path& path);                        // throws InputError

// A table of values with a header line; texts that hold a comma, quote or line end are quoted (RFC 4180).
void WriteCsv(const std::filesystem::path& path, std::span<const std::string> columns,
              std::span<const std::vector<MetricValue>> rows);

// trace.csv: one line a trace point, under "evaluations,seconds,best_objective".
struct TraceRow {
  std::int64_t evaluations = 0;
  double seconds = 0;
  double best_objective = 0;
};
void WriteTrace(const std::filesystem::path& path, std::span<const TraceRow> rows);

}  // namespace frond
