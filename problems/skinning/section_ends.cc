// SPDX-License-Identifier: BSD-3-Clause
#include "problems/skinning/section_ends.h"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "base/errors.h"
#include "problems/skinning/local_quadric.h"
#include "problems/skinning/section_planes.h"

namespace frond {
namespace {

constexpr double kEndShare = 0.25;
constexpr double kLargestHole = 0.35;  // of the median radius

struct EndPoint {
  Eigen::Vector3d point;
  double outward, angle, radius;  // along the line, larger towards the end; about it; from it
};

double MedianRadius(const std::vector<EndPoint>& near) {
  std::vector<double> radii;
  for (const EndPoint& p : near) radii.push_back(p.radius);
  std::nth_element(radii.begin(), radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2), radii.end());
  return radii[radii.size() / 2];
}

// The outermost point of each sector, in the order of the angle; sectors without points are left out.
std::vector<EndPoint> OutermostBySector(const std::vector<EndPoint>& near, int sectors) {
  std::vector<const EndPoint*> best(static_cast<std::size_t>(sectors), nullptr);
  for (const EndPoint& p : near) {
    const int k = std::min(static_cast<int>(p.angle / (2 * std::numbers::pi) * sectors), sectors - 1);
    const EndPoint*& now = best[static_cast<std::size_t>(k)];
    if (now == nullptr || p.outward > now->outward) now = &p;
  }
  std::vector<EndPoint> ring;
  for (const EndPoint* p : best) {
    if (p != nullptr) ring.push_back(*p);
  }
  return ring;
}

// A ring's position along the line as a Fourier series of the angle.
struct SmoothRing {
  Eigen::VectorXd coefficients;

  static Eigen::RowVectorXd Row(double angle, int order) {
    Eigen::RowVectorXd row(1 + 2 * order);
    row[0] = 1;
    for (int k = 1; k <= order; ++k) {
      row[2 * k - 1] = std::cos(k * angle);
      row[2 * k] = std::sin(k * angle);
    }
    return row;
  }
  SmoothRing(const std::vector<EndPoint>& ring, int order) {
    Eigen::MatrixXd left(static_cast<Eigen::Index>(ring.size()), 1 + 2 * order);
    Eigen::VectorXd right(left.rows());
    for (Eigen::Index k = 0; k < left.rows(); ++k) {
      left.row(k) = Row(ring[static_cast<std::size_t>(k)].angle, order);
      right[k] = ring[static_cast<std::size_t>(k)].outward;
    }
    coefficients = left.colPivHouseholderQr().solve(right);
  }
  double At(double angle) const {
    return Row(angle, static_cast<int>(coefficients.size() / 2)).dot(coefficients);
  }
};

// The ring without the points that lie more than `depth` inside a smooth one.
std::vector<EndPoint> WithoutGaps(const std::vector<EndPoint>& ring, double depth) {
  std::vector<EndPoint> kept = ring;
  for (int round = 0; round < 8 && kept.size() >= 8; ++round) {
    const SmoothRing smooth(kept, 2);
    std::vector<EndPoint> next;
    for (const EndPoint& p : ring) {
      if (p.outward > smooth.At(p.angle) - depth) next.push_back(p);
    }
    const bool settled = next.size() == kept.size();
    kept = std::move(next);
    if (settled) break;
  }
  return kept;
}

}  // namespace

CloudEnd FindEnd(std::span<const Eigen::Vector3d> points, const KdTree& tree, double spacing,
                 const CentreLine& line, std::span<const double> positions, bool first, SectionEnd wanted) {
  const double sign = first ? -1 : 1;
  double top = -std::numeric_limits<double>::infinity(), bottom = -top;
  for (const double s : positions) {
    top = std::max(top, sign * s);
    bottom = std::min(bottom, sign * s);
  }
  SectionPlane plane;
  plane.origin = line.At(sign * top);
  plane.normal = line.Tangent(sign * top);
  plane.start = plane.normal.unitOrthogonal();
  std::vector<EndPoint> near;
  const EndPoint* outermost = nullptr;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (sign * positions[i] < top - kEndShare * (top - bottom)) continue;
    const Eigen::Vector3d offset = points[i] - line.At(positions[i]);
    near.push_back({points[i], sign * positions[i], plane.Angle(plane.origin + offset), offset.norm()});
  }
  for (const EndPoint& p : near) {
    if (outermost == nullptr || p.outward > outermost->outward) outermost = &p;
  }
  const double median = MedianRadius(near);
  CloudEnd end;
  end.kind = wanted;
  if (wanted == SectionEnd::kAuto) {
    double hole = std::numeric_limits<double>::infinity();
    for (const EndPoint& p : near) hole = std::min(hole, p.radius);
    end.kind = hole < kLargestHole * median ? SectionEnd::kPole : SectionEnd::kRim;
  }
  if (end.kind == SectionEnd::kPole) {
    end.pole = outermost->point;
    if (const auto quadric = FitLocalQuadric(points, tree, outermost->point)) {
      end.pole = HighestPoint(*quadric, sign * plane.normal, 3 * spacing);
    }
    const double height = sign * line.Locate(end.pole);
    end.position = sign * height;
    double squares = 0, depths = 0;
    for (const EndPoint& p : near) {
      const double radius = (p.point - end.pole).cross(plane.normal).norm();
      if (radius > 0.5 * median) continue;
      squares += radius * radius / 2;
      depths += std::max(height - p.outward, 0.0);
    }
    end.pole_radius = depths > 0 ? squares / depths : 0;
    return end;
  }
  const int sectors = std::clamp(static_cast<int>(2 * std::numbers::pi * median / (1.3 * spacing)), 8, 90);
  const std::vector<EndPoint> ring = OutermostBySector(near, sectors);
  const std::vector<EndPoint> rim = WithoutGaps(ring, 0.5 * spacing);
  if (end.kind == SectionEnd::kRim && 2 * rim.size() < static_cast<std::size_t>(sectors)) {
    throw InputError(std::string("the cloud has no rim all round its ") + (first ? "first" : "last") +
                     " end; set sections." + (first ? "first" : "last") + ": plane");
  }
  if (end.kind == SectionEnd::kPlane) {
    double inside = top;
    for (const EndPoint& p : rim) inside = std::min(inside, p.outward);
    end.position = sign * inside;
    return end;
  }
  // A ragged rim would fold the surface beside it: its points move along the surface onto a smooth ring.
  const SmoothRing smooth(rim, rim.size() >= 16 ? 4 : 2);
  double inside = top;
  for (const EndPoint& p : rim) {
    const double position = smooth.At(p.angle);
    inside = std::min(inside, position);
    end.rim.push_back(p.point);
    const auto quadric = FitLocalQuadric(points, tree, p.point);
    if (!quadric) continue;
    const auto moved =
        MoveToPlane(*quadric, line.At(sign * position), line.Tangent(sign * position), 2 * spacing);
    if (moved) end.rim.back() = moved->position;
  }
  end.position = sign * inside;
  return end;
}

}  // namespace frond
