// SPDX-License-Identifier: BSD-3-Clause
#include "small_study.h"

#include <ceres/sized_cost_function.h>
#include <sys/stat.h>

#include <sstream>
#include <utility>

#include "tests/io/temp_folder.h"

namespace frond {
namespace {

class AnyResidual final : public ceres::SizedCostFunction<1, 2> {
 public:
  explicit AnyResidual(const std::function<double(const double*)>& residual) : residual_(residual) {}

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    residuals[0] = residual_(parameters[0]);
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    for (int i = 0; i < 2; ++i) {
      double moved[2] = {parameters[0][0], parameters[0][1]};
      moved[i] += 1e-6;
      jacobians[0][i] = (residual_(moved) - residuals[0]) / 1e-6;
    }
    return true;
  }

 private:
  const std::function<double(const double*)>& residual_;
};

class AnyFit final : public FitProblem {
 public:
  explicit AnyFit(std::function<double(const double*)> residual) : residual_(std::move(residual)) {}

  const std::vector<ParameterBlock>& parameters() const override { return blocks_; }

  void AddResiduals(const std::vector<double*>& blocks, ceres::EvaluationCallback* /*state*/,
                    ceres::Problem* problem) const override {
    problem->AddResidualBlock(new AnyResidual(residual_), nullptr, blocks[0]);
  }

 private:
  std::function<double(const double*)> residual_;
  std::vector<ParameterBlock> blocks_ = {
      {.name = "x", .start = {1, 1}, .start_lower = {-2, -2}, .start_upper = {2, 2}}};
};

// The fields of one line; quotes may hold commas and doubled quotes.
std::vector<std::string> Fields(const std::string& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (std::size_t k = 0; k < line.size(); ++k) {
    if (line[k] == '"' && quoted && k + 1 < line.size() && line[k + 1] == '"') {
      fields.back() += line[k++];
    } else if (line[k] == '"') {
      quoted = !quoted;
    } else if (line[k] == ',' && !quoted) {
      fields.emplace_back();
    } else {
      fields.back() += line[k];
    }
  }
  return fields;
}

}  // namespace

StudyPlan PlanOf(const std::string& yaml, const RunFlags& flags) {
  return ReadStudyPlan(ConfigFile::Parse(yaml, "study.yaml"), flags);
}

std::vector<std::map<std::string, std::string>> CsvRows(const std::filesystem::path& file) {
  std::istringstream lines(FileText(file));
  std::string line;
  std::getline(lines, line);
  const std::vector<std::string> columns = Fields(line);
  std::vector<std::map<std::string, std::string>> rows;
  while (std::getline(lines, line)) {
    const std::vector<std::string> fields = Fields(line);
    EXPECT_EQ(fields.size(), columns.size()) << line;
    rows.emplace_back();
    for (std::size_t k = 0; k < std::min(fields.size(), columns.size()); ++k) {
      rows.back()[columns[k]] = fields[k];
    }
  }
  return rows;
}

std::string RunsWithoutTimes(const std::filesystem::path& folder) {
  std::istringstream lines(FileText(folder / "runs.csv"));
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    for (int k = 0; k < 2; ++k) line.resize(line.rfind(','));
    text += line + "\n";
  }
  return text;
}

std::map<std::string, FileState> ResultFiles(const std::filesystem::path& folder) {
  std::map<std::string, FileState> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "jobs")) {
    struct stat status {};
    if (::stat(entry.path().c_str(), &status) != 0) continue;
    files[entry.path().filename()] = {
        FileText(entry.path()), status.st_ino,
        std::int64_t{status.st_mtim.tv_sec} * 1'000'000'000 + std::int64_t{status.st_mtim.tv_nsec}};
  }
  return files;
}

std::shared_ptr<const FitProblem> FitOf(std::function<double(const double*)> residual) {
  return std::make_shared<AnyFit>(std::move(residual));
}

}  // namespace frond
