// SPDX-License-Identifier: BSD-3-Clause
// Accuracy of matching on the synthetic pear (MATH.md §3: height 100 mm, distance 600 mm, f = 2000 px, noise
// 1.5 grey levels, a lamp that stays while the pear turns), beside OpenCV's block matching, semi-global
// matching and ECC. Windows every 4 pixels, at least 10 pixels inside the silhouette; errors of those that a
// method finds (frond: accepts) and that are not off by more than a pixel (gross). "no tests": all windows
// that converge are accepted, as ECC's are; "plain": neither smoothing nor the removal of the bias by
// curvature.
//
//   bench_turntable_accuracy [seeds = 2] [threads = 1]
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>
#include <numbers>
#include <opencv2/calib3d.hpp>
#include <opencv2/video/tracking.hpp>
#include <string>
#include <vector>

#include "problems/stereo/stereo_matcher.h"
#include "problems/turntable/synthetic_turntable.h"
#include "problems/turntable/view_images.h"

namespace frond {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr int kStep = 4, kInside = 10;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// One pair of normal images with the truth at its windows.
struct Case {
  NormalPair pair;
  struct Window {
    int x, y;
    double disparity, range_slope;
  };
  std::vector<Window> windows;
};

struct Variant {
  std::string name;
  double phi = 4;
  bool lamp = true;
  Exposure exposure = {};
  double contrast = SyntheticTurntableOptions().contrast;
};

Case MakeCase(const Variant& variant, std::uint64_t seed, int threads) {
  SyntheticTurntableOptions options;
  options.seed = seed;
  options.tilt = options.offset = 0;
  options.distortion = {0, 0, 0, 0, 0};
  options.phi = variant.phi;
  options.contrast = variant.contrast;
  options.second_exposure = variant.exposure;
  if (!variant.lamp) {
    options.lighting.ambient = 1;
    options.lighting.diffuse = options.lighting.specular = 0;
  }
  const SyntheticTurntable session(options);
  const double half = variant.phi / 2 * kDegree, base = session.scene().pear_origin.z();
  const auto view = [&](std::size_t index) {
    SyntheticView photograph = session.View(index, threads);
    return TurntableView{.angle = session.views()[index].angle,
                         .image = std::move(photograph.image),
                         .mask = std::move(photograph.mask)};
  };
  Case result;
  result.pair = RectifyViews(view(0), view(1), session.rig(),
                             {.radius = 38, .bottom = base, .top = base + options.pear.height}, threads);
  const Rectification& normal = result.pair.normal;
  Mask pear(normal.width, normal.height, 0);
  for (int y = 0; y < normal.height; ++y) {
    for (int x = 0; x < normal.width; ++x) {
      pear(x, y) = FindTrueMatch(session.scene(), normal, half, -half, x, y).has_value() ? 1 : 0;
    }
  }
  const auto inside = [&](int x, int y) {
    for (int dy = -kInside; dy <= kInside; ++dy) {
      for (int dx = -kInside; dx <= kInside; ++dx) {
        if (!pear.Contains(x + dx, y + dy) || pear(x + dx, y + dy) == 0) return false;
      }
    }
    return true;
  };
  for (int y = 0; y < normal.height; y += kStep) {
    for (int x = 0; x < normal.width; x += kStep) {
      if (!inside(x, y)) continue;
      const auto match = FindTrueMatch(session.scene(), normal, half, -half, x, y);
      if (!match->seen) continue;
      result.windows.push_back({x, y, match->disparity, normal.RangeSlope(x, y, match->disparity)});
    }
  }
  return result;
}

// --- OpenCV ---

cv::Mat Bytes(const Image& image) {
  cv::Mat bytes(image.height, image.width, CV_8U);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) bytes.at<uchar>(y, x) = cv::saturate_cast<uchar>(image(x, y));
  }
  return bytes;
}

cv::Mat Floats(const Image& image) {
  return cv::Mat(image.height, image.width, CV_32F, const_cast<float*>(image.values.data())).clone();
}

constexpr int kLeast = -32, kRange = 64;  // of disparities that OpenCV searches

std::vector<double> Disparities(const Case& c, const cv::Mat& sixteenths) {
  std::vector<double> disparities;
  for (const Case::Window& w : c.windows) {
    const short value = sixteenths.at<short>(w.y, w.x);
    disparities.push_back(value < 16 * kLeast ? kNone : value / 16.0);
  }
  return disparities;
}

std::vector<double> BlockMatching(const Case& c) {
  const auto matcher = cv::StereoBM::create(kRange, 21);
  matcher->setMinDisparity(kLeast);
  cv::Mat sixteenths;
  matcher->compute(Bytes(c.pair.left), Bytes(c.pair.right), sixteenths);
  return Disparities(c, sixteenths);
}

// With block size b, penalties of 8 b² and 32 b² as OpenCV's documentation has them; or a quarter of them.
std::vector<double> SemiGlobal(const Case& c, int block, int penalty, int cap) {
  const auto matcher = cv::StereoSGBM::create(kLeast, kRange, block, penalty * block * block,
                                              4 * penalty * block * block, 1, cap, 10);
  cv::Mat sixteenths;
  matcher->compute(Bytes(c.pair.left), Bytes(c.pair.right), sixteenths);
  return Disparities(c, sixteenths);
}

// Affine, a window at a time, from the true disparity to a pixel.
std::vector<double> Ecc(const Case& c, int size) {
  constexpr int kMargin = 8;
  const int half = size / 2;
  const cv::Mat left = Floats(c.pair.left), right = Floats(c.pair.right);
  std::vector<double> disparities;
  for (const Case::Window& w : c.windows) {
    const int start = static_cast<int>(std::lround(w.disparity));
    const cv::Rect from(w.x - half, w.y - half, size, size);
    const cv::Rect to(from.x - start - kMargin, from.y - kMargin, size + 2 * kMargin, size + 2 * kMargin);
    cv::Mat warp = (cv::Mat_<float>(2, 3) << 1, 0, kMargin, 0, 1, kMargin);
    double disparity = kNone;
    if ((to & cv::Rect(0, 0, right.cols, right.rows)) == to) {
      try {
        cv::findTransformECC(left(from).clone(), right(to).clone(), warp, cv::MOTION_AFFINE,
                             cv::TermCriteria(3, 50, 1e-5), cv::noArray(), 1);
        const auto a = [&](int k) { return static_cast<double>(warp.at<float>(0, k)); };
        disparity = w.x - (to.x + a(0) * half + a(1) * half + a(2));
      } catch (const cv::Exception&) {  // it does not converge
      }
    }
    disparities.push_back(disparity);
  }
  return disparities;
}

// --- frond ---

struct Matched {
  std::vector<double> disparities;  // NaN: not accepted
  double within = 0;                // share of the accepted ones that lie within their σ
};

Matched Match(const Case& c, StereoMatchOptions options, int threads) {
  options.step = kStep;
  const StereoMatches matches =
      MatchStereo(c.pair.left, c.pair.right, c.pair.left_mask, c.pair.right_mask, options, threads);
  Matched matched;
  int accepted = 0, within = 0;
  auto next = matches.windows.begin();  // both are in the order of rows
  for (const Case::Window& w : c.windows) {
    while (next != matches.windows.end() && (next->y < w.y || (next->y == w.y && next->x < w.x))) ++next;
    const bool good = next != matches.windows.end() && next->x == w.x && next->y == w.y &&
                      next->status == WindowStatus::kAccepted;
    matched.disparities.push_back(good ? next->match.warp[0] : kNone);
    if (!good) continue;
    ++accepted;
    within += std::abs(next->match.warp[0] - w.disparity) < next->match.sigma ? 1 : 0;
  }
  matched.within = static_cast<double>(within) / accepted;
  return matched;
}

// --- the table ---

// Over all seeds of one variant and method.
struct Errors {
  double squares = 0, range_squares = 0, within = 0;
  int windows = 0, found = 0, gross = 0, seeds = 0;

  void Add(const Case& c, const std::vector<double>& disparities, double within_share) {
    for (std::size_t i = 0; i < c.windows.size(); ++i) {
      ++windows;
      if (std::isnan(disparities[i])) continue;
      ++found;
      const double error = disparities[i] - c.windows[i].disparity;
      if (std::abs(error) > 1) {
        ++gross;
        continue;
      }
      squares += error * error;
      range_squares += error * error * c.windows[i].range_slope * c.windows[i].range_slope;
    }
    within += within_share;
    ++seeds;
  }
};

struct Method {
  std::string name;
  std::function<Matched(const Case&)> run;
};

std::vector<Method> Methods(int threads) {
  const auto peer = [](std::vector<double> disparities) { return Matched{std::move(disparities), kNone}; };
  const auto ours = [threads](MatchMethod method, auto change) {
    return [=](const Case& c) {
      StereoMatchOptions options;
      options.method = method;
      change(&options);
      return Match(c, options, threads);
    };
  };
  const auto as_it_is = [](StereoMatchOptions*) {};
  return {
      {"OpenCV BM 21", [=](const Case& c) { return peer(BlockMatching(c)); }},
      {"OpenCV SGBM 5 (8, 32)", [=](const Case& c) { return peer(SemiGlobal(c, 5, 8, 0)); }},
      {"OpenCV SGBM 9 (2, 8), cap 63", [=](const Case& c) { return peer(SemiGlobal(c, 9, 2, 63)); }},
      {"OpenCV ECC affine 15", [=](const Case& c) { return peer(Ecc(c, 15)); }},
      {"OpenCV ECC affine 21", [=](const Case& c) { return peer(Ecc(c, 21)); }},
      {"closed form",
       ours(MatchMethod::kClosedForm, [](StereoMatchOptions* o) { o->window.warp = WarpKind::kShift; })},
      {"classical DMT", ours(MatchMethod::kClassicalDmt, as_it_is)},
      {"modified DMT", ours(MatchMethod::kModifiedDmt, as_it_is)},
      {"window 15", ours(MatchMethod::kWindow, as_it_is)},
      {"window 15, no tests", ours(MatchMethod::kWindow,
                                   [](StereoMatchOptions* o) {
                                     o->min_texture = o->left_right = o->discontinuity = 0;
                                     o->min_correlation = 0;
                                     o->max_sigma = 10;
                                   })},
      {"window 15, plain", ours(MatchMethod::kWindow,
                                [](StereoMatchOptions* o) {
                                  o->window.smoothing = 0;
                                  o->curvature = false;
                                })},
      {"window 21", ours(MatchMethod::kWindow, [](StereoMatchOptions* o) { o->window.size = 21; })},
      {"window 21, quadratic", ours(MatchMethod::kWindow,
                                    [](StereoMatchOptions* o) {
                                      o->window.size = 21;
                                      o->window.warp = WarpKind::kQuadratic;
                                    })},
  };
}

void Run(int seeds, int threads) {
  const std::vector<Variant> variants = {
      {.name = "phi 4"},
      {.name = "no lamp", .lamp = false},
      {.name = "right x 0.75 + 20", .exposure = {.gain = 0.75, .offset = 20}},
      {.name = "phi 2", .phi = 2},
      {.name = "phi 6", .phi = 6},
      {.name = "contrast / 4", .contrast = SyntheticTurntableOptions().contrast / 4}};
  std::printf("| images | method | windows | found %% | gross | RMSE px | RMSE mm | within 1 sigma %% |\n");
  std::printf("|---|---|---|---|---|---|---|---|\n");
  for (const Variant& variant : variants) {
    std::vector<Case> cases;
    for (int seed = 1; seed <= seeds; ++seed) {
      cases.push_back(MakeCase(variant, static_cast<std::uint64_t>(seed), threads));
    }
    for (const Method& method : Methods(threads)) {
      Errors errors;
      for (const Case& c : cases) {
        const Matched matched = method.run(c);
        errors.Add(c, matched.disparities, matched.within);
      }
      const int fine = errors.found - errors.gross;
      std::printf("| %s | %s | %d | %.2f | %d | %.4f | %.3f | %.1f |\n", variant.name.c_str(),
                  method.name.c_str(), errors.windows, 100.0 * errors.found / errors.windows, errors.gross,
                  std::sqrt(errors.squares / fine), std::sqrt(errors.range_squares / fine),
                  100 * errors.within / errors.seeds);
      std::fflush(stdout);
    }
  }
}

}  // namespace
}  // namespace frond

int main(int argc, char** argv) {
  frond::Run(argc > 1 ? std::atoi(argv[1]) : 2, argc > 2 ? std::atoi(argv[2]) : 1);
}
