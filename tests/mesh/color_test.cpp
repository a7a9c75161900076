// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/color.h"

#include <gtest/gtest.h>

#include <cmath>

namespace exemplar {
namespace {

TEST(Color, EightBitSrgbSurvivesTheWayToLinearAndBack) {
  for (int c = 0; c < 256; ++c) {
    EXPECT_EQ(linearToSrgb8(srgb8ToLinear(static_cast<std::uint8_t>(c))), c);
    if (c > 0) {
      EXPECT_GT(srgb8ToLinear(static_cast<std::uint8_t>(c)),
                srgb8ToLinear(static_cast<std::uint8_t>(c - 1)));
    }
  }
}

TEST(Color, TheCurveIsTheStandardsAndItsInverseUndoesIt) {
  EXPECT_EQ(srgbToLinear(0), 0);
  EXPECT_EQ(srgbToLinear(1), 1);
  EXPECT_NEAR(srgbToLinear(0.5), 0.2140411, 1e-7);  // IEC 61966-2-1
  // The standard's rounded constants leave a step of 3e-8 where the line meets the power.
  for (int i = 0; i <= 1000; ++i)
    EXPECT_NEAR(linearToSrgb(srgbToLinear(i / 1000.0)), i / 1000.0, 1e-7);
}

TEST(Color, LinearGoesToTheNearestSampleAndClampsOutside) {
  for (int i = 0; i <= 1000; ++i) {
    const float linear = static_cast<float>(i) / 1000;
    // At a threshold between two samples either is as near; float has 24 bits for it.
    EXPECT_NEAR(linearToSrgb8(linear), 255 * linearToSrgb(linear), 0.5 + 1e-4) << linear;
  }
  EXPECT_EQ(linearToSrgb8(-3), 0);
  EXPECT_EQ(linearToSrgb8(17), 255);
}

}  // namespace
}  // namespace exemplar
