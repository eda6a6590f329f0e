// SPDX-License-Identifier: BSD-3-Clause
// frond mesh: what it writes, what it refuses.
#include <signal.h>
#include <sys/wait.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "io/surface_json.h"
#include "tests/apps/run_program.h"
#include "tests/io/sample_surfaces.h"
#include "tests/io/temp_folder.h"

namespace frond {
namespace {

class MeshCommand : public ::testing::Test {
 protected:
  MeshCommand() {
    std::filesystem::create_directory(folder_ / "run");
    WriteSurfaceJson(folder_ / "run/surface.json", {{Pear(0.08), {}}, "m"});
    std::filesystem::create_directory(folder_ / "cup");
    WriteSurfaceJson(folder_ / "cup/surface.json", {{Cup(), {}}, "mm"});
  }

  ProgramResult Mesh(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "mesh");
    return RunFrond(arguments, folder_.path());
  }

  void ExpectRefusal(const std::vector<std::string>& arguments, int code, const std::string& said) const {
    const auto before = NamesIn(folder_ / "run");
    const ProgramResult result = Mesh(arguments);
    EXPECT_EQ(result.exit_code, code) << result.err;
    EXPECT_TRUE(IsOneErrorLine(result.err)) << result.err;
    EXPECT_TRUE(Holds(result.err, said));
    EXPECT_EQ(NamesIn(folder_ / "run"), before);
  }

  TempFolder folder_;
};

TEST_F(MeshCommand, Volume_WritesTheMeshAndItsQuality) {
  const ProgramResult result = Mesh({"run", "--volume", "--order=2", "--size=0.01"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(Holds(result.out, "tetrahedra of order 2, size 0.01 m, SICN min 0."));
  EXPECT_EQ(NamesIn(folder_ / "run"),
            (std::vector<std::string>{"mesh.msh", "mesh_quality.json", "surface.json"}));
  const std::string quality = FileText(folder_ / "run/mesh_quality.json");
  for (const char* part : {"\"schema\": \"frond.mesh_quality/1\"", "\"unit\": \"m\"",
                           "\"element\": \"tetrahedron\"", "\"order\": 2", "\"size\": 0.01",
                           "\"shell_thickness\": null", "\"below_0.1\": 0", "\"volume\": 9.9"}) {
    EXPECT_TRUE(Holds(quality, part));
  }
}

TEST_F(MeshCommand, ShellThickness_WritesASectionIntoInpAndBdf) {
  const ProgramResult result =
      Mesh({"cup", "--format=inp,bdf", "--shell-thickness=1.5", "--size=8", "--out=fe"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(NamesIn(folder_ / "fe"), (std::vector<std::string>{"mesh.bdf", "mesh.inp", "mesh_quality.json"}));
  EXPECT_TRUE(
      FileText(folder_ / "fe/mesh.inp").ends_with("*SHELL SECTION, ELSET=surface, MATERIAL=material\n1.5\n"));
  EXPECT_NE(FileText(folder_ / "fe/mesh.inp").find("type=S3,"), std::string::npos);
  EXPECT_NE(FileText(folder_ / "fe/mesh.bdf").find("PSHELL*"), std::string::npos);
  EXPECT_EQ(NamesIn(folder_ / "cup"), std::vector<std::string>{"surface.json"});
  // The underscored name is the same flag.
  EXPECT_EQ(Mesh({"cup", "--format=inp", "--shell_thickness=1.5", "--size=8"}).exit_code, 0);
}

TEST_F(MeshCommand, ExistingMesh_IsReplacedOnlyByOverwrite) {
  ASSERT_EQ(Mesh({"run", "--size=0.02"}).exit_code, 0);
  ExpectRefusal({"run", "--size=0.02"}, 2, "run/mesh.msh: exists already; give --overwrite");
  const std::string before = FileText(folder_ / "run/mesh.msh");
  ASSERT_EQ(Mesh({"run", "--size=0.015", "--overwrite", "--quiet"}).exit_code, 0);
  EXPECT_NE(FileText(folder_ / "run/mesh.msh"), before);
}

TEST_F(MeshCommand, Overwrite_LeavesNoMeshThatTheQualityFileDoesNotName) {
  ASSERT_EQ(Mesh({"run", "--size=0.02", "--format=msh,inp"}).exit_code, 0);
  ASSERT_EQ(Mesh({"run", "--size=0.02", "--format=vtk", "--overwrite"}).exit_code, 0);
  EXPECT_EQ(NamesIn(folder_ / "run"),
            (std::vector<std::string>{"mesh.vtk", "mesh_quality.json", "surface.json"}));
  ExpectRefusal({"run", "--size=1000", "--overwrite"}, 4, "a smaller --size");  // the old one stays
  std::filesystem::create_directory(folder_ / "run/mesh.msh");
  ExpectRefusal({"run", "--size=0.02", "--overwrite"}, 2, "run/mesh.msh: is a folder");
}

TEST_F(MeshCommand, FailedMesh_LeavesNoFolder) {
  ExpectRefusal({"run", "--size=1000", "--out=a/b"}, 4, "a smaller --size");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a"));
}

TEST_F(MeshCommand, SameRun_GivesTheSameBytes) {
  ASSERT_EQ(Mesh({"run", "--volume", "--size=0.015", "--out=a"}).exit_code, 0);
  ASSERT_EQ(Mesh({"run", "--volume", "--size=0.015", "--out=b"}).exit_code, 0);
  for (const char* name : {"mesh.msh", "mesh_quality.json"}) {
    EXPECT_EQ(FileText(folder_ / "a" / name), FileText(folder_ / "b" / name)) << name;
  }
}

TEST_F(MeshCommand, WrongUse_IsRefusedInOneLine) {
  ExpectRefusal({}, 2, "usage: frond mesh RUN");
  ExpectRefusal({"nowhere"}, 3, "nowhere: no such run");
  ExpectRefusal({"."}, 3, "holds neither surface.json nor surface.step");
  ExpectRefusal({"cup", "--volume"}, 3, "cup/surface.json: the surface is open; --volume needs a closed one");
  ExpectRefusal({"run", "--order=3"}, 2, "flag '--order' must be 1 or 2");
  ExpectRefusal({"run", "--size=0"}, 2, "flag '--size' must be positive");
  ExpectRefusal({"run", "--size=1000"}, 4, "a smaller --size");
  ExpectRefusal({"run", "--size=1e-6"}, 2,
                "1e-06 m would make more than 20 million elements; the default is");
  ExpectRefusal({"run", "--size=0.0001", "--volume"}, 2, "more than 20 million elements");
  ExpectRefusal({"run", "--size=nan"}, 2, "flag '--size' must be positive");
  ExpectRefusal({"run", "--size=inf"}, 2, "flag '--size' must be positive and finite");
  ExpectRefusal({"run", "--shell-thickness=inf", "--format=inp"}, 2, "'--shell-thickness' must be positive");
  for (const std::string flag : {"--set=a.b=1", "--seed=3", "--threads=2"}) {
    ExpectRefusal({"run", flag}, 2, "means nothing to frond mesh");
  }
  ExpectRefusal({"run", "--format=stl"}, 2, "unknown format 'stl'; known: msh, inp, bdf, unv, vtk");
  ExpectRefusal({"run", "--format=inp,inp"}, 2, "names 'inp' twice");
  ExpectRefusal({"run", "--format="}, 2, "names no format");
  ExpectRefusal({"run", "--shell-thickness=1"}, 2, "use --format=inp or --format=bdf");
  ExpectRefusal({"run", "--shell-thickness=1", "--format=inp", "--volume"}, 2, "not with --volume");
  ExpectRefusal({"run", "--shell-thicknes=1"}, 2, "did you mean '--shell-thickness'?");
  const ProgramResult other = RunFrond({"check", "a.yaml", "--size=2"}, folder_.path());
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_TRUE(Holds(other.err, "flag '--size' is of frond mesh, not of frond check"));
}

TEST_F(MeshCommand, Terminated_LeavesNoGmshBehind) {
  const char* path = std::getenv("PATH");
  const std::string before = path == nullptr ? "" : path;
  const std::string pid_file = (folder_ / "pid").string();
  std::filesystem::permissions(
      folder_.Write("gmsh", "#!/bin/sh\n[ \"$1\" = --version ] && echo 4.8.4 && exit\necho $$ > " + pid_file +
                                "-; mv " + pid_file + "- " + pid_file + "; exec sleep 60\n"),
      std::filesystem::perms::owner_all);
  ::setenv("PATH", (folder_.path().string() + ":" + before).c_str(), 1);
  const pid_t frond = StartFrond({"mesh", "run"}, folder_.path());
  ::setenv("PATH", before.c_str(), 1);
  const auto wait_until = [](const auto& done) {
    for (int k = 0; k < 200 && !done(); ++k) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    return done();
  };
  ASSERT_TRUE(wait_until([&] { return std::filesystem::exists(pid_file); }));
  const pid_t gmsh = std::stoi(FileText(pid_file));
  ::kill(frond, SIGTERM);
  int status = 0;
  ::waitpid(frond, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM);
  // Nobody may reap an orphan: a zombie has ended too.
  EXPECT_TRUE(wait_until([&] {
    std::ifstream stat("/proc/" + std::to_string(gmsh) + "/stat");
    std::string text;
    return !std::getline(stat, text) || text.find(") Z ") != std::string::npos;
  }));
}

TEST_F(MeshCommand, WithoutGmsh_NamesThePackage) {
  const char* path = std::getenv("PATH");
  const std::string before = path == nullptr ? "" : path;
  ::setenv("PATH", "", 1);
  ExpectRefusal({"run"}, 2, "there is no program 'gmsh' on PATH; install the package gmsh");
  ::setenv("PATH", before.c_str(), 1);
}

}  // namespace
}  // namespace frond
