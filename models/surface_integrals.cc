// SPDX-License-Identifier: BSD-3-Clause
#include "models/surface_integrals.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "models/gauss_rule.h"
#include "models/surface_cells.h"

namespace frond {
namespace {

// Points for a whole span: few spans must each carry more of the shape.
int FullCount(int spans) { return spans <= 4 ? kMaxGaussPoints : spans <= 12 ? 8 : 6; }

// Points for a part of a span.
int PartCount(double fraction, int full) {
  if (fraction > 0.5) return full;
  if (fraction > 0.15) return std::max(3, full / 2 + 1);
  return fraction > 0.01 ? 3 : 2;
}

double AreaElement(const SurfaceCells& cells, double u, double v) {
  const SurfaceCells::Jet1 s = cells.Evaluate1(u, v);
  return s.du.cross(s.dv).norm();
}

// ∫ |S_u × S_v| dv at fixed u over [a, b], knot span by knot span.
double AlongV(const SurfaceCells& cells, double u, double a, double b) {
  const SpanPolynomials& spans = cells.v();
  const int full = FullCount(spans.count());
  double sum = 0;
  for (int k = spans.SpanOf(a); k < spans.count() && spans.begin(k) < b; ++k) {
    const double low = std::max(a, spans.begin(k));
    const double length = std::min(b, spans.begin(k) + spans.length(k)) - low;
    if (!(length > 0)) continue;
    const GaussRule& rule = GaussRuleOf(PartCount(length / spans.length(k), full));
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      sum += rule.weights[i] * length * AreaElement(cells, u, low + rule.nodes[i] * length);
    }
  }
  return sum;
}

// An edge of a loop as u rises from `begin` to `end`.
struct LoopEdge {
  double begin, end, v_begin, v_end;
  double VAt(double u) const { return v_begin + (v_end - v_begin) * ((u - begin) / (end - begin)); }
};

std::vector<LoopEdge> EdgesByBegin(const std::vector<TrimLoop>& trim) {
  std::vector<LoopEdge> edges;
  for (const TrimLoop& loop : trim) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      Eigen::Vector2d a = loop[i], b = loop[(i + 1) % loop.size()];
      if (a.x() == b.x()) continue;
      if (b.x() < a.x()) std::swap(a, b);
      edges.push_back({a.x(), b.x(), a.y(), b.y()});
    }
  }
  std::stable_sort(edges.begin(), edges.end(),
                   [](const LoopEdge& a, const LoopEdge& b) { return a.begin < b.begin; });
  return edges;
}

// Where the integrand of ∫ du stops being smooth: the knots, and the loops' vertices inside the domain.
std::vector<double> Breakpoints(const SpanPolynomials& u, double end, const std::vector<LoopEdge>& edges) {
  std::vector<double> breaks{end};
  for (int k = 0; k < u.count(); ++k) breaks.push_back(u.begin(k));
  for (const LoopEdge& edge : edges) {
    for (const double t : {edge.begin, edge.end}) {
      if (t > u.begin(0) && t < end) breaks.push_back(t);
    }
  }
  std::sort(breaks.begin(), breaks.end());
  breaks.erase(std::unique(breaks.begin(), breaks.end()), breaks.end());
  return breaks;
}

// ∫ dv inside the loops at fixed u: between every first and second crossing (even-odd rule).
double InsideAlongV(const SurfaceCells& cells, double u, const std::vector<LoopEdge>& active,
                    std::vector<double>& crossings) {
  crossings.clear();
  for (const LoopEdge& edge : active) {
    crossings.push_back(std::clamp(edge.VAt(u), cells.basis_v().begin(), cells.basis_v().end()));
  }
  std::sort(crossings.begin(), crossings.end());
  double sum = 0;
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
    if (crossings[i] < crossings[i + 1]) sum += AlongV(cells, u, crossings[i], crossings[i + 1]);
  }
  return sum;
}

double TrimmedArea(const SurfaceCells& cells, const std::vector<TrimLoop>& trim) {
  const SpanPolynomials& spans = cells.u();
  const std::vector<LoopEdge> edges = EdgesByBegin(trim);
  const std::vector<double> breaks = Breakpoints(spans, cells.basis_u().end(), edges);
  const int full = FullCount(spans.count());
  std::vector<LoopEdge> active;
  std::vector<double> crossings;
  std::size_t next = 0;
  double area = 0;
  for (std::size_t k = 0; k + 1 < breaks.size(); ++k) {
    const double begin = breaks[k], length = breaks[k + 1] - begin;
    std::erase_if(active, [begin](const LoopEdge& edge) { return edge.end <= begin; });
    for (; next < edges.size() && edges[next].begin <= begin; ++next) {
      if (edges[next].end > begin) active.push_back(edges[next]);
    }
    if (active.empty()) continue;
    const double span = spans.length(spans.SpanOf(begin + length / 2));
    const GaussRule& rule = GaussRuleOf(PartCount(length / span, full));
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      area +=
          rule.weights[i] * length * InsideAlongV(cells, begin + rule.nodes[i] * length, active, crossings);
    }
  }
  return area;
}

double WholeArea(const SurfaceCells& cells) {
  const SpanPolynomials& spans = cells.u();
  const GaussRule& rule = GaussRuleOf(FullCount(spans.count()));
  double area = 0;
  for (int k = 0; k < spans.count(); ++k) {
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double u = spans.begin(k) + rule.nodes[i] * spans.length(k);
      area += rule.weights[i] * spans.length(k) *
              AlongV(cells, u, cells.basis_v().begin(), cells.basis_v().end());
    }
  }
  return area;
}

double GaussLength(const NurbsCurve& curve, double begin, double end) {
  const GaussRule& rule = GaussRuleOf(10);
  double sum = 0;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const double t = begin + rule.nodes[i] * (end - begin);
    sum += rule.weights[i] * (end - begin) * curve.EvaluateWithDerivatives(t).d1.norm();
  }
  return sum;
}

double AdaptiveLength(const NurbsCurve& curve, double begin, double end, double whole, double tolerance,
                      int depth) {
  const double middle = (begin + end) / 2;
  const double first = GaussLength(curve, begin, middle), second = GaussLength(curve, middle, end);
  if (depth == 0 || std::abs(first + second - whole) <= tolerance) return first + second;
  return AdaptiveLength(curve, begin, middle, first, tolerance, depth - 1) +
         AdaptiveLength(curve, middle, end, second, tolerance, depth - 1);
}

}  // namespace

double Area(const TrimmedSurface& surface) {
  const SurfaceCells cells(surface.surface);
  return surface.trim.empty() ? WholeArea(cells) : TrimmedArea(cells, surface.trim);
}

double ArcLength(const NurbsCurve& curve) {
  return ArcLength(curve, curve.basis().begin(), curve.basis().end());
}

double ArcLength(const NurbsCurve& curve, double begin, double end) {
  const BSplineBasis& basis = curve.basis();
  std::vector<std::array<double, 3>> pieces;  // begin, end, first estimate
  double total = 0;
  for (const int s : basis.spans()) {
    const double low = std::max(begin, basis.knots()[static_cast<std::size_t>(s)]);
    const double high = std::min(end, basis.knots()[static_cast<std::size_t>(s) + 1]);
    if (!(low < high)) continue;
    pieces.push_back({low, high, GaussLength(curve, low, high)});
    total += pieces.back()[2];
  }
  double length = 0;
  for (const auto& [low, high, estimate] : pieces) {
    length +=
        AdaptiveLength(curve, low, high, estimate, 1e-12 * total / static_cast<double>(pieces.size()), 30);
  }
  return length;
}

}  // namespace frond
