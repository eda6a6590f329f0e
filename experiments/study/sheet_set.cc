// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <utility>

#include "base/errors.h"
#include "base/option_specs.h"
#include "experiments/study/set_scans.h"
#include "experiments/study/study_sets.h"
#include "models/knot_vector.h"
#include "problems/surface/distance_fit.h"
#include "problems/surface/linear_start.h"
#include "problems/surface/principal_axes.h"
#include "problems/surface/sheet_start.h"

namespace frond {
namespace {

constexpr std::uint64_t kGridSeed = 1;  // of the thinning voxel grid: every repetition has the same points
constexpr double kDomainMargin = 0.02;  // left free around the data, as in the sheet fit

struct SheetSettings {
  std::array<int, 2> degree, control_points;
  double fairness;
  SurfaceUnknowns unknowns;
};

// A fit with the points that it views.
struct Sheet {
  std::vector<Eigen::Vector3d> points;
  std::unique_ptr<const SurfaceDistanceFit> fit;
};

std::shared_ptr<const FitProblem> Make(const InputSource& source, const SheetSettings& settings) {
  const RunInput input = LoadInput(source, kGridSeed);
  const auto sheet = std::make_shared<Sheet>();
  const PrincipalAxes axes =
      FindPrincipalAxes(input.cloud.points, std::vector<std::uint8_t>(input.cloud.points.size(), 0));
  for (const Eigen::Vector3d& point : input.cloud.points) {
    sheet->points.push_back(axes.axes.transpose() * (point - axes.origin));
  }
  const auto parameters = RectangleParameters(sheet->points, sheet->points, kDomainMargin);
  const NurbsSurface start =
      FitAtParameters(sheet->points, parameters, UniformBasis(settings.degree[0], settings.control_points[0]),
                      UniformBasis(settings.degree[1], settings.control_points[1]), settings.fairness);
  DistanceFitOptions options;
  options.unknowns = settings.unknowns;
  options.fairness = settings.fairness;
  sheet->fit = std::make_unique<SurfaceDistanceFit>(sheet->points, start, start, options, 1);
  return {sheet, sheet->fit.get()};
}

std::array<int, 2> Pair(const Options& options, const std::string& name) {
  const std::vector<int> values = options.Integers(name);
  return {values.front(), values.back()};
}

std::vector<TestProblem> Problems(const Options& options) {
  SheetSettings settings{.degree = Pair(options, "degree"),
                         .control_points = Pair(options, "control_points"),
                         .fairness = options.Number("fairness"),
                         .unknowns = options.Text("unknowns") == "weights" ? SurfaceUnknowns::kWeights
                                                                           : SurfaceUnknowns::kControlPoints};
  for (const std::size_t k : {0, 1}) {
    if (settings.control_points[k] <= settings.degree[k]) {
      throw ConfigError("'control_points' must be more than 'degree' in each direction");
    }
  }
  std::vector<TestProblem> problems;
  for (const SetScan& scan : SetScansFrom(options)) {
    problems.push_back({.name = scan.name, .make = [=] { return Make(scan.source, settings); }});
  }
  return problems;
}

OptionSpec PairSpec(const std::string& name, double value, double minimum, double maximum,
                    const std::string& help) {
  return {.name = name,
          .type = OptionType::kIntegers,
          .default_value = std::vector<double>{value, value},
          .help = help,
          .minimum = minimum,
          .maximum = maximum,
          .min_size = 1,
          .max_size = 2};
}

}  // namespace

ProblemSetType SheetSetType() {
  std::vector<OptionSpec> specs = SetScanSpecs(2000);
  specs.push_back(PairSpec("degree", 3, 1, 5, "Across and along"));
  specs.push_back(PairSpec("control_points", 6, 2, 100, "Across and along"));
  specs.push_back(NumberSpec("fairness", 1e-8, 0, 1, "Weight of the thin-plate energy"));
  specs.push_back(ChoiceSpec("unknowns", {"control_points", "weights"}, "What the solver moves"));
  return {.name = "sheet",
          .help = "The distance fit of a small NURBS surface over a scan, from its linear start",
          .options = std::move(specs),
          .problems = Problems};
}

}  // namespace frond
