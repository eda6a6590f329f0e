// SPDX-License-Identifier: BSD-3-Clause
#include "io/cad_shape.h"

#include <BRepAdaptor_Curve2d.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepLib.hxx>
#include <BRepTools_WireExplorer.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_TrimmedCurve.hxx>
#include <GeomConvert.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BezierSurface.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "io/cad_geometry.h"
#include "io/cad_trim_edges.h"

namespace frond {
namespace {

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

TopoDS_Shape MakeShape(const TrimmedSurface& trimmed) {
  const TopoDS_Face face = MakeFace(trimmed);
  if (!trimmed.trim.empty()) return face;
  BRep_Builder builder;
  TopoDS_Shell shell;
  builder.MakeShell(shell);
  builder.Add(shell, face);
  if (!BRep_Tool::IsClosed(shell)) return face;
  shell.Closed(true);
  TopoDS_Solid solid;
  builder.MakeSolid(solid);
  builder.Add(solid, shell);
  if (!BRepLib::OrientClosedSolid(solid)) throw FitError("the closed surface has no inside");
  return solid;
}

TopoDS_Edge MakeEdge(const NurbsCurve& curve) {
  const auto& points = curve.control_points();
  const double tolerance = Tolerance(curve);
  if (std::all_of(points.begin(), points.end(),
                  [&](const auto& point) { return (point - points[0]).norm() <= tolerance; })) {
    throw FitError("the curve is a point in space");
  }
  BRepBuilderAPI_MakeEdge maker(ToOpenCascade(curve));
  if (!maker.IsDone()) throw FitError("Open CASCADE makes no edge of the curve");
  return maker.Edge();
}

Handle(Geom_BSplineCurve) SplineOf(const TopoDS_Edge& edge) {
  double first = 0, last = 0;
  const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, first, last);
  if (curve.IsNull()) return nullptr;
  Handle(Geom_BSplineCurve) spline = Handle(Geom_BSplineCurve)::DownCast(curve);
  const bool whole = !spline.IsNull() && spline->FirstParameter() == first && spline->LastParameter() == last;
  if (whole) {
    spline = Handle(Geom_BSplineCurve)::DownCast(spline->Copy());
  } else {
    spline = GeomConvert::CurveToBSplineCurve(new Geom_TrimmedCurve(curve, first, last));
  }
  if (spline->IsPeriodic()) spline->SetNotPeriodic();
  if (edge.Orientation() == TopAbs_REVERSED) spline->Reverse();
  return spline;
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
