// SPDX-License-Identifier: BSD-3-Clause
#include "problems/turntable/object_mask.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/errors.h"
#include "base/random.h"

namespace frond {
namespace {

constexpr int kWidth = 120, kHeight = 90;

bool InDisk(int x, int y, double radius = 30) { return std::hypot(x - 60, y - 45) < radius; }

// A textured disk, with a dark hole in it, a speck and a wire on the background, and noise.
Image Photograph(float object, float background) {
  Random random(1);
  Image image(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      float grey = InDisk(x, y) ? object : background;
      if (std::hypot(x - 55, y - 40) < 5 || x == 100) grey = x == 100 ? object : background;
      if (x > 5 && x < 12 && y > 5 && y < 12) grey = object;
      image(x, y) = grey + static_cast<float>(4 * random.Normal());
    }
  }
  return image;
}

double Disagreement(const Mask& mask) {
  int wrong = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) wrong += (mask(x, y) != 0) != InDisk(x, y) ? 1 : 0;
  }
  return wrong;
}

TEST(ObjectMask, BrightObject_IsFoundWithoutHolesAndSpecks) {
  EXPECT_LE(Disagreement(FindObjectMask(Photograph(180, 30), {}, "a.png")), 40);  // of 188 on the outline
}

TEST(ObjectMask, DarkObject_IsFoundOnALightBackground) {
  EXPECT_LE(Disagreement(FindObjectMask(Photograph(60, 220), {}, "a.png")), 40);
  EXPECT_LE(
      Disagreement(FindObjectMask(Photograph(60, 220), {.background = BackgroundKind::kLight}, "a.png")), 40);
}

TEST(ObjectMask, NoBackground_TakesAllOfTheImage) {
  EXPECT_EQ(MaskShare(FindObjectMask(Photograph(180, 30), {.background = BackgroundKind::kNone}, "a.png")),
            1);
}

TEST(ObjectMask, BlackOrWhiteImage_IsAnError) {
  for (const float grey : {0.0F, 255.0F}) {
    EXPECT_THROW(FindObjectMask(Image(kWidth, kHeight, grey), {}, "a.png"), InputError);
  }
  Image noise(kWidth, kHeight);
  Random random(2);
  for (float& grey : noise.values) grey = 3 + static_cast<float>(1.5 * random.Normal());
  EXPECT_THROW(FindObjectMask(noise, {}, "a.png"), InputError);
}

}  // namespace
}  // namespace frond
