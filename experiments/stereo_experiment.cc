// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/stereo_experiment.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "base/errors.h"
#include "base/median.h"
#include "base/option_specs.h"
#include "experiments/board_views.h"
#include "experiments/match_outputs.h"
#include "experiments/named_errors.h"
#include "io/image_file.h"
#include "problems/stereo/stereo_calibration.h"
#include "problems/stereo/stereo_matcher.h"
#include "problems/turntable/view_cloud.h"
#include "problems/turntable/view_images.h"

namespace frond {
namespace {

std::vector<OptionSpec> Specs() {
  std::vector<OptionSpec> specs = StereoMatchSpecs();
  specs.push_back(
      NumberSpec("truth_scale", 1, 1e-6, 1e6, "Levels of the image input.truth per pixel of disparity"));
  specs.push_back(NumberSpec("cloud.least_cosine", 0.15, 0, 1,
                             "Windows seen more slantingly (cosine to the normal) give no point"));
  for (OptionSpec& spec : BoardSpecs()) specs.push_back(std::move(spec));
  const StereoCalibrationOptions calibration;
  specs.push_back(FlagSpec("calibration.square_pixels", calibration.square_pixels, "fx = fy of each camera"));
  specs.push_back(
      FlagSpec("calibration.same_focal_length", calibration.same_focal_length, "Of both cameras"));
  specs.push_back(FlagSpec("calibration.tangential_distortion", calibration.tangential_distortion, "p1, p2"));
  specs.push_back(IntegerSpec("calibration.radial_distortion", calibration.radial_distortion, 0, 3,
                              "How many of k1, k2, k3"));
  specs.push_back(NumberSpec("calibration.robust_width", calibration.robust_width, 0, 100,
                             "Pixels: corners farther off count less (Huber); 0: all alike"));
  return specs;
}

void CheckInput(const InputSource& input, const Options& problem) {
  const PhotographSource& source = input.photographs;
  CheckBoardOptions(problem, !source.boards.empty());
  const bool calibrated = !source.boards.empty() || !source.calibration.empty();
  const bool rectified = StereoMatchOptionsFrom(problem).rectified;
  if (calibrated && !rectified) {
    throw ConfigError("a calibrated pair is made normal: leave 'match.rectified' out, or the calibration");
  }
  if (!source.truth.empty() && (calibrated || !rectified)) {
    throw ConfigError("'input.truth' holds disparities of a pair that is rectified as it is: leave it out");
  }
}

void CheckWindowSolver(const Options& problem, const std::string& solver) {
  const StereoMatchOptions options = StereoMatchOptionsFrom(problem);
  if (solver == "lm" || options.derivatives == MatchDerivatives::kAutodiff) return;
  throw ConfigError("'" + solver +
                    "' would not be used: windows are fitted by the solver of the config where "
                    "'problem.match.derivatives' is autodiff");
}

StereoPairCalibration CalibrateFromBoards(const ImagePairList& list, const Options& problem,
                                          const std::string& unit, int threads, FitOutcome* outcome) {
  const BoardPairs boards = FindBoardPairs(list, BoardFrom(problem), threads);
  const StereoCalibrationOptions options{
      .square_pixels = problem.Flag("calibration.square_pixels"),
      .tangential_distortion = problem.Flag("calibration.tangential_distortion"),
      .radial_distortion = problem.Integer("calibration.radial_distortion"),
      .same_focal_length = problem.Flag("calibration.same_focal_length"),
      .robust_width = problem.Number("calibration.robust_width"),
      .threads = threads};
  StereoCalibration found = NameErrors(list.file.string(), [&] {
    return CalibrateStereo(boards.pairs, boards.width, boards.height, options);
  });
  outcome->warnings.insert(outcome->warnings.end(), found.warnings.begin(), found.warnings.end());
  outcome->metrics.Set("board_pairs", static_cast<std::int64_t>(boards.pairs.size()));
  return {found.pair, {.unit = unit, .rms = found.rms, .parameters = {}, .covariance = {}}};
}

void SetCalibrationMetrics(const StereoPairCalibration& calibration, MetricTable* metrics) {
  metrics->Set("stereo_calibration_rms", calibration.record.rms);
  metrics->Set("baseline", calibration.pair.right_from_left.translation().norm());
  metrics->Set("focal_length_px", (calibration.pair.left.focal[0] + calibration.pair.left.focal[1]) / 2);
}

void CheckCameraSize(const PinholeCamera& camera, const Image& image, const std::string& side) {
  if (camera.width == image.width && camera.height == image.height) return;
  throw InputError("the " + side + " image is " + std::to_string(image.width) + " x " +
                   std::to_string(image.height) + " pixels, but its camera was calibrated at " +
                   std::to_string(camera.width) + " x " + std::to_string(camera.height) +
                   "; calibrate with images of this size");
}

// Both photographs of a calibrated pair as normal images.
NormalPair NormalImages(const StereoInput& input, const StereoPair& cameras, int threads) {
  CheckCameraSize(cameras.left, input.left, "left");
  CheckCameraSize(cameras.right, input.right, "right");
  NormalPair pair;
  pair.normal = Rectify(cameras);
  const TurntableView left{.image = input.left, .colour = input.left_colour, .mask = input.left_mask};
  const TurntableView right{.image = input.right, .mask = input.right_mask};
  NormalView normal = ResampleView(left, cameras.left, pair.normal, 0, true, threads);
  pair.left = std::move(normal.image);
  pair.left_colour = std::move(normal.colour);
  pair.left_mask = std::move(normal.mask);
  normal = ResampleView(right, cameras.right, pair.normal, 1, false, threads);
  pair.right = std::move(normal.image);
  pair.right_mask = std::move(normal.mask);
  return pair;
}

// In the left camera's frame.
void AddStereoCloud(const StereoMatches& matches, const NormalPair& pair, double least_cosine,
                    FitOutcome* outcome) {
  const TurntableRig camera_alone;  // its "disk" is the left camera's frame
  const std::vector<ScanPoint> points =
      TriangulateView(matches, pair, camera_alone, 0, 0, {.least_cosine = least_cosine});
  ColouredCloud cloud;
  for (const ScanPoint& point : points) {
    cloud.points.push_back(point.position);
    cloud.normals.push_back(point.normal);
    cloud.standard_deviation.push_back(point.sigma);
    cloud.colours.push_back(point.colour);
  }
  outcome->metrics.Set("cloud_points", static_cast<std::int64_t>(points.size()));
  if (points.empty()) outcome->warnings.push_back("no window gives a point: cloud.ply is empty");
  if (!points.empty()) outcome->metrics.Set("cloud_median_sigma", Median(cloud.standard_deviation));
  outcome->cloud = PointCloud{cloud.points};
  AddCloudFile(std::move(cloud), outcome);
}

// The images that are matched, normal where there is a calibration.
NormalPair ImagesToMatch(const StereoInput& input, const std::optional<StereoPairCalibration>& calibration,
                         int threads, FitOutcome* outcome) {
  if (!calibration) {
    NormalPair pair;
    pair.left = input.left;
    pair.right = input.right;
    pair.left_mask = input.left_mask;
    pair.right_mask = input.right_mask;
    return pair;
  }
  NormalPair pair = NormalImages(input, calibration->pair, threads);
  for (const auto& [name, image] :
       {std::pair("normal_left.png", &pair.left), std::pair("normal_right.png", &pair.right)}) {
    outcome->files.push_back(
        {name, [copy = *image](const std::filesystem::path& path) { WriteImage(path, copy); }});
  }
  return pair;
}

FitOutcome Run(const RunInput& run_input, const Options& problem, const Solver& solver, const Budget& budget,
               const RunContext& context) {
  const StereoInput& input = *run_input.stereo;
  FitOutcome outcome;
  StageClock clock;
  std::optional<StereoPairCalibration> calibration = input.calibration;
  if (input.boards) {
    calibration = CalibrateFromBoards(*input.boards, problem, input.unit, context.threads, &outcome);
    clock.End("calibration");
  }
  if (calibration) {
    SetCalibrationMetrics(*calibration, &outcome.metrics);
    outcome.files.push_back({"calibration.json", [=](const std::filesystem::path& path) {
                               WriteCalibration(path, *calibration);
                             }});
  }
  if (!input.left.empty()) {
    const StereoMatchOptions options = StereoMatchOptionsFrom(problem);
    const std::string both = input.names[0] + " and " + input.names[1];
    const NormalPair pair =
        NameErrors(both, [&] { return ImagesToMatch(input, calibration, context.threads, &outcome); });
    clock.End("normal_images");
    const auto matches = NameErrors(both, [&] {
      return std::make_shared<const StereoMatches>(
          MatchStereo(pair.left, pair.right, pair.left_mask, pair.right_mask, options, context.threads,
                      {.solver = &solver, .budget = budget, .seed = context.seed}));
    });
    clock.End("matching");
    outcome.warnings.insert(outcome.warnings.end(), matches->warnings.begin(), matches->warnings.end());
    SetMatchMetrics(*matches, pair.left_mask, &outcome.metrics);
    if (!input.truth.empty()) {
      SetDisparityTruth(*matches, input.truth, problem.Number("truth_scale"), &outcome.metrics);
    }
    AddMatchFiles(matches, options.rectified, &outcome);
    if (calibration) AddStereoCloud(*matches, pair, problem.Number("cloud.least_cosine"), &outcome);
  }
  outcome.stages = clock.stages();
  return outcome;
}

}  // namespace

FitType StereoFitType() {
  return {.name = "stereo",
          .help = "Sub-pixel disparities of a rectified pair of images; a cloud where it is calibrated",
          .options = Specs(),
          .solver_defaults = [](const Options&, const std::string&) { return OptionDefaults(); },
          .check = [](const Options& problem) { CheckStereoMatchOptions(StereoMatchOptionsFrom(problem)); },
          .check_input = CheckInput,
          .check_solver = CheckWindowSolver,
          .run = Run,
          .formats = {},
          .input = InputKind::kStereo};
}

}  // namespace frond
