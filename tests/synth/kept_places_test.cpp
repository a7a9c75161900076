// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/kept_places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "core/cells.h"
#include "synth/geometry/objects/objects.h"
#include "synth/geometry/objects/slice_path.h"
#include "synth/geometry/voting/voting.h"
#include "tests/synth/fields.h"

namespace exemplar {
namespace {

using namespace testing;

using Where = std::function<bool(const Vec3i&)>;

Array3D<std::uint8_t> maskOf(const Vec3i& size, const Where& where) {
  Array3D<std::uint8_t> mask(size);
  forEachCell(size, [&](const Vec3i& p) { mask[p] = where(p); });
  return mask;
}

DistanceField sampled(const Vec3i& size, const std::function<double(const Vec3d&)>& shape) {
  DistanceField field = constant(size, 0);
  forEachCell(size, [&](const Vec3i& p) {
    field.values[p] = static_cast<float>(std::clamp(shape(cast<double>(p)), -8.0, 8.0));
  });
  return field;
}

double box(const Vec3d& p, const Vec3d& low, const Vec3d& high) {
  return std::max(
      {low.x - p.x, p.x - high.x, low.y - p.y, p.y - high.y, low.z - p.z, p.z - high.z});
}

/// A wall of blocks with a pier at each end, taller at the right one; `axis` is where it runs.
DistanceField wall(int axis = 0) {
  Vec3i size{64, 20, 32};
  if (axis != 0) std::swap(size.x, size[axis]);
  return sampled(size, [axis](Vec3d p) {
    if (axis != 0) std::swap(p.x, p[axis]);
    double d = box(p, {4, 7, 3}, {59, 12, 20});
    d = std::max(d, 0.8 - std::abs(std::fmod(p.x, 8.0) - 4));  // joints between the blocks
    d = std::min(d, box(p, {4, 8, 3}, {59, 11, 20}));
    d = std::min(d, box(p, {4, 5, 3}, {11, 14, 24}));
    return std::min(d, box(p, {52, 5, 3}, {59, 14, 28}));
  });
}

/// A column with a base and a wider cap.
DistanceField column() {
  return sampled({28, 28, 64}, [](const Vec3d& p) {
    const double r = std::hypot(p.x - 13.5, p.y - 13.5);
    double d = std::max(r - 5 - 0.8 * std::cos(p.z * 0.785), std::abs(p.z - 31.5) - 27);
    d = std::min(d, box(p, {4, 4, 4}, {23, 23, 10}));
    return std::min(d, box(p, {5, 5, 53}, {22, 22, 59}));
  });
}

TEST(KeptPlaces, EndsStayEndsAndWhatIsBetweenStaysBetween) {
  const DistanceField example = wall();
  const Vec3i n = example.size(), size{128, n.y, n.z};
  struct Case {
    const char* name;
    Where where;
    Vec3i low, high;  ///< where the first and the last kept sample along x go
  };
  const Case cases[] = {
      {"left", [](const Vec3i& p) { return p.x < 32; }, {0, 0, 0}, {31, 0, 0}},
      {"right", [](const Vec3i& p) { return p.x >= 32; }, {96, 0, 0}, {127, 0, 0}},
      {"middle", [](const Vec3i& p) { return p.x >= 24 && p.x < 40; }, {56, 0, 0}, {71, 0, 0}},
      {"both", [](const Vec3i& p) { return p.x < 16 || p.x >= 48; }, {0, 0, 0}, {127, 0, 0}},
      {"whole", [](const Vec3i&) { return true; }, {0, 0, 0}, {63, 0, 0}}};
  for (const Case& c : cases) {
    const Array3D<std::uint8_t> kept = maskOf(n, c.where);
    const KeptPlaces places = placeKept(example, kept, size, {});
    Vec3i low = size, high{-1, -1, -1};
    std::int64_t count = 0, wanted = 0;
    for (const std::uint8_t k : kept.values()) wanted += k;
    forEachCell(size, [&](const Vec3i& p) {
      const std::uint8_t k = places.kept[p];
      if (!k) return;
      const Vec3i from = places.offsets.empty() ? p : p - places.offsets[k - 1U];
      EXPECT_TRUE(kept[from]) << c.name;
      low = min(low, p);
      high = max(high, p);
      ++count;
    });
    EXPECT_EQ(count, wanted) << c.name;
    EXPECT_EQ(low.x, c.low.x) << c.name;
    EXPECT_EQ(high.x, c.high.x) << c.name;
    // Along an axis that tiles there are no ends.
    EXPECT_TRUE(placeKept(example, kept, size, {true, false, false}).offsets.empty()) << c.name;
  }
}

TEST(KeptRanges, AreJoinedOverNarrowGaps) {
  const auto ranges = [](const Where& where) { return keptRanges(maskOf({64, 2, 2}, where), 0); };
  EXPECT_EQ(ranges([](const Vec3i& p) { return p.x % 8 == 0; }),
            (std::vector<SliceRange>{{0, 57}}));
  EXPECT_EQ(ranges([](const Vec3i& p) { return p.x < 10 || (p.x >= 20 && p.y == 1); }),
            (std::vector<SliceRange>{{0, 10}, {20, 64}}));
  EXPECT_TRUE(ranges([](const Vec3i&) { return false; }).empty());
}

/// The runs of solid along an axis, of the slices that hold at least `least` solid samples.
int runs(const DistanceField& field, int axis, std::int64_t least) {
  std::vector<std::int64_t> solid(static_cast<std::size_t>(field.size()[axis]));
  forEachCell(field.size(), [&](const Vec3i& p) {
    solid[static_cast<std::size_t>(p[axis])] += field.values[p] < 0;
  });
  int count = 0;
  for (std::size_t s = 0; s < solid.size(); ++s)
    count += solid[s] >= least && (s == 0 || solid[s - 1] < least);
  return count;
}

/// The object made twice as long along `axis` around what is kept.
ObjectResult longer(const DistanceField& example, int axis, const Where& kept,
                    std::uint64_t seed = 0) {
  ObjectOptions options;
  options.size = example.size();
  options.size[axis] *= 2;
  options.seed = seed;
  options.kept = maskOf(example.size(), kept);
  return synthesizeObject(example, options);
}

TEST(KeptPlaces, AWallGoesOnAsOneWallWhicheverPartOfItIsKept) {
  // The piers alone are higher than the wall: slices with solid above it.
  for (const int axis : {0, 1}) {
    const DistanceField example = wall(axis);
    const int n = example.size()[axis];
    const Where parts[] = {[=](const Vec3i& p) { return p[axis] < n / 2; },
                           [=](const Vec3i& p) { return p[axis] >= n / 2; },
                           [=](const Vec3i& p) { return p[axis] < 14 || p[axis] >= n - 14; },
                           [=](const Vec3i& p) { return p[axis] >= 24 && p[axis] < 40; }};
    for (const Where& part : parts) {
      for (std::uint64_t seed = 0; seed < 2; ++seed) {
        const ObjectResult result = longer(example, axis, part, seed);
        const DistanceField& made = result.made.field;
        ASSERT_EQ(made.size()[axis], 2 * n);
        EXPECT_EQ(runs(made, axis, 1), 1);  // without a gap
        // Each pier is there once, at its end: their sections are by far the largest.
        EXPECT_EQ(runs(made, axis, 130), 2);
        forEachCell(example.size(), [&](const Vec3i& p) {
          if (!part(p) || p[axis] < 2 || p[axis] >= n - 2) return;
          // The low one of two ends says where what is kept has gone; the other is at its end.
          Vec3i to = p + result.keptOffset;
          const bool bothEnds = part(Vec3i{0, 0, 0}) && p[axis] >= n / 2;
          if (bothEnds && part(example.size() - Vec3i{1, 1, 1})) return;
          ASSERT_TRUE(made.values.contains(to));
          ASSERT_EQ(made.values[to], example.values[p]);
        });
      }
    }
  }
}

/// A wall with a hole that becomes higher from one end to the other: no slice is like the next.
DistanceField brokenWall() {
  return sampled({64, 20, 32}, [](const Vec3d& p) {
    const double hole = std::min({0.1 * (p.x - 6) - std::abs(p.z - 15), p.x - 7, 56 - p.x});
    return std::max(box(p, {4, 6, 3}, {59, 13, 28}), hole);
  });
}

TEST(KeptPlaces, AWallThatIsKeptToTheMiddleOfAHoleIsOneWall) {
  const DistanceField example = brokenWall();
  // Beside the low half there is no joint as good as objects are extended by (0.15).
  const std::vector<SliceRange> half{{0, 33}};
  const double cost = fittedPath(SliceDocking(example, 0), 128, 0, half).meanCost;
  EXPECT_GT(cost, 0.15);
  EXPECT_LT(cost, 0.25);
  for (const bool low : {true, false}) {
    const ObjectResult result =
        longer(example, 0, [&](const Vec3i& p) { return (p.x < 33) == low; });
    const DistanceField& made = result.made.field;
    ASSERT_EQ(made.size().x, 128) << low;
    // Above the hole and below it the wall goes on as thick as it is (7), to a step of a sample,
    // without a groove.
    for (const int z : {5, 26}) {
      for (int x = 10; x < 118; ++x) {
        int thick = 0;
        for (int y = 0; y < 20; ++y) thick += made.values(x, y, z) < 0;
        ASSERT_GE(thick, 6) << x << " " << z;
      }
    }
    forEachCell(example.size(), [&](const Vec3i& p) {
      if ((p.x < 33) != low || p.x < 2 || p.x >= 62) return;
      ASSERT_EQ(made.values[p + result.keptOffset], example.values[p]);
    });
  }
}

TEST(KeptPlaces, AWallGrowsBetweenItsPlinthAndItsCoping) {
  const DistanceField example = sampled({48, 20, 64}, [](const Vec3d& p) {
    double d = box(p, {4, 7, 4}, {43, 12, 58});
    d = std::max(d, 0.8 - std::abs(std::fmod(p.z, 8.0) - 4));  // courses
    d = std::min(d, box(p, {4, 8, 4}, {43, 11, 58}));
    d = std::min(d, box(p, {4, 4, 4}, {43, 15, 9}));
    return std::min(d, box(p, {4, 5, 54}, {43, 14, 59}));
  });
  const Where parts[] = {[](const Vec3i& p) { return p.z < 32; },
                         [](const Vec3i& p) { return p.z >= 32; }};
  for (const Where& part : parts) {
    const ObjectResult result = longer(example, 2, part);
    const DistanceField& made = result.made.field;
    ASSERT_EQ(made.size().z, 128);
    EXPECT_EQ(runs(made, 2, 1), 1);
    EXPECT_EQ(runs(made, 2, 300), 2);  // plinth and coping, each once
    forEachCell(example.size(), [&](const Vec3i& p) {
      if (!part(p) || p.z < 2 || p.z >= 62) return;
      ASSERT_EQ(made.values[p + result.keptOffset], example.values[p]);
    });
  }
}

TEST(KeptPlaces, AColumnGrowsBetweenItsBaseAndItsCap) {
  const DistanceField example = column();
  const Where parts[] = {[](const Vec3i& p) { return p.z < 32; },
                         [](const Vec3i& p) { return p.z >= 32; }};
  for (const Where& part : parts) {
    const DistanceField made = longer(example, 2, part).made.field;
    ASSERT_EQ(made.size().z, 128);
    EXPECT_EQ(runs(made, 2, 1), 1);
    EXPECT_EQ(runs(made, 2, 250), 2);  // base and cap, each once
  }
}

TEST(KeptPlaces, WhatDoesNotDockIsLeftToVoting) {
  const DistanceField example = balls({40, 32, 32}, 5, 3);
  const ObjectResult result = longer(example, 0, [](const Vec3i& p) { return p.x < 16; });
  EXPECT_EQ(result.made.field.values.count(), 0u);
}

struct Voted {
  KeptPlaces places;
  SynthesisResult result;
};
/// A result of a size, by voting, around a part of the example that is kept.
Voted votedAround(const DistanceField& example, const Where& part, const Vec3i& size) {
  Voted made{placeKept(example, maskOf(example.size(), part), size, {}), {}};
  VotingOptions options;
  options.size = size;
  options.rounds = 3;
  options.kept = made.places.kept;
  options.keptOffsets = made.places.offsets;
  made.result = synthesizeByVoting(example, options);
  return made;
}
/// Where in the example a kept sample is from.
Vec3i keptFrom(const KeptPlaces& places, const Vec3i& p) {
  return places.offsets.empty() ? p : p - places.offsets[places.kept[p] - 1U];
}

TEST(KeptPlaces, VotingGoesOnFromEitherSideAlike) {
  // Ground that is cut at its sides, kept at one of them: it stays to the bit at its own end.
  const DistanceField example = ground({40, 40, 28}, 6);
  const auto made = [&](const Where& part, const Vec3i& size = {72, 40, 28}) {
    const Voted voted = votedAround(example, part, size);
    const KeptPlaces& places = voted.places;
    const SynthesisResult& result = voted.result;
    forEachCell(size, [&](const Vec3i& p) {
      if (!places.kept[p]) return;
      const Vec3i from = keptFrom(places, p);
      ASSERT_EQ(result.field.values[p], example.values[from]);
      ASSERT_EQ(result.origins[p].cell(), from);
    });
    return brokenFaces(example, result.field, result.origins, 1.5F);
  };
  // All else is made of what is kept: of narrower parts there is less to choose from.
  EXPECT_LT(made([](const Vec3i& p) { return p.x < 20; }), 0.02);
  EXPECT_LT(made([](const Vec3i& p) { return p.x >= 20; }), 0.02);
  EXPECT_LT(made([](const Vec3i& p) { return p.y < 20; }, {40, 72, 28}), 0.02);
  EXPECT_LT(made([](const Vec3i& p) { return p.y >= 20; }, {40, 72, 28}), 0.02);
  EXPECT_LT(made([](const Vec3i& p) { return p.x < 12 || p.x >= 28; }), 0.05);
  EXPECT_LT(made([](const Vec3i& p) { return p.x >= 14 && p.x < 26; }), 0.05);
}

TEST(KeptPlaces, GroundStaysAtTheTopOrTheBottomThatIsKept) {
  const DistanceField example = ground({28, 28, 28}, 6);
  const Vec3i n = example.size(), size{28, 28, 44};
  // Half of it each: what is below the surface, and what is above it with the surface.
  const Where parts[] = {[](const Vec3i& p) { return p.z < 8; },
                         [](const Vec3i& p) { return p.z >= 8; }};
  for (const Where& part : parts) {
    const Voted made = votedAround(example, part, size);
    const KeptPlaces& places = made.places;
    const bool below = part({0, 0, 0});
    int kept = 0;
    forEachCell(size, [&](const Vec3i& p) {
      if (!places.kept[p]) return;
      ++kept;
      const Vec3i from = keptFrom(places, p);
      ASSERT_EQ(made.result.field.values[p], example.values[from]);
      // The lower part is the result's lowest, the upper one its highest.
      ASSERT_EQ(p.z - from.z, below ? 0 : size.z - n.z);
    });
    EXPECT_EQ(kept, n.x * n.y * (below ? 8 : n.z - 8));
  }
}

}  // namespace
}  // namespace exemplar
