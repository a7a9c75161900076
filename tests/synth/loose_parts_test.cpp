// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/objects/loose_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "core/cells.h"
#include "synth/geometry/objects/objects.h"
#include "synth/geometry/seams/regions.h"
#include "tests/progress_checks.h"
#include "tests/synth/fields.h"
#include "tests/threads.h"

namespace exemplar {
namespace {

using namespace testing;

/// Four stones of different sizes on one ground; `bridged`: two of them touch.
DistanceField stones(bool bridged = false) {
  DistanceField field = constant({48, 44, 18}, 0);
  forEachCell(field.size(), [&](const Vec3i& p) {
    constexpr double kStones[][3] = {{12, 12, 5}, {33, 11, 4}, {13, 31, 4.5}, {34, 31, 6}};
    double d = 100;
    for (const auto& s : kStones)
      d = std::min(d, length(cast<double>(p) - Vec3d{s[0], s[1], 3 + s[2]}) - s[2]);
    if (bridged && p.x >= 12 && p.x < 36) d = std::min(d, std::hypot(p.y - 11, p.z - 7) - 2);
    field.values[p] = static_cast<float>(d);
  });
  return field;
}

/// The number of samples of each piece of solid, in order.
std::multiset<int> piecesOf(const Array3D<float>& values) {
  const Regions regions = findRegions(values.size(), [&](const Vec3i& p) { return values[p] < 0; });
  std::map<std::uint32_t, int> sizes;
  regions.forEachRun([&](const Regions::Run& run, const Vec3i& p) {
    if (values[p] < 0) sizes[run.region] += run.end - run.begin;
  });
  std::multiset<int> found;
  for (const auto& [region, size] : sizes) found.insert(size);
  return found;
}

TEST(LooseParts, AreStrewnWholeAndEvenly) {
  const DistanceField example = stones();
  const std::multiset<int> parts = piecesOf(example.values);
  ASSERT_EQ(parts.size(), 4u);
  std::set<std::vector<float>> results;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const auto strewn = strewParts(example, {{96, 88, 18}, seed});
    ASSERT_TRUE(strewn);
    EXPECT_EQ(strewn->parts, 16);
    // Each four times, whole, and none touches another.
    std::multiset<int> wanted;
    for (int n = 0; n < 4; ++n) wanted.insert(parts.begin(), parts.end());
    EXPECT_EQ(piecesOf(strewn->made.field.values), wanted);
    const auto values = strewn->made.field.values.values();
    results.emplace(values.begin(), values.end());
  }
  EXPECT_EQ(results.size(), 4u);
}

TEST(LooseParts, AreTheExamplesToTheBitAndStayOnTheirGround) {
  const DistanceField example = stones();
  const auto strewn = strewParts(example, {{70, 44, 18}, 1});
  ASSERT_TRUE(strewn);
  int lowest = 18;
  forEachCell(strewn->made.field.size(), [&](const Vec3i& p) {
    const Vec3i cell = strewn->made.origins[p].cell();
    ASSERT_TRUE(example.values.contains(cell));
    EXPECT_EQ(strewn->made.field.values[p], example.values[cell]);
    if (!(strewn->made.field.values[p] < 0)) return;
    EXPECT_EQ(cell.z, p.z);
    lowest = std::min(lowest, p.z);
  });
  EXPECT_EQ(lowest, 4);  // the ground of all stones
  // As much solid as there is room for, to a half of the smallest stone.
  const auto all = [](const Array3D<float>& values) {
    int sum = 0;
    for (const int size : piecesOf(values)) sum += size;
    return sum;
  };
  EXPECT_NEAR(all(strewn->made.field.values) * 48.0 / 70, all(example.values),
              *piecesOf(example.values).begin());
}

TEST(LooseParts, AreNotFoundWherePartsHangTogether) {
  // Two stones that are joined are one part.
  const auto joined = strewParts(stones(true), {{48, 44, 18}, 0});
  ASSERT_TRUE(joined);
  EXPECT_EQ(joined->parts, 3);
  // All on a slab, they are none.
  DistanceField slab = stones();
  forEachCell({{1, 1, 3}, {47, 43, 5}}, [&](const Vec3i& p) { slab.values[p] = -1; });
  EXPECT_FALSE(strewParts(slab, {{48, 44, 18}, 0}));
  EXPECT_FALSE(strewParts(constant({12, 12, 12}, 1), {{12, 12, 12}, 0}));
  EXPECT_FALSE(strewParts(constant({12, 12, 12}, -1), {{12, 12, 12}, 0}));
}

TEST(LooseParts, AreNotTheRingsOfAChain) {
  // Rings that go through each other, by turns flat and upright; moved apart, they are loose.
  const auto chain = [](double apart) {
    DistanceField field = constant({84, 28, 28}, 0);
    forEachCell(field.size(), [&](const Vec3i& p) {
      double d = 100;
      for (int n = 0; n < 4; ++n) {
        const double x = p.x - 12 - apart * n, y = p.y - 13.5, z = p.z - 13.5;
        const double across = n % 2 == 0 ? y : z, along = n % 2 == 0 ? z : y;
        d = std::min(d, std::hypot(std::hypot(x, across) - 7, along) - 1.5);
      }
      field.values[p] = static_cast<float>(d);
    });
    return field;
  };
  EXPECT_FALSE(strewParts(chain(10), {{84, 28, 28}, 0}));
  EXPECT_TRUE(strewParts(chain(20), {{84, 28, 28}, 0}));
}

TEST(LooseParts, AreWhatObjectsOfThemAreMadeOf) {
  const DistanceField example = stones();
  const ObjectResult made = synthesizeObject(example, {.size = {96, 44, 18}});
  EXPECT_EQ(made.strewn, 8);
  const ObjectResult same = synthesizeObject(example, {.size = example.size(), .seed = 1});
  EXPECT_EQ(same.strewn, 4);
  EXPECT_GT(same.distance, 0.2);
}

TEST(LooseParts, AreTheSameAtAnyNumberOfThreads) {
  std::optional<StrewnParts> one, eight;
  withThreads(1, [&] { one = strewParts(stones(), {{90, 60, 18}, 3}); });
  withThreads(8, [&] { eight = strewParts(stones(), {{90, 60, 18}, 3}); });
  EXPECT_EQ(one->made.field.values, eight->made.field.values);
  EXPECT_EQ(one->made.origins, eight->made.origins);
}

TEST(LooseParts, MayFindNoRoomAndStopWhenAsked) {
  for (const Vec3i& size : {Vec3i{6, 6, 6}, Vec3i{200, 3, 200}}) {
    const auto narrow = strewParts(stones(), {size, 0});
    ASSERT_TRUE(narrow);
    EXPECT_EQ(narrow->parts, 0);
  }
  CancelAfter cancel(1, "strewing");
  EXPECT_THROW(strewParts(stones(), {{96, 88, 18}, 0}, cancel.progress()), Cancelled);
}

}  // namespace
}  // namespace exemplar
