// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "models/curve_spans.h"

namespace frond {

// The nearest point of a curve to a given one, eqs (36) and (37) of Moustakides et al. `at_end`: an end of an
// open curve, where the distance would fall further outside.
struct CurveFoot {
  double t = 0;
  double squared_distance = 0;
  bool at_end = false;
};

struct CurveFootOptions {
  int max_iterations = 20;
  // Newton stops after a step of at most this length (the data's unit); the error left is of its square.
  double step_tolerance = 0;
};

// Safeguarded Newton in the domain from t: Newton's slope where it is positive, Gauss–Newton's otherwise;
// steps that do not lower the distance are halved. Closed curves wrap.
CurveFoot RefineCurveFoot(const CurveSpans& spans, const Eigen::Vector3d& point, double t,
                          const CurveFootOptions& options);

// Global search. Of samples along the curve, each that is nearer than its neighbours starts RefineCurveFoot,
// as far as the curve beside it can come nearer than the best foot so far. No tree: a curve has few hundred
// samples, and those at a far point's distance may lie anywhere. Searches are re-entrant.
class CurveFootSearch {
 public:
  // `per_span` samples a knot span. `spans` must outlive this.
  explicit CurveFootSearch(const CurveSpans& spans, int per_span = 16);

  CurveFoot Find(const Eigen::Vector3d& point) const;

  // The better of Find and the foot refined from a given start.
  CurveFoot FindFrom(const Eigen::Vector3d& point, double t) const;

  const CurveFootOptions& options() const { return options_; }

 private:
  const CurveSpans* spans_;
  std::vector<Eigen::Vector3d> samples_;
  std::vector<double> parameters_;
  std::vector<double> reach_;  // of the curve between a sample and its neighbours, from the sample
  CurveFootOptions options_;
};

}  // namespace frond
