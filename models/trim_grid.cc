// SPDX-License-Identifier: BSD-3-Clause
#include "models/trim_grid.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/errors.h"

namespace frond {
namespace {

constexpr std::int64_t kSteps = std::int64_t{1} << 50;
constexpr std::int64_t kSnap = kSteps / 10000000000;

std::size_t At(int i) { return static_cast<std::size_t>(i); }

// The index of `value` among rising values, or −1.
int IndexOf(const std::vector<std::int64_t>& values, std::int64_t value) {
  const auto it = std::lower_bound(values.begin(), values.end(), value);
  return it != values.end() && *it == value ? static_cast<int>(it - values.begin()) : -1;
}

// The k with values[k] < value < values[k + 1].
int IntervalOf(const std::vector<std::int64_t>& values, std::int64_t value) {
  return static_cast<int>(std::upper_bound(values.begin(), values.end(), value) - values.begin()) - 1;
}

// start + (end − start) * part / whole, rounded; monotone in `part`. whole ≠ 0.
std::int64_t Interpolate(std::int64_t start, std::int64_t end, std::int64_t part, std::int64_t whole) {
  __int128 numerator = static_cast<__int128>(end - start) * part, denominator = whole;
  if (denominator < 0) {
    numerator = -numerator;
    denominator = -denominator;
  }
  numerator = 2 * numerator + denominator;
  denominator *= 2;
  __int128 quotient = numerator / denominator;
  if (numerator % denominator < 0) --quotient;
  return start + static_cast<std::int64_t>(quotient);
}

// The nearest line if it is within kSnap, t otherwise. Monotone: the order of points along a segment stays.
std::int64_t Snap(const std::vector<std::int64_t>& lines, std::int64_t t) {
  const auto above = std::lower_bound(lines.begin(), lines.end(), t);
  if (above != lines.end() && *above - t <= kSnap) return *above;
  if (above != lines.begin() && t - *(above - 1) <= kSnap) return *(above - 1);
  return t;
}

// Lines strictly between a and b, as indices [first, last).
std::array<int, 2> LinesBetween(const std::vector<std::int64_t>& lines, std::int64_t a, std::int64_t b) {
  const auto first = std::upper_bound(lines.begin(), lines.end(), std::min(a, b));
  const auto last = std::lower_bound(lines.begin(), lines.end(), std::max(a, b));
  return {static_cast<int>(first - lines.begin()), static_cast<int>(std::max(first, last) - lines.begin())};
}

}  // namespace

GridAxis::GridAxis(const BSplineBasis& basis, int segments_per_span) : periodic(basis.periodic()) {
  for (const int s : basis.spans()) {
    const double begin = basis.knots()[At(s)], length = basis.knots()[At(s + 1)] - begin;
    for (int k = 0; k < segments_per_span; ++k) lines.push_back(begin + length * k / segments_per_span);
  }
  lines.push_back(basis.end());
  for (const double line : lines) lattice_lines.push_back(ToLattice(line));
}

std::int64_t GridAxis::ToLattice(double t) const {
  return std::llround((t - lines.front()) / (lines.back() - lines.front()) * static_cast<double>(kSteps));
}

TrimGrid::TrimGrid(GridAxis u, GridAxis v, const std::vector<TrimLoop>& trim)
    : u_(std::move(u)), v_(std::move(v)), trimmed_(!trim.empty()) {
  edges_along_u_.resize(At(u_.cells()) * v_.lines.size());
  edges_along_v_.resize(At(v_.cells()) * u_.lines.size());
  for (const TrimLoop& loop : trim) {
    Polygon polygon = CleanLoop(loop);
    if (polygon.size() >= 3) loops_.push_back(std::move(polygon));
  }
  OrientLoops();
  for (const Polygon& loop : loops_) {
    for (std::size_t k = 0; k < loop.size(); ++k) AddSegment(loop[k], loop[(k + 1) % loop.size()]);
  }
  ShareSeams();
  FindCentresInside();
}

int TrimGrid::VertexAt(const LatticePoint& at, const Eigen::Vector2d& uv) {
  const auto [it, is_new] = vertex_at_.try_emplace(at, static_cast<int>(vertices_.size()));
  if (is_new) {
    const int line_u = IndexOf(u_.lattice_lines, at.u), line_v = IndexOf(v_.lattice_lines, at.v);
    vertices_.emplace_back(line_u >= 0 ? u_.lines[At(line_u)] : uv.x(),
                           line_v >= 0 ? v_.lines[At(line_v)] : uv.y());
    lattice_.push_back(at);
    PutOnEdge(it->second);
  }
  return it->second;
}

void TrimGrid::PutOnEdge(int vertex) {
  const LatticePoint& at = lattice_[At(vertex)];
  const int line_u = IndexOf(u_.lattice_lines, at.u), line_v = IndexOf(v_.lattice_lines, at.v);
  if (line_u >= 0 && line_v < 0) {
    edges_along_v_[EdgeAlongV(line_u, IntervalOf(v_.lattice_lines, at.v))].vertices.push_back(vertex);
  } else if (line_u < 0 && line_v >= 0) {
    edges_along_u_[EdgeAlongU(IntervalOf(u_.lattice_lines, at.u), line_v)].vertices.push_back(vertex);
  }
}

int TrimGrid::Node(int i, int j) {
  return VertexAt({u_.lattice_lines[At(i)], v_.lattice_lines[At(j)]}, {u_.lines[At(i)], v_.lines[At(j)]});
}

// Vertices of the loop without repeated ones. Rounding over the domain's edge is taken back.
TrimGrid::Polygon TrimGrid::CleanLoop(const TrimLoop& loop) {
  constexpr std::int64_t kRounding = kSteps / 1000000000;
  Polygon polygon;
  for (const Eigen::Vector2d& uv : loop) {
    const double u_length = u_.lines.back() - u_.lines.front(), v_length = v_.lines.back() - v_.lines.front();
    const bool near = uv.allFinite() && std::abs(uv.x() - u_.lines.front()) < 2 * u_length &&
                      std::abs(uv.y() - v_.lines.front()) < 2 * v_length;
    const LatticePoint at =
        near ? LatticePoint{u_.ToLattice(uv.x()), v_.ToLattice(uv.y())} : LatticePoint{-kSteps, 0};
    if (std::min(at.u, at.v) < -kRounding || std::max(at.u, at.v) > kSteps + kRounding) {
      throw InputError("trim loop point (" + std::to_string(uv.x()) + ", " + std::to_string(uv.y()) +
                       ") is outside the surface's domain");
    }
    const LatticePoint inside{Snap(u_.lattice_lines, std::clamp<std::int64_t>(at.u, 0, kSteps)),
                              Snap(v_.lattice_lines, std::clamp<std::int64_t>(at.v, 0, kSteps))};
    const Eigen::Vector2d clamped(std::clamp(uv.x(), u_.lines.front(), u_.lines.back()),
                                  std::clamp(uv.y(), v_.lines.front(), v_.lines.back()));
    const int vertex = VertexAt(inside, clamped);
    if (polygon.empty() || polygon.back() != vertex) polygon.push_back(vertex);
  }
  while (polygon.size() > 1 && polygon.back() == polygon.front()) polygon.pop_back();
  return polygon;
}

// Counter-clockwise where an even number of other loops is around a loop, clockwise otherwise.
void TrimGrid::OrientLoops() {
  std::vector<char> reverse(loops_.size());
  for (std::size_t k = 0; k < loops_.size(); ++k) {
    bool outer = true;
    for (std::size_t other = 0; other < loops_.size(); ++other) {
      if (other != k && PolygonHolds(lattice_, loops_[other], lattice_[At(loops_[k][0])])) outer = !outer;
    }
    reverse[k] = (TwiceArea(lattice_, loops_[k]) > 0) != outer;
  }
  for (std::size_t k = 0; k < loops_.size(); ++k) {
    if (reverse[k]) std::reverse(loops_[k].begin(), loops_[k].end());
  }
}

void TrimGrid::AddSegment(int from, int to) {
  const LatticePoint a = lattice_[At(from)], b = lattice_[At(to)];
  const Eigen::Vector2d uv_a = vertices_[At(from)], uv_b = vertices_[At(to)];
  struct Crossing {
    LatticePoint at;
    Eigen::Vector2d uv;
  };
  std::vector<Crossing> crossings;
  const auto lines_u = LinesBetween(u_.lattice_lines, a.u, b.u);
  for (int k = lines_u[0]; k < lines_u[1]; ++k) {
    const std::int64_t line = u_.lattice_lines[At(k)];
    const double t = static_cast<double>(line - a.u) / static_cast<double>(b.u - a.u);
    crossings.push_back({{line, Snap(v_.lattice_lines, Interpolate(a.v, b.v, line - a.u, b.u - a.u))},
                         {u_.lines[At(k)], uv_a.y() + t * (uv_b.y() - uv_a.y())}});
  }
  const auto lines_v = LinesBetween(v_.lattice_lines, a.v, b.v);
  for (int k = lines_v[0]; k < lines_v[1]; ++k) {
    const std::int64_t line = v_.lattice_lines[At(k)];
    const double t = static_cast<double>(line - a.v) / static_cast<double>(b.v - a.v);
    crossings.push_back({{Snap(u_.lattice_lines, Interpolate(a.u, b.u, line - a.v, b.v - a.v)), line},
                         {uv_a.x() + t * (uv_b.x() - uv_a.x()), v_.lines[At(k)]}});
  }
  // Both coordinates are monotone along the segment, rounded as they are.
  const std::int64_t sign_u = b.u >= a.u ? 1 : -1, sign_v = b.v >= a.v ? 1 : -1;
  std::sort(crossings.begin(), crossings.end(), [&](const Crossing& x, const Crossing& y) {
    return x.at.u != y.at.u ? sign_u * x.at.u < sign_u * y.at.u : sign_v * x.at.v < sign_v * y.at.v;
  });
  int last = from;
  for (const Crossing& crossing : crossings) {
    const int next = crossing.at == b ? to : VertexAt(crossing.at, crossing.uv);
    if (next != last) AddPiece(last, next);
    last = next;
  }
  if (last != to) AddPiece(last, to);
}

// A piece of a loop that crosses no grid line goes to the cell that it lies in, or to the grid edge that it
// runs along.
void TrimGrid::AddPiece(int from, int to) {
  const LatticePoint &a = lattice_[At(from)], &b = lattice_[At(to)];
  const int line_u = a.u == b.u ? IndexOf(u_.lattice_lines, a.u) : -1;
  const int line_v = a.v == b.v ? IndexOf(v_.lattice_lines, a.v) : -1;
  const int i = IntervalOf(u_.lattice_lines, std::min(a.u, b.u));
  const int j = IntervalOf(v_.lattice_lines, std::min(a.v, b.v));
  if (line_u >= 0) {
    edges_along_v_[EdgeAlongV(line_u, j)].runs.push_back({a.v, b.v});
  } else if (line_v >= 0) {
    edges_along_u_[EdgeAlongU(i, line_v)].runs.push_back({a.u, b.u});
  } else {
    segments_[Cell(i, j)].push_back({from, to});
  }
}

// The two sides of a seam get the same vertices.
void TrimGrid::ShareSeams() {
  const auto copy = [&](std::vector<int> vertices, bool along_v, std::size_t line) {
    for (const int vertex : vertices) {
      LatticePoint at = lattice_[At(vertex)];
      Eigen::Vector2d uv = vertices_[At(vertex)];
      (along_v ? at.u : at.v) = (along_v ? u_ : v_).lattice_lines[line];
      (along_v ? uv.x() : uv.y()) = (along_v ? u_ : v_).lines[line];
      VertexAt(at, uv);
    }
  };
  for (int j = 0; u_.periodic && j < v_.cells(); ++j) {
    copy(edges_along_v_[EdgeAlongV(0, j)].vertices, true, At(u_.cells()));
    copy(edges_along_v_[EdgeAlongV(u_.cells(), j)].vertices, true, 0);
  }
  for (int i = 0; v_.periodic && i < u_.cells(); ++i) {
    copy(edges_along_u_[EdgeAlongU(i, 0)].vertices, false, At(v_.cells()));
    copy(edges_along_u_[EdgeAlongU(i, v_.cells())].vertices, false, 0);
  }
}

// Row by row: the loops' crossings with the line through the cells' centres.
void TrimGrid::FindCentresInside() {
  centre_inside_.assign(At(u_.cells()) * At(v_.cells()), trimmed_ ? 0 : 1);
  std::vector<double> crossings;
  for (int j = 0; trimmed_ && j < v_.cells(); ++j) {
    const std::int64_t centre = (v_.lattice_lines[At(j)] + v_.lattice_lines[At(j + 1)]) / 2;
    crossings.clear();
    for (const Polygon& loop : loops_) {
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const LatticePoint &a = lattice_[At(loop[k])], &b = lattice_[At(loop[(k + 1) % loop.size()])];
        if ((a.v > centre) == (b.v > centre)) continue;
        const double t = static_cast<double>(centre - a.v) / static_cast<double>(b.v - a.v);
        crossings.push_back(static_cast<double>(a.u) + t * static_cast<double>(b.u - a.u));
      }
    }
    std::sort(crossings.begin(), crossings.end());
    for (int i = 0; i < u_.cells(); ++i) {
      const double middle = static_cast<double>(u_.lattice_lines[At(i)] + u_.lattice_lines[At(i + 1)]) / 2;
      const auto before = std::lower_bound(crossings.begin(), crossings.end(), middle) - crossings.begin();
      centre_inside_[Cell(i, j)] = before % 2 == 1;
    }
  }
}

bool TrimGrid::LoopsHold(const LatticePoint& at) const {
  bool inside = !trimmed_;
  for (const Polygon& loop : loops_) inside ^= PolygonHolds(lattice_, loop, at);
  return inside;
}

TrimGrid::Inside TrimGrid::StateOf(int i, int j) const {
  if (segments_.contains(Cell(i, j))) return Inside::kCut;
  if (!centre_inside_[Cell(i, j)]) return Inside::kNone;
  const bool plain = edges_along_u_[EdgeAlongU(i, j)].vertices.empty() &&
                     edges_along_u_[EdgeAlongU(i, j + 1)].vertices.empty() &&
                     edges_along_v_[EdgeAlongV(i, j)].vertices.empty() &&
                     edges_along_v_[EdgeAlongV(i + 1, j)].vertices.empty();
  return plain ? Inside::kWhole : Inside::kCut;
}

std::array<int, 4> TrimGrid::CornersOf(int i, int j) {
  return {Node(i, j), Node(i + 1, j), Node(i + 1, j + 1), Node(i, j + 1)};
}

}  // namespace frond
