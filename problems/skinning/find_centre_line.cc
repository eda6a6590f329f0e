// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Geometry>
#include <Eigen/QR>
#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <tuple>
#include <utility>

#include "base/errors.h"
#include "models/kd_tree.h"
#include "models/knot_vector.h"
#include "problems/skinning/basis_matrix.h"
#include "problems/skinning/centre_line.h"
#include "problems/skinning/section_planes.h"
#include "problems/surface/spatial_order.h"

namespace frond {
namespace {

constexpr std::size_t kGraphPoints = 4000;
constexpr std::size_t kNeighbours = 10;
constexpr int kNodes = 200;
constexpr int kFirstSteps = 10;
constexpr int kSectors = 12;
constexpr int kRepeats = 3;
constexpr double kSmoothing = 0.05;
constexpr int kInverseIterations = 40;

using Edges = std::vector<std::vector<std::pair<std::size_t, double>>>;  // to whom, and how far

Edges NeighbourGraph(const std::vector<Eigen::Vector3d>& points) {
  const KdTree tree(points);
  Edges edges(points.size());
  std::array<KdTree::Neighbour, kNeighbours + 1> found;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t count = tree.Nearest(points[i], found);
    for (std::size_t k = 0; k < count; ++k) {
      if (!(found[k].squared_distance > 0)) continue;
      const double length = std::sqrt(found[k].squared_distance);
      edges[i].emplace_back(found[k].index, length);
      edges[found[k].index].emplace_back(i, length);
    }
  }
  return edges;
}

// The points that hang together with `source`.
std::size_t Reached(const Edges& edges, std::size_t source) {
  std::vector<std::uint8_t> seen(edges.size(), 0);
  std::vector<std::size_t> stack(1, source);
  seen[source] = 1;
  std::size_t count = 1;
  while (!stack.empty()) {
    const std::size_t i = stack.back();
    stack.pop_back();
    for (const auto& [k, length] : edges[i]) {
      if (seen[k]) continue;
      seen[k] = 1;
      ++count;
      stack.push_back(k);
    }
  }
  return count;
}

// Along a long object the first eigenvector of the graph's Laplacian after the constant one is about
// cos(π s / L), and even across it. By inverse iteration from `start`; returned is s / L in [0, 1].
std::vector<double> PositionsByLaplacian(const Edges& edges, const std::vector<double>& start) {
  const auto size = static_cast<Eigen::Index>(edges.size());
  std::vector<Eigen::Triplet<double>> entries;
  double diagonal = 0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (const auto& [k, length] : edges[i]) {
      const auto row = static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(k);
      entries.emplace_back(row, row, 1 / length);
      if (column < row) entries.emplace_back(row, column, -1 / length);
      diagonal += 1 / length;
    }
  }
  for (Eigen::Index i = 0; i < size; ++i)
    entries.emplace_back(i, i, 1e-9 * diagonal / static_cast<double>(size));
  Eigen::SparseMatrix<double> laplacian(size, size);
  laplacian.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(laplacian);
  Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(start.data(), size);
  for (int k = 0; k < kInverseIterations; ++k) {
    x.array() -= x.mean();
    x = factor.solve(x).normalized();
  }
  x.array() -= x.mean();
  const double low = x.minCoeff(), high = x.maxCoeff();
  std::vector<double> position;
  for (const double value : x) {
    position.push_back(std::acos(std::clamp(1 - 2 * (value - low) / (high - low), -1.0, 1.0)) /
                       std::numbers::pi);
  }
  return position;
}

// The middles of the points in equal steps of `position`, from the first to the last step that has points all
// round; and the points' mean distance from them.
struct Steps {
  std::vector<Eigen::Vector3d> middles;
  double radius = 0;
};

// The mean of the means in equal sectors about `mean`, as far as there are points, and how many sectors have
// some. Unlike the points' mean it does not move to where they are dense.
std::pair<Eigen::Vector3d, int> Middle(const std::vector<Eigen::Vector3d>& points,
                                       const Eigen::Vector3d& mean, const Eigen::Vector3d& direction) {
  const SectionPlane plane{.origin = mean, .normal = direction, .start = direction.unitOrthogonal()};
  std::array<Eigen::Vector3d, kSectors> sum;
  std::array<double, kSectors> count{};
  sum.fill(Eigen::Vector3d::Zero());
  for (const auto& point : points) {
    const auto k = static_cast<std::size_t>(plane.Angle(point) / (2 * std::numbers::pi) * kSectors);
    sum[k] += point;
    count[k] += 1;
  }
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  int filled = 0;
  for (std::size_t k = 0; k < kSectors; ++k) {
    if (count[k] == 0) continue;
    middle += sum[k] / count[k];
    ++filled;
  }
  return {middle / std::max(filled, 1), filled};
}

Steps FindSteps(std::span<const Eigen::Vector3d> points, const std::vector<double>& position, int steps,
                int skipped) {
  const auto [low, high] = std::minmax_element(position.begin(), position.end());
  const double begin = *low, length = *high - *low;
  std::vector<std::vector<Eigen::Vector3d>> of_step(static_cast<std::size_t>(steps));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int k = std::clamp(static_cast<int>((position[i] - begin) / length * steps), 0, steps - 1);
    of_step[static_cast<std::size_t>(k)].push_back(points[i]);
  }
  std::erase_if(of_step, [](const auto& step) { return step.empty(); });
  std::vector<Eigen::Vector3d> means;
  for (const auto& step : of_step) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto& point : step) sum += point;
    means.push_back(sum / static_cast<double>(step.size()));
  }
  Steps result;
  std::vector<int> filled;
  for (std::size_t k = 0; k < of_step.size(); ++k) {
    const std::size_t next = std::min(k + 1, means.size() - 1), last = k == 0 ? 0 : k - 1;
    const Eigen::Vector3d direction = (means[next] - means[last]).stableNormalized();
    Eigen::Vector3d middle = means[k];
    int sectors = 0;
    for (int repeat = 0; repeat < 3; ++repeat)
      std::tie(middle, sectors) = Middle(of_step[k], middle, direction);
    result.middles.push_back(middle);
    filled.push_back(sectors);
    for (const auto& point : of_step[k]) {
      result.radius += (point - middle).norm() / static_cast<double>(points.size());
    }
  }
  std::size_t first = 0, last = filled.size();
  while (first + 4 < last && filled[first] < kSectors) ++first;
  while (last > first + 4 && filled[last - 1] < kSectors) --last;
  for (int k = 0; k < skipped && last > first + 5; ++k) {
    ++first;
    --last;
  }
  result.middles = {result.middles.begin() + static_cast<std::ptrdiff_t>(first),
                    result.middles.begin() + static_cast<std::ptrdiff_t>(last)};
  return result;
}

// A cubic B-spline curve near the nodes, as a polyline. Third differences of its control points, which stand
// about a radius apart, are held small: waves shorter than about four radii would turn the slabs across the
// line, and grow, while an even bend passes.
CentreLine Smoothed(const std::vector<Eigen::Vector3d>& nodes, double beyond) {
  if (nodes.size() < 4) return CentreLine({nodes.front(), nodes.back()});
  const std::vector<double> t = Parametrise(nodes, Parametrisation::kChord);
  const auto rows = static_cast<Eigen::Index>(nodes.size());
  const int count = std::max(4, static_cast<int>(rows) / 2);
  std::vector<double> knots;  // not clamped: evenly spaced control points all have the same differences
  for (int k = 0; k < count + 4; ++k) knots.push_back(static_cast<double>(k - 3) / (count - 3));
  const BSplineBasis basis(3, std::move(knots));
  Eigen::MatrixXd left = Eigen::MatrixXd::Zero(rows + count - 3, count), right(rows + count - 3, 3);
  left.topRows(rows) = BasisMatrix(basis, t);
  right.setZero();
  for (Eigen::Index k = 0; k < rows; ++k) right.row(k) = nodes[static_cast<std::size_t>(k)].transpose();
  const double weight = std::sqrt(kSmoothing * static_cast<double>(rows) / count);
  for (Eigen::Index k = 0; k < count - 3; ++k) {
    left.row(rows + k).segment<4>(k) = weight * Eigen::RowVector4d(-1, 3, -3, 1);
  }
  const Eigen::MatrixXd points = left.colPivHouseholderQr().solve(right);
  std::vector<double> samples;
  for (int k = 0; k < kNodes; ++k) samples.push_back(static_cast<double>(k) / (kNodes - 1));
  const Eigen::MatrixXd positions = BasisMatrix(basis, samples) * points;
  std::vector<Eigen::Vector3d> line;
  for (Eigen::Index k = 0; k < positions.rows(); ++k) line.push_back(positions.row(k).transpose());
  const CentreLine inner(line);
  // On at both ends by `beyond`, with the bend of as long a part.
  const auto extended = [&](double from, double inwards) {
    std::vector<Eigen::Vector3d> more;
    const double part = std::min(2 * beyond, inner.length() / 2);
    const Eigen::Vector3d tangent = inner.Tangent(from);
    const Eigen::Vector3d bend = (inner.Tangent(from + inwards * part) - tangent) / (inwards * part);
    for (int k = kNodes / 10; k > 0; --k) {
      const double s = -inwards * beyond * k / (kNodes / 10);
      more.push_back(inner.At(from) + s * tangent + s * s / 2 * bend);
    }
    return more;  // the farthest first
  };
  std::vector<Eigen::Vector3d> all = extended(0, 1);
  all.insert(all.end(), line.begin(), line.end());
  const std::vector<Eigen::Vector3d> after = extended(inner.length(), -1);
  all.insert(all.end(), after.rbegin(), after.rend());
  return CentreLine(std::move(all));
}

}  // namespace

CentreLine FindCentreLine(std::span<const Eigen::Vector3d> points) {
  std::vector<Eigen::Vector3d> some;
  for (const std::uint32_t i : SpatialOrder(points)) some.push_back(points[i]);
  some = Thinned(some, kGraphPoints);
  const Edges edges = NeighbourGraph(some);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& point : some) mean += point / static_cast<double>(some.size());
  const auto farthest = std::max_element(some.begin(), some.end(), [&](const auto& a, const auto& b) {
    return (a - mean).squaredNorm() < (b - mean).squaredNorm();
  });
  const auto source = static_cast<std::size_t>(farthest - some.begin());
  if (10 * Reached(edges, source) < 9 * some.size()) {
    throw InputError("the cloud is in parts: no centre line runs through all of it; give sections.planes");
  }
  std::vector<double> position;
  for (const auto& point : some) position.push_back((point - *farthest).norm());
  position = PositionsByLaplacian(edges, position);
  const Steps coarse = FindSteps(some, position, kFirstSteps, 0);
  double length = 0;
  for (std::size_t k = 1; k < coarse.middles.size(); ++k) {
    length += (coarse.middles[k] - coarse.middles[k - 1]).norm();
  }
  const int steps = std::clamp(static_cast<int>(length / (0.5 * coarse.radius)), 6, 100);
  // Towards both ends the eigenvector is flat, and its steps stand askew: about a radius is left out, and
  // later too, where a slab may leave the object on one side.
  const auto skipped = static_cast<int>(steps * coarse.radius / length + 0.5);
  CentreLine line = Smoothed(FindSteps(some, position, steps, skipped).middles, coarse.radius);
  for (int repeat = 0; repeat < kRepeats; ++repeat) {
    for (std::size_t i = 0; i < some.size(); ++i) position[i] = line.Locate(some[i]);
    line = Smoothed(FindSteps(some, position, steps, skipped).middles, coarse.radius);
  }
  return line;
}

}  // namespace frond
