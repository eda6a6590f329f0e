// SPDX-License-Identifier: BSD-3-Clause
#include "io/image_file.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "base/errors.h"
#include "tests/io/temp_folder.h"

namespace frond {
namespace {

Image Ramp() {
  Image image(16, 9);
  for (int y = 0; y < 9; ++y) {
    for (int x = 0; x < 16; ++x) image(x, y) = static_cast<float>(15 * x + 3 * y);
  }
  return image;
}

TEST(ImageFile, GreyPng_ReadsBackToTheSameLevels) {
  const TempFolder folder;
  WriteImage(folder / "a.png", Ramp());
  const Image read = ReadImage(folder / "a.png");
  EXPECT_EQ(read.width, 16);
  EXPECT_EQ(read.height, 9);
  EXPECT_EQ(read.values, Ramp().values);
}

TEST(ImageFile, LevelsOutsideTheRange_AreHeldAtBlackAndWhite) {
  const TempFolder folder;
  Image image(4, 1);
  image.values = {-20, 300, 127.6f, std::numeric_limits<float>::quiet_NaN()};
  WriteImage(folder / "a.png", image);
  EXPECT_EQ(ReadImage(folder / "a.png").values, (std::vector<float>{0, 255, 128, 0}));
}

TEST(ImageFile, Colour_KeepsItsChannelsAndWeighsThemToGrey) {
  const TempFolder folder;
  ColourImage image(3, 1);
  image.values = {{255, 0, 0}, {0, 255, 0}, {10, 20, 30}};
  WriteColourImage(folder / "a.png", image);
  EXPECT_EQ(ReadColourImage(folder / "a.png").values, image.values);
  const Image grey = ReadImage(folder / "a.png");
  EXPECT_NEAR(grey(0, 0), 0.299 * 255, 1e-3);
  EXPECT_NEAR(grey(1, 0), 0.587 * 255, 1e-3);
  EXPECT_NEAR(grey(2, 0), 0.299 * 10 + 0.587 * 20 + 0.114 * 30, 1e-4);
  EXPECT_EQ(GreyImage(image).values, grey.values);
}

TEST(ImageFile, SixteenBitGrey_IsScaledTo255AndRawIsNot) {
  const TempFolder folder;
  folder.Write("a.pgm", std::string("P5\n2 1\n65535\n") + std::string("\xFF\xFF\x01\x00", 4));
  const Image image = ReadImage(folder / "a.pgm");
  EXPECT_EQ(image(0, 0), 255);
  EXPECT_NEAR(image(1, 0), 256 * 255.0 / 65535, 1e-6);
  EXPECT_EQ(ReadRawImage(folder / "a.pgm")(1, 0), 256);
  EXPECT_EQ(ReadColourImage(folder / "a.pgm")(0, 0), (std::array<std::uint8_t, 3>{255, 255, 255}));
}

TEST(ImageFile, FloatTiff_KeepsEveryBitAndNan) {
  const TempFolder folder;
  Image image(300, 3, -123.456f);
  image(5, 1) = std::numeric_limits<float>::quiet_NaN();
  image(6, 1) = 1e-30f;
  WriteFloatTiff(folder / "a.tiff", image);
  const Image read = ReadRawImage(folder / "a.tiff");
  ASSERT_EQ(read.values.size(), image.values.size());
  for (std::size_t k = 0; k < image.values.size(); ++k) {
    const bool both_nan = std::isnan(read.values[k]) && std::isnan(image.values[k]);
    EXPECT_TRUE(both_nan || read.values[k] == image.values[k]) << k;
  }
}

TEST(ImageFile, Mask_IsItsBrightHalf) {
  const TempFolder folder;
  Mask mask(3, 2);
  mask.values = {0, 1, 0, 1, 1, 0};
  WriteMask(folder / "a.png", mask);
  EXPECT_EQ(ReadMask(folder / "a.png").values, mask.values);
  EXPECT_EQ(ReadImage(folder / "a.png")(1, 0), 255);
  folder.Write("ones.pgm", std::string("P5\n4 1\n255\n") + std::string("\0\1\0\1", 4));
  EXPECT_EQ(ReadMask(folder / "ones.pgm").values, (std::vector<std::uint8_t>{0, 1, 0, 1}));
  folder.Write("jpeg_noise.pgm", std::string("P5\n3 1\n255\n") + std::string("\3\xF8\xFF", 3));
  EXPECT_EQ(ReadMask(folder / "jpeg_noise.pgm").values, (std::vector<std::uint8_t>{0, 1, 1}));
  folder.Write("black.pgm", std::string("P5\n2 1\n255\n") + std::string("\0\0", 2));
  EXPECT_EQ(ReadMask(folder / "black.pgm").values, (std::vector<std::uint8_t>{0, 0}));
}

TEST(ImageFile, BadFiles_AreRefusedInOneLineThatNamesThem) {
  const TempFolder folder;
  const auto error = [&](const std::string& name) {
    return MessageOf<InputError>([&] { ReadImage(folder / name); });
  };
  EXPECT_TRUE(Holds(error("none.png"), "none.png: no such file"));
  folder.Write("empty.png", "");
  EXPECT_TRUE(Holds(error("empty.png"), "empty.png: is empty"));
  folder.Write("text.png", "hello, this is no image\n");
  EXPECT_TRUE(Holds(error("text.png"), "text.png: is not an image"));
  WriteImage(folder / "a.png", Ramp());
  const std::string png = FileText(folder / "a.png");
  folder.Write("cut.png", png.substr(0, png.size() / 2));
  EXPECT_TRUE(Holds(error("cut.png"), "cut.png: is truncated"));
  folder.Write("cut.jpg", std::string("\xFF\xD8\xFF\xE0") + std::string(100, 'x'));
  EXPECT_TRUE(Holds(error("cut.jpg"), "cut.jpg: is truncated"));
  EXPECT_TRUE(Holds(MessageOf<InputError>([&] { WriteImage(folder / "no/a.png", Ramp()); }), "a.png: "));
  EXPECT_TRUE(Holds(MessageOf<InputError>([&] { WriteImage(folder / "b.png", Image()); }), "without pixels"));
}

}  // namespace
}  // namespace frond
