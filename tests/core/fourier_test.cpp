// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "core/fourier.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/cells.h"
#include "core/random.h"
#include "tests/threads.h"

namespace exemplar {
namespace {

Array3D<float> noise(const Vec3i& size, std::uint64_t seed) {
  const Random random(seed, 5);
  Array3D<float> grid(size);
  for (std::size_t n = 0; n < grid.count(); ++n)
    grid.data()[n] = static_cast<float>(random.uniform(-1, 1, n));
  return grid;
}

double byDefinition(const Array3D<float>& a, const Array3D<float>& b, const Vec3i& shift) {
  double sum = 0;
  forEachCell(a.size(), [&](const Vec3i& x) {
    Vec3i from;
    for (int axis = 0; axis < 3; ++axis) {
      const int n = a.size()[axis];
      from[axis] = ((x[axis] - shift[axis]) % n + n) % n;
    }
    sum += static_cast<double>(a[x]) * b[from];
  });
  return sum;
}

TEST(CircularCorrelation, IsTheSumOfProductsAtEveryShift) {
  // Powers of two and of others, primes, products, single layers.
  for (const Vec3i& n : {Vec3i{8, 4, 2}, Vec3i{12, 15, 10}, Vec3i{7, 11, 13}, Vec3i{64, 1, 1},
                         Vec3i{1, 37, 6}, Vec3i{16, 9, 25}, Vec3i{1, 1, 1}}) {
    const Array3D<float> a = noise(n, 1), b = noise(n, 2);
    const Array3D<float> found = circularCorrelation(a, b);
    // Sums of `count` products below 1, each step of the transforms rounding by 6e-8 of |a| |b|.
    const double slack = 1e-5 * static_cast<double>(a.count());
    forEachCell(n, [&](const Vec3i& s) { EXPECT_NEAR(found[s], byDefinition(a, b, s), slack); });
  }
}

TEST(CircularCorrelation, PeaksWhereOneGridIsTheOtherRolled) {
  const Vec3i n{30, 21, 18}, shift{11, 20, 3};
  const Array3D<float> b = noise(n, 3);
  Array3D<float> a(n);
  forEachCell(n, [&](const Vec3i& x) {
    const Vec3i to = x + shift;
    a(to.x % n.x, to.y % n.y, to.z % n.z) = b[x];
  });
  const Array3D<float> found = circularCorrelation(a, b);
  const auto best = std::max_element(found.values().begin(), found.values().end());
  EXPECT_EQ(found.ijk(static_cast<std::size_t>(best - found.values().begin())), shift);
}

TEST(CircularCorrelation, IsTheSameAtOneAndEightThreads) {
  const Array3D<float> a = noise({40, 36, 35}, 4), b = noise({40, 36, 35}, 5);
  testing::expectSameAtAnyThreads([&] { return circularCorrelation(a, b); });
}

TEST(QuickLength, IsTheNextProductOfTwoThreeAndFive) {
  EXPECT_EQ(quickLength(1), 1);
  EXPECT_EQ(quickLength(7), 8);
  EXPECT_EQ(quickLength(61), 64);
  EXPECT_EQ(quickLength(97), 100);
  EXPECT_EQ(quickLength(120), 120);
}

}  // namespace
}  // namespace exemplar
