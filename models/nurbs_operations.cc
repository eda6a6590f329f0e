// SPDX-License-Identifier: BSD-3-Clause
#include "models/nurbs_operations.h"

#include <cmath>
#include <functional>
#include <string>

#include "base/errors.h"
#include "models/homogeneous_net.h"

namespace frond {
namespace {

std::size_t At(Eigen::Index i) { return static_cast<std::size_t>(i); }

HomogeneousNet NetOf(const NurbsCurve& curve) {
  HomogeneousNet net{curve.basis().degree(), curve.basis().knots(), {}};
  net.points.resize(curve.basis().num_control_points(), 4);
  for (Eigen::Index i = 0; i < net.points.rows(); ++i) {
    const double w = curve.weights()[At(i)];
    net.points.row(i) << w * curve.control_points()[At(i)].transpose(), w;
  }
  return net;
}

NurbsCurve CurveOf(HomogeneousNet net, bool periodic) {
  std::vector<Eigen::Vector3d> points;
  std::vector<double> weights;
  for (Eigen::Index i = 0; i < net.points.rows(); ++i) {
    weights.push_back(net.points(i, 3));
    points.push_back(net.points.row(i).head<3>().transpose() / net.points(i, 3));
  }
  return NurbsCurve(BSplineBasis(net.degree, std::move(net.knots), periodic), std::move(points),
                    std::move(weights));
}

const BSplineBasis& BasisOf(const NurbsSurface& surface, Direction direction) {
  return direction == Direction::kU ? surface.u() : surface.v();
}

// Row i: the control points of index i in `direction`, in the order of the other index, four numbers each.
HomogeneousNet NetOf(const NurbsSurface& surface, Direction direction) {
  const bool along_u = direction == Direction::kU;
  const BSplineBasis& basis = BasisOf(surface, direction);
  const int others = along_u ? surface.count_v() : surface.count_u();
  HomogeneousNet net{basis.degree(), basis.knots(), {}};
  net.points.resize(basis.num_control_points(), 4 * others);
  for (int i = 0; i < basis.num_control_points(); ++i) {
    for (int j = 0; j < others; ++j) {
      const int iu = along_u ? i : j, iv = along_u ? j : i;
      const double w = surface.weight(iu, iv);
      net.points.block<1, 4>(i, 4 * j) << w * surface.control_point(iu, iv).transpose(), w;
    }
  }
  return net;
}

// The surface whose `direction` is `net`; the other direction's basis is that of `surface`.
NurbsSurface SurfaceOf(const NurbsSurface& surface, Direction direction, HomogeneousNet net, bool periodic) {
  const bool along_u = direction == Direction::kU;
  const Eigen::Index rows = net.points.rows(), others = net.points.cols() / 4;
  std::vector<Eigen::Vector3d> points(At(rows * others));
  std::vector<double> weights(points.size());
  for (Eigen::Index i = 0; i < rows; ++i) {
    for (Eigen::Index j = 0; j < others; ++j) {
      const std::size_t k = At(along_u ? i * others + j : j * rows + i);
      weights[k] = net.points(i, 4 * j + 3);
      points[k] = net.points.block<1, 3>(i, 4 * j).transpose() / weights[k];
    }
  }
  BSplineBasis basis(net.degree, std::move(net.knots), periodic);
  return along_u ? NurbsSurface(std::move(basis), surface.v(), std::move(points), std::move(weights))
                 : NurbsSurface(surface.u(), std::move(basis), std::move(points), std::move(weights));
}

double CheckedParameter(const HomogeneousNet& net, double t) {
  t = SnapToKnot(net, t);
  if (!(t >= net.begin() && t <= net.end())) {
    throw InputError("parameter " + std::to_string(t) + " is outside the domain [" +
                     std::to_string(net.begin()) + ", " + std::to_string(net.end()) + "]");
  }
  return t;
}

void InsertChecked(HomogeneousNet& net, double t) {
  if (Multiplicity(net, t) >= net.degree) {
    throw InputError("knot " + std::to_string(t) + " has the multiplicity " + std::to_string(net.degree) +
                     " of the degree already");
  }
  InsertKnot(net, t);
}

HomogeneousNet WithKnots(HomogeneousNet net, bool periodic, std::span<const double> knots) {
  const double begin = net.begin(), end = net.end(), length = end - begin;
  std::vector<double> inserted;
  for (const double t : knots) inserted.push_back(CheckedParameter(net, t));
  if (!periodic) {
    for (const double t : inserted) InsertChecked(net, t);
    return net;
  }
  HomogeneousNet unrolled = Unroll(net);
  for (const double t : inserted) {
    for (const double image : {t - length, t, t + length}) {
      const double snapped = SnapToKnot(unrolled, image);
      if (snapped >= unrolled.begin() && snapped <= unrolled.end()) InsertChecked(unrolled, snapped);
    }
  }
  return MiddlePeriod(unrolled, begin, end);
}

HomogeneousNet Elevated(HomogeneousNet net, bool periodic, int by) {
  if (by < 0 || net.degree + by > kMaxDegree) {
    throw InputError("degree " + std::to_string(net.degree) + " cannot be raised by " + std::to_string(by) +
                     " (the largest is " + std::to_string(kMaxDegree) + ")");
  }
  if (by == 0) return net;
  const double begin = net.begin(), end = net.end();
  if (periodic) net = Unroll(net);
  const double a = net.begin(), b = net.end();
  net = Part(std::move(net), a, b);
  for (int i = 0; i < by; ++i) ElevateDegree(net);
  return periodic ? MiddlePeriod(net, begin, end) : net;
}

HomogeneousNet CheckedPart(HomogeneousNet net, double begin, double end) {
  const double a = CheckedParameter(net, begin), b = CheckedParameter(net, end);
  if (!(a < b))
    throw InputError("a part from " + std::to_string(a) + " to " + std::to_string(b) + " is empty");
  return Part(std::move(net), a, b);
}

std::vector<double> MiddlesOfSpans(const BSplineBasis& basis) {
  std::vector<double> middles;
  for (const int s : basis.spans()) middles.push_back((basis.knots()[At(s)] + basis.knots()[At(s + 1)]) / 2);
  return middles;
}

void CheckInside(const BSplineBasis& basis, double t) {
  if (!(t > basis.begin() && t < basis.end())) {
    throw InputError("cannot split at " + std::to_string(t) + ": not inside the domain (" +
                     std::to_string(basis.begin()) + ", " + std::to_string(basis.end()) + ")");
  }
}

}  // namespace

NurbsCurve InsertKnots(const NurbsCurve& curve, std::span<const double> knots) {
  const bool periodic = curve.basis().periodic();
  return CurveOf(WithKnots(NetOf(curve), periodic, knots), periodic);
}

NurbsSurface InsertKnots(const NurbsSurface& surface, Direction direction, std::span<const double> knots) {
  const bool periodic = BasisOf(surface, direction).periodic();
  return SurfaceOf(surface, direction, WithKnots(NetOf(surface, direction), periodic, knots), periodic);
}

NurbsCurve Refine(const NurbsCurve& curve) { return InsertKnots(curve, MiddlesOfSpans(curve.basis())); }

NurbsSurface Refine(const NurbsSurface& surface, Direction direction) {
  return InsertKnots(surface, direction, MiddlesOfSpans(BasisOf(surface, direction)));
}

NurbsCurve ElevateDegree(const NurbsCurve& curve, int by) {
  const bool periodic = curve.basis().periodic();
  return CurveOf(Elevated(NetOf(curve), periodic, by), periodic);
}

NurbsSurface ElevateDegree(const NurbsSurface& surface, Direction direction, int by) {
  const bool periodic = BasisOf(surface, direction).periodic();
  return SurfaceOf(surface, direction, Elevated(NetOf(surface, direction), periodic, by), periodic);
}

NurbsCurve Part(const NurbsCurve& curve, double begin, double end) {
  return CurveOf(CheckedPart(NetOf(curve), begin, end), false);
}

NurbsSurface Part(const NurbsSurface& surface, Direction direction, double begin, double end) {
  return SurfaceOf(surface, direction, CheckedPart(NetOf(surface, direction), begin, end), false);
}

NurbsCurve Clamped(const NurbsCurve& curve) {
  return Part(curve, curve.basis().begin(), curve.basis().end());
}

NurbsSurface Clamped(const NurbsSurface& surface, Direction direction) {
  const BSplineBasis& basis = BasisOf(surface, direction);
  return Part(surface, direction, basis.begin(), basis.end());
}

std::pair<NurbsCurve, NurbsCurve> Split(const NurbsCurve& curve, double t) {
  CheckInside(curve.basis(), t);
  return {Part(curve, curve.basis().begin(), t), Part(curve, t, curve.basis().end())};
}

std::pair<NurbsSurface, NurbsSurface> Split(const NurbsSurface& surface, Direction direction, double t) {
  const BSplineBasis& basis = BasisOf(surface, direction);
  CheckInside(basis, t);
  return {Part(surface, direction, basis.begin(), t), Part(surface, direction, t, basis.end())};
}

NurbsCurve Reversed(const NurbsCurve& curve) {
  HomogeneousNet net = NetOf(curve);
  Reverse(net);
  return CurveOf(std::move(net), curve.basis().periodic());
}

NurbsSurface Reversed(const NurbsSurface& surface, Direction direction) {
  HomogeneousNet net = NetOf(surface, direction);
  Reverse(net);
  return SurfaceOf(surface, direction, std::move(net), BasisOf(surface, direction).periodic());
}

NurbsSurface Transposed(const NurbsSurface& surface) {
  std::vector<Eigen::Vector3d> points;
  std::vector<double> weights;
  for (int j = 0; j < surface.count_v(); ++j) {
    for (int i = 0; i < surface.count_u(); ++i) {
      points.push_back(surface.control_point(i, j));
      weights.push_back(surface.weight(i, j));
    }
  }
  return NurbsSurface(surface.v(), surface.u(), std::move(points), std::move(weights));
}

NurbsCurve Transformed(const NurbsCurve& curve, const Eigen::Affine3d& map) {
  std::vector<Eigen::Vector3d> points = curve.control_points();
  for (Eigen::Vector3d& point : points) point = map * point;
  return NurbsCurve(curve.basis(), std::move(points), curve.weights());
}

NurbsSurface Transformed(const NurbsSurface& surface, const Eigen::Affine3d& map) {
  std::vector<Eigen::Vector3d> points = surface.control_points();
  for (Eigen::Vector3d& point : points) point = map * point;
  return NurbsSurface(surface.u(), surface.v(), std::move(points), surface.weights());
}

NurbsCurve IsoCurve(const NurbsSurface& surface, Direction fixed, double t) {
  const HomogeneousNet net = NetOf(surface, fixed);
  const BSplineBasis& basis = BasisOf(surface, fixed);
  const BSplineBasis& running = fixed == Direction::kU ? surface.v() : surface.u();
  const double inside = basis.IntoDomain(t);
  const int span = basis.FindSpan(inside);
  double values[kMaxDegree + 1];
  basis.Evaluate(span, inside, 0, values);
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(net.points.cols());
  for (int k = 0; k <= basis.degree(); ++k) row += values[k] * net.points.row(span - basis.degree() + k);
  HomogeneousNet curve{running.degree(), running.knots(), Eigen::MatrixXd(row.size() / 4, 4)};
  for (Eigen::Index j = 0; j < curve.points.rows(); ++j) curve.points.row(j) = row.segment<4>(4 * j);
  return CurveOf(std::move(curve), running.periodic());
}

Eigen::AlignedBox3d BoundingBox(const NurbsCurve& curve) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : curve.control_points()) box.extend(point);
  return box;
}

Eigen::AlignedBox3d BoundingBox(const NurbsSurface& surface) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : surface.control_points()) box.extend(point);
  return box;
}

}  // namespace frond
