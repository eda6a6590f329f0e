// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/camera_film.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/parallel.h"

namespace frond {
namespace {

constexpr std::array<float, 3> kLuminance = {0.299F, 0.587F, 0.114F};

std::vector<float> GaussianWeights(double sigma) {
  const int reach = static_cast<int>(std::ceil(4 * sigma));
  std::vector<float> weights;
  float sum = 0;
  for (int i = -reach; i <= reach; ++i) {
    weights.push_back(static_cast<float>(std::exp(-0.5 * i * i / (sigma * sigma))));
    sum += weights.back();
  }
  for (float& w : weights) w /= sum;
  return weights;
}

// Along x (dx = 1) or y (dy = 1); the border pixels go on outside.
Light Blur(const Light& light, const std::vector<float>& weights, int dx, int dy) {
  const int reach = static_cast<int>(weights.size() / 2);
  Light blurred(light.width, light.height);
  for (int y = 0; y < light.height; ++y) {
    for (int x = 0; x < light.width; ++x) {
      std::array<float, 3> sum{};
      for (int k = -reach; k <= reach; ++k) {
        const std::array<float, 3>& value =
            light(std::clamp(x + k * dx, 0, light.width - 1), std::clamp(y + k * dy, 0, light.height - 1));
        const float w = weights[static_cast<std::size_t>(k + reach)];
        for (std::size_t c = 0; c < 3; ++c) sum[c] += w * value[c];
      }
      blurred(x, y) = sum;
    }
  }
  return blurred;
}

float GreyLevel(double light, double noise, const Exposure& exposure, Random& random) {
  const double level = exposure.gain * light + exposure.offset + (noise > 0 ? noise * random.Normal() : 0);
  return static_cast<float>(std::clamp(std::round(level), 0.0, 255.0));
}

}  // namespace

float Luminance(const std::array<float, 3>& colour) {
  return kLuminance[0] * colour[0] + kLuminance[1] * colour[1] + kLuminance[2] * colour[2];
}

void Collect(const PixelBox& box, const PixelBox& done, int supersampling, int threads,
             const std::function<std::array<float, 3>(double u, double v)>& light, Light* film) {
  if (box.y1 <= box.y0) return;
  const float share = 1.0F / static_cast<float>(supersampling * supersampling);
  ParallelFor(static_cast<std::size_t>(box.y1 - box.y0), 4, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      const int y = box.y0 + static_cast<int>(row);
      for (int x = box.x0; x < box.x1; ++x) {
        if (done.Contains(x, y)) continue;
        std::array<float, 3> sum{};
        for (int k = 0; k < supersampling * supersampling; ++k) {
          const double u = x - 0.5 + (k % supersampling + 0.5) / supersampling;
          const double v = y - 0.5 + (k / supersampling + 0.5) / supersampling;
          const std::array<float, 3> value = light(u, v);
          for (std::size_t c = 0; c < 3; ++c) sum[c] += share * value[c];
        }
        (*film)(x, y) = sum;
      }
    }
  });
}

Photograph Develop(Light film, const Sensor& sensor, const Exposure& exposure, Random& random) {
  if (sensor.blur > 0) {
    const std::vector<float> weights = GaussianWeights(sensor.blur);
    film = Blur(Blur(film, weights, 1, 0), weights, 0, 1);
  }
  Photograph photograph{.image = Image(film.width, film.height)};
  if (!sensor.colour) {
    for (std::size_t i = 0; i < film.values.size(); ++i) {
      photograph.image.values[i] = GreyLevel(Luminance(film.values[i]), sensor.noise, exposure, random);
    }
    return photograph;
  }
  const double channel_noise = sensor.noise / std::hypot(kLuminance[0], kLuminance[1], kLuminance[2]);
  photograph.colour = ColourImage(film.width, film.height);
  for (std::size_t i = 0; i < film.values.size(); ++i) {
    std::array<float, 3> level{};
    for (std::size_t c = 0; c < 3; ++c) {
      level[c] = GreyLevel(film.values[i][c], channel_noise, exposure, random);
      photograph.colour.values[i][c] = static_cast<std::uint8_t>(level[c]);
    }
    photograph.image.values[i] = std::round(Luminance(level));
  }
  return photograph;
}

}  // namespace frond
