// SPDX-License-Identifier: BSD-3-Clause
#include "io/view_list.h"

#include <gtest/gtest.h>

#include <numbers>

#include "base/errors.h"
#include "tests/io/temp_folder.h"

namespace frond {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

class ViewListFile : public ::testing::Test {
 protected:
  ViewListFile() {
    for (const char* name : {"a.png", "b.png", "m.png"}) folder_.Write(name, "any");
  }
  std::string ErrorOf(const std::string& text, bool board = false) {
    folder_.Write("views.csv", text);
    return MessageOf<InputError>(
        [&] { board ? ReadBoardViews(folder_ / "views.csv") : ReadViewList(folder_ / "views.csv"); });
  }

  TempFolder folder_;
};

TEST_F(ViewListFile, Views_HaveAnglesInRadiansAndPathsOfTheListsFolder) {
  folder_.Write("views.csv", "# a turn\nimage,angle,mask\na.png, 0 ,m.png\r\n\n\"b.png\",-4,\n");
  const ViewList list = ReadViewList(folder_ / "views.csv");
  ASSERT_EQ(list.views.size(), 2U);
  EXPECT_EQ(list.views[0].image, folder_ / "a.png");
  EXPECT_EQ(list.views[0].mask, folder_ / "m.png");
  EXPECT_EQ(*list.views[0].angle, 0);
  EXPECT_EQ(list.views[1].image, folder_ / "b.png");
  EXPECT_TRUE(list.views[1].mask.empty());
  EXPECT_DOUBLE_EQ(*list.views[1].angle, -4 * kDegree);
  EXPECT_TRUE(list.Place(1).ends_with("views.csv:5"));
}

TEST_F(ViewListFile, BoardViews_MayLackTheirAngles) {
  folder_.Write("board.csv", "angle,image\n,a.png\n30,b.png\n");
  const ViewList list = ReadBoardViews(folder_ / "board.csv");
  EXPECT_FALSE(list.views[0].angle);
  EXPECT_DOUBLE_EQ(*list.views[1].angle, 30 * kDegree);
  folder_.Write("free.csv", "image\na.png\n");
  EXPECT_FALSE(ReadBoardViews(folder_ / "free.csv").views[0].angle);
}

TEST_F(ViewListFile, ImagePairs_AreReadInOrder) {
  folder_.Write("pairs.csv", "left,right\na.png,b.png\nb.png,a.png\n");
  const ImagePairList list = ReadImagePairs(folder_ / "pairs.csv");
  ASSERT_EQ(list.pairs.size(), 2U);
  EXPECT_EQ(list.pairs[1].left, folder_ / "b.png");
  EXPECT_EQ(list.pairs[1].right, folder_ / "a.png");
  EXPECT_TRUE(list.Place(1).ends_with("pairs.csv:3"));
}

TEST_F(ViewListFile, Mistakes_AreToldWithFileAndLine) {
  EXPECT_TRUE(Holds(ErrorOf(""), "views.csv: is empty; its first line is 'image,angle'"));
  EXPECT_TRUE(Holds(ErrorOf("image,angle\n"), "lists no image"));
  EXPECT_TRUE(Holds(ErrorOf("image,angel\na.png,1\n"),
                    "views.csv:1: unknown column 'angel' (did you mean 'angle'?)"));
  EXPECT_TRUE(Holds(ErrorOf("image\na.png\n"), "views.csv:1: has no column 'angle'"));
  EXPECT_TRUE(Holds(ErrorOf("image,angle\na.png\n"), "views.csv:2: has 1 values under a header of 2"));
  EXPECT_TRUE(Holds(ErrorOf("image,angle\n\na.png,four\n"), "views.csv:3: the angle 'four'"));
  EXPECT_TRUE(Holds(ErrorOf("image,angle\na.png,\n"), "views.csv:2: a view of the object needs its angle"));
  EXPECT_TRUE(Holds(ErrorOf("image,angle\na.png,0\nc.png,4\n"), "views.csv:3: no such file: "));
  EXPECT_TRUE(Holds(ErrorOf("image,angle,mask\na.png,0,n.png\n"), "views.csv:2: no such file: "));
  EXPECT_TRUE(Holds(ErrorOf("image,angle\na.png,0\n,4\n"), "views.csv:3: names no file under 'image'"));
  EXPECT_TRUE(
      Holds(ErrorOf("image,angle\na.png,10\nb.png,370\n"), "views.csv:3: the same angle as in line 2"));
  EXPECT_TRUE(Holds(ErrorOf("image,angle\na.png,x\n", true), "views.csv:2: the angle 'x'"));
  folder_.Write("pairs.csv", "left,right\na.png,\n");
  EXPECT_TRUE(Holds(MessageOf<InputError>([&] { ReadImagePairs(folder_ / "pairs.csv"); }),
                    "pairs.csv:2: names no file under 'right'"));
  EXPECT_TRUE(Holds(MessageOf<InputError>([&] { ReadImagePairs(folder_ / "none.csv"); }), "no such file"));
}

}  // namespace
}  // namespace frond
