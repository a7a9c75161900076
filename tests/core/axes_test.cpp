// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "core/axes.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace exemplar {
namespace {

TEST(Axes, AreReadInEveryWayOfWritingThem) {
  EXPECT_EQ(parseAxes("x,y", ""), (Axes{true, true, false}));
  EXPECT_EQ(parseAxes("zx", ""), (Axes{true, false, true}));
  EXPECT_EQ(parseAxes("none", ""), Axes::none());
  EXPECT_EQ(parseAxes("", ""), Axes::none());
  EXPECT_EQ(parseAxes("x, y, z", ""), Axes::every());
}

TEST(Axes, WhatIsNoAxisIsNamed) {
  try {
    parseAxes("xw", "`periodic` xw");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "`periodic` xw: expected axes such as xy or x,y,z, or none");
  }
}

TEST(Axes, ReadWhatTheyWrite) {
  for (int n = 0; n < 8; ++n) {
    const Axes axes{(n & 1) != 0, (n & 2) != 0, (n & 4) != 0};
    EXPECT_EQ(parseAxes(readableAxes(axes), ""), axes);
    EXPECT_EQ(axes.any(), n != 0);
    EXPECT_EQ(axes.all(), n == 7);
  }
}

}  // namespace
}  // namespace exemplar
