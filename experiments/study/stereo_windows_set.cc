// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <string>
#include <vector>

#include "base/option_specs.h"
#include "base/random.h"
#include "experiments/study/study_sets.h"
#include "models/smoothing.h"
#include "problems/stereo/textured_pair.h"
#include "problems/stereo/window_fit.h"

namespace frond {
namespace {

std::vector<OptionSpec> Specs() {
  return {
      IntegerSpec("windows", 10, 1, 1000, "Windows at random places of the synthetic pair, a problem each"),
      NumberSpec("start_box", 1, 0.01, 10, "Start and search within so many pixels of the true disparity"),
      IntegerSpec("size", 15, 3, kMaxWindowSize, "Pixels a side, an odd number"),
      ChoiceSpec("warp", {"linear", "shift", "quadratic", "affine"}, "How the disparity varies in a window"),
      ChoiceSpec("radiometry", {"planar_gain", "gain_offset", "none"},
                 "How grey levels vary between the images"),
      NumberSpec("contrast", 20, 0.1, 100, "Standard deviation of the texture, grey levels"),
      NumberSpec("grain", 3, 0.5, 50, "Correlation length of the texture, px"),
      NumberSpec("noise", 1.5, 0, 100, "Standard deviation of the noise of both images, grey levels"),
      NumberSpec("smoothing", 0, 0, kLargestSmoothing, "Of both images, standard deviation, px"),
      IntegerSpec("pair_seed", 1, 0, 1e9, "Of the texture, the noise and the windows' places"),
  };
}

// A window with the pair that it is of.
struct OwnedWindow {
  TexturedPair pair;
  Mask all;
  CubicImage right;
  std::unique_ptr<const WindowFit> fit;

  OwnedWindow(const TexturedPairOptions& options, const WindowModel& model, int x, int y, double start_box)
      : pair(MakeTexturedPair(options)) {
    pair.left = Smoothed(pair.left, all, model.smoothing);
    right = CubicImage(Smoothed(pair.right, all, model.smoothing));
    const double truth = pair.Disparity(x, y);
    fit = std::make_unique<const WindowFit>(
        WindowImages{&pair.left, &all, &right, &all}, model, x, y, WarpValues{truth},
        WindowFitOptions{.start_box = start_box, .true_disparity = truth});
  }
};

std::vector<TestProblem> Problems(const Options& options) {
  const WindowModel model{.size = options.Integer("size"),
                          .warp = WarpFrom(options.Text("warp")),
                          .radiometry = RadiometryFrom(options.Text("radiometry")),
                          .smoothing = options.Number("smoothing")};
  CheckWindowModel(model);
  const TexturedPairOptions pair{.contrast = options.Number("contrast"),
                                 .grain = options.Number("grain"),
                                 .noise = options.Number("noise"),
                                 .seed = static_cast<std::uint64_t>(options.Integer("pair_seed"))};
  const double start_box = options.Number("start_box");

  // Far enough inside that the window and its counterparts at any start stay in the images.
  const int border_y = model.size / 2 + 1, border_x = border_y + 45;
  Random random = Random::ForKey(pair.seed, "windows");
  std::vector<TestProblem> problems;
  for (int i = 0; i < options.Integer("windows"); ++i) {
    const auto place = [&random](int border, int length) {
      return border + static_cast<int>(random.Below(static_cast<std::uint64_t>(length - 2 * border)));
    };
    const int x = place(border_x, pair.width), y = place(border_y, pair.height);
    problems.push_back({.name = "window_" + std::to_string(i + 1), .make = [=] {
                          const auto owned =
                              std::make_shared<const OwnedWindow>(pair, model, x, y, start_box);
                          return std::shared_ptr<const FitProblem>(owned, owned->fit.get());
                        }});
  }
  return problems;
}

}  // namespace

ProblemSetType StereoWindowsSetType() {
  return {.name = "stereo_windows",
          .help = "Windows of a synthetic stereo pair with known disparity",
          .options = Specs(),
          .problems = Problems};
}

}  // namespace frond
