// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/near_copies.h"

#include <gtest/gtest.h>

#include "core/cells.h"
#include "core/random.h"
#include "tests/progress_checks.h"
#include "tests/threads.h"

namespace exemplar {
namespace {

/// Cells built at random, half of them, with one of 200 labels: no two windows are alike.
BuiltLabels noise(const Vec3i& size, std::uint64_t seed) {
  BuiltLabels grid(size, kNotBuilt);
  const Random random(seed);
  forEachCell(size, [&](const Vec3i& p) {
    const auto cell = static_cast<std::uint64_t>(grid.index(p));
    if (random.below(2, cell) == 0) grid[p] = static_cast<Label>(random.below(200, cell, 1));
  });
  return grid;
}

/// A part of `from` that begins at `begin`, put into `to` at `at`.
void put(const BuiltLabels& from, const CellBox& part, BuiltLabels& to, const Vec3i& at) {
  forEachCell(part, [&](const Vec3i& p) { to[p - part.begin + at] = from[p]; });
}

NearCopies compare(const BuiltLabels& example, const BuiltLabels& result) {
  return findNearCopies({&example, 1}, result);
}

TEST(NearCopies, OfTheExampleItselfAreAllOfIt) {
  const BuiltLabels example = noise({20, 17, 5}, 1);
  const NearCopies found = compare(example, example);
  EXPECT_EQ(found.windows, 1);
  EXPECT_EQ(found.largest, 1);
}

TEST(NearCopies, AreNoneWhereEverythingIsNew) {
  const NearCopies found = compare(noise({20, 17, 5}, 1), noise({40, 34, 5}, 2));
  EXPECT_EQ(found.windows, 0);
  EXPECT_EQ(found.largest, 0);
}

TEST(NearCopies, OfTheExampleTiledAreFoundThoughNoWindowIsVerbatim) {
  const Vec3i size{24, 16, 6};
  const BuiltLabels example = noise(size, 1);
  BuiltLabels tiled(Vec3i{2 * size.x, 2 * size.y, size.z}, kNotBuilt);
  for (const int x : {0, size.x})
    for (const int y : {0, size.y}) put(example, CellBox::of(size), tiled, {x, y, 0});
  // One cell of every 4 x 4 columns: of the some 192 built cells of a window 4, or 2 %.
  for (int x = 1; x < tiled.size().x; x += 4)
    for (int y = 2; y < tiled.size().y; y += 4) tiled(x, y, 3) = 1000;
  const NearCopies found = compare(example, tiled);
  // Windows within one of the four: 17 x 9 each of 41 x 25 in all.
  EXPECT_NEAR(found.windows, 4.0 * 17 * 9 / (41 * 25), 0.01);
  EXPECT_NEAR(found.largest, 1, 0.01);
}

TEST(NearCopies, AreNotFoundWhereMoreThanAShareDiffers) {
  const Vec3i size{24, 16, 6};
  const BuiltLabels example = noise(size, 1);
  BuiltLabels other = example;
  const Random random(3);
  forEachCell(size, [&](const Vec3i& p) {
    if (random.below(8, static_cast<std::uint64_t>(other.index(p))) == 0) other[p] = 1000;
  });
  EXPECT_LT(compare(example, other).windows, 0.02);
}

TEST(NearCopies, MeasureTheLargestAreaAtOneOffset) {
  const Vec3i size{30, 30, 4};
  const BuiltLabels example = noise(size, 1);
  BuiltLabels result = noise({60, 50, 4}, 2);
  // 12 x 10 columns from one place, 9 x 20 that touch them from another.
  put(example, {{2, 3, 0}, {14, 13, 4}}, result, {20, 10, 0});
  put(example, {{20, 5, 0}, {29, 25, 4}}, result, {32, 10, 0});
  const NearCopies found = compare(example, result);
  EXPECT_NEAR(found.largest * 900, 180, 20);  // windows over its border agree by chance, or not
  EXPECT_GT(found.windows * 53 * 43, 5 * 3 + 2 * 13 - 1);
}

TEST(NearCopies, AreTheSameAtAnyNumberOfThreads) {
  const BuiltLabels example = noise({20, 20, 3}, 1);
  BuiltLabels result = noise({50, 50, 3}, 2);
  put(example, {{1, 1, 0}, {15, 15, 3}}, result, {9, 8, 0});
  testing::expectSameAtAnyThreads([&] {
    const NearCopies found = compare(example, result);
    return std::pair(found.windows, found.largest);
  });
}

TEST(NearCopies, Stop) {
  const BuiltLabels example = noise({20, 20, 3}, 1);
  const std::atomic<bool> stop{true};
  EXPECT_THROW(findNearCopies({&example, 1}, example, Progress(nullptr, &stop)), Cancelled);
}

}  // namespace
}  // namespace exemplar
