// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/objects/objects.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <tuple>
#include <vector>

#include "core/cells.h"
#include "core/error.h"
#include "synth/geometry/objects/object_kind.h"
#include "synth/geometry/objects/part_exchange.h"
#include "synth/geometry/objects/slice_path.h"
#include "tests/synth/fields.h"

namespace exemplar {
namespace {

using namespace testing;

using Shape = std::function<double(const Vec3d&)>;

DistanceField sampled(const Vec3i& size, const Shape& shape) {
  DistanceField field = constant(size, 0);
  for (std::size_t s = 0; s < field.values.count(); ++s) {
    const double d = shape(cast<double>(field.values.ijk(s)));
    field.values.values()[s] = static_cast<float>(std::clamp(d, -8.0, 8.0));
  }
  return field;
}

double box(const Vec3d& p, const Vec3d& center, const Vec3d& half) {
  const Vec3d d{std::abs(p.x - center.x) - half.x, std::abs(p.y - center.y) - half.y,
                std::abs(p.z - center.z) - half.z};
  return std::max({d.x, d.y, d.z});
}

/// Four houses of different sizes on a plate.
DistanceField village() {
  return sampled({72, 40, 28}, [](const Vec3d& p) {
    double d = box(p, {35.5, 19.5, 6}, {31, 15, 2});
    constexpr double kHouses[][4] = {
        {13, 14, 4, 5}, {28, 24, 5, 7}, {44, 13, 3, 4}, {58, 25, 4, 6}};
    for (const auto& h : kHouses) {
      d = std::min(d, box(p, {h[0], h[1], 7 + h[3]}, {h[2], h[2], h[3]}));
    }
    return d;
  });
}

/// Columns at equal distances between a base and a beam.
DistanceField colonnade() {
  return sampled({64, 24, 32}, [](const Vec3d& p) {
    double d = std::min(box(p, {31.5, 11.5, 6}, {27, 7, 2}), box(p, {31.5, 11.5, 26}, {27, 7, 2}));
    for (int n = 0; n < 5; ++n) {
      const double r = std::hypot(p.x - (9.5 + 11 * n), p.y - 11.5) - 3;
      d = std::min(d, std::max(r, std::abs(p.z - 16) - 9));
    }
    return d;
  });
}

/// A ball with bumps.
DistanceField boulder() {
  return sampled({40, 36, 36}, [](const Vec3d& p) {
    const Vec3d q{(p.x - 19.5) / 14, (p.y - 17.5) / 13, (p.z - 17.5) / 12};
    const double bumps = 0.1 * std::sin(5 * q.x + 2 * q.y) + 0.1 * std::sin(4 * q.y - 3 * q.z);
    return 12 * (std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z) - 1 - bumps);
  });
}

/// The same, smaller: it is soon grown.
DistanceField pebble() {
  return sampled({28, 26, 26}, [](const Vec3d& p) {
    const Vec3d q{(p.x - 13.5) / 10, (p.y - 12.5) / 9, (p.z - 12.5) / 8.5};
    const double bumps = 0.1 * std::sin(4 * q.x + 2 * q.y) + 0.1 * std::sin(3 * q.y - 3 * q.z);
    return 8.5 * (std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z) - 1 - bumps);
  });
}

/// A trunk with four branches, a ball at the end of each.
DistanceField tree() {
  return sampled({36, 34, 40}, [](const Vec3d& p) {
    double d = std::max(std::hypot(p.x - 17.5, p.y - 16.5) - 3, std::abs(p.z - 13) - 10);
    for (int n = 0; n < 4; ++n) {
      const Vec3d way{n < 2 ? (n == 0 ? 9.0 : -9.0) : 0, n < 2 ? 0 : (n == 2 ? 8.0 : -8.0), 9};
      const Vec3d q = p - Vec3d{17.5, 16.5, 20};
      const double t = std::clamp(dot(q, way) / dot(way, way), 0.0, 1.0);
      d = std::min({d, length(q - way * t) - 2, length(q - way) - 4});
    }
    return d;
  });
}

double distance(const Array3D<float>& a, const Array3D<float>& b) {
  double both = 0, either = 0;
  for (std::size_t s = 0; s < a.count(); ++s) {
    both += a.values()[s] < 0 && b.values()[s] < 0;
    either += a.values()[s] < 0 || b.values()[s] < 0;
  }
  return 1 - both / either;
}

double solid(const DistanceField& field) {
  double count = 0;
  for (const float v : field.values.values()) count += v < 0;
  return count;
}

/// The number of pieces that share faces.
int pieces(const DistanceField& field) {
  Array3D<std::uint8_t> seen(field.size());
  int count = 0;
  for (std::size_t s = 0; s < seen.count(); ++s) {
    if (seen.values()[s] || !(field.values.values()[s] < 0)) continue;
    ++count;
    std::vector<Vec3i> left{seen.ijk(s)};
    seen.values()[s] = 1;
    while (!left.empty()) {
      const Vec3i p = left.back();
      left.pop_back();
      for (const Vec3i& step : kFaceSteps) {
        const Vec3i q = p + step;
        if (!seen.contains(q) || seen[q] || !(field.values[q] < 0)) continue;
        seen[q] = 1;
        left.push_back(q);
      }
    }
  }
  return count;
}

CellBox extent(const DistanceField& field) {
  CellBox box{field.size(), {0, 0, 0}};
  forEachCell(field.size(), [&](const Vec3i& p) {
    if (!(field.values[p] < 0)) return;
    box.begin = min(box.begin, p);
    box.end = max(box.end, p + Vec3i{1, 1, 1});
  });
  return box;
}

TEST(FreeStanding, HasAirOnAllSides) {
  EXPECT_TRUE(isFreeStanding(village()));
  EXPECT_TRUE(isFreeStanding(boulder()));
  EXPECT_FALSE(isFreeStanding(balls({32, 32, 32}, 4, 1)));
  EXPECT_FALSE(isFreeStanding(ground({32, 32, 24}, 1)));
  EXPECT_FALSE(isFreeStanding(constant({8, 8, 8}, 1)));
  DistanceField cut = boulder();
  cut.values(0, 17, 17) = -1;
  EXPECT_FALSE(isFreeStanding(cut));
}

TEST(ObjectKind, IsByFacesEdgesAndThickness) {
  EXPECT_EQ(objectKind(village()), ObjectKind::Planes);
  EXPECT_EQ(objectKind(colonnade()), ObjectKind::Planes);
  EXPECT_EQ(objectKind(boulder()), ObjectKind::Lump);
  EXPECT_EQ(objectKind(pebble()), ObjectKind::Lump);
  EXPECT_EQ(objectKind(tree()), ObjectKind::Limbs);
  // Where distances are clamped, limbs cannot be known from lumps.
  DistanceField clamped = tree();
  for (float& v : clamped.values.values()) v = std::max(v, -2.0F);
  EXPECT_EQ(objectKind(clamped), ObjectKind::Lump);
  // Turned about the vertical, what has edges still has them.
  const DistanceField turned = sampled({64, 64, 20}, [](const Vec3d& p) {
    const Vec3d q{0.8 * (p.x - 31.5) + 0.6 * (p.y - 31.5), 0.8 * (p.y - 31.5) - 0.6 * (p.x - 31.5),
                  p.z - 9.5};
    return box(q, {0, 0, 0}, {24, 4, 5});
  });
  EXPECT_EQ(objectKind(turned), ObjectKind::Planes);
  EXPECT_EQ(objectKind(constant({8, 8, 8}, 1)), ObjectKind::Limbs);
}

TEST(SliceDocking, IsFreeWhereSlicesRepeatAndDearWhereTheyDoNot) {
  const SliceDocking docking(colonnade(), 0);
  EXPECT_EQ(docking.slices(), 64);
  EXPECT_EQ(docking.solidBegin(), 5);
  EXPECT_EQ(docking.solidEnd(), 59);
  EXPECT_NEAR(docking.cost(16, 27), 0, 1e-4);  // a column further, to a rounding of its circle
  EXPECT_EQ(docking.cost(20, 20), 0);
  EXPECT_EQ(docking.cost(15, 26), docking.cost(26, 15));
  // Not with the air beyond the end.
  EXPECT_GT(docking.cost(20, 62), 0.5);
  // What narrows is no continuation of what widens, though sections are equal.
  const SliceDocking round(boulder(), 0);
  EXPECT_GT(round.cost(10, 30), 0.3);
}

TEST(SlicePath, VariationsKeepBothEndsAndSomeOfEachPart) {
  const DistanceField example = colonnade();
  const SliceDocking docking(example, 0);
  for (std::uint64_t draw = 0; draw < 4; ++draw) {
    const SlicePath path = variedPath(docking, 4, 200, draw);
    ASSERT_EQ(path.source.size(), 64u);
    for (int i = 0; i <= docking.solidBegin(); ++i) EXPECT_EQ(path.source[i], i);
    for (int i = docking.solidEnd() - 1; i < 64; ++i) EXPECT_EQ(path.source[i], i);
    for (int i = 0; i < 64; ++i) EXPECT_LE(std::abs(path.source[i] - i), 4);
    EXPECT_GT(path.joints, 0);
  }
  EXPECT_NE(variedPath(docking, 4, 200, 0).source, variedPath(docking, 4, 200, 1).source);
  EXPECT_EQ(variedPath(docking, 0.5, 200, 0).joints, 0);
}

TEST(SlicePath, LongerPathsRepeatNothingMoreThanTheyMust) {
  const SliceDocking docking(colonnade(), 0);
  for (std::uint64_t draw = 0; draw < 4; ++draw) {
    const SlicePath path = fittedPath(docking, 128, draw);
    ASSERT_EQ(path.source.size(), 128u);
    EXPECT_LT(path.worstCost, 0.2);  // between columns; across one it is more than twice that
    EXPECT_GT(docking.cost(20, 25), 0.4);
    std::array<int, 64> used{};
    for (const int s : path.source) ++used[static_cast<std::size_t>(s)];
    for (int s = 0; s < 64; ++s) EXPECT_GE(used[static_cast<std::size_t>(s)], 1);
    // Twice as long, with both ends once: some parts thrice, but not four times.
    EXPECT_LE(*std::max_element(used.begin() + 5, used.begin() + 59), 3);
  }
  const SlicePath shorter = fittedPath(docking, 48, 0);
  ASSERT_EQ(shorter.source.size(), 48u);
  EXPECT_LT(shorter.worstCost, 0.2);
}

TEST(SlicePath, StretchesWhatIsLikeAPrism) {
  // Two balls on a rod along x.
  const DistanceField dumbbell = sampled({80, 32, 32}, [](const Vec3d& p) {
    const double r = std::hypot(p.y - 15.5, p.z - 15.5);
    double d = std::max(r - 4, std::abs(p.x - 39.5) - 22);
    for (const double x : {17.5, 61.5}) d = std::min(d, std::hypot(p.x - x, r) - 11);
    return d;
  });
  const SliceDocking docking(dumbbell, 0);
  EXPECT_LT(docking.change(40), 0.05);
  EXPECT_GT(docking.change(10), 0.4);
  for (std::uint64_t draw = 0; draw < 3; ++draw) {
    const std::vector<double> path = stretchedPath(docking, 160, draw);
    ASSERT_EQ(path.size(), 160u);
    std::array<int, 3> part{};  // slices of the result in the first ball, between, in the second
    for (std::size_t i = 1; i < path.size(); ++i) {
      EXPECT_GE(path[i], path[i - 1]);
      EXPECT_LE(path[i], path[i - 1] + 1 + 1e-9);
      if (path[i] >= docking.solidBegin() && path[i] < docking.solidEnd())
        ++part[path[i] < 28 ? 0 : path[i] < 51 ? 1 : 2];
    }
    EXPECT_EQ(path.front(), 0);
    EXPECT_EQ(path.back(), 79);
    // A slice of the rod (23 of them) is stretched more than one of a ball (21).
    EXPECT_GT((part[1] - 23) / 23.0, 1.05 * (part[0] - 21) / 21.0);
    EXPECT_GT((part[1] - 23) / 23.0, 1.05 * (part[2] - 21) / 21.0);
  }
  EXPECT_NE(stretchedPath(docking, 160, 0), stretchedPath(docking, 160, 1));
}

TEST(PartExchange, ChangesPartsAndLeavesTheFoot) {
  const DistanceField example = village();
  const PartExchange found = exchangeParts(example, {.seed = 1, .novelty = 0.15});
  EXPECT_GT(found.parts, 0);
  DistanceField shown = example;
  forEachCell(example.size(), [&](const Vec3i& p) {
    const Vec3i q = p + found.offsets[p];
    shown.values[p] = example.values.contains(q) ? example.values[q] : 8;
    // What is not exchanged stays.
    if (found.offsets[p] == Vec3i{0, 0, 0}) {
      EXPECT_EQ(found.changed[p], 0);
    }
    // The lowest layers of the plate are as they were.
    if (p.z < 6) {
      EXPECT_EQ(shown.values[p] < 0, example.values[p] < 0);
    }
  });
  EXPECT_NEAR(distance(shown.values, example.values), found.distance, 1e-9);
  EXPECT_GT(found.distance, 0.05);
  EXPECT_NEAR(solid(shown) / solid(example), 1, 0.051);
  EXPECT_EQ(pieces(shown), 1);
  // A boulder has hardly any parts that its surroundings would let go.
  EXPECT_LT(exchangeParts(boulder()).distance, 0.05);
}

TEST(Objects, OfTheExamplesSizeAreVariationsOfIt) {
  const DistanceField example = village();
  std::vector<Array3D<float>> results;
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const ObjectResult result = synthesizeObject(example, {.size = example.size(), .seed = seed});
    const DistanceField& field = result.made.field;
    EXPECT_GT(distance(field.values, example.values), 0.15);
    EXPECT_NEAR(solid(field) / solid(example), 1, 0.1);
    EXPECT_EQ(pieces(field), 1);
    const CellBox before = extent(example), after = extent(field);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(after.begin[axis], before.begin[axis], 2);
      EXPECT_NEAR(after.end[axis], before.end[axis], 3);
    }
    std::map<std::tuple<int, int, int>, double> share;
    double all = 0;
    forEachCell(field.size(), [&](const Vec3i& p) {
      if (std::abs(field.values[p]) >= 1) return;
      const Vec3i d = result.made.origins[p].cell() - p;
      share[{d.x, d.y, d.z}] += 1;
      all += 1;
    });
    for (const auto& [offset, count] : share) EXPECT_LT(count / all, 0.6);
    for (const Array3D<float>& other : results) EXPECT_GT(distance(field.values, other), 0.1);
    results.push_back(field.values);
  }
}

TEST(Objects, AreExtendedWhereTheyDockAndGrowWhereNot) {
  const DistanceField columns = colonnade();
  const ObjectResult longer = synthesizeObject(columns, {.size = {128, 24, 32}, .seed = 2});
  EXPECT_EQ(longer.growth[0], Growth::Fitted);
  EXPECT_EQ(longer.growth[1], Growth::Varied);
  EXPECT_EQ(pieces(longer.made.field), 1);
  EXPECT_NEAR(solid(longer.made.field) / solid(columns), 2, 0.14);

  // A stone has no part that could be repeated: it becomes one larger stone.
  const DistanceField stone = pebble();
  const ObjectResult two = synthesizeObject(stone, {.size = {42, 26, 26}});
  EXPECT_EQ(two.growth[0], Growth::Grown);
  EXPECT_EQ(two.growth[1], Growth::Varied);
  EXPECT_EQ(pieces(two.made.field), 1);
  EXPECT_NEAR(solid(two.made.field) / solid(stone) / 1.5, 1, 0.1);
  const CellBox stretched = extent(two.made.field), before = extent(stone);
  EXPECT_NEAR(stretched.size().x, 1.5 * before.size().x, 4);
  const ObjectResult high = synthesizeObject(stone, {.size = {28, 26, 39}});
  EXPECT_EQ(high.growth[2], Growth::Grown);
  EXPECT_EQ(pieces(high.made.field), 1);
  EXPECT_NEAR(extent(high.made.field).size().z, 1.5 * before.size().z, 4);
  EXPECT_NEAR(solid(high.made.field) / solid(stone) / 1.5, 1, 0.1);
}

TEST(Objects, GrowOnOneTrunk) {
  const DistanceField example = tree();
  const ObjectResult made = synthesizeObject(example, {.size = {54, 51, 40}, .seed = 1});
  EXPECT_EQ(made.growth[0], Growth::Grown);
  EXPECT_EQ(made.growth[1], Growth::Grown);
  const DistanceField& field = made.made.field;
  EXPECT_EQ(pieces(field), 1);
  // At half the height of the trunk there is one.
  DistanceField slice = constant({54, 51, 1}, 1);
  forEachCell(slice.size(), [&](const Vec3i& p) { slice.values[p] = field.values(p.x, p.y, 12); });
  EXPECT_EQ(pieces(slice), 1);
  EXPECT_LT(extent(slice).size().x, 20);
  // With as much solid as the example has, for its box.
  EXPECT_NEAR(solid(field) / solid(example) / 2.25, 1, 0.1);
  // The crown is wider, as the result is.
  EXPECT_GT(extent(field).size().x, 1.35 * extent(example).size().x);
}

TEST(Objects, AreTheSameAtAnyNumberOfThreads) {
  for (const Vec3i& size : {Vec3i{72, 40, 28}, Vec3i{100, 60, 28}}) {
    ObjectResult one, eight;
    withThreads(1, [&] { one = synthesizeObject(village(), {.size = size, .seed = 3}); });
    withThreads(8, [&] { eight = synthesizeObject(village(), {.size = size, .seed = 3}); });
    EXPECT_EQ(one.made.field.values, eight.made.field.values);
    EXPECT_EQ(one.made.origins, eight.made.origins);
  }
  ObjectResult one, eight;
  const Vec3i size{36, 26, 26};
  withThreads(1, [&] { one = synthesizeObject(pebble(), {.size = size, .seed = 3}); });
  withThreads(8, [&] { eight = synthesizeObject(pebble(), {.size = size, .seed = 3}); });
  EXPECT_EQ(one.growth[0], Growth::Grown);
  EXPECT_EQ(one.made.field.values, eight.made.field.values);
  EXPECT_EQ(one.made.origins, eight.made.origins);
  withThreads(1, [&] { one = synthesizeObject(tree(), {.size = {54, 34, 40}}); });
  withThreads(8, [&] { eight = synthesizeObject(tree(), {.size = {54, 34, 40}}); });
  EXPECT_EQ(one.growth[0], Growth::Grown);
  EXPECT_EQ(one.made.field.values, eight.made.field.values);
  EXPECT_EQ(one.made.origins, eight.made.origins);
}

TEST(Objects, HaveTheSignOfTheirOrigins) {
  for (const DistanceField& example : {village(), pebble(), tree()}) {
    const Vec3i size = example.size() + Vec3i{12, 0, 0};
    const SynthesisResult made = synthesizeObject(example, {.size = size}).made;
    std::int64_t wrong = 0;
    for (std::size_t s = 0; s < made.origins.count(); ++s) {
      const Vec3i cell = made.origins.values()[s].cell();
      ASSERT_TRUE(example.values.contains(cell));
      wrong += (made.field.values.values()[s] < 0) != (example.values[cell] < 0);
    }
    EXPECT_EQ(wrong, 0);
  }
}

TEST(Objects, RefuseSizesOutOfRangeAndStopWhenAsked) {
  EXPECT_THROW(synthesizeObject(village(), {.size = {0, 40, 28}}), InputError);
  EXPECT_THROW(synthesizeObject(village(), {.size = {30000, 30000, 30000}}), InputError);
  for (const char* stage : {"docks", "exchanging parts", "seams"}) {
    CancelAfter cancel(1, stage);
    EXPECT_THROW(synthesizeObject(village(), {.size = {72, 40, 28}}, cancel.progress()), Cancelled);
    EXPECT_TRUE(cancel.happened());
  }
  CancelAfter cancel(1, "voting");
  EXPECT_THROW(synthesizeObject(boulder(), {.size = {50, 36, 36}}, cancel.progress()), Cancelled);
  EXPECT_TRUE(cancel.happened());
}

TEST(Objects, MayBeSmallerThanTheExampleOrThin) {
  for (const Vec3i& size : {Vec3i{50, 30, 28}, Vec3i{9, 9, 9}, Vec3i{1, 1, 1}}) {
    EXPECT_EQ(synthesizeObject(village(), {.size = size}).made.field.size(), size);
  }
  DistanceField plate = constant({40, 40, 3}, 0.5F);
  for (int j = 4; j < 36; ++j) {
    for (int i = 4; i < 36; ++i) plate.values(i, j, 1) = -0.5F;
  }
  EXPECT_EQ(synthesizeObject(plate, {.size = {40, 40, 3}}).made.field.size(), plate.size());
  EXPECT_EQ(synthesizeObject(plate, {.size = {80, 80, 3}}).made.field.size().x, 80);
  const DistanceField air = constant({16, 16, 16}, 1);
  EXPECT_EQ(solid(synthesizeObject(air, {.size = {24, 16, 16}}).made.field), 0);
}

}  // namespace
}  // namespace exemplar
