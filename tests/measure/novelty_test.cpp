// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/novelty.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "tests/measure/fields.h"
#include "tests/threads.h"

namespace exemplar {
namespace {

using testing::ball;
using testing::ballPacking;
using testing::emptyField;
using testing::gathered;
using testing::makeField;
using testing::makeOrigins;
using testing::moved;
using testing::noise;

Origin identity(const Vec3i& p) { return Origin(p); }

TEST(Diversity, IsTheMeanOverPairs) {
  const Vec3i n{20, 20, 20};
  // Slabs of 5, 10 and 20 layers: IoU 5/10, 5/20, 10/20.
  std::vector<Occupancy> slabs;
  for (const double depth : {5, 10, 20})
    slabs.emplace_back(makeField(n, [&](const Vec3d& p) { return p.z - depth + 0.5; }));
  EXPECT_DOUBLE_EQ(diversity(slabs), (0.5 + 0.75 + 0.5) / 3);
  EXPECT_EQ(diversity(std::span(slabs).first(1)), 0);
  slabs[1] = slabs[2] = slabs[0];
  EXPECT_EQ(diversity(slabs), 0);
}

TEST(Diversity, NeedsResultsOfOneSize) {
  const std::vector<Occupancy> results{Occupancy(emptyField({4, 4, 4})),
                                       Occupancy(emptyField({4, 4, 5}))};
  EXPECT_THROW(diversity(results), InputError);
}

TEST(CopyDistance, IsZeroWhereverTheCopyLies) {
  const DistanceField example = ballPacking({32, 32, 32}, 1, 3);
  const Occupancy e(example);
  const Occupancy copy(moved(example, {3, -2, 3}));
  EXPECT_EQ(copyDistance(e, copy), 0);
  EXPECT_GT(1 - intersectionOverUnion(e, copy), 0.5);  // the aligned distance is fooled

  // Inside something larger, whose other content counts for nothing.
  const Vec3i at{17, 5, 30};
  const Occupancy larger(makeField({80, 50, 70}, [&](const Vec3d& p) {
    const Vec3i c = cast<int>(p) - at;
    return example.values.contains(c) ? example.values[c] : std::sin(p.x) + std::sin(p.y);
  }));
  EXPECT_EQ(copyDistance(e, larger), 0);
  CopyDistanceOptions few;
  few.placements = 20000;  // of 56 * 26 * 46 = 67,000: a lattice, then the best neighborhoods
  EXPECT_EQ(copyDistance(e, larger, few), 0);
  EXPECT_GT(copyDistance(Occupancy(ballPacking({32, 32, 32}, 2, 3)), larger), 0.3);
}

TEST(CopyDistance, NeverExceedsTheAlignedDistance) {
  for (const std::uint64_t seed : {3, 4, 5}) {
    const Occupancy a(ballPacking({30, 34, 38}, seed)), b(ballPacking({30, 34, 38}, seed + 10));
    EXPECT_LE(copyDistance(a, b), 1 - intersectionOverUnion(a, b));
  }
}

TEST(Novelty, OfACopyIsNone) {
  const DistanceField example = ballPacking({24, 24, 24}, 1);
  const Origins origins = makeOrigins(example.size(), identity);
  const Novelty n = measureNovelty(example, example, &origins);
  EXPECT_EQ(n.distance, 0);
  EXPECT_EQ(n.copyDistance, 0);
  EXPECT_EQ(n.verbatimRun, 1);
  // Sums of logarithms, rounded.
  EXPECT_NEAR(*n.use, 1, 1e-12);
  EXPECT_NEAR(*n.usedShare, 1, 1e-9);
}

TEST(Novelty, WithoutOriginsTellsTheDistanceOnly) {
  const DistanceField a = ballPacking({24, 24, 24}, 1), b = ballPacking({24, 24, 24}, 2);
  const Novelty n = measureNovelty(a, b);
  EXPECT_GT(n.distance, 0.3);
  EXPECT_FALSE(n.verbatimRun || n.use || n.usedShare);
  EXPECT_FALSE(measureNovelty(a, ballPacking({48, 24, 24}, 2)).distance);
}

TEST(VerbatimRun, IsTheVolumeWeightedMeanOfRegions) {
  const DistanceField example = ballPacking({16, 16, 16}, 1);
  const auto run = [&](const Vec3i& size, const auto& origin) {
    const Origins origins = makeOrigins(size, origin);
    return *measureNovelty(example, gathered(example, origins), &origins).verbatimRun;
  };
  // A tiling: each tile is a copy of the whole.
  EXPECT_DOUBLE_EQ(run({32, 32, 16},
                       [](const Vec3i& p) {
                         return Origin({p.x % 16, p.y % 16, p.z});
                       }),
                   1);
  // Blocks of 4³ swapped about, so that no two go on: (4 / 16)³.
  EXPECT_DOUBLE_EQ(run({16, 16, 16},
                       [](const Vec3i& p) {
                         return Origin({p.x % 4 + 4 * (3 - p.x / 4), p.y % 4 + 4 * (3 - p.y / 4),
                                        p.z % 4 + 4 * (3 - p.z / 4)});
                       }),
                   1.0 / 64);
  // A quarter in one region, the rest in another: (1/4)² + (3/4)².
  EXPECT_DOUBLE_EQ(run({16, 16, 16},
                       [](const Vec3i& p) {
                         return Origin({p.x < 4 ? p.x + 12 : p.x - 4, p.y, p.z});
                       }),
                   10.0 / 16);
  // Every cell from one place: single cells.
  EXPECT_DOUBLE_EQ(run({16, 16, 16}, [](const Vec3i&) { return Origin({3, 4, 5}); }), 1.0 / 4096);
}

TEST(VerbatimRun, FollowsTurns) {
  // A quarter turn anticlockwise takes (x, y) to (-y, x); in a box of 16, to (15 - y, x).
  const DistanceField example = ballPacking({16, 16, 16}, 1);
  for (int turns = 0; turns < 4; ++turns) {
    const Origins origins = makeOrigins({16, 16, 16}, [&](const Vec3i& p) {
      Vec3i c = p;
      for (int t = 0; t < turns; ++t) c = {c.y, 15 - c.x, c.z};
      return Origin(c, 0, turns);
    });
    EXPECT_EQ(measureNovelty(example, gathered(example, origins), &origins).verbatimRun, 1)
        << turns;
    // The same cells with another turn noted go on along z only.
    Origins wrong = origins;
    for (Origin& o : wrong.values()) o.turns = static_cast<std::uint8_t>((turns + 1) % 4);
    EXPECT_EQ(measureNovelty(example, gathered(example, origins), &wrong).verbatimRun, 16.0 / 4096)
        << turns;
  }
}

TEST(Use, IsTheEntropyOfTheSurfaceCells) {
  // A slab whose surface is the 16 x 16 cells of layer 7.
  const DistanceField example = makeField({16, 16, 16}, [](const Vec3d& p) { return p.z - 7.5; });
  const auto measured = [&](const auto& origin) {
    const Origins origins = makeOrigins({16, 16, 16}, origin);
    return measureNovelty(example, gathered(example, origins), &origins);
  };
  // A quarter of the surface, four times over: log 64 / log 256 = 6 / 8.
  const Novelty quarter = measured([](const Vec3i& p) { return Origin({p.x % 8, p.y % 8, p.z}); });
  EXPECT_NEAR(*quarter.use, 0.75, 1e-12);
  EXPECT_NEAR(*quarter.usedShare, 0.25, 1e-12);
  // One cell of the surface.
  const Novelty one = measured([](const Vec3i& p) { return Origin({3, 3, p.z}); });
  EXPECT_NEAR(*one.use, 0, 1e-12);
  EXPECT_NEAR(*one.usedShare, 1.0 / 256, 1e-12);
  const Occupancy solid(example);
  EXPECT_EQ(surfaceUse(solid, makeOrigins({16, 16, 16},
                                          [](const Vec3i& p) {
                                            return Origin({3, 3, p.z});
                                          }))
                .usedShare,
            *one.usedShare);
  // None of it.
  const Novelty none = measured([](const Vec3i& p) { return Origin({p.x, p.y, 14}); });
  EXPECT_EQ(none.use, 0);
  EXPECT_EQ(none.usedShare, 0);
  // A smaller result cannot use every cell: even use of what it can is 1.
  const Origins small = makeOrigins({4, 4, 16}, identity);
  EXPECT_NEAR(*measureNovelty(example, gathered(example, small), &small).use, 1, 1e-12);
}

TEST(Novelty, OfSeveralExamplesCountsTheOneAskedFor) {
  const DistanceField example = makeField({16, 16, 16}, [](const Vec3d& p) { return p.z - 7.5; });
  const Origins origins = makeOrigins({16, 16, 16}, [](const Vec3i& p) {
    return p.x < 8 ? Origin(p, 0) : Origin({9000, 9000, 9000}, 1);
  });
  const Novelty n = measureNovelty(example, example, &origins, 0);
  EXPECT_NEAR(*n.use, 1, 1e-12);
  EXPECT_THROW(measureNovelty(example, example, &origins, 1), InputError);
}

TEST(Novelty, RefusesOriginsThatDoNotFit) {
  const DistanceField example = ball({16, 16, 16}, {8, 8, 8}, 5);
  Origins origins = makeOrigins({16, 16, 15}, identity);
  EXPECT_THROW(measureNovelty(example, example, &origins), InputError);
  origins = makeOrigins({16, 16, 16}, identity);
  EXPECT_NO_THROW(measureNovelty(example, example, &origins));
  origins(3, 3, 3) = Origin({3, 3, 16});
  EXPECT_THROW(measureNovelty(example, example, &origins), InputError);
  origins(3, 3, 3) = Origin({-1, 3, 3});
  EXPECT_THROW(measureNovelty(example, example, &origins), InputError);
}

TEST(Novelty, IsTheSameAtOneAndEightThreads) {
  const DistanceField a = ballPacking({24, 24, 24}, 1), b = ballPacking({40, 40, 24}, 2);
  const Origins origins = makeOrigins(b.size(), [](const Vec3i& p) {
    return Origin({p.x * 7 % 24, p.y * 5 % 24, p.z});
  });
  const auto measure = [&] {
    const Novelty n = measureNovelty(a, b, &origins);
    return std::array{n.copyDistance, *n.verbatimRun, *n.use, *n.usedShare};
  };
  EXPECT_EQ(testing::onThreads(1, measure), testing::onThreads(8, measure));
}

}  // namespace
}  // namespace exemplar
