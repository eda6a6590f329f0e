// SPDX-License-Identifier: BSD-3-Clause
#include "io/cad_file.h"

#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <ShapeAnalysis_ShapeTolerance.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <utility>

#include "base/errors.h"
#include "io/cad_exchange.h"
#include "io/cad_geometry.h"
#include "io/cad_shape.h"
#include "io/file_bytes.h"

namespace frond {
namespace {

namespace fs = std::filesystem;

enum class Format { kStep, kIges };

// `make` makes the shape, inside the session.
template <typename Make>
void WriteShape(const fs::path& path, Format format, const std::string& unit, const Make& make) {
  const CadSession session;
  session.SetUnit(unit);
  WriteFileBytes(path, Guarded<FitError>(path.string(), [&] {
                   const TopoDS_Shape shape = make();
                   if (!BRepCheck_Analyzer(shape).IsValid()) {
                     throw FitError(path.string() + ": Open CASCADE finds the shape invalid (does the " +
                                    "surface or its trim cross itself?)");
                   }
                   return format == Format::kStep ? StepText(path, shape) : IgesText(path, shape, unit);
                 }));
}

void WriteShape(const fs::path& path, Format format, const SurfaceDocument& document) {
  WriteShape(path, format, document.unit, [&] { return MakeShape(document.trimmed); });
}

void WriteShape(const fs::path& path, Format format, const CurveDocument& document) {
  WriteShape(path, format, document.unit, [&] { return MakeEdge(document.curve); });
}

SurfaceDocument ReadDocument(const fs::path& path) {
  const CadSession session;
  return Guarded<InputError>(path.string(), [&]() -> SurfaceDocument {
    std::string unit;
    const TopoDS_Shape shape = LoadShape(path, session, &unit);
    for (TopExp_Explorer faces(shape, TopAbs_FACE); faces.More(); faces.Next()) {
      const TopoDS_Face face = TopoDS::Face(faces.Current());
      const Handle(Geom_BSplineSurface) spline = SplineOf(face);
      if (spline.IsNull()) continue;
      NurbsSurface surface = FromOpenCascade(*spline);
      std::vector<TrimLoop> trim = TrimOf(face, surface);
      return {{std::move(surface), std::move(trim)}, unit};
    }
    FailFile(path, "holds no face over a B-spline surface");
  });
}

CurveDocument ReadCurveDocument(const fs::path& path) {
  const CadSession session;
  return Guarded<InputError>(path.string(), [&]() -> CurveDocument {
    std::string unit;
    const TopoDS_Shape shape = LoadShape(path, session, &unit);
    for (TopExp_Explorer edges(shape, TopAbs_EDGE, TopAbs_FACE); edges.More(); edges.Next()) {
      const Handle(Geom_BSplineCurve) spline = SplineOf(TopoDS::Edge(edges.Current()));
      if (!spline.IsNull()) return {FromOpenCascade(*spline), unit};
    }
    FailFile(path, "holds no curve of its own");
  });
}

CadCheck Check(const TopoDS_Shape& shape) {
  CadCheck check;
  check.valid = BRepCheck_Analyzer(shape).IsValid();
  for (TopExp_Explorer faces(shape, TopAbs_FACE); faces.More(); faces.Next()) ++check.faces;
  GProp_GProps properties;
  BRepGProp::SurfaceProperties(shape, properties, 1e-7);
  check.area = properties.Mass();
  TopExp_Explorer shells(shape, TopAbs_SHELL);
  check.closed = shells.More();
  for (; shells.More(); shells.Next()) check.closed = check.closed && BRep_Tool::IsClosed(shells.Current());
  for (TopExp_Explorer solids(shape, TopAbs_SOLID); solids.More(); solids.Next()) ++check.solids;
  if (check.solids > 0) {
    BRepGProp::VolumeProperties(shape, properties, 1e-7);
    check.volume = properties.Mass();
  }
  check.tolerance = ShapeAnalysis_ShapeTolerance().Tolerance(shape, 1);
  return check;
}

}  // namespace

void WriteStep(const fs::path& path, const SurfaceDocument& document) {
  WriteShape(path, Format::kStep, document);
}
void WriteIges(const fs::path& path, const SurfaceDocument& document) {
  WriteShape(path, Format::kIges, document);
}
void WriteStep(const fs::path& path, const CurveDocument& document) {
  WriteShape(path, Format::kStep, document);
}
void WriteIges(const fs::path& path, const CurveDocument& document) {
  WriteShape(path, Format::kIges, document);
}

SurfaceDocument ReadStep(const fs::path& path) { return ReadDocument(path); }
SurfaceDocument ReadIges(const fs::path& path) { return ReadDocument(path); }
CurveDocument ReadStepCurve(const fs::path& path) { return ReadCurveDocument(path); }
CurveDocument ReadIgesCurve(const fs::path& path) { return ReadCurveDocument(path); }

bool HasFaces(const fs::path& path) {
  const CadSession session;
  return Guarded<InputError>(path.string(), [&] {
    std::string unit;
    return TopExp_Explorer(LoadShape(path, session, &unit), TopAbs_FACE).More() == Standard_True;
  });
}

CadCheck CheckShape(const SurfaceDocument& document) {
  const CadSession session;
  return Guarded<FitError>("the surface", [&] { return Check(MakeShape(document.trimmed)); });
}

CadCheck CheckCadFile(const fs::path& path) {
  const CadSession session;
  return Guarded<InputError>(path.string(), [&] {
    std::string unit;
    return Check(LoadShape(path, session, &unit));
  });
}

}  // namespace frond
