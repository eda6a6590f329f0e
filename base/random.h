// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace frond {

// The one generator of random numbers: xoshiro256++ (Blackman and Vigna 2019) seeded through splitmix64. Own
// distributions, because those of <random> differ between standard libraries. Always passed in by the caller.
class Random {
 public:
  explicit Random(std::uint64_t seed);

  // An independent stream for (seed, key), for example a study's seed and a job's name.
  static Random ForKey(std::uint64_t seed, std::string_view key);

  std::uint64_t NextBits();
  double Uniform();                            // in [0, 1)
  double Uniform(double lower, double upper);  // in [lower, upper)
  double Normal();                             // mean 0, standard deviation 1 (polar method)
  std::uint64_t Below(std::uint64_t bound);    // in [0, bound), bound > 0, without bias

 private:
  std::array<std::uint64_t, 4> state_;
  double spare_normal_ = 0;
  bool has_spare_normal_ = false;
};

}  // namespace frond
