// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/dilate.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "core/random.h"

namespace exemplar {
namespace {

TEST(Dilated, MarksExactlyTheCubesAroundMarks) {
  for (std::uint64_t trial = 0; trial < 12; ++trial) {
    const Random random(trial);
    const Vec3i size{1 + static_cast<int>(random.below(9, 0)),
                     1 + static_cast<int>(random.below(9, 1)),
                     1 + static_cast<int>(random.below(9, 2))};
    Array3D<std::uint8_t> marks(size);
    for (std::size_t n = 0; n < marks.count(); ++n) {
      marks.values()[n] = random.uniform(100 + n) < 0.02;
    }
    for (const int reach : {0, 1, 3}) {
      const Array3D<std::uint8_t> found = dilated(marks, reach);
      for (std::size_t n = 0; n < marks.count(); ++n) {
        const Vec3i p = marks.ijk(n);
        bool expected = false;
        for (std::size_t m = 0; m < marks.count(); ++m) {
          const Vec3i d = marks.ijk(m) - p;
          expected = expected || (marks.values()[m] && std::abs(d.x) <= reach &&
                                  std::abs(d.y) <= reach && std::abs(d.z) <= reach);
        }
        ASSERT_EQ(found.values()[n] != 0, expected);
      }
    }
  }
}

}  // namespace
}  // namespace exemplar
