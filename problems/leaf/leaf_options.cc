// SPDX-License-Identifier: BSD-3-Clause
#include "problems/leaf/leaf_options.h"

#include <cmath>
#include <limits>

#include "base/errors.h"
#include "base/option_specs.h"

namespace frond {
namespace {

OptionSpec Pair(const std::string& name, double first, double second, double minimum, double maximum,
                const std::string& help) {
  return {.name = name,
          .type = OptionType::kNumbers,
          .default_value = std::vector<double>{first, second},
          .help = help,
          .minimum = minimum,
          .maximum = maximum,
          .min_size = 2,
          .max_size = 2};
}

OptionSpec Flag(const std::string& name, bool value, const std::string& help) {
  return {.name = name, .type = OptionType::kFlag, .default_value = value, .help = help};
}

constexpr double kPetioleWidth = 2;  // mm: the mean of tea leaves (Wu et al. 2021, section 2.3.2)

OptionSpec PetioleWidth() {
  OptionSpec spec = NumberSpec("point_set.petiole_width", 2, 1e-12, 1e12,
                               "Width of the leaf's base edge, in the input's unit; auto: 2 mm");
  spec.default_value = std::string("auto");
  spec.words = {"auto"};
  return spec;
}

}  // namespace

std::vector<OptionSpec> LeafSpecs() {
  constexpr double kMany = 100000;
  return {
      ChoiceSpec(
          "method", {"distance", "paper"},
          "distance: least orthogonal distances of all points; paper: slices, point set and B-spline of "
          "Wu et al. 2021"),
      Flag("frame.leave_out_strays", true, "Points far from the sheet have no say in the leaf's frame"),
      ChoiceSpec("point_set.kind", {"unordered", "ordered"},
                 "unordered: all points of the selected slices; ordered: margin, midrib and a few between "
                 "(falls back to unordered where no midrib stands out)"),
      IntegerSpec("point_set.slices", 50, 1, kMany, "Slices across the leaf, base and tip apart"),
      IntegerSpec("point_set.selected", 7, 3, kMany, "Slices that are fitted, base and tip included"),
      PetioleWidth(),
      IntegerSpec("point_set.left", 2, 0, kMany, "Points of an ordered row between left margin and midrib"),
      IntegerSpec("point_set.right", 2, 0, kMany, "Points of an ordered row between midrib and right margin"),
      NumberSpec("point_set.midrib_threshold", 0.5, 0, 10,
                 "A midrib stands out while its offset from the middle, over the half-width, is below this"),
      IntegerSpec("test_subset.slices", 10, 1, kMany, "Slices of the paper's test subset"),
      IntegerSpec("test_subset.left", 3, 0, kMany,
                  "Points of the test subset between left margin and midrib"),
      IntegerSpec("test_subset.right", 3, 0, kMany,
                  "Points of the test subset between midrib and right margin"),
      ChoiceSpec(
          "paper.algorithm", {"algorithm_1", "approximation", "interpolation"},
          "algorithm_1: knots of each row averaged, any point set; the other two: Algorithm A1, ordered "
          "sets"),
      ChoiceSpec("paper.parametrisation", {"chord", "centripetal", "uniform"}, "Eqs (A5), (A6), (A4)"),
      ChoiceSpec(
          "paper.weights", {"fixed", "free"},
          "free: the solver minimises F = alpha[0] RMSE + alpha[1] max over the test subset by the weights"),
      Pair("paper.alpha", 0.8, 0.2, 0, 1, "Shares of RMSE and maximum in F; their sum is 1"),
      Pair("paper.weight_bounds", 0.1, 10, 1e-6, 1e6,
           "Bounds of each free weight; 1 lies between them (a swarm's start_box should be [0.9, 1.1])"),
      ChoiceSpec("paper.projection", {"tracked", "paper"},
                 "tracked: safeguarded Newton from each point's foot at weights of 1; paper: eqs (7), (8), "
                 "appendix A"),
  };
}

LeafMethod LeafMethodFrom(const Options& options) {
  return options.Text("method") == "paper" ? LeafMethod::kPaper : LeafMethod::kDistance;
}

LeafFrameOptions LeafFrameOptionsFrom(const Options& options) {
  return {.leave_out_strays = options.Flag("frame.leave_out_strays")};
}

PointSetOptions PointSetOptionsFrom(const Options& options, double unit_mm) {
  return {
      .kind = options.Text("point_set.kind") == "ordered" ? PointSetKind::kOrdered : PointSetKind::kUnordered,
      .slices = options.Integer("point_set.slices"),
      .selected = options.Integer("point_set.selected"),
      .petiole_width = options.HoldsWord("point_set.petiole_width")
                           ? kPetioleWidth / unit_mm
                           : options.Number("point_set.petiole_width"),
      .left = options.Integer("point_set.left"),
      .right = options.Integer("point_set.right"),
      .midrib_threshold = options.Number("point_set.midrib_threshold")};
}

TestSubsetOptions TestSubsetOptionsFrom(const Options& options) {
  return {.slices = options.Integer("test_subset.slices"),
          .left = options.Integer("test_subset.left"),
          .right = options.Integer("test_subset.right"),
          .midrib_threshold = options.Number("point_set.midrib_threshold")};
}

LeafWeightsOptions LeafWeightsOptionsFrom(const Options& options) {
  const std::vector<double>&alpha = options.Numbers("paper.alpha"),
        &bounds = options.Numbers("paper.weight_bounds");
  if (!(std::abs(alpha[0] + alpha[1] - 1) < 1e-9)) {
    throw ConfigError("paper.alpha is " + FormatValue(alpha) + ", the sum must be 1");
  }
  if (!(bounds[0] <= 1 && bounds[1] >= 1)) {
    throw ConfigError("paper.weight_bounds is " + FormatValue(bounds) + ", 1 must lie between them");
  }
  return {.objective = {.rmse_share = alpha[0], .max_share = alpha[1]},
          .lower = bounds[0],
          .upper = bounds[1],
          .projection = options.Text("paper.projection") == "paper" ? WeightProjection::kPaper
                                                                    : WeightProjection::kTracked};
}

LeafSurfaceOptions LeafSurfaceOptionsFrom(const Options& options, const std::vector<int>& degree,
                                          const std::vector<int>& control_points) {
  const std::string& algorithm = options.Text("paper.algorithm");
  const std::string& parameters = options.Text("paper.parametrisation");
  return {.algorithm = algorithm == "interpolation"   ? LeafSurfaceAlgorithm::kInterpolation
                       : algorithm == "approximation" ? LeafSurfaceAlgorithm::kApproximation
                                                      : LeafSurfaceAlgorithm::kAlgorithm1,
          .parametrisation = parameters == "uniform"       ? Parametrisation::kUniform
                             : parameters == "centripetal" ? Parametrisation::kCentripetal
                                                           : Parametrisation::kChord,
          .degree_u = degree.at(0),
          .degree_v = degree.at(1),
          .count_u = control_points.at(0),
          .count_v = control_points.at(1)};
}

LeafPaperOptions LeafPaperOptionsFrom(const Options& options, const std::vector<int>& degree,
                                      const std::vector<int>& control_points, double unit_mm) {
  return {.frame = LeafFrameOptionsFrom(options),
          .point_set = PointSetOptionsFrom(options, unit_mm),
          .test_subset = TestSubsetOptionsFrom(options),
          .surface = LeafSurfaceOptionsFrom(options, degree, control_points),
          .free_weights = options.Text("paper.weights") == "free",
          .weights = LeafWeightsOptionsFrom(options)};
}

std::vector<OptionSpec> SyntheticLeafSpecs() {
  const LeafScanOptions scan;
  const double infinity = std::numeric_limits<double>::infinity();
  std::vector<OptionSpec> specs = {
      ChoiceSpec("character", {"by_seed", "hill", "smooth", "wrinkled", "flat"},
                 "Look of the leaf; by_seed: 1 hill, 2 smooth, 3 wrinkled, 4 flat, 5 hill, …"),
      IntegerSpec("points", scan.points, 1, 1e8, "Points of the scan, outliers and petiole included"),
      NumberSpec("noise", scan.noise, 0, 10, "Standard deviation, mm"),
      ChoiceSpec("noise_direction", {"isotropic", "normal"},
                 "Noise in every coordinate, or along the surface's normal"),
      NumberSpec("outlier_share", scan.outlier_share, 0, 0.9, "Share of the points thrown off the surface"),
      Pair("outlier_distance", scan.outlier_near, scan.outlier_far, 0, 1e6, "How far they are thrown, mm"),
      IntegerSpec("holes", scan.holes, 0, 1000, "Round holes without points"),
      NumberSpec("hole_radius", scan.hole_radius, 0, 1000, "Radius of each, mm"),
      NumberSpec("missing_tip", scan.missing_tip, 0, 0.9, "Share of the length not scanned at the tip"),
      NumberSpec("petiole_length", scan.petiole_length, 0, 1000, "Length of a petiole left on, mm"),
      ChoiceSpec("pose", {"random", "standard"},
                 "Any rotation and shift by the seed, or base at 0 and midrib along x"),
      ChoiceSpec("unit", {"mm", "cm", "m"}, "Unit of the written coordinates"),
      IntegerSpec("dense_points", scan.dense_points, 0, 1e8, "Points of the clean truth sample"),
  };
  for (const auto& [name, value] : ShapeValues(LeafShape{})) {
    if (name == "seed") continue;
    OptionSpec spec = NumberSpec("shape." + name, value, -infinity, infinity,
                                 "Shape of the leaf instead of the seed's (mm, degrees)");
    spec.default_value = std::string("by_seed");
    spec.type = OptionType::kNumbers;
    spec.words = {"by_seed"};
    specs.push_back(std::move(spec));
  }
  return specs;
}

LeafShape LeafShapeFrom(const Options& options, std::uint64_t seed) {
  const std::string& character = options.Text("character");
  LeafShape shape =
      character == "by_seed" ? RandomLeaf(seed) : RandomLeaf(seed, FindLeafCharacter(character));
  for (const auto& [name, value] : ShapeValues(shape)) {
    const std::string option = "shape." + name;
    if (name == "seed" || options.HoldsWord(option)) continue;
    SetShapeValue(&shape, name, options.Numbers(option).at(0));
  }
  return shape;
}

LeafScanOptions LeafScanOptionsFrom(const Options& options, std::uint64_t seed) {
  const std::vector<double>& thrown = options.Numbers("outlier_distance");
  const std::string& unit = options.Text("unit");
  return {.seed = seed,
          .points = options.Integer("points"),
          .noise = options.Number("noise"),
          .noise_direction = options.Text("noise_direction") == "normal" ? NoiseDirection::kNormal
                                                                         : NoiseDirection::kIsotropic,
          .outlier_share = options.Number("outlier_share"),
          .outlier_near = thrown[0],
          .outlier_far = thrown[1],
          .holes = options.Integer("holes"),
          .hole_radius = options.Number("hole_radius"),
          .missing_tip = options.Number("missing_tip"),
          .petiole_length = options.Number("petiole_length"),
          .random_pose = options.Text("pose") == "random",
          .pose_seed = seed,
          .unit_mm = unit == "m"    ? 1000.0
                     : unit == "cm" ? 10.0
                                    : 1.0,
          .dense_points = options.Integer("dense_points")};
}

}  // namespace frond
