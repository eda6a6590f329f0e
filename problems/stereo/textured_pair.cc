// SPDX-License-Identifier: BSD-3-Clause
#include "problems/stereo/textured_pair.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "base/random.h"

namespace frond {
namespace {

constexpr int kWaves = 150;
constexpr double kMeanLevel = 120;

struct Wave {
  double kx = 0, ky = 0, phase = 0;  // radians a pixel, radians
};

std::vector<Wave> RandomWaves(double grain, Random* random) {
  std::vector<Wave> waves(kWaves);
  for (Wave& wave : waves) {
    wave = {.kx = random->Normal() / grain,
            .ky = random->Normal() / grain,
            .phase = random->Uniform(0, 2 * std::numbers::pi)};
  }
  return waves;
}

}  // namespace

double TexturedPair::Disparity(double x, double y) const {
  return options.disparity + options.slope_x * (x - 0.5 * options.width) +
         options.slope_y * (y - 0.5 * options.height);
}

TexturedPair MakeTexturedPair(const TexturedPairOptions& options) {
  Random random(options.seed);
  const std::vector<Wave> waves = RandomWaves(options.grain, &random);
  const double amplitude = options.contrast * std::sqrt(2.0 / kWaves);
  const auto texture = [&](double x, double y) {
    double sum = 0;
    for (const Wave& wave : waves) sum += std::cos(wave.kx * x + wave.ky * y + wave.phase);
    return kMeanLevel + amplitude * sum;
  };
  TexturedPair pair{.options = options,
                    .left = Image(options.width, options.height),
                    .right = Image(options.width, options.height)};
  for (int y = 0; y < options.height; ++y) {
    for (int x = 0; x < options.width; ++x) {
      // The left column that is seen at x of the right image: x_left − disparity(x_left, y) = x.
      const double left_x = (x + pair.Disparity(0, y)) / (1 - options.slope_x);
      pair.left(x, y) = static_cast<float>(texture(x, y) + options.noise * random.Normal());
      pair.right(x, y) = static_cast<float>(options.gain * texture(left_x, y) + options.offset +
                                            options.noise * random.Normal());
    }
  }
  return pair;
}

}  // namespace frond
