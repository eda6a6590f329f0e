// SPDX-License-Identifier: BSD-3-Clause
#include "models/bspline_basis.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/errors.h"

namespace frond {
namespace {

void CheckKnots(int degree, const std::vector<double>& knots, bool periodic) {
  if (degree < 1 || degree > kMaxDegree) {
    throw InputError("degree " + std::to_string(degree) + " is outside [1, " + std::to_string(kMaxDegree) +
                     "]");
  }
  const auto p = static_cast<std::size_t>(degree);
  if (knots.size() < 2 * (p + 1)) {
    throw InputError("a knot vector of degree " + std::to_string(degree) + " needs at least " +
                     std::to_string(2 * (p + 1)) + " knots, not " + std::to_string(knots.size()));
  }
  for (std::size_t i = 0; i < knots.size(); ++i) {
    if (!std::isfinite(knots[i])) throw InputError("knot " + std::to_string(i) + " is not finite");
    if (i > 0 && knots[i] < knots[i - 1]) throw InputError("knot " + std::to_string(i) + " decreases");
  }
  const std::size_t n = knots.size() - p - 1;
  const double length = knots[n] - knots[p];
  if (!(length > 0)) throw InputError("the knot vector's domain is empty");
  for (std::size_t i = 1; i + p + 1 < knots.size(); ++i) {
    const bool inside = knots[i] > knots[p] && knots[i] < knots[n];
    if ((inside || periodic) && knots[i + p] == knots[i]) {
      throw InputError("knot " + std::to_string(i) + " has a multiplicity above the degree");
    }
  }
  if (!periodic) return;
  if (n < 2 * p + 1) {
    throw InputError("a periodic direction of degree " + std::to_string(degree) + " needs at least " +
                     std::to_string(p + 1) + " distinct control points (" + std::to_string(2 * p + 1) +
                     " with the repeated ones), not " + std::to_string(n) + " with the repeated ones");
  }
  for (std::size_t i = 0; i < 2 * p + 1; ++i) {
    if (std::abs(knots[i] + length - knots[i + n - p]) > 1e-9 * length) {
      throw InputError("the knots of a periodic direction do not repeat with the domain's length");
    }
  }
}

// Makes the knots outside the domain copies of those inside, shifted by the domain's length: rounding in them
// (checked above to be small) would open the seam.
void RepeatKnots(std::size_t p, std::vector<double>& knots) {
  const std::size_t n = knots.size() - p - 1;
  const double length = knots[n] - knots[p];
  for (std::size_t i = 0; i < p; ++i) {
    knots[i] = knots[i + n - p] == knots[n] ? knots[p] : std::min(knots[p], knots[i + n - p] - length);
  }
  for (std::size_t i = 1; i <= p; ++i) {
    knots[n + i] = knots[p + i] == knots[p] ? knots[n] : std::max(knots[n], knots[p + i] + length);
  }
}

}  // namespace

BSplineBasis::BSplineBasis(int degree, std::vector<double> knots, bool periodic)
    : degree_(degree), knots_(std::move(knots)), periodic_(periodic) {
  CheckKnots(degree_, knots_, periodic_);
  if (periodic_) RepeatKnots(static_cast<std::size_t>(degree_), knots_);
  for (int s = degree_; s < num_control_points(); ++s) {
    const auto i = static_cast<std::size_t>(s);
    if (knots_[i] < knots_[i + 1]) spans_.push_back(s);
  }
}

double BSplineBasis::IntoDomain(double t) const {
  if (!periodic_) return std::clamp(t, begin(), end());
  const double length = end() - begin();
  const double wrapped = t - length * std::floor((t - begin()) / length);
  return wrapped < begin() || wrapped >= end() ? begin() : wrapped;
}

int BSplineBasis::FindSpan(double t) const {
  if (t >= end()) return spans_.back();
  if (t <= begin()) return spans_.front();
  const auto first = knots_.begin() + degree_;
  const auto last = knots_.begin() + num_control_points() + 1;
  return static_cast<int>(std::upper_bound(first, last, t) - knots_.begin()) - 1;
}

}  // namespace frond
