// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace frond {

// While one lives, what Ceres logs through glog stays off stderr, even where it is told to be silent ("Error
// in evaluating the ResidualBlock", a page each time a step is tried where a residual is not finite); solvers
// put the cause into their report instead. Nests, and may live on several threads at once. glog knows one
// threshold for the whole program, so other code's messages below FATAL are held back too meanwhile.
class QuietCeresLog {
 public:
  QuietCeresLog();
  ~QuietCeresLog();
  QuietCeresLog(const QuietCeresLog&) = delete;
  QuietCeresLog& operator=(const QuietCeresLog&) = delete;
};

}  // namespace frond
