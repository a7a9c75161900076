// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/seams/regions.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "core/array3d.h"
#include "core/cells.h"
#include "core/random.h"
#include "tests/synth/fields.h"

namespace exemplar {
namespace {

using namespace testing;

/// Keys below `keys` at random.
Array3D<int> speckled(const Vec3i& size, std::uint32_t keys, std::uint64_t seed) {
  const Random random(seed);
  Array3D<int> grid(size);
  for (std::size_t s = 0; s < grid.count(); ++s) {
    grid.values()[s] = static_cast<int>(random.below(keys, s));
  }
  return grid;
}

Array3D<std::uint32_t> regionsOf(const Array3D<int>& grid, std::uint32_t* count = nullptr) {
  const Regions regions = findRegions(grid.size(), [&](const Vec3i& p) { return grid[p]; });
  Array3D<std::uint32_t> number(grid.size());
  regions.forEachRun([&](const Regions::Run& run, Vec3i p) {
    for (; p.x < run.end; ++p.x) number[p] = run.region;
  });
  if (count) *count = regions.count;
  return number;
}

/// The same by filling one region after another from its first sample.
Array3D<std::uint32_t> filled(const Array3D<int>& grid, std::uint32_t* count) {
  constexpr std::uint32_t kNone = 0xffffffff;
  Array3D<std::uint32_t> number(grid.size(), kNone);
  *count = 0;
  std::vector<Vec3i> stack;
  for (std::size_t s = 0; s < grid.count(); ++s) {
    if (number.values()[s] != kNone) continue;
    stack.assign(1, grid.ijk(s));
    number.values()[s] = *count;
    while (!stack.empty()) {
      const Vec3i p = stack.back();
      stack.pop_back();
      for (const Vec3i& step : kFaceSteps) {
        const Vec3i q = p + step;
        if (!grid.contains(q) || number[q] != kNone || grid[q] != grid[p]) continue;
        number[q] = *count;
        stack.push_back(q);
      }
    }
    ++*count;
  }
  return number;
}

TEST(FindRegions, AgreesWithFilling) {
  for (const Vec3i& size : {Vec3i{13, 11, 9}, Vec3i{1, 17, 5}, Vec3i{40, 1, 1}, Vec3i{1, 1, 1}}) {
    for (const std::uint32_t keys : {1u, 2u, 3u, 9u}) {
      const Array3D<int> grid = speckled(size, keys, keys);
      std::uint32_t found = 0, wanted = 0;
      const Array3D<std::uint32_t> number = regionsOf(grid, &found);
      EXPECT_EQ(number, filled(grid, &wanted));
      EXPECT_EQ(found, wanted);
    }
  }
}

TEST(FindRegions, IsTheSameAtAnyNumberOfThreads) {
  const Array3D<int> grid = speckled({30, 40, 50}, 2, 1);
  Array3D<std::uint32_t> one, eight;
  withThreads(1, [&] { one = regionsOf(grid); });
  withThreads(8, [&] { eight = regionsOf(grid); });
  EXPECT_EQ(one, eight);
}

}  // namespace
}  // namespace exemplar
