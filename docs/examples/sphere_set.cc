// SPDX-License-Identifier: BSD-3-Clause
// The example of docs/add_a_fit.md, which shows parts of this file.
#include "docs/examples/sphere_set.h"

#include <memory>
#include <numbers>

#include "base/option_specs.h"
#include "base/random.h"
#include "docs/examples/sphere_fit.h"

namespace frond {
namespace {

// Points of the unit sphere about (1, 2, 3) within `degrees` of its pole.
std::vector<Eigen::Vector3d> CapPoints(int degrees, int count, double noise) {
  Random random = Random::ForKey(1, "cap " + std::to_string(degrees));
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < count; ++i) {
    const double z = random.Uniform(std::cos(degrees * std::numbers::pi / 180), 1);
    const double phi = random.Uniform(0, 2 * std::numbers::pi), r = std::sqrt(1 - z * z);
    const Eigen::Vector3d direction(r * std::cos(phi), r * std::sin(phi), z);
    points.emplace_back(Eigen::Vector3d(1, 2, 3) + (1 + noise * random.Normal()) * direction);
  }
  return points;
}

std::vector<TestProblem> Problems(const Options& options) {
  const int count = options.Integer("points");
  const double noise = options.Number("noise");
  std::vector<TestProblem> problems;
  for (const int degrees : options.Integers("degrees")) {
    TestProblem problem;
    problem.name = "cap_" + std::to_string(degrees);
    problem.make = [=] { return std::make_shared<SphereFit>(CapPoints(degrees, count, noise), 1.0); };
    if (noise == 0) {  // else the least objective is not known: a study takes the best of its runs
      problem.best_objective = 0.0;
      problem.resolution = 1e-24;
      problem.best_x = {1, 2, 3, 1};
    }
    problems.push_back(problem);
  }
  return problems;
}

}  // namespace

ProblemSetType SphereCapSetType() {
  return {.name = "sphere_caps",
          .help = "Spheres through points of a part of a unit sphere",
          .options = {{.name = "degrees",
                       .type = OptionType::kIntegers,
                       .default_value = std::vector<double>{180, 60, 20},
                       .help = "From the pole to the edge of the part, a problem each",
                       .minimum = 1,
                       .maximum = 180,
                       .max_size = 180},
                      IntegerSpec("points", 100, 4, 1e6, "Of each problem"),
                      NumberSpec("noise", 0, 0, 1, "Standard deviation of the points' distances")},
          .problems = Problems};
}

}  // namespace frond
