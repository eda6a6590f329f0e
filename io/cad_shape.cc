// SPDX-License-Identifier: BSD-3-Clause
#include "io/cad_shape.h"

#include <BRepAdaptor_Curve2d.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepTools_WireExplorer.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_TrimmedCurve.hxx>
#include <GeomConvert.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BezierSurface.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Precision.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/errors.h"
#include "io/cad_trim_edges.h"

namespace frond {
namespace {

gp_Pnt ToPoint(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

struct KnotRuns {
  std::vector<double> knots;
  std::vector<int> multiplicities;
};

KnotRuns RunsOf(const std::vector<double>& knots) {
  KnotRuns runs;
  for (const double knot : knots) {
    if (runs.knots.empty() || knot != runs.knots.back()) {
      runs.knots.push_back(knot);
      runs.multiplicities.push_back(0);
    }
    ++runs.multiplicities.back();
  }
  return runs;
}

template <typename Array, typename T>
Array ToArray(const std::vector<T>& values) {
  Array array(1, static_cast<int>(values.size()));
  for (int k = 0; k < static_cast<int>(values.size()); ++k)
    array(k + 1) = values[static_cast<std::size_t>(k)];
  return array;
}

bool IsClamped(const BSplineBasis& basis) {
  const auto& knots = basis.knots();
  return knots.front() == basis.begin() && knots.back() == basis.end();
}

// Below this distance two points are one. Coordinates far from the origin (UTM) hold no more digits than
// that.
double Tolerance(const NurbsSurface& surface) {
  double largest = 0;
  for (const auto& point : surface.control_points()) largest = std::max(largest, point.cwiseAbs().maxCoeff());
  return std::max(Precision::Confusion(), 16 * std::numeric_limits<double>::epsilon() * largest);
}

double SignedArea(const TrimLoop& loop) {
  double area = 0;
  for (std::size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++) {
    area += 0.5 * (loop[j].x() * loop[i].y() - loop[i].x() * loop[j].y());
  }
  return area;
}

// The wire of one loop.
class LoopBuilder {
 public:
  LoopBuilder(const NurbsSurface& surface, const Handle(Geom_BSplineSurface) & spline, double tolerance)
      : surface_(surface), spline_(spline), tolerance_(tolerance) {}

  TopoDS_Wire Build(const TrimLoop& given, bool counter_clockwise) {
    loop_ = Simplified(given);
    if (loop_.size() < 3) throw FitError("a trim loop encloses nothing");
    if ((SignedArea(loop_) > 0) != counter_clockwise) std::reverse(loop_.begin(), loop_.end());
    RotateToAStart();
    TopoDS_Wire wire;
    builder_.MakeWire(wire);
    const std::vector<std::size_t> starts = EdgeStarts();
    const TopoDS_Vertex first = MakeVertex(0);
    TopoDS_Vertex from = first;
    for (std::size_t k = 0; k < starts.size(); ++k) {
      const bool last = k + 1 == starts.size();
      const std::size_t begin = starts[k], end = last ? loop_.size() : starts[k + 1];
      const bool collapsed = end == begin + 1 && IsCollapsed(begin);
      const TopoDS_Vertex to = last ? first : collapsed ? from : MakeVertex(end);
      builder_.Add(wire, MakeEdge(begin, end, collapsed, from, to));
      from = to;
    }
    wire.Closed(true);
    return wire;
  }

 private:
  const Eigen::Vector2d& At(std::size_t k) const { return loop_[k % loop_.size()]; }
  Eigen::Vector3d PointAt(const Eigen::Vector2d& uv) const { return surface_.Evaluate(uv.x(), uv.y()); }

  // The loop in the domain, without vertices that repeat or lie on the line between their neighbours.
  TrimLoop Simplified(const TrimLoop& given) const {
    const BSplineBasis &u = surface_.u(), &v = surface_.v();
    const Eigen::Vector2d low(u.begin(), v.begin()), high(u.end(), v.end()), range = high - low;
    TrimLoop loop;
    for (const Eigen::Vector2d& point : given) {
      const Eigen::Vector2d inside = point.cwiseMax(low).cwiseMin(high);
      if (((point - inside).cwiseAbs().array() > 1e-9 * range.array()).any()) {
        throw FitError("a trim loop leaves the surface's domain");
      }
      if (loop.empty() || !Near(loop.back(), inside, range)) loop.push_back(inside);
    }
    while (loop.size() > 1 && Near(loop.front(), loop.back(), range)) loop.pop_back();
    TrimLoop corners;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Eigen::Vector2d before = corners.empty() ? loop.back() : corners.back();
      const Eigen::Vector2d in = (loop[i] - before).cwiseQuotient(range);
      const Eigen::Vector2d out = (loop[(i + 1) % loop.size()] - loop[i]).cwiseQuotient(range);
      const double cross = in.x() * out.y() - in.y() * out.x();
      if (std::abs(cross) > 1e-12 * in.norm() * out.norm() || in.dot(out) < 0) corners.push_back(loop[i]);
    }
    return corners;
  }

  static bool Near(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& range) {
    return (a - b).cwiseQuotient(range).norm() < 1e-9;
  }

  // Whether segment k is a point in space.
  bool IsCollapsed(std::size_t k) const {
    const Eigen::Vector3d start = PointAt(At(k));
    constexpr int kSamples = 16;
    for (int i = 1; i <= kSamples; ++i) {
      const Eigen::Vector2d uv = At(k) + (At(k + 1) - At(k)) * (static_cast<double>(i) / kSamples);
      if ((PointAt(uv) - start).norm() > tolerance_) return false;
    }
    return true;
  }

  // The wire must not begin or end with a collapsed segment, nor after one.
  void RotateToAStart() {
    for (std::size_t k = 0; k < loop_.size(); ++k) {
      const std::size_t before = (k + loop_.size() - 1) % loop_.size();
      if (IsCollapsed(k) || IsCollapsed(before)) continue;
      std::rotate(loop_.begin(), loop_.begin() + static_cast<std::ptrdiff_t>(k), loop_.end());
      return;
    }
    throw FitError("a trim loop is a point in space");
  }

  // Collapsed segments are edges of their own; what lies between is cut into at least four edges of at most
  // 32 segments: Open CASCADE's checker takes 10 times longer for 4 edges of 250 segments, and twice as long,
  // with twice the file, for one edge a segment.
  std::vector<std::size_t> EdgeStarts() const {
    const std::size_t longest = std::min<std::size_t>(32, (loop_.size() + 3) / 4);
    std::vector<std::size_t> starts = {0};
    for (std::size_t k = 1; k < loop_.size(); ++k) {
      if (IsCollapsed(k) || IsCollapsed(k - 1) || k - starts.back() >= longest) starts.push_back(k);
    }
    return starts;
  }

  TopoDS_Vertex MakeVertex(std::size_t k) {
    TopoDS_Vertex vertex;
    builder_.MakeVertex(vertex, ToPoint(PointAt(At(k))), tolerance_);
    return vertex;
  }

  TopoDS_Edge MakeEdge(std::size_t begin, std::size_t end, bool collapsed, const TopoDS_Vertex& from,
                       const TopoDS_Vertex& to) {
    std::vector<Eigen::Vector2d> polyline;
    for (std::size_t k = begin; k <= end; ++k) polyline.push_back(At(k));
    TopoDS_Edge edge;
    if (collapsed) {
      builder_.MakeEdge(edge);
    } else {
      builder_.MakeEdge(edge, SpaceCurve(ComposePolyline(surface_, polyline)), tolerance_);
    }
    builder_.UpdateEdge(edge, PlaneCurve(polyline), spline_, TopLoc_Location(), tolerance_);
    builder_.Add(edge, from.Oriented(TopAbs_FORWARD));
    builder_.Add(edge, to.Oriented(TopAbs_REVERSED));
    builder_.Range(edge, 0, static_cast<double>(polyline.size() - 1));
    builder_.SameRange(edge, true);
    builder_.SameParameter(edge, true);
    builder_.Degenerated(edge, collapsed);
    return edge;
  }

  static Handle(Geom2d_BSplineCurve) PlaneCurve(const std::vector<Eigen::Vector2d>& polyline) {
    const auto count = static_cast<int>(polyline.size());
    TColgp_Array1OfPnt2d poles(1, count);
    TColStd_Array1OfReal knots(1, count);
    TColStd_Array1OfInteger multiplicities(1, count);
    for (int k = 0; k < count; ++k) {
      const Eigen::Vector2d& uv = polyline[static_cast<std::size_t>(k)];
      poles(k + 1) = gp_Pnt2d(uv.x(), uv.y());
      knots(k + 1) = k;
      multiplicities(k + 1) = k == 0 || k + 1 == count ? 2 : 1;
    }
    return new Geom2d_BSplineCurve(poles, knots, multiplicities, 1);
  }

  static Handle(Geom_BSplineCurve) SpaceCurve(const CurveOnSurface& curve) {
    std::vector<gp_Pnt> points;
    for (const auto& point : curve.control_points) points.push_back(ToPoint(point));
    std::vector<int> multiplicities(curve.breaks.size(), curve.degree);
    multiplicities.front() = multiplicities.back() = curve.degree + 1;
    const bool rational = std::any_of(curve.weights.begin(), curve.weights.end(),
                                      [&](double w) { return w != curve.weights.front(); });
    const auto poles = ToArray<TColgp_Array1OfPnt>(points);
    const auto knots = ToArray<TColStd_Array1OfReal>(curve.breaks);
    const auto runs = ToArray<TColStd_Array1OfInteger>(multiplicities);
    if (!rational) return new Geom_BSplineCurve(poles, knots, runs, curve.degree);
    return new Geom_BSplineCurve(poles, ToArray<TColStd_Array1OfReal>(curve.weights), knots, runs,
                                 curve.degree);
  }

  const NurbsSurface& surface_;
  Handle(Geom_BSplineSurface) spline_;
  double tolerance_;
  TrimLoop loop_;
  BRep_Builder builder_;
};

}  // namespace

Handle(Geom_BSplineSurface) ToOpenCascade(const NurbsSurface& surface) {
  const KnotRuns u = RunsOf(surface.u().knots()), v = RunsOf(surface.v().knots());
  TColgp_Array2OfPnt poles(1, surface.count_u(), 1, surface.count_v());
  TColStd_Array2OfReal weights(1, surface.count_u(), 1, surface.count_v());
  for (int i = 0; i < surface.count_u(); ++i) {
    for (int j = 0; j < surface.count_v(); ++j) {
      poles(i + 1, j + 1) = ToPoint(surface.control_point(i, j));
      weights(i + 1, j + 1) = surface.weight(i, j);
    }
  }
  const auto knots_u = ToArray<TColStd_Array1OfReal>(u.knots),
             knots_v = ToArray<TColStd_Array1OfReal>(v.knots);
  const auto runs_u = ToArray<TColStd_Array1OfInteger>(u.multiplicities);
  const auto runs_v = ToArray<TColStd_Array1OfInteger>(v.multiplicities);
  const int p = surface.u().degree(), q = surface.v().degree();
  Handle(Geom_BSplineSurface) spline =
      surface.IsRational() ? new Geom_BSplineSurface(poles, weights, knots_u, knots_v, runs_u, runs_v, p, q)
                           : new Geom_BSplineSurface(poles, knots_u, knots_v, runs_u, runs_v, p, q);
  if (!IsClamped(surface.u()) || !IsClamped(surface.v())) {
    spline->Segment(surface.u().begin(), surface.u().end(), surface.v().begin(), surface.v().end());
  }
  return spline;
}

TopoDS_Face MakeFace(const TrimmedSurface& trimmed) {
  const double tolerance = Tolerance(trimmed.surface);
  const Handle(Geom_BSplineSurface) spline = ToOpenCascade(trimmed.surface);
  if (trimmed.trim.empty()) {
    BRepBuilderAPI_MakeFace maker(spline, tolerance);
    if (!maker.IsDone()) throw FitError("Open CASCADE makes no face of the surface");
    return maker.Face();
  }
  TopoDS_Face face;
  BRep_Builder builder;
  builder.MakeFace(face, spline, tolerance);
  LoopBuilder loops(trimmed.surface, spline, tolerance);
  for (std::size_t k = 0; k < trimmed.trim.size(); ++k) {
    builder.Add(face, loops.Build(trimmed.trim[k], /*counter_clockwise=*/k == 0));
  }
  return face;
}

Handle(Geom_BSplineSurface) SplineOf(const TopoDS_Face& face) {
  Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
  if (const auto window = Handle(Geom_RectangularTrimmedSurface)::DownCast(surface); !window.IsNull()) {
    surface = window->BasisSurface();
  }
  Handle(Geom_BSplineSurface) spline = Handle(Geom_BSplineSurface)::DownCast(surface);
  if (const auto bezier = Handle(Geom_BezierSurface)::DownCast(surface); !bezier.IsNull()) {
    spline = GeomConvert::SurfaceToBSplineSurface(bezier);
  }
  if (spline.IsNull()) return spline;
  spline = Handle(Geom_BSplineSurface)::DownCast(spline->Copy());
  if (spline->IsUPeriodic()) spline->SetUNotPeriodic();
  if (spline->IsVPeriodic()) spline->SetVNotPeriodic();
  return spline;
}

NurbsSurface FromOpenCascade(const Geom_BSplineSurface& s) {
  const auto flat = [](const TColStd_Array1OfReal& sequence) {
    return std::vector<double>(sequence.begin(), sequence.end());
  };
  std::vector<Eigen::Vector3d> points;
  std::vector<double> weights;
  for (int i = 1; i <= s.NbUPoles(); ++i) {
    for (int j = 1; j <= s.NbVPoles(); ++j) {
      const gp_Pnt point = s.Pole(i, j);
      points.emplace_back(point.X(), point.Y(), point.Z());
      // Of a surface that is not rational Open CASCADE may hold zeros for weights.
      if (s.IsURational() || s.IsVRational()) weights.push_back(s.Weight(i, j));
    }
  }
  return {BSplineBasis(s.UDegree(), flat(s.UKnotSequence())),
          BSplineBasis(s.VDegree(), flat(s.VKnotSequence())), std::move(points), std::move(weights)};
}

namespace {

// Parameters at which a pcurve is sampled: the knots of a polyline; 16 to each span of other curves but
// lines.
std::vector<double> SampleParameters(const BRepAdaptor_Curve2d& curve) {
  const double first = curve.FirstParameter(), last = curve.LastParameter();
  std::vector<double> breaks = {first, last};
  int steps = curve.GetType() == GeomAbs_Line ? 1 : 16;
  if (curve.GetType() == GeomAbs_BSplineCurve) {
    const Handle(Geom2d_BSplineCurve) spline = curve.BSpline();
    if (spline->Degree() == 1) steps = 1;
    for (int k = 1; k <= spline->NbKnots(); ++k) {
      if (spline->Knot(k) > first && spline->Knot(k) < last) breaks.push_back(spline->Knot(k));
    }
    std::sort(breaks.begin(), breaks.end());
  }
  std::vector<double> parameters;
  for (std::size_t k = 0; k + 1 < breaks.size(); ++k) {
    for (int i = 0; i < steps; ++i) parameters.push_back(breaks[k] + (breaks[k + 1] - breaks[k]) * i / steps);
  }
  parameters.push_back(last);
  return parameters;
}

TrimLoop LoopOf(const TopoDS_Wire& wire, const TopoDS_Face& face) {
  TrimLoop loop;
  for (BRepTools_WireExplorer edges(wire, face); edges.More(); edges.Next()) {
    const BRepAdaptor_Curve2d curve(edges.Current(), face);
    std::vector<double> parameters = SampleParameters(curve);
    if (edges.Current().Orientation() == TopAbs_REVERSED) std::reverse(parameters.begin(), parameters.end());
    for (const double t : parameters) {
      const gp_Pnt2d uv = curve.Value(t);
      const Eigen::Vector2d point(uv.X(), uv.Y());
      if (loop.empty() || (point - loop.back()).norm() > 1e-9) loop.push_back(point);
    }
  }
  while (loop.size() > 1 && (loop.front() - loop.back()).norm() <= 1e-9) loop.pop_back();
  return loop;
}

}  // namespace

std::vector<TrimLoop> TrimOf(const TopoDS_Face& given, const NurbsSurface& surface) {
  const TopoDS_Face face = TopoDS::Face(given.Oriented(TopAbs_FORWARD));
  const BSplineBasis &u = surface.u(), &v = surface.v();
  const Eigen::Vector2d low(u.begin(), v.begin()), high(u.end(), v.end()), range = high - low;
  std::vector<TrimLoop> loops;
  for (TopExp_Explorer wires(face, TopAbs_WIRE); wires.More(); wires.Next()) {
    TrimLoop loop = LoopOf(TopoDS::Wire(wires.Current()), face);
    for (Eigen::Vector2d& point : loop) point = point.cwiseMax(low).cwiseMin(high);
    if (loop.size() >= 3) loops.push_back(std::move(loop));
  }
  const auto larger = [](const TrimLoop& a, const TrimLoop& b) {
    return std::abs(SignedArea(a)) > std::abs(SignedArea(b));
  };
  std::sort(loops.begin(), loops.end(), larger);
  const bool whole = loops.size() == 1 && std::abs(SignedArea(loops[0])) > (1 - 1e-9) * range.prod();
  return loops.empty() || whole ? std::vector<TrimLoop>() : loops;
}

}  // namespace frond
