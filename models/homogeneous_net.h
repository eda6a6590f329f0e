// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace frond {

// One direction of a curve or surface as a vector-valued B-spline: the shared ground of knot insertion,
// degree elevation and splitting. Row i of `points` holds all coordinates (for a surface, of the whole row of
// the net) that go with function N_i, homogeneous: (w x, w y, w z, w). knots.size() = rows + degree + 1.
struct HomogeneousNet {
  int degree;
  std::vector<double> knots;
  Eigen::MatrixXd points;

  int count() const { return static_cast<int>(points.rows()); }
  double begin() const { return knots[static_cast<std::size_t>(degree)]; }
  double end() const { return knots[static_cast<std::size_t>(count())]; }
};

// How often `t` stands among the knots.
int Multiplicity(const HomogeneousNet& net, double t);

// The knot nearest to t if it is nearer than 1e-12 of the domain's length, t otherwise.
double SnapToKnot(const HomogeneousNet& net, double t);

// One more knot t in [begin, end], of multiplicity below the degree so far (algorithm A5.1).
void InsertKnot(HomogeneousNet& net, double t);

// The part over [a, b] as a clamped net, begin ≤ a < b ≤ end.
HomogeneousNet Part(HomogeneousNet net, double a, double b);

// Degree + 1 of a clamped net; every distinct knot's multiplicity grows by one. Each new control point is a
// mean of degree + 1 blossom values (Ramshaw's rule), each of these a convex combination of old control
// points (the Oslo algorithm): no digits are lost, in contrast to removing knots from elevated Bézier pieces.
void ElevateDegree(HomogeneousNet& net);

// A periodic net as three periods of it, [begin − L, end + L], and the middle one back as a periodic net.
HomogeneousNet Unroll(const HomogeneousNet& net);
HomogeneousNet MiddlePeriod(const HomogeneousNet& unrolled, double begin, double end);

// t runs backwards: C(begin + end − t).
void Reverse(HomogeneousNet& net);

}  // namespace frond
