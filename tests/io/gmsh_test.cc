// SPDX-License-Identifier: BSD-3-Clause
// Meshes made by the program gmsh, judged by analytic shapes, by our own reading of the files and by Gmsh's.
#include "io/gmsh.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>
#include <sstream>

#include "base/errors.h"
#include "io/cad_file.h"
#include "io/child_process.h"
#include "io/file_bytes.h"
#include "tests/io/sample_surfaces.h"
#include "tests/io/temp_folder.h"

namespace frond {
namespace {

GmshMesh MeshIn(const TempFolder& folder, const NurbsSurface& surface, const std::string& unit,
                const GmshOptions& options) {
  return MeshByGmsh({{surface, {}}, unit}, options, folder.path());
}

double Least(const std::vector<double>& values) { return *std::min_element(values.begin(), values.end()); }

// An environment variable for the length of a scope.
class Environment {
 public:
  Environment(const char* name, const std::string& value) : name_(name) {
    const char* before = std::getenv(name);
    if (before != nullptr) before_ = before;
    had_ = before != nullptr;
    ::setenv(name, value.c_str(), 1);
  }
  ~Environment() { had_ ? ::setenv(name_, before_.c_str(), 1) : ::unsetenv(name_); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  const char* name_;
  std::string before_;
  bool had_ = false;
};

TEST(Gmsh, StepOfAPear_IsOneVolumeOfItsVolumeToOneThousandth) {
  const TempFolder folder;
  const SurfaceDocument pear{{Pear(0.08), {}}, "m"};
  WriteStep(folder / "pear.step", pear);
  folder.Write("a.geo",
               "SetFactory(\"OpenCASCADE\");\nGeometry.OCCTargetUnit = \"M\";\nMerge \"pear.step\";\n"
               "v[] = Volume{:}; s[] = Surface{:}; m[] = Mass Volume {v[0]};\n"
               "Printf(\"%g %g %.16g\", #v[], #s[], m[0]) > \"out.txt\";\n");
  EXPECT_EQ(RunChild("gmsh", {"a.geo", "-", "-nopopup"}, folder.path(), {}).exit_code, 0);
  std::istringstream out(FileText(folder / "out.txt"));
  double volumes = 0, surfaces = 0, volume = 0;
  out >> volumes >> surfaces >> volume;
  EXPECT_EQ(volumes, 1);
  EXPECT_EQ(surfaces, 1);
  const double exact = CheckShape(pear).volume;
  EXPECT_NEAR(volume, exact, 1e-3 * exact);
}

TEST(Gmsh, VolumeMeshOfAPearInMetres_IsWellShapedAndFillsIt) {
  const double exact = CheckShape({{Pear(0.08), {}}, "m"}).volume;
  for (const int order : {1, 2}) {
    const TempFolder folder;
    const GmshMesh mesh =
        MeshIn(folder, Pear(0.08), "m", {.size = 0.0056, .order = order, .volume = true, .formats = {"msh"}});
    EXPECT_EQ(mesh.mesh.order, order);
    EXPECT_EQ(mesh.mesh.dimension, 3);
    EXPECT_GT(mesh.mesh.NumElements(), 1000u);
    EXPECT_GT(Least(mesh.sicn), 0.05);
    RecordProperty("min_sicn_order_" + std::to_string(order), std::to_string(Least(mesh.sicn)));
    EXPECT_NEAR(Measure(mesh.mesh), exact, (order == 1 ? 3e-2 : 5e-4) * exact);
    EXPECT_EQ(mesh.version.substr(0, 1), "4");
  }
}

TEST(Gmsh, NodesOfASphereOfOrderTwo_LieOnIt) {
  const TempFolder folder;
  const GmshMesh mesh = MeshIn(folder, Sphere(10), "mm", {.size = 2.5, .order = 2, .volume = false});
  double worst = 0;
  for (const Eigen::Vector3d& node : mesh.mesh.nodes) worst = std::max(worst, std::abs(node.norm() - 10));
  EXPECT_LT(worst, 1e-6);
  const double exact = 400 * std::numbers::pi;
  EXPECT_NEAR(Measure(mesh.mesh), exact, 2e-3 * exact);
}

TEST(Gmsh, TrianglesOfAClosedSurface_LookOutward) {
  for (const bool clockwise : {false, true}) {
    const TempFolder folder;
    const FeMesh mesh = MeshIn(folder, Pear(80, clockwise), "mm", {.size = 12}).mesh;
    double volume = 0;
    for (std::size_t e = 0; e < mesh.elements.size(); e += 3) {
      const auto node = [&](std::size_t k) { return mesh.nodes[mesh.elements[e + k]]; };
      volume += node(0).cross(node(1)).dot(node(2)) / 6;
    }
    EXPECT_GT(volume, 80000) << clockwise;
  }
}

TEST(Gmsh, EveryUnit_KeepsItsCoordinates) {
  for (const char* unit : {"um", "mm", "cm", "m", "km", "in", "ft"}) {
    const TempFolder folder;
    Eigen::AlignedBox3d box;
    for (const auto& node : MeshIn(folder, Sphere(10), unit, {.size = 6}).mesh.nodes) box.extend(node);
    EXPECT_NEAR(box.sizes().z(), 20, 0.01) << unit;
  }
}

// The elements of the kind that holds `nodes` nodes each, by their node numbers; and the nodes.
struct Deck {
  std::map<int, Eigen::Vector3d> nodes;
  std::vector<std::vector<int>> elements;
};

Deck ReadInp(const std::string& text, const std::string& type) {
  Deck deck;
  std::istringstream lines(text);
  std::string line, section;
  while (std::getline(lines, line)) {
    if (line[0] == '*') {
      section = line;
      continue;
    }
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    int number = 0;
    words >> number;
    if (section == "*NODE") {
      Eigen::Vector3d& node = deck.nodes[number];
      words >> node[0] >> node[1] >> node[2];
    } else if (section.starts_with("*ELEMENT, type=" + type + ",")) {
      deck.elements.emplace_back();
      for (int node = 0; words >> node;) deck.elements.back().push_back(node);
    }
  }
  return deck;
}

// Nastran: fields of 8 columns, 16 in cards with an asterisk; a card goes on in lines that begin with a blank
// or an asterisk.
Deck ReadBdf(const std::string& text, const std::string& type) {
  std::vector<std::vector<std::string>> cards;
  std::istringstream lines(text);
  std::string line;
  while (std::getline(lines, line)) {
    if (line[0] == '$') continue;
    const bool large = line.substr(0, 8).find('*') != std::string::npos;
    if (line[0] != ' ' && line[0] != '*') cards.push_back({line.substr(0, line.find_first_of("* "))});
    const std::size_t width = large ? 16 : 8;
    for (std::size_t at = 8; at < std::min<std::size_t>(line.size(), 72); at += width) {
      cards.back().push_back(line.substr(at, width));
    }
  }
  Deck deck;
  for (const auto& card : cards) {
    if (card[0] == "GRID") {
      deck.nodes[std::stoi(card[1])] = {std::stod(card[3]), std::stod(card[4]), std::stod(card[5])};
    } else if (card[0] == type) {
      deck.elements.emplace_back();
      for (std::size_t k = 3; k < card.size(); ++k) {
        if (card[k].find_first_not_of(' ') != std::string::npos) {
          deck.elements.back().push_back(std::stoi(card[k]));
        }
      }
    }
  }
  return deck;
}

// Abaqus, CalculiX and Nastran number mid-edge nodes alike: 12 23 31, then 14 24 34.
void ExpectRightMidNodes(const Deck& deck, std::size_t corners, std::size_t elements) {
  const std::pair<std::size_t, std::size_t> edges[] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  const std::size_t mids = corners == 3 ? 3 : 6;
  ASSERT_EQ(deck.elements.size(), elements);
  for (const auto& element : deck.elements) {
    ASSERT_EQ(element.size(), corners + mids);
    const auto node = [&](std::size_t k) { return deck.nodes.at(element[k]); };
    for (std::size_t k = 0; k < mids; ++k) {
      const Eigen::Vector3d a = node(edges[k].first), b = node(edges[k].second);
      EXPECT_LT((node(corners + k) - (a + b) / 2).norm(), 0.3 * (a - b).norm());
    }
  }
}

TEST(Gmsh, QuadraticElementsOfInpAndBdf_HaveTheirMidNodesInThoseFormatsOrder) {
  for (const bool volume : {false, true}) {
    const TempFolder folder;
    const std::size_t elements =
        MeshIn(folder, Sphere(10), "mm", {.size = 5, .order = 2, .volume = volume, .formats = {"inp", "bdf"}})
            .mesh.NumElements();
    const std::size_t corners = volume ? 4 : 3;
    ExpectRightMidNodes(ReadInp(FileText(folder / "mesh.inp"), volume ? "C3D10" : "S6"), corners, elements);
    ExpectRightMidNodes(ReadBdf(FileText(folder / "mesh.bdf"), volume ? "CTETRA" : "CTRIA6"), corners,
                        elements);
  }
}

TEST(Gmsh, ItsOwnReaders_FindTheSameMeshInEveryFormatTheyRead) {
  for (const bool volume : {false, true}) {
    for (const int order : {1, 2}) {
      const TempFolder folder;
      const FeMesh mesh =
          MeshIn(folder, Sphere(10), "mm",
                 {.size = 5, .order = order, .volume = volume, .formats = {"msh", "bdf", "unv", "vtk"}})
              .mesh;
      for (const std::string format : {"msh", "bdf", "unv", "vtk"}) {
        if (format == "bdf" && volume && order == 2) continue;  // Gmsh 4.8 reads the corners alone
        RunChild("gmsh", {"mesh." + format, "-", "-nopopup", "-save", "-o", format + ".msh2"}, folder.path(),
                 {});
        const FeMesh read = ParseMsh2(FileText(folder / (format + ".msh2")), format);
        EXPECT_EQ(read.dimension, mesh.dimension) << format;
        EXPECT_EQ(read.order, order) << format;
        EXPECT_EQ(read.nodes.size(), mesh.nodes.size()) << format;
        EXPECT_EQ(read.NumElements(), mesh.NumElements()) << format;
        EXPECT_NEAR(Measure(read), Measure(mesh), 1e-7 * Measure(mesh)) << format;
      }
    }
  }
}

TEST(Gmsh, AUsersSettings_ChangeNotOneByte) {
  const TempFolder home, first, second;
  home.Write(".gmshrc", "Mesh.MeshSizeFactor = 0.5;\n");
  home.Write(".gmsh-options", "Mesh.Algorithm = 1;\nGeneral.NumThreads = 2;\n");
  const GmshOptions options{.size = 10, .formats = FeMeshFormats()};
  MeshIn(first, Pear(80), "mm", options);
  const Environment user("HOME", home.path().string()), german("LC_ALL", "de_DE.UTF-8");
  const Environment theirs("GMSH_HOME", home.path().string());
  MeshIn(second, Pear(80), "mm", options);
  for (const std::string& format : FeMeshFormats()) {
    EXPECT_EQ(FileText(first / ("mesh." + format)), FileText(second / ("mesh." + format))) << format;
  }
}

TEST(Gmsh, KilledOrBroken_IsSaid) {
  const TempFolder programs, folder;
  const Environment path("PATH", programs.path().string() + ":/usr/bin:/bin");
  const auto pretend = [&](const char* script) {
    std::filesystem::permissions(programs.Write("gmsh", script), std::filesystem::perms::owner_all);
  };
  pretend("#!/bin/sh\n[ \"$1\" = --version ] && echo 4.8.4 || kill -9 $$\n");
  EXPECT_TRUE(Holds(MessageOf<FitError>([&] { MeshIn(folder, Sphere(10), "mm", {.size = 5}); }),
                    "gmsh was killed by signal 9 (out of memory? take a larger --size)"));
  pretend("#!/bin/sh\necho no library; exit 127\n");
  EXPECT_TRUE(Holds(MessageOf<ConfigError>([&] { MeshIn(folder, Sphere(10), "mm", {.size = 5}); }),
                    "gmsh does not run: 'gmsh --version' ends with exit code 127 (no library)"));
}

TEST(Gmsh, WithoutTheProgram_NamesThePackage) {
  const TempFolder folder;
  const Environment nowhere("PATH", folder.path().string());
  EXPECT_TRUE(Holds(MessageOf<ConfigError>([&] { MeshIn(folder, Sphere(10), "mm", {.size = 5}); }),
                    "install the package gmsh"));
}

}  // namespace
}  // namespace frond
