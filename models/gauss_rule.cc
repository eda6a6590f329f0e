// SPDX-License-Identifier: BSD-3-Clause
#include "models/gauss_rule.h"

#include <cmath>
#include <numbers>

namespace frond {
namespace {

// Gauss–Legendre of `count` points: Newton on the Legendre polynomial from the Chebyshev-like guess.
GaussRule MakeGaussRule(int count) {
  GaussRule rule;
  for (int k = 0; k < count; ++k) {
    double x = -std::cos(std::numbers::pi * (k + 0.75) / (count + 0.5)), derivative = 1;
    for (int iteration = 0; iteration < 20; ++iteration) {
      double previous = 1, value = x;
      for (int j = 2; j <= count; ++j) {
        const double next = ((2 * j - 1) * x * value - (j - 1) * previous) / j;
        previous = value;
        value = next;
      }
      derivative = count * (x * value - previous) / (x * x - 1);
      const double step = value / derivative;
      x -= step;
      if (std::abs(step) < 1e-16) break;
    }
    rule.nodes.push_back((x + 1) / 2);
    rule.weights.push_back(1 / ((1 - x * x) * derivative * derivative));
  }
  return rule;
}

}  // namespace

const GaussRule& GaussRuleOf(int count) {
  static const std::vector<GaussRule> rules = [] {
    std::vector<GaussRule> all(1);
    for (int n = 1; n <= kMaxGaussPoints; ++n) {
      all.push_back(n == 1 ? GaussRule{{0.5}, {1.0}} : MakeGaussRule(n));
    }
    return all;
  }();
  return rules[static_cast<std::size_t>(count)];
}

}  // namespace frond
