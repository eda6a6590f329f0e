// SPDX-License-Identifier: BSD-3-Clause
#include "models/homogeneous_net.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "models/bspline_basis.h"

namespace frond {
namespace {

std::size_t At(int i) { return static_cast<std::size_t>(i); }

// Index of the last knot ≤ t.
int LastKnotUpTo(const std::vector<double>& knots, double t) {
  return static_cast<int>(std::upper_bound(knots.begin(), knots.end(), t) - knots.begin()) - 1;
}

// Weights of control points span − p … span in the blossom value f(arguments), by the Oslo algorithm
// (Cohen, Lyche and Riesenfeld 1980). Arguments rise; knots[span] ≤ (the knot before the arguments in the
// refinement) < knots[span + 1]. Written from level 1 up, all terms are then ≥ 0.
std::array<double, kMaxDegree + 1> OsloWeights(const HomogeneousNet& net, int span, const double* arguments) {
  const int p = net.degree;
  std::array<double, kMaxDegree + 1> weights{};
  weights[At(p)] = 1;  // weights[p − k + i] belongs to control point span − k + i at level k
  for (int k = 1; k <= p; ++k) {
    const double t = arguments[k - 1];
    std::array<double, kMaxDegree + 1> next{};
    for (int i = span - k + 1; i <= span; ++i) {
      const double weight = weights[At(p - span + i)];
      const double left = net.knots[At(i)], right = net.knots[At(i + k)];
      const double share = (t - left) / (right - left);
      next[At(p - span + i)] += share * weight;
      next[At(p - span + i - 1)] += (1 - share) * weight;
    }
    weights = next;
  }
  return weights;
}

std::vector<double> RaiseMultiplicities(const std::vector<double>& knots) {
  std::vector<double> raised;
  for (std::size_t i = 0; i < knots.size(); ++i) {
    raised.push_back(knots[i]);
    if (i + 1 == knots.size() || knots[i + 1] != knots[i]) raised.push_back(knots[i]);
  }
  return raised;
}

}  // namespace

int Multiplicity(const HomogeneousNet& net, double t) {
  return static_cast<int>(std::count(net.knots.begin(), net.knots.end(), t));
}

double SnapToKnot(const HomogeneousNet& net, double t) {
  const auto nearest = std::min_element(net.knots.begin(), net.knots.end(), [t](double a, double b) {
    return std::abs(a - t) < std::abs(b - t);
  });
  return std::abs(*nearest - t) < 1e-12 * (net.end() - net.begin()) ? *nearest : t;
}

void InsertKnot(HomogeneousNet& net, double t) {
  const int p = net.degree, n = net.count();
  const int k = LastKnotUpTo(net.knots, t);
  const int s = Multiplicity(net, t);
  Eigen::MatrixXd points(n + 1, net.points.cols());
  points.topRows(k - p + 1) = net.points.topRows(k - p + 1);
  for (int i = k - p + 1; i <= k - s; ++i) {
    const double left = net.knots[At(i)];
    const double alpha = (t - left) / (net.knots[At(i + p)] - left);
    points.row(i) = alpha * net.points.row(i) + (1 - alpha) * net.points.row(i - 1);
  }
  points.bottomRows(n - (k - s)) = net.points.bottomRows(n - (k - s));
  net.points = std::move(points);
  net.knots.insert(net.knots.begin() + k + 1, t);
}

HomogeneousNet Part(HomogeneousNet net, double a, double b) {
  const int p = net.degree;
  while (Multiplicity(net, a) < p) InsertKnot(net, a);
  while (Multiplicity(net, b) < p) InsertKnot(net, b);
  const int last_a = LastKnotUpTo(net.knots, a);
  const auto first_b =
      static_cast<int>(std::lower_bound(net.knots.begin(), net.knots.end(), b) - net.knots.begin());
  HomogeneousNet part;
  part.degree = p;
  part.knots.assign(At(p + 1), a);
  part.knots.insert(part.knots.end(), net.knots.begin() + last_a + 1, net.knots.begin() + first_b);
  part.knots.insert(part.knots.end(), At(p + 1), b);
  part.points = net.points.middleRows(last_a - p, first_b - last_a + p);
  return part;
}

void ElevateDegree(HomogeneousNet& net) {
  const int p = net.degree;
  std::vector<double> knots = RaiseMultiplicities(net.knots);
  const int count = static_cast<int>(knots.size()) - p - 2;
  Eigen::MatrixXd points = Eigen::MatrixXd::Zero(count, net.points.cols());
  std::array<double, kMaxDegree + 1> arguments{};
  for (int j = 0; j < count; ++j) {
    const int span = LastKnotUpTo(net.knots, knots[At(j)]);
    for (int omitted = 1; omitted <= p + 1; ++omitted) {
      std::size_t filled = 0;
      for (int k = 1; k <= p + 1; ++k) {
        if (k != omitted) arguments[filled++] = knots[At(j + k)];
      }
      const auto weights = OsloWeights(net, span, arguments.data());
      for (int i = 0; i <= p; ++i) {
        if (weights[At(i)] != 0) points.row(j) += weights[At(i)] / (p + 1) * net.points.row(span - p + i);
      }
    }
  }
  net = {p + 1, std::move(knots), std::move(points)};
}

HomogeneousNet Unroll(const HomogeneousNet& net) {
  const int p = net.degree, distinct = net.count() - p;
  const double length = net.end() - net.begin();
  HomogeneousNet unrolled;
  unrolled.degree = p;
  const int count = 3 * distinct + p;
  unrolled.points.resize(count, net.points.cols());
  for (int i = 0; i < count; ++i) unrolled.points.row(i) = net.points.row(i % distinct);
  for (int i = 0; i < count + p + 1; ++i) {
    // The middle period keeps its knots to the bit: net.knots[k] stands at distinct + k.
    const int k = i - distinct;
    if (k >= 0 && k <= net.count() + p) {
      unrolled.knots.push_back(net.knots[At(k)]);
    } else {
      unrolled.knots.push_back(net.knots[At(k < 0 ? k + distinct : k - distinct)] +
                               (k < 0 ? -length : length));
    }
  }
  return unrolled;
}

HomogeneousNet MiddlePeriod(const HomogeneousNet& unrolled, double begin, double end) {
  const int p = unrolled.degree;
  const int first = LastKnotUpTo(unrolled.knots, begin), last = LastKnotUpTo(unrolled.knots, end);
  const int distinct = last - first;
  HomogeneousNet net;
  net.degree = p;
  net.knots.assign(unrolled.knots.begin() + first - p, unrolled.knots.begin() + last + p + 1);
  net.points = unrolled.points.middleRows(first - p, distinct + p);
  net.points.bottomRows(p) = net.points.topRows(p).eval();
  return net;
}

void Reverse(HomogeneousNet& net) {
  const double begin = net.begin(), end = net.end();
  for (double& knot : net.knots) {
    // Exact at both ends of the domain.
    knot = knot - begin < end - knot ? end - (knot - begin) : begin + (end - knot);
  }
  std::reverse(net.knots.begin(), net.knots.end());
  net.points = net.points.colwise().reverse().eval();
}

}  // namespace frond
