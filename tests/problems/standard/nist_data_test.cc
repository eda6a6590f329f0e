// SPDX-License-Identifier: BSD-3-Clause
#include "problems/standard/nist_data.h"

#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include "problems/standard/nist_models.h"
#include "problems/standard/rounding_floor.h"

namespace frond {
namespace {

// A data file of NIST's, parsed by the line numbers in its own head.
struct NistFile {
  std::vector<std::vector<double>> observations;  // y, then the predictors
  std::vector<std::vector<double>> parameters;    // start 1, start 2, certified, deviation
  double rss = 0;
};

std::vector<double> Numbers(const std::string& line) {
  std::istringstream words(line);
  std::vector<double> numbers;
  for (std::string word; words >> word;) numbers.push_back(std::stod(word));
  return numbers;
}

NistFile ReadNistFile(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  NistFile result;
  const std::regex range(R"((Starting Values|Data) +\(lines +(\d+) +to +(\d+)\))");
  for (std::size_t head = 0; head < 12; ++head) {
    std::smatch match;
    if (!std::regex_search(lines.at(head), match, range)) continue;
    const bool data = match[1] == "Data";
    for (std::size_t i = std::stoul(match[2]) - 1; i < std::stoul(match[3]); ++i) {
      const std::string& line = lines.at(i);
      if (data) result.observations.push_back(Numbers(line));
      if (!data) result.parameters.push_back(Numbers(line.substr(line.find('=') + 1)));
    }
  }
  for (const std::string& line : lines) {
    if (line.starts_with("Residual Sum of Squares:")) result.rss = std::stod(line.substr(24));
  }
  return result;
}

// What some copies of Roszman1.dat say for b1, 2.0196866396E-01: an offset of exactly 1, which would make the
// sum of squares 25 instead of the certified 5e-4.
constexpr double kMisprint = 1.20196866396E-0;

TEST(NistData, NistDatasets_AreTwentySevenInOrder) {
  const std::vector<NistDataset>& datasets = NistDatasets();
  ASSERT_EQ(datasets.size(), 27u);
  EXPECT_EQ(datasets.front().name, "Bennett5");
  EXPECT_EQ(datasets.back().name, "Thurber");
}

TEST(NistData, NistDatasets_EqualNistFiles) {
  const std::filesystem::path folder = std::filesystem::path(FROND_SHARED_DATA) / "nist";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no NIST files in " << folder;
  for (const NistDataset& dataset : NistDatasets()) {
    SCOPED_TRACE(dataset.name);
    NistFile file = ReadNistFile(folder / (dataset.name + ".dat"));
    const std::size_t predictors = static_cast<std::size_t>(dataset.predictors);
    ASSERT_EQ(dataset.y.size(), file.observations.size());
    ASSERT_EQ(dataset.x.size(), file.observations.size() * predictors);
    for (std::size_t i = 0; i < file.observations.size(); ++i) {
      ASSERT_EQ(file.observations[i].size(), predictors + 1);
      EXPECT_EQ(dataset.y[i], file.observations[i][0]);
      for (std::size_t k = 0; k < predictors; ++k) {
        EXPECT_EQ(dataset.x[i * predictors + k], file.observations[i][k + 1]);
      }
    }
    ASSERT_EQ(dataset.parameters.size(), file.parameters.size());
    for (std::size_t j = 0; j < file.parameters.size(); ++j) {
      const NistParameter& p = dataset.parameters[j];
      if (file.parameters[j][2] == kMisprint) file.parameters[j][2] = 2.0196866396E-01;
      EXPECT_EQ((std::vector<double>{p.start_1, p.start_2, p.certified, p.deviation}), file.parameters[j]);
    }
    EXPECT_EQ(dataset.rss, file.rss);
  }
}

// Half a unit of the last of the 11 digits that NIST prints of `value`.
double HalfUnit(double value) { return 0.5e-10 * std::pow(10, std::floor(std::log10(std::abs(value)))); }

struct AtCertified {
  long double rss = 0;       // in long double
  Eigen::MatrixXd jacobian;  // ∂f(x_i)/∂b_j, m × n
  double response_norm = 0;
};

template <typename Model>
AtCertified EvaluateAtCertified(const NistDataset& dataset) {
  constexpr int kN = Model::kParameters;
  EXPECT_EQ(dataset.parameters.size(), static_cast<std::size_t>(kN));
  long double exact[kN];
  ceres::Jet<double, kN> jets[kN];
  for (int j = 0; j < kN; ++j) {
    exact[j] = dataset.parameters[j].certified;
    jets[j] = ceres::Jet<double, kN>(dataset.parameters[j].certified, j);
  }
  AtCertified result{.jacobian = Eigen::MatrixXd(dataset.y.size(), kN)};
  for (std::size_t i = 0; i < dataset.y.size(); ++i) {
    const double* x = &dataset.x[i * static_cast<std::size_t>(dataset.predictors)];
    const auto y = static_cast<long double>(dataset.y[i]);
    const long double residual = (dataset.log_response ? std::log(y) : y) - Model()(exact, x);
    result.rss += residual * residual;
    result.jacobian.row(static_cast<Eigen::Index>(i)) = Model()(jets, x).v.transpose();
    result.response_norm = std::hypot(result.response_norm, static_cast<double>(y));
  }
  return result;
}

AtCertified EvaluateAtCertified(const NistDataset& dataset) {
  return WithNistModel(dataset.name,
                       [&]<typename Model>(Model) { return EvaluateAtCertified<Model>(dataset); });
}

// At the least sum of squares the gradient is 0, so that rounding b by δ adds |J δ|² and no more (to second
// order): what is left is the rounding of the printed sum itself, and of the arithmetic.
TEST(NistModels, SumOfSquares_AtCertifiedParameters_IsTheCertifiedOne) {
  for (const NistDataset& dataset : NistDatasets()) {
    SCOPED_TRACE(dataset.name);
    const AtCertified at = EvaluateAtCertified(dataset);
    double moved = 0;  // the most that printing b can change the fitted values, |J δ|
    for (std::size_t j = 0; j < dataset.parameters.size(); ++j) {
      moved +=
          at.jacobian.col(static_cast<Eigen::Index>(j)).norm() * HalfUnit(dataset.parameters[j].certified);
    }
    const double excess = static_cast<double>(at.rss) - dataset.rss;
    // long double: 2⁻¹¹ of the rounding of double.
    const double rounding =
        HalfUnit(dataset.rss) + 2 * RoundingFloor(std::sqrt(dataset.rss), at.response_norm) / 2048;
    EXPECT_GE(excess, -rounding);
    EXPECT_LE(excess, rounding + moved * moved);
  }
}

// s² (JᵀJ)⁻¹ with s² = RSS / (m − n), by QR of J with its columns scaled.
TEST(NistModels, StandardDeviations_AtCertifiedParameters_AreTheCertifiedOnes) {
  for (const NistDataset& dataset : NistDatasets()) {
    SCOPED_TRACE(dataset.name);
    const AtCertified at = EvaluateAtCertified(dataset);
    const Eigen::Index n = at.jacobian.cols();
    const Eigen::VectorXd scale = at.jacobian.colwise().norm();
    const Eigen::MatrixXd scaled = at.jacobian * scale.cwiseInverse().asDiagonal();
    const Eigen::MatrixXd r =
        Eigen::HouseholderQR<Eigen::MatrixXd>(scaled).matrixQR().topRows(n).triangularView<Eigen::Upper>();
    const Eigen::MatrixXd inverse = r.inverse();
    const double s = std::sqrt(dataset.rss / static_cast<double>(at.jacobian.rows() - n));
    for (Eigen::Index j = 0; j < n; ++j) {
      const double certified = dataset.parameters[static_cast<std::size_t>(j)].deviation;
      EXPECT_NEAR(s * inverse.row(j).norm() / scale[j], certified, 1e-6 * certified) << "parameter " << j + 1;
    }
  }
}

}  // namespace
}  // namespace frond
