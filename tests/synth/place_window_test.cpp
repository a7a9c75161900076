// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/pyramid/place_window.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/synth/fields.h"

namespace exemplar {
namespace {

using namespace testing;

constexpr Axes kAcross{true, true, false};

TEST(BlockWindow, WhatRestsOnASideOfItsBoxStaysThere) {
  DistanceField soil = constant({24, 24, 20}, 0);
  for (std::size_t s = 0; s < soil.values.count(); ++s) {
    soil.values.values()[s] = static_cast<float>(soil.values.ijk(s).z) - 2.5f;
  }
  EXPECT_EQ(blockWindow(levelOf(soil, {48, 48, 20}), kAcross).z, 0);
  // Upside down as well; but not where there is to be more of it along z.
  for (float& v : soil.values.values()) v = -v;
  EXPECT_EQ(blockWindow(levelOf(soil, {48, 48, 20}), kAcross).z, 0);
  EXPECT_GT(blockWindow(levelOf(soil, {48, 48, 40}), kAcross).z, 0);
  // What fills its box along z may move.
  EXPECT_GT(blockWindow(levelOf(balls({24, 24, 20}, 4, 1), {48, 48, 20}), kAcross).z, 0);
}

TEST(BlockWindow, AnObjectsPartsMoveALittleUnlessItIsThin) {
  DistanceField box = constant({24, 8, 24}, 0);
  for (std::size_t s = 0; s < box.values.count(); ++s) {
    const Vec3i p = box.values.ijk(s);
    box.values.values()[s] = static_cast<float>(
        std::max({std::abs(p.x - 11.5) - 9, std::abs(p.y - 3.5) - 2, std::abs(p.z - 11.5) - 9}));
  }
  const Vec3i window = blockWindow(levelOf(box, {24, 8, 24}), {false, false, false});
  EXPECT_EQ(window.x, 4);  // 0.16 of its length
  EXPECT_EQ(window.y, 0);
  EXPECT_EQ(window.z, 4);
}

}  // namespace
}  // namespace exemplar
