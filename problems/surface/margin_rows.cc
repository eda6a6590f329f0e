// SPDX-License-Identifier: BSD-3-Clause
#include "problems/surface/margin_rows.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <limits>

#include "models/kd_tree.h"

namespace frond {
namespace {

struct EdgeSample {
  int edge;
  double t, step;  // parameter along the edge, spacing of the samples
  double u, v;
  Eigen::Vector3d position;
};

// Edges 0, 1: u at its begin, end; 2, 3: v at its begin, end.
Eigen::Vector2d OnEdge(const SurfaceCells& cells, int edge, double t) {
  const BSplineBasis &bu = cells.basis_u(), &bv = cells.basis_v();
  switch (edge) {
    case 0:
      return {bu.begin(), t};
    case 1:
      return {bu.end(), t};
    case 2:
      return {t, bv.begin()};
    default:
      return {t, bv.end()};
  }
}

const BSplineBasis& AlongEdge(const SurfaceCells& cells, int edge) {
  return edge < 2 ? cells.basis_v() : cells.basis_u();
}

std::vector<EdgeSample> SampleEdges(const SurfaceCells& cells, int per_edge) {
  std::vector<EdgeSample> samples;
  for (int edge = 0; edge < 4; ++edge) {
    if ((edge < 2 ? cells.basis_u() : cells.basis_v()).periodic()) continue;
    if ((edge == 2 && cells.poles().begin) || (edge == 3 && cells.poles().end)) continue;
    const BSplineBasis& along = AlongEdge(cells, edge);
    const double step = (along.end() - along.begin()) / per_edge;
    for (int i = 0; i < per_edge; ++i) {
      const double t = along.begin() + (i + 0.5) * step;
      const Eigen::Vector2d uv = OnEdge(cells, edge, t);
      samples.push_back({edge, t, step, uv[0], uv[1], cells.Evaluate(uv[0], uv[1])});
    }
  }
  return samples;
}

Eigen::Matrix3d SquareTo(const Eigen::Vector3d& direction) {
  const double squared = direction.squaredNorm();
  if (!(squared > 0)) return Eigen::Matrix3d::Identity();
  return Eigen::Matrix3d::Identity() - direction * direction.transpose() / squared;
}

// Gauss–Newton along one edge from a sample; clamped to the edge's ends.
MarginRow FootOnEdge(const SurfaceCells& cells, const EdgeSample& start, const Eigen::Vector3d& point,
                     double weight) {
  const BSplineBasis& along = AlongEdge(cells, start.edge);
  double t = start.t;
  Eigen::Vector2d uv;
  Eigen::Vector3d tangent, r;
  bool at_end = false;
  for (int iteration = 0; iteration < 5; ++iteration) {
    uv = OnEdge(cells, start.edge, t);
    const SurfaceCells::Jet1 jet = cells.Evaluate1(uv[0], uv[1]);
    tangent = start.edge < 2 ? jet.dv : jet.du;
    r = jet.position - point;
    const double squared = tangent.squaredNorm();
    if (!(squared > 0) || iteration == 4) break;
    const double step = std::clamp(-r.dot(tangent) / squared, -2 * start.step, 2 * start.step);
    const double next = along.IntoDomain(t + step);
    at_end = !along.periodic() && (next == along.begin() || next == along.end());
    if (next == t) break;
    t = next;
  }
  return {uv[0], uv[1], weight, point, at_end ? Eigen::Matrix3d::Identity() : SquareTo(tangent)};
}

// The segments of all rings, by their first vertex.
class RingSegments {
 public:
  explicit RingSegments(const std::vector<std::vector<Eigen::Vector3d>>& rings)
      : vertices_(Joined(rings)), tree_(vertices_) {
    for (const auto& ring : rings) {
      const std::size_t first = next_.size(), n = ring.size();
      for (std::size_t i = 0; i < n; ++i) {
        next_.push_back(first + (i + 1) % n);
        previous_.push_back(first + (i + n - 1) % n);
        length_ += (ring[(i + 1) % n] - ring[i]).norm();
      }
    }
  }

  const std::vector<Eigen::Vector3d>& vertices() const { return vertices_; }
  double length() const { return length_; }

  // The nearest point to `point`, among the segments at the nearest vertices, and its segment's direction.
  void Nearest(const Eigen::Vector3d& point, Eigen::Vector3d* nearest, Eigen::Vector3d* direction) const {
    std::array<KdTree::Neighbour, 4> neighbours;
    const std::size_t found = tree_.Nearest(point, neighbours);
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < found; ++k) {
      for (const std::size_t first : {neighbours[k].index, previous_[neighbours[k].index]}) {
        const Eigen::Vector3d &a = vertices_[first], d = vertices_[next_[first]] - a;
        const double squared_length = d.squaredNorm();
        const double along =
            squared_length > 0 ? std::clamp((point - a).dot(d) / squared_length, 0.0, 1.0) : 0.0;
        const Eigen::Vector3d candidate = a + along * d;
        const double squared = (candidate - point).squaredNorm();
        if (squared < best) {
          best = squared;
          *nearest = candidate;
          *direction = d;
        }
      }
    }
  }

 private:
  static std::vector<Eigen::Vector3d> Joined(const std::vector<std::vector<Eigen::Vector3d>>& rings) {
    std::vector<Eigen::Vector3d> all;
    for (const auto& ring : rings) all.insert(all.end(), ring.begin(), ring.end());
    return all;
  }

  std::vector<Eigen::Vector3d> vertices_;
  KdTree tree_;
  std::vector<std::size_t> next_, previous_;
  double length_ = 0;
};

}  // namespace

std::vector<MarginRow> MakeMarginRows(const SurfaceCells& cells, const MarginOptions& options,
                                      std::size_t num_points) {
  const std::vector<EdgeSample> samples = SampleEdges(cells, options.samples_per_edge);
  std::vector<MarginRow> rows;
  if (samples.empty() || options.rings.empty()) return rows;
  std::vector<Eigen::Vector3d> positions;
  for (const EdgeSample& sample : samples) positions.push_back(sample.position);
  const KdTree edge_tree(positions);
  const RingSegments rings(options.rings);
  const double total = options.weight * static_cast<double>(num_points);
  for (const Eigen::Vector3d& point : rings.vertices()) {
    const EdgeSample& start = samples[edge_tree.Nearest(point).index];
    rows.push_back(FootOnEdge(cells, start, point, total / static_cast<double>(rings.vertices().size())));
  }
  if (options.tip) {
    const BSplineBasis& bu = cells.basis_u();
    rows.push_back({0.5 * (bu.begin() + bu.end()), cells.basis_v().end(), options.tip_share * total,
                    *options.tip, Eigen::Matrix3d::Identity()});
  }
  for (const EdgeSample& sample : samples) {
    const SurfaceCells::Jet1 jet = cells.Evaluate1(sample.u, sample.v);
    const double length = sample.step * (sample.edge < 2 ? jet.dv : jet.du).norm();
    Eigen::Vector3d nearest, direction;
    rings.Nearest(sample.position, &nearest, &direction);
    rows.push_back({sample.u, sample.v, total * length / rings.length(), nearest, SquareTo(direction)});
  }
  return rows;
}

}  // namespace frond
