// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "core/origin.h"

#include <gtest/gtest.h>

namespace exemplar {
namespace {

Array3D<int> numbered(const Vec3i& size) {
  Array3D<int> grid(size);
  for (std::size_t s = 0; s < grid.count(); ++s) grid.values()[s] = static_cast<int>(s);
  return grid;
}

/// The origins of a grid turned.
Origins turnedOrigins(const Vec3i& size, int turns) {
  Origins origins(turnedSize(size, turns));
  for (std::size_t s = 0; s < origins.count(); ++s) {
    origins.values()[s] = Origin(turnedCell(origins.ijk(s), origins.size(), -turns), 0, turns);
  }
  return origins;
}

TEST(Origin, FourQuarterTurnsAreNone) {
  const Array3D<int> grid = numbered({3, 5, 2});
  Array3D<int> turning = grid;
  for (int turns = 1; turns <= 4; ++turns) {
    turning = turnedGrid(turning, 1);
    EXPECT_EQ(turning, turnedGrid(grid, turns));
    EXPECT_EQ(turnedGrid(turning, -turns), grid);
  }
  EXPECT_EQ(turning, grid);
}

TEST(Origin, CellsTurnAsDirectionsDo) {
  const Vec3i size{3, 5, 2};
  for (int turns = -4; turns <= 4; ++turns) {
    const Vec3i a{1, 2, 0}, step{1, 1, 1};
    EXPECT_EQ(turnedCell(a + step, size, turns) - turnedCell(a, size, turns), turned(step, turns));
  }
}

TEST(Origin, OnePieceContinuesAndHasOneMotion) {
  for (int turns = 0; turns < 4; ++turns) {
    const Origins origins = turnedOrigins({4, 3, 2}, turns);
    const OriginMotion motion = motionAt(origins, {0, 0, 0});
    const Vec3i a{1, 1, 0};
    for (const Vec3i& step : {Vec3i{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}}) {
      EXPECT_TRUE(continues(origins[a], origins[a + step], step));
      EXPECT_EQ(motionAt(origins, a + step), motion);
      EXPECT_EQ(motion.toExample(a + step), origins[a + step].cell());
      Origin elsewhere = origins[a + step];
      ++elsewhere.i;
      EXPECT_FALSE(continues(origins[a], elsewhere, step));
    }
  }
}

TEST(Origin, ComposedIsTheOriginOfAResultOfAResult) {
  const Array3D<int> example = numbered({3, 5, 2});
  for (int first = 0; first < 4; ++first) {
    const Origins inner = turnedOrigins(example.size(), first);
    for (int second = 0; second < 4; ++second) {
      const Origins outer = turnedOrigins(inner.size(), second);
      const Array3D<int> result = turnedGrid(turnedGrid(example, first), second);
      for (std::size_t s = 0; s < outer.count(); ++s) {
        const Origin& from = outer.values()[s];
        const Origin origin = composed(from, inner[from.cell()]);
        EXPECT_EQ(result.values()[s], example[origin.cell()]);
        EXPECT_EQ(origin.turns, (first + second) % 4);
      }
    }
  }
}

}  // namespace
}  // namespace exemplar
