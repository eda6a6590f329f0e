// SPDX-License-Identifier: BSD-3-Clause
#include "tests/io/sample_pair.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/random.h"

namespace frond {
namespace {

struct Wave {
  double x = 0, y = 0, phase = 0;  // radians a pixel, radians
};

std::vector<Wave> MakeWaves() {
  Random random(11);
  std::vector<Wave> waves(60);
  for (Wave& wave : waves) {
    const double length = random.Uniform(5, 25), direction = random.Uniform(0, 2 * std::numbers::pi);
    wave = {2 * std::numbers::pi / length * std::cos(direction),
            2 * std::numbers::pi / length * std::sin(direction), random.Uniform(0, 2 * std::numbers::pi)};
  }
  return waves;
}

}  // namespace

double SampleSpeckle(double x, double y) {
  static const std::vector<Wave> waves = MakeWaves();
  double sum = 0;
  for (const Wave& wave : waves) sum += std::cos(wave.x * x + wave.y * y + wave.phase);
  return 127.5 + 107.5 * std::tanh(sum / std::sqrt(static_cast<double>(waves.size())));
}

SamplePair MakeSamplePair(int width, int height, double offset, double slope) {
  SamplePair pair{Image(width, height), Image(width, height), Image(width, height)};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double left_of_right = (x + offset) / (1 - slope);  // x_right = x − offset − slope · x
      pair.left(x, y) = static_cast<float>(SampleSpeckle(x, y));
      pair.right(x, y) = static_cast<float>(SampleSpeckle(left_of_right, y));
      pair.disparity(x, y) = static_cast<float>(offset + slope * x);
    }
  }
  return pair;
}

}  // namespace frond
