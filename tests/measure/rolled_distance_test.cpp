// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/rolled_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>

#include "core/error.h"
#include "measure/novelty.h"
#include "tests/example_shapes.h"
#include "tests/measure/fields.h"
#include "tests/threads.h"

namespace exemplar {
namespace {

using testing::makeField;

/// `field` rolled by `shift` over a box of `size`: tiled where that is larger.
DistanceField rolled(const DistanceField& field, const Vec3i& shift, const Vec3i& size) {
  return makeField(size, [&](const Vec3d& p) {
    Vec3i from;
    for (int axis = 0; axis < 3; ++axis) {
      const int n = field.size()[axis];
      from[axis] = ((static_cast<int>(p[axis]) - shift[axis]) % n + n) % n;
    }
    return field.values[from];
  });
}
DistanceField rolled(const DistanceField& field, const Vec3i& shift) {
  return rolled(field, shift, field.size());
}

double byDefinition(const Occupancy& a, const Occupancy& b) {
  const Vec3i n = b.size();
  double best = 0;
  forEachCell(n, [&](const Vec3i& shift) {
    std::int64_t both = 0, either = 0;
    forEachCell(a.size(), [&](const Vec3i& p) {
      Vec3i q;
      for (int axis = 0; axis < 3; ++axis) q[axis] = (p[axis] - shift[axis] + n[axis]) % n[axis];
      const bool in = a.solid(p.x, p.y, p.z), from = b.solid(q.x, q.y, q.z);
      both += in && from;
      either += in || from;
    });
    best = std::max(best, either == 0 ? 1 : static_cast<double>(both) / either);
  });
  return 1 - best;
}

TEST(RolledDistance, IsTheLeastOverAllShifts) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Vec3i n{12, 9, 10};
    const Occupancy a(testing::noise(n, 0.3, seed)), b(testing::noise(n, 0.4, seed + 10));
    EXPECT_DOUBLE_EQ(rolledDistance(b, a).distance, byDefinition(a, b));
    // A result smaller than its example along two axes sees a part of it.
    const Occupancy small(testing::noise({7, 9, 4}, 0.3, seed + 20));
    EXPECT_NEAR(rolledDistance(b, small).distance, byDefinition(small, b), 1e-12);
  }
}

TEST(RolledDistance, OfAMovedCopyIsNoneForEveryKind) {
  for (const testing::ShapeKind& kind : testing::shapeKinds()) {
    const DistanceField example = kind.make(48, 0);
    const Vec3i n = example.size();
    const Occupancy e(example);
    EXPECT_EQ(rolledDistance(e, e).distance, 0) << kind.name;
    // Moved, what leaves on one side coming in on the other: an object moved within its air, a
    // material cut once and its halves exchanged.
    const Vec3i shift{n.x / 3, n.y - 1, 2};
    const Occupancy moved(rolled(example, shift));
    const RolledDistance found = rolledDistance(e, moved);
    EXPECT_EQ(found.distance, 0) << kind.name;
    EXPECT_GT(1 - intersectionOverUnion(e, moved), 0.2) << kind.name;  // which that fools
    // Another sample of the same process is another; arches and temples differ by
    // their proportions and the number of columns alone.
    if (std::string(kind.name) == "arch" || std::string(kind.name) == "temple") continue;
    EXPECT_GT(rolledDistance(e, Occupancy(kind.make(48, 1))).distance, 0.2) << kind.name;
  }
}

TEST(RolledDistance, OfATilingIsNoneAtAnyPhase) {
  const DistanceField example = testing::village(32);
  const Vec3i n = example.size();
  const Occupancy e(example);
  const RolledDistance twice =
      rolledDistance(e, Occupancy(rolled(example, {5, 30, 0}, {2 * n.x, 2 * n.y, n.z})));
  EXPECT_EQ(twice.distance, 0);
  EXPECT_EQ(twice.windows, 4);
  // 1.5 times the size: windows overlap, and are tilings all the same.
  EXPECT_EQ(
      rolledDistance(e, Occupancy(rolled(example, {7, 0, 3}, {n.x * 3 / 2, n.y, n.z}))).distance,
      0);
}

TEST(RolledDistance, TellsTheWindowThatIsACopyFromTheRest) {
  // Two boxes side by side: the example, and something else.
  const DistanceField example = testing::packing(32, 1), other = testing::packing(32, 2);
  const Occupancy both(makeField({64, 32, 32}, [&](const Vec3d& p) {
    const Vec3i c = cast<int>(p);
    return c.x < 32 ? example.values[c] : other.values(c.x - 32, c.y, c.z);
  }));
  const RolledDistance found = rolledDistance(Occupancy(example), both);
  EXPECT_EQ(found.least, 0);
  EXPECT_EQ(found.shift, (Vec3i{0, 0, 0}));
  EXPECT_GT(found.distance, 0.25);
}

TEST(RolledDistance, FindsTheShiftOnACoarserGridToo) {
  for (const testing::ShapeKind& kind : testing::shapeKinds()) {
    const DistanceField example = kind.make(48, 0);
    const Vec3i n = example.size(), shift{n.x / 2 + 1, 5, n.z - 3};
    const RolledDistanceOptions coarse{.cells = 12 * 12 * 12};
    EXPECT_EQ(
        rolledDistance(Occupancy(example), Occupancy(rolled(example, shift)), coarse).distance, 0)
        << kind.name;
  }
}

TEST(RolledDistance, FollowsTurnsAndMirrorImages) {
  const DistanceField example = testing::stairs(32);
  const Occupancy e(example);
  for (int way = 1; way < 8; ++way) {
    const Occupancy turned = turnedOccupancy(e, way & 3, way >= 4);
    EXPECT_EQ(rolledDistance(e, turned, {.turned = true}).distance, 0) << way;
    // The stairs are alike to themselves mirrored across, but for their rail.
    EXPECT_GT(rolledDistance(e, turned).distance, way == 6 ? 0.05 : 0.3) << way;
  }
}

TEST(RolledDistance, OfNothing) {
  const Occupancy empty(testing::emptyField({8, 8, 8})), solid(testing::solidField({8, 8, 8}));
  EXPECT_EQ(rolledDistance(empty, empty).distance, 0);
  EXPECT_EQ(rolledDistance(empty, solid).distance, 1);
  EXPECT_EQ(rolledDistance(solid, empty).distance, 1);
  EXPECT_THROW(rolledDistance(Occupancy(), solid), InputError);
}

TEST(RolledDiversity, IsNotFooledByAShift) {
  const DistanceField example = testing::tree(48);
  std::vector<Occupancy> moved;
  for (const int by : {0, 9, 20}) moved.emplace_back(rolled(example, {by, 2 * by, 0}));
  EXPECT_EQ(rolledDiversity(moved), 0);
  EXPECT_GT(diversity(moved), 0.8);
  std::vector<Occupancy> fresh;
  for (const std::uint64_t seed : {0, 1, 2}) fresh.emplace_back(testing::tree(48, seed));
  EXPECT_GT(rolledDiversity(fresh), 0.3);
  EXPECT_EQ(rolledDiversity(std::span(fresh).first(1)), 0);
  fresh.emplace_back(testing::tree(40));
  EXPECT_THROW(rolledDiversity(fresh), InputError);
}

TEST(RolledDistance, IsTheSameAtOneAndEightThreads) {
  const Occupancy a(testing::packing(40, 1)), b(testing::packing(60, 2));
  const auto measure = [&] {
    const RolledDistance r = rolledDistance(a, b, {.turned = true, .cells = 20000});
    return std::array{r.distance, r.least, static_cast<double>(r.shift.x)};
  };
  EXPECT_EQ(testing::onThreads(1, measure), testing::onThreads(8, measure));
}

}  // namespace
}  // namespace exemplar
