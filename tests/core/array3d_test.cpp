// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "core/array3d.h"

#include <gtest/gtest.h>

namespace exemplar {
namespace {

TEST(Array3D, IndexAndIjkAreInverse) {
  const Array3D<int> a({3, 5, 7});
  std::size_t n = 0;
  for (int k = 0; k < 7; ++k)
    for (int j = 0; j < 5; ++j)
      for (int i = 0; i < 3; ++i, ++n) {
        EXPECT_EQ(a.index(i, j, k), n);
        EXPECT_EQ(a.ijk(n), (Vec3i{i, j, k}));
      }
  EXPECT_EQ(a.count(), n);
}

TEST(Array3D, ClampedGoesToTheNearestSampleInside) {
  const Array3D<int> a({3, 5, 7});
  EXPECT_EQ(a.clamped({-4, 2, 9}), (Vec3i{0, 2, 6}));
  EXPECT_TRUE(a.contains({2, 4, 6}));
  EXPECT_FALSE(a.contains({3, 0, 0}));
  EXPECT_FALSE(a.contains({0, -1, 0}));
}

TEST(Vec3, VolumeDoesNotWrap) { EXPECT_EQ(volume({4096, 4096, 4096}), 68719476736); }

}  // namespace
}  // namespace exemplar
