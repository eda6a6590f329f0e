// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace frond {

// Wall time of one named stage of a fit, in seconds.
struct StageTime {
  std::string name;
  double seconds = 0;
};

// Notes how long each stage took: End("frame") closes the stage that began at construction or at the last
// End.
class StageClock {
 public:
  void End(const std::string& name) {
    const auto now = Clock::now();
    stages_.push_back({name, std::chrono::duration<double>(now - last_).count()});
    last_ = now;
  }
  const std::vector<StageTime>& stages() const { return stages_; }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
  std::vector<StageTime> stages_;
};

}  // namespace frond
