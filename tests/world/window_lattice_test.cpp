// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "world/window_lattice.h"

#include <gtest/gtest.h>

#include "core/random.h"

namespace exemplar {
namespace {

WindowLattice someLattice(std::uint64_t trial) {
  const Random random(trial);
  WindowLattice lattice;
  lattice.separator = 1 + static_cast<int>(random.below(3, 0));
  lattice.pitch = 3 * (lattice.separator + 1) + static_cast<int>(random.below(40, 1));
  return lattice;
}

TEST(WindowLattice, EveryColumnIsFreeInSomePhase) {
  for (std::uint64_t trial = 0; trial < 40; ++trial) {
    const WindowLattice lattice = someLattice(trial);
    const int n = 2 * lattice.pitch;
    for (int x = -n; x < n; ++x) {
      for (int y = -n; y < n; ++y) {
        int free = 0;
        for (int phase = 1; phase <= WindowLattice::phases; ++phase) {
          const auto windows = lattice.touching(phase, {{x, y}, {x + 1, y + 1}});
          ASSERT_EQ(windows.size(), 1u);
          free += lattice.free(phase, windows[0]).contains({x, y});
        }
        ASSERT_GE(free, 1) << trial << ": " << x << "," << y;
      }
    }
  }
}

TEST(WindowLattice, WindowsOfAPhaseSpeakOfNoColumnTogether) {
  for (std::uint64_t trial = 0; trial < 40; ++trial) {
    const WindowLattice lattice = someLattice(trial);
    for (int phase = 1; phase <= WindowLattice::phases; ++phase) {
      for (int x = -2; x < 2; ++x) {
        const PlaneBox a = lattice.free(phase, {x, 0}), b = lattice.free(phase, {x + 1, 0});
        // Rules that reach `separator` columns do not reach from one to the other.
        EXPECT_EQ(b.begin.x - a.end.x, lattice.separator);
        EXPECT_TRUE((a & lattice.whole(phase, {x + 1, 0})).empty());
      }
    }
  }
}

TEST(WindowLattice, TheLastPhaseIsAlignedWithTheOrigin) {
  const WindowLattice lattice;
  EXPECT_EQ(lattice.whole(WindowLattice::phases, {0, 0}).begin, (PlanePoint{0, 0}));
  EXPECT_EQ(lattice.touching(WindowLattice::phases, {{-1, 0}, {36, 36}}).size(), 2u);
}

TEST(WindowLattice, FloorDivideRoundsDown) {
  EXPECT_EQ(floorDivide(-1, 36), -1);
  EXPECT_EQ(floorDivide(-36, 36), -1);
  EXPECT_EQ(floorDivide(-37, 36), -2);
  EXPECT_EQ(floorDivide(35, 36), 0);
}

}  // namespace
}  // namespace exemplar
