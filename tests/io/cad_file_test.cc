// SPDX-License-Identifier: BSD-3-Clause
#include "io/cad_file.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "base/errors.h"
#include "base/random.h"
#include "io/surface_file.h"
#include "tests/io/sample_surfaces.h"
#include "tests/io/temp_folder.h"

namespace frond {
namespace {

double SignedArea(const TrimLoop& loop) {
  double area = 0;
  for (std::size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++) {
    area += 0.5 * (loop[j].x() * loop[i].y() - loop[i].x() * loop[j].y());
  }
  return area;
}

// ∫ |S_u × S_v| du from the domain's begin to (u, v), by the midpoint rule in each knot span.
double InnerArea(const NurbsSurface& s, double u, double v) {
  constexpr int kSteps = 40;
  double sum = 0;
  for (const int span : s.u().spans()) {
    const auto k = static_cast<std::size_t>(span);
    const double begin = s.u().knots()[k], width = std::min(s.u().knots()[k + 1], u) - begin;
    for (int j = 0; j < kSteps && width > 0; ++j) {
      const SurfacePoint p = s.EvaluateWithDerivatives(begin + width * (j + 0.5) / kSteps, v);
      sum += p.du.cross(p.dv).norm() * width / kSteps;
    }
  }
  return sum;
}

// ∫∫ |S_u × S_v| over the inside of the loops by Green's theorem, ∮ InnerArea dv: a way independent of Open
// CASCADE's.
double AreaInsideTrim(const TrimmedSurface& t) {
  const NurbsSurface& s = t.surface;
  std::vector<TrimLoop> loops = t.trim;
  if (loops.empty()) {
    const double u0 = s.u().begin(), u1 = s.u().end(), v0 = s.v().begin(), v1 = s.v().end();
    loops = {{{u0, v0}, {u1, v0}, {u1, v1}, {u0, v1}}};
  }
  double total = 0;
  for (std::size_t k = 0; k < loops.size(); ++k) {
    const TrimLoop& loop = loops[k];
    const double sign = (SignedArea(loop) > 0) == (k == 0) ? 1 : -1;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Eigen::Vector2d a = loop[i], b = loop[(i + 1) % loop.size()];
      const double dv = b.y() - a.y();
      const int pieces = dv == 0 ? 0 : static_cast<int>(std::ceil(std::abs(dv) * 2000));
      for (int piece = 0; piece < pieces; ++piece) {
        const Eigen::Vector2d uv = a + (b - a) * ((piece + 0.5) / pieces);
        total += sign * InnerArea(s, uv.x(), uv.y()) * dv / pieces;
      }
    }
  }
  return total;
}

struct Case {
  SampleSurface sample;
  std::string extension;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.sample.name << "." << c.extension; }

class CadFile : public ::testing::TestWithParam<Case> {};

std::vector<Case> Cases() {
  std::vector<Case> cases;
  for (const SampleSurface& sample : SampleSurfaces()) {
    for (const char* extension : {"step", "igs"}) cases.push_back({sample, extension});
  }
  return cases;
}

INSTANTIATE_TEST_SUITE_P(EverySurface, CadFile, ::testing::ValuesIn(Cases()), [](const auto& info) {
  return info.param.sample.name + "_" + info.param.extension;
});

TEST_P(CadFile, ReadBackByOpenCascade_AgreesWithSurfaceJsonTo1e9OfTheSize) {
  const TempFolder folder;
  const SurfaceDocument document{GetParam().sample.trimmed, "mm"};
  const auto cad_path = folder / ("surface." + GetParam().extension);
  WriteSurface(cad_path, document);
  WriteSurface(folder / "surface.json", document);
  const SurfaceDocument cad = ReadSurface(cad_path), json = ReadSurface(folder / "surface.json");
  const NurbsSurface &a = cad.trimmed.surface, &b = json.trimmed.surface;
  EXPECT_EQ(cad.unit, "mm");
  ASSERT_NEAR(a.u().begin(), b.u().begin(), 1e-12);
  ASSERT_NEAR(a.u().end(), b.u().end(), 1e-12);
  Random random(7);
  double worst = 0;
  for (int k = 0; k < 10000; ++k) {
    const double u = random.Uniform(b.u().begin(), b.u().end()),
                 v = random.Uniform(b.v().begin(), b.v().end());
    worst = std::max(worst, (a.Evaluate(u, v) - b.Evaluate(u, v)).norm());
  }
  EXPECT_LT(worst, 1e-9 * b.Size());
}

TEST_P(CadFile, ReadBackByOpenCascade_HasTheSameTrim) {
  const TempFolder folder;
  const SurfaceDocument document{GetParam().sample.trimmed, "mm"};
  const auto path = folder / ("surface." + GetParam().extension);
  WriteSurface(path, document);
  const std::vector<TrimLoop> read = ReadSurface(path).trimmed.trim, &written = document.trimmed.trim;
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t k = 0; k < read.size(); ++k) {
    EXPECT_NEAR(std::abs(SignedArea(read[k])), std::abs(SignedArea(written[k])), 1e-9);
  }
}

TEST_P(CadFile, OpenCascadesChecker_FindsItValidAndOfOurArea) {
  const TempFolder folder;
  const SurfaceDocument document{GetParam().sample.trimmed, "mm"};
  const auto path = folder / ("surface." + GetParam().extension);
  WriteSurface(path, document);
  const CadCheck check = CheckCadFile(path);
  EXPECT_TRUE(check.valid);
  EXPECT_EQ(check.faces, 1u);
  const double area = AreaInsideTrim(document.trimmed);
  // Open CASCADE integrates across the creases of a bilinear surface: 2.6e-4 off, whatever tolerance is asked
  // for.
  const bool creased = document.trimmed.surface.u().degree() == 1;
  EXPECT_NEAR(check.area, area, (creased ? 5e-4 : 2e-4) * area);
  EXPECT_LT(check.tolerance, 1e-5);
}

// ∮ S · dA / 3, by four Gauss points in u and v on every cell of the knots.
double VolumeInside(const NurbsSurface& s) {
  const double nodes[] = {-0.8611363115940526, -0.3399810435848563, 0.3399810435848563, 0.8611363115940526};
  const double weights[] = {0.3478548451374538, 0.6521451548625461, 0.6521451548625461, 0.3478548451374538};
  constexpr int kPieces = 4;  // to a cell, for rational surfaces
  double sum = 0;
  const auto pieces = [](const BSplineBasis& basis) {
    std::vector<std::pair<double, double>> all;
    for (const int span : basis.spans()) {
      const auto k = static_cast<std::size_t>(span);
      const double step = (basis.knots()[k + 1] - basis.knots()[k]) / kPieces;
      for (int i = 0; i < kPieces; ++i) all.emplace_back(basis.knots()[k] + step * (i + 0.5), step / 2);
    }
    return all;
  };
  for (const auto& [u, half_u] : pieces(s.u())) {
    for (const auto& [v, half_v] : pieces(s.v())) {
      for (std::size_t a = 0; a < 4; ++a) {
        for (std::size_t b = 0; b < 4; ++b) {
          const SurfacePoint p = s.EvaluateWithDerivatives(u + half_u * nodes[a], v + half_v * nodes[b]);
          sum += weights[a] * weights[b] * half_u * half_v * p.position.dot(p.du.cross(p.dv)) / 3;
        }
      }
    }
  }
  return sum;
}

TEST(CadFile, ClosedSurfaces_BecomeWatertightSolidsOfTheirVolume) {
  const TempFolder folder;
  const std::pair<const char*, NurbsSurface> cases[] = {{"pear", Pear(80)},
                                                        {"pear, normal inward", Pear(80, true)},
                                                        {"pear in metres", Pear(0.08)},
                                                        {"ring", Ring()},
                                                        {"sphere", Sphere(10)}};
  for (const auto& [name, surface] : cases) {
    const double volume = std::abs(VolumeInside(surface));
    for (const char* file : {"a.step", "a.igs"}) {
      WriteSurface(folder / file, {{surface, {}}, "m"});
      const CadCheck check = CheckCadFile(folder / file);
      EXPECT_TRUE(check.valid) << name << file;
      EXPECT_EQ(check.faces, 1u) << name << file;
      EXPECT_EQ(check.solids, 1u) << name << file;
      EXPECT_TRUE(check.closed) << name << file;
      EXPECT_NEAR(check.volume, volume, 1e-5 * volume) << name << file;
    }
    EXPECT_NEAR(CheckShape({{surface, {}}, "m"}).volume, volume, 1e-5 * volume) << name;
  }
  const double exact = 4000 * std::numbers::pi / 3;
  EXPECT_NEAR(CheckShape({{Sphere(10), {}}, "mm"}).volume, exact, 1e-5 * exact);
}

TEST(CadFile, SurfacesWithARimOrATrim_StayFaces) {
  for (const SampleSurface& sample : SampleSurfaces()) {
    const CadCheck check = CheckShape({sample.trimmed, "mm"});
    const bool closed = sample.name == "Pear" || sample.name == "Ring" || sample.name == "Sphere";
    EXPECT_EQ(check.solids, closed ? 1u : 0u) << sample.name;
    EXPECT_EQ(check.closed, closed) << sample.name;
    EXPECT_EQ(check.volume > 0, closed) << sample.name;
  }
  EXPECT_EQ(CheckShape({{Pear(80), {LeafOutline(50)}}, "mm"}).solids, 0u);
}

TEST(CadFile, Files_HoldTheEntitiesOfSolidsAndFaces) {
  const TempFolder folder;
  WriteStep(folder / "pear.step", SurfaceDocument{{Pear(80), {}}, "mm"});
  WriteIges(folder / "pear.igs", SurfaceDocument{{Pear(80), {}}, "mm"});
  WriteStep(folder / "cup.step", SurfaceDocument{{Cup(), {}}, "mm"});
  WriteIges(folder / "cup.igs", SurfaceDocument{{Cup(), {}}, "mm"});
  const std::string step = FileText(folder / "pear.step"), iges = FileText(folder / "pear.igs");
  EXPECT_TRUE(Holds(step.substr(0, 4000), "MANIFOLD_SOLID_BREP"));
  EXPECT_TRUE(Holds(step.substr(0, 4000), "CLOSED_SHELL"));
  EXPECT_NE(iges.find("     186 "), std::string::npos);
  EXPECT_NE(iges.find("     128 "), std::string::npos);
  EXPECT_EQ(FileText(folder / "cup.step").find("MANIFOLD_SOLID_BREP"), std::string::npos);
  EXPECT_NE(FileText(folder / "cup.igs").find("     144 "), std::string::npos);
}

TEST(CadFile, EveryUnit_ReadsBackAtTheSameScale) {
  const TempFolder folder;
  for (const char* unit : {"um", "mm", "cm", "m", "in", "ft"}) {
    for (const char* extension : {"step", "igs"}) {
      const SurfaceDocument document{{WavySheet(3, 3, 8, 6, false), {}}, unit};
      const auto path = folder / (std::string(unit) + "." + extension);
      WriteSurface(path, document);
      const SurfaceDocument read = ReadSurface(path);
      EXPECT_EQ(read.unit, unit) << path;
      EXPECT_LT(
          (read.trimmed.surface.Evaluate(0.3, 0.4) - document.trimmed.surface.Evaluate(0.3, 0.4)).norm(),
          1e-8)
          << path;
    }
  }
  EXPECT_NE(FileText(folder / "in.step").find("INCH"), std::string::npos);
  EXPECT_NE(FileText(folder / "m.step").find("SI_UNIT($,.METRE.)"), std::string::npos);
}

TEST(CadFile, Writing_PrintsNothing) {
  const TempFolder folder;
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  WriteStep(folder / "a.step", {{WavySheet(3, 3, 8, 6, false), {}}, "mm"});
  WriteIges(folder / "a.igs", {{WavySheet(3, 3, 8, 6, false), {}}, "mm"});
  ReadStep(folder / "a.step");
  ReadIges(folder / "a.igs");
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(CadFile, SelfCrossingTrim_IsRefusedAndNothingIsWritten) {
  const TempFolder folder;
  const TrimmedSurface bow_tie{WavySheet(3, 3, 8, 6, false),
                               {{{0.1, 0.1}, {0.9, 0.9}, {0.9, 0.1}, {0.1, 0.85}}}};
  MessageOf<FitError>([&] { WriteStep(folder / "a.step", {bow_tie, "mm"}); });
  EXPECT_FALSE(std::filesystem::exists(folder / "a.step"));
}

TEST(CadFile, Rubbish_IsRefusedInOneLineThatNamesTheFile) {
  const TempFolder folder;
  std::string binary(5000, '\0');
  for (std::size_t k = 0; k < binary.size(); ++k) binary[k] = static_cast<char>(k * 37 + k / 11);
  for (const char* name : {"a.step", "a.igs"}) {
    for (const std::string& text : {std::string(), std::string("hello\n"), binary}) {
      const auto path = folder.Write(name, text);
      EXPECT_TRUE(Holds(MessageOf<InputError>([&] { ReadSurface(path); }), path.string()));
    }
    std::filesystem::remove(folder / name);
    EXPECT_TRUE(Holds(MessageOf<InputError>([&] { ReadSurface(folder / name); }), "no such file"));
  }
}

TEST(CadFile, TruncatedFiles_AreRefusedWhereverTheyAreCut) {
  const TempFolder folder;
  for (const char* extension : {"step", "igs"}) {
    const auto path = folder / (std::string("whole.") + extension);
    WriteSurface(path, {{WavySheet(3, 3, 8, 6, true), {LeafOutline(20)}}, "mm"});
    const std::string whole = FileText(path);
    for (std::size_t percent = 1; percent < 100; percent += 7) {
      const auto cut =
          folder.Write(std::string("cut.") + extension, whole.substr(0, whole.size() * percent / 100));
      EXPECT_TRUE(Holds(MessageOf<InputError>([&] { ReadSurface(cut); }), cut.string())) << percent << " %";
    }
  }
}

TEST(CadFile, DamagedStep_IsReadOrRefused) {
  const TempFolder folder;
  WriteStep(folder / "whole.step", {{WavySheet(3, 3, 8, 6, true), {LeafOutline(20)}}, "mm"});
  const std::string whole = FileText(folder / "whole.step");
  Random random(8);
  int refused = 0;
  for (int trial = 0; trial < 60; ++trial) {
    std::string damaged = whole;
    for (int k = 0; k < 5; ++k)
      damaged[random.Below(damaged.size())] = static_cast<char>(32 + random.Below(95));
    const auto path = folder.Write("damaged.step", damaged);
    try {
      ReadStep(path);
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 10);
}

}  // namespace
}  // namespace frond
