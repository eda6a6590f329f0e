// SPDX-License-Identifier: BSD-3-Clause
#include "io/run_directory.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "base/errors.h"
#include "io/file_bytes.h"
#include "tests/io/temp_folder.h"

namespace frond {
namespace {

namespace fs = std::filesystem;

std::size_t EntriesOf(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

void MakeRun(const fs::path& target, const std::string& config, bool overwrite = false) {
  RunDirectory run(target, overwrite);
  WriteFileBytes(run.File("config.yaml"), config);
  run.Commit();
}

TEST(RunDirectory, Commit_MakesTheTargetAppearWhole) {
  const TempFolder folder;
  {
    RunDirectory run(folder / "deep/run", false);
    WriteFileBytes(run.File("config.yaml"), "a: 1\n");
    EXPECT_FALSE(fs::exists(folder / "deep/run"));
    EXPECT_EQ(run.working().filename().string(), ".run.partial-" + std::to_string(::getpid()));
    run.Commit();
  }
  EXPECT_EQ(FileText(folder / "deep/run/config.yaml"), "a: 1\n");
  EXPECT_EQ(EntriesOf(folder / "deep"), 1u);
}

TEST(RunDirectory, WithoutCommit_LeavesNothing) {
  const TempFolder folder;
  try {
    RunDirectory run(folder / "run", false);
    WriteFileBytes(run.File("half.txt"), "half");
    throw FitError("it failed");
  } catch (const FitError&) {
  }
  EXPECT_EQ(EntriesOf(folder.path()), 0u);
}

TEST(RunDirectory, WithoutCommit_RemovesTheParentsItMadeWhileTheyAreEmpty) {
  const TempFolder folder;
  fs::create_directory(folder / "mine");
  { const RunDirectory run(folder / "mine/a/b/run", false); }
  EXPECT_EQ(EntriesOf(folder / "mine"), 0u);
  EXPECT_EQ(EntriesOf(folder.path()), 1u);
  {
    const RunDirectory run(folder / "mine/a/b/run", false);
    folder.Write("mine/a/note", "text");
  }
  EXPECT_EQ(EntriesOf(folder / "mine/a"), 1u);
  folder.Write("file", "text");
  MessageOf<InputError>([&] { RunDirectory(folder / "file/a/run", false); });
  MessageOf<InputError>([&] { RunDirectory("/proc/frond/a/run", false); });
}

TEST(RunDirectory, ExistingRun_IsRefusedUnlessOverwritten) {
  const TempFolder folder;
  MakeRun(folder / "run", "first");
  EXPECT_TRUE(Holds(MessageOf<ConfigError>([&] { RunDirectory(folder / "run", false); }),
                    "exists; choose another --out, or give --overwrite"));
  MakeRun(folder / "run/", "second", true);
  EXPECT_EQ(FileText(folder / "run/config.yaml"), "second");
  EXPECT_EQ(EntriesOf(folder.path()), 1u);
}

TEST(RunDirectory, ForeignFolders_AreNeverDeleted) {
  const TempFolder folder;
  fs::create_directory(folder / "photos");
  folder.Write("photos/leaf.jpg", "pixels");
  folder.Write("file", "text");
  for (const bool overwrite : {false, true}) {
    MessageOf<ConfigError>([&] { RunDirectory(folder / "photos", overwrite); });
    MessageOf<ConfigError>([&] { RunDirectory(folder / "file", overwrite); });
  }
  EXPECT_EQ(FileText(folder / "photos/leaf.jpg"), "pixels");
  fs::create_directory_symlink(folder / "photos", folder / "link");
  MessageOf<ConfigError>([&] { RunDirectory(folder / "link", true); });
}

TEST(RunDirectory, EmptyFolder_IsFilled) {
  const TempFolder folder;
  fs::create_directory(folder / "run");
  MakeRun(folder / "run", "here");
  EXPECT_EQ(FileText(folder / "run/config.yaml"), "here");
}

TEST(RunDirectory, TargetThatAppearsMeanwhile_IsKept) {
  const TempFolder folder;
  RunDirectory late(folder / "run", false);
  MakeRun(folder / "run", "first");
  MessageOf<ConfigError>([&] { late.Commit(); });
  EXPECT_EQ(FileText(folder / "run/config.yaml"), "first");
}

TEST(RunDirectory, UnwritableParent_IsNamedInOneLine) {
  const TempFolder folder;
  folder.Write("file", "text");
  EXPECT_TRUE(Holds(MessageOf<InputError>([&] { RunDirectory(folder / "file/run", false); }),
                    (folder / "file").string()));
  EXPECT_TRUE(
      Holds(MessageOf<InputError>([&] { RunDirectory("/proc/run", false); }), "/proc: cannot be written"));
  if (::geteuid() == 0) return;  // root writes everywhere
  fs::create_directory(folder / "locked");
  fs::permissions(folder / "locked", fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_TRUE(Holds(MessageOf<InputError>([&] { RunDirectory(folder / "locked/run", false); }),
                    "locked: cannot be written"));
}

}  // namespace
}  // namespace frond
