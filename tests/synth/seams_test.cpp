// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/seams/seams.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/random.h"
#include "tests/synth/fields.h"

namespace exemplar {
namespace {

using namespace testing;

Array3D<float> clamped(const DistanceField& field, float limit = 1.5f) {
  Array3D<float> values = field.values;
  for (float& v : values.values()) v = std::clamp(v, -limit, limit);
  return values;
}

/// Cubes of `side` samples, each of an offset of its own at random.
Origins randomCubes(const Vec3i& size, int side, const Vec3i& example, std::uint64_t seed) {
  const Random random(seed);
  Origins origins(size);
  for (std::size_t s = 0; s < origins.count(); ++s) {
    const Vec3i p = origins.ijk(s);
    const Vec3i cube{p.x / side, p.y / side, p.z / side};
    const std::uint64_t key = (cube.z * 64 + cube.y) * 64 + cube.x;
    Vec3i cell;
    for (int axis = 0; axis < 3; ++axis) {
      cell[axis] = static_cast<int>(random.below(example[axis] - side + 1, key, axis)) + p[axis] -
                   cube[axis] * side;
    }
    origins[p] = Origin(cell);
  }
  return origins;
}

struct Puzzle {
  Array3D<float> example, target;
  Origins origins;
};

Puzzle puzzle(std::uint64_t seed, const Vec3i& size = {30, 30, 24}) {
  const DistanceField packing = balls({28, 28, 28}, 4, seed);
  Puzzle p{clamped(packing), {}, randomCubes(size, 7, packing.size(), seed)};
  p.target = Array3D<float>(size);
  for (std::size_t s = 0; s < p.target.count(); ++s) {
    p.target.values()[s] = p.example[p.origins.values()[s].cell()];
  }
  return p;
}

TEST(SeamCost, IsZeroWithinOnePieceThatIsAsWanted) {
  const Array3D<float> example = clamped(balls({16, 16, 16}, 4, 1));
  Origins origins(example.size());
  for (std::size_t s = 0; s < origins.count(); ++s) origins.values()[s] = Origin(origins.ijk(s));
  EXPECT_EQ(seamCost(example, example, origins), 0);
}

TEST(SeamCost, IsTheSumOverFacesAndSamples) {
  // Two samples, of offsets 0 and 2: |E(0) - E(2)| + |E(1) - E(3)|, the slopes' difference |(E(0) -
  // E(1)) - (E(2) - E(3))| = 3, the length, the square of what is wanted less what is there.
  Array3D<float> example({4, 1, 1});
  const float values[] = {0, 3, 1, 7};
  std::copy(std::begin(values), std::end(values), example.data());
  Array3D<float> target({2, 1, 1});
  target(0, 0, 0) = 2;
  target(1, 0, 0) = 7;
  Origins origins({2, 1, 1});
  origins(0, 0, 0) = Origin({0, 0, 0});
  origins(1, 0, 0) = Origin({3, 0, 0});
  SeamOptions options;
  options.length = 0.25;
  options.fidelity = 0.5;
  options.slope = 0.5;
  EXPECT_EQ(seamCost(example, target, origins, options),
            1000000 * 1 + 1000000 * 4 + 1500000 + 250000 + 2000000);
  options.squared = true;
  EXPECT_EQ(seamCost(example, target, origins, options), 42250000 + 250000 + 2000000);
  // 3 and 7 count as 2, in slopes as what they are.
  options.truncation = 2;
  EXPECT_EQ(seamCost(example, target, origins, options), 6250000 + 250000 + 2000000);
}

/// The cost of a face between two samples of these offsets, without its length.
std::int64_t faceCost(const Array3D<float>& example, const Vec3i& a, const Vec3i& b, bool squared) {
  Origins origins({2, 1, 1});
  origins(0, 0, 0) = Origin(a);
  origins(1, 0, 0) = Origin(b + Vec3i{1, 0, 0});
  return seamCost(example, Array3D<float>({2, 1, 1}), origins,
                  {.fidelity = 0, .length = 0, .squared = squared});
}

TEST(SeamCost, IsAMetricOfOffsetsUnlessSquared) {
  const Array3D<float> example = balls({24, 24, 24}, 5, 3).values;
  const Random random(5);
  int squaredFail = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    Vec3i offset[3];
    for (int n = 0; n < 9; ++n) offset[n / 3][n % 3] = static_cast<int>(random.below(23, trial, n));
    const auto [a, b, c] = offset;
    EXPECT_EQ(faceCost(example, a, b, false), faceCost(example, b, a, false));
    EXPECT_LE(faceCost(example, a, c, false),
              faceCost(example, a, b, false) + faceCost(example, b, c, false));
    squaredFail += faceCost(example, a, c, true) >
                   faceCost(example, a, b, true) + faceCost(example, b, c, true);
  }
  EXPECT_GT(squaredFail, 100);
}

TEST(RefineSeams, NeverRaisesTheCost) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    Puzzle p = puzzle(seed);
    SeamOptions options;
    options.passes = 1;
    options.reach = 1 + static_cast<int>(seed) * 2;
    options.squared = seed % 2 == 1;
    std::int64_t cost = seamCost(p.example, p.target, p.origins, options);
    const std::int64_t first = cost;
    for (int pass = 0; pass < 3; ++pass) {
      refineSeams(p.example, p.target, p.origins, options);
      const std::int64_t next = seamCost(p.example, p.target, p.origins, options);
      EXPECT_LE(next, cost);
      cost = next;
    }
    // Cubes cut blindly through balls: there is much to win.
    EXPECT_LT(static_cast<double>(cost), 0.8 * static_cast<double>(first));
    for (const Origin& origin : p.origins.values()) ASSERT_TRUE(p.example.contains(origin.cell()));
  }
}

TEST(RefineSeams, FindsTheWayThroughAir) {
  // A row of the left part (example samples 30 on) has balls at 5 and 16, of the right part
  // (example samples 0 on) at 19; the seam at 17 cuts both. Air that both share lies from 9 to 12.
  // The left part cannot reach beyond 20, where the example ends.
  const Vec3i size{24, 15, 15};
  Array3D<float> example({50, 15, 15});
  const Vec3d centers[] = {{19, 7, 7}, {35, 7, 7}, {46, 7, 7}};
  for (std::size_t s = 0; s < example.count(); ++s) {
    float distance = 1.5f;
    for (const Vec3d& c : centers) {
      distance =
          std::min(distance, static_cast<float>(length(cast<double>(example.ijk(s)) - c)) - 3);
    }
    example.values()[s] = std::max(distance, -1.5f);
  }
  Origins origins(size);
  Array3D<float> target(size);
  for (std::size_t s = 0; s < origins.count(); ++s) {
    const Vec3i p = origins.ijk(s);
    origins[p] = Origin(p.x < 17 ? p + Vec3i{30, 0, 0} : p);
    target[p] = example[origins[p].cell()];
  }
  SeamOptions options;
  options.reach = 8;
  options.length = 0;
  options.fidelity = 0;
  EXPECT_GT(seamCost(example, target, origins, options), 20 * 1000000);
  refineSeams(example, target, origins, options);
  EXPECT_EQ(seamCost(example, target, origins, options), 0);
  EXPECT_EQ(origins(0, 7, 7), Origin({30, 7, 7}));  // the left part is still there
  EXPECT_EQ(origins(23, 7, 7), Origin({23, 7, 7}));
}

TEST(RefineSeams, FindsWhereSlopesAgree) {
  // Far from any surface, where only slopes count: the left part (example samples 24 on) rises by
  // 0.5 a sample; the right part falls by 0.3, but for the samples 6 to 9, where it rises like the
  // left one. The seam is at 15. The
  // left part cannot reach beyond 20, where the example ends.
  const Vec3i size{24, 6, 6};
  Array3D<float> example({44, 6, 6});
  for (std::size_t s = 0; s < example.count(); ++s) {
    const int x = example.ijk(s).x;
    const double v = x >= 24  ? 20 + 0.5 * (x - 24)
                     : x <= 6 ? 30 - 0.3 * x
                     : x <= 9 ? 28.2 + 0.5 * (x - 6)
                              : 29.7 - 0.3 * (x - 9);
    example.values()[s] = static_cast<float>(v);
  }
  for (const bool squared : {false, true}) {
    Origins origins(size);
    Array3D<float> target(size, 20);
    for (std::size_t s = 0; s < origins.count(); ++s) {
      const Vec3i p = origins.ijk(s);
      origins[p] = Origin(p.x < 15 ? p + Vec3i{24, 0, 0} : p);
    }
    SeamOptions options{.reach = 12, .fidelity = 0, .length = 0, .squared = squared};
    options.slope = 0;
    EXPECT_EQ(seamCost(example, target, origins, options), 0);
    options.slope = 1;
    EXPECT_GT(seamCost(example, target, origins, options), 36 * 600000);
    refineSeams(example, target, origins, options);
    // Of 36 faces, each with what floats of 20 to 30 are off by.
    EXPECT_LT(seamCost(example, target, origins, options), 36 * 20);
    for (int x = 0; x < size.x; ++x) {
      const bool right = origins(x, 3, 3) == Origin({x, 3, 3});
      EXPECT_TRUE(x < 7 ? !right : x < 9 || right) << x;
    }
  }
}

/// Two halves of a field that repeats after 9 samples, the right one `off` samples out of step.
Puzzle misaligned(const Vec3i& off) {
  Puzzle p;
  p.example = waves({40, 40, 40}, 9).values;
  p.origins = Origins({24, 16, 16});
  for (std::size_t s = 0; s < p.origins.count(); ++s) {
    const Vec3i x = p.origins.ijk(s);
    p.origins[x] = Origin(x.x < 14 ? x + Vec3i{3, 3, 3} : x + Vec3i{12, 3, 3} + off);
  }
  p.target = Array3D<float>(p.origins.size());
  return p;
}

TEST(AlignPieces, AlignsPieces) {
  for (const Vec3i& off : {Vec3i{1, 0, 0}, Vec3i{-1, 1, 0}, Vec3i{1, -1, 1}}) {
    Puzzle p = misaligned(off);
    SeamOptions options;
    options.length = options.fidelity = 0;
    EXPECT_GT(seamCost(p.example, p.target, p.origins, options), 1000000);
    EXPECT_EQ(alignPieces(p.example, p.origins, 1, options), 1);
    EXPECT_EQ(seamCost(p.example, p.target, p.origins, options), 0);
    for (const Origin& origin : p.origins.values()) ASSERT_TRUE(p.example.contains(origin.cell()));
    EXPECT_EQ(alignPieces(p.example, p.origins, 1, options), 0);
  }
  // Farther out than both may move.
  Puzzle p = misaligned({4, 4, 4});
  alignPieces(p.example, p.origins, 1);
  EXPECT_GT(seamCost(p.example, p.target, p.origins, {.fidelity = 0, .length = 0}), 0);
}

TEST(AlignPieces, SameBytesAtAnyNumberOfThreads) {
  const Puzzle p = puzzle(7);
  Origins one = p.origins, eight = p.origins;
  withThreads(1, [&] { alignPieces(p.example, one); });
  withThreads(8, [&] { alignPieces(p.example, eight); });
  EXPECT_NE(one, p.origins);
  EXPECT_EQ(one, eight);
}

TEST(AlignPieces, NeverRaisesTheCostOfFaces) {
  SeamOptions options;
  options.fidelity = 0;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    Puzzle p = puzzle(seed);
    const std::int64_t before = seamCost(p.example, p.target, p.origins, options);
    EXPECT_GT(alignPieces(p.example, p.origins, 1, options), 0);
    EXPECT_LT(seamCost(p.example, p.target, p.origins, options), before);
    for (const Origin& origin : p.origins.values()) ASSERT_TRUE(p.example.contains(origin.cell()));
  }
}

TEST(RefineSeams, HonorsWhatIsFixedUsableAndAir) {
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const Puzzle p = puzzle(seed);
    const Vec3i n = p.origins.size();
    Array3D<std::uint8_t> fixed(n), usable(p.example.size(), 1), air(n);
    std::int64_t moved = 0;
    for (std::size_t s = 0; s < fixed.count(); ++s) {
      fixed.values()[s] = p.origins.ijk(s).y < 9;
      air.values()[s] = p.origins.ijk(s).x < 6;
    }
    for (std::size_t s = 0; s < usable.count(); ++s) usable.values()[s] = usable.ijk(s).z > 8;
    SeamOptions options;
    Origins free = p.origins;
    refineSeams(p.example, p.target, free, options);
    options.fixed = &fixed;
    options.usable = &usable;
    options.air = &air;
    Origins held = p.origins;
    refineSeams(p.example, p.target, held, options);
    int freely[3] = {};
    for (std::size_t s = 0; s < fixed.count(); ++s) {
      const Origin before = p.origins.values()[s];
      const auto breaks = [&](const Origin& after, int rule) {
        if (after == before) return false;
        if (rule == 0) return fixed.values()[s] != 0;
        if (rule == 1) return usable[after.cell()] == 0;
        return air.values()[s] && p.example[after.cell()] < 0;
      };
      for (int rule = 0; rule < 3; ++rule) {
        ASSERT_FALSE(breaks(held.values()[s], rule)) << rule;
        freely[rule] += breaks(free.values()[s], rule);
      }
      moved += held.values()[s] != before;
    }
    EXPECT_GT(moved, 0);
    for (const int count : freely) EXPECT_GT(count, 0);
  }
}

TEST(RefineSeams, SameBytesAtAnyNumberOfThreads) {
  const Puzzle p = puzzle(7, {40, 40, 30});
  Origins one = p.origins, eight = p.origins;
  withThreads(1, [&] { refineSeams(p.example, p.target, one); });
  withThreads(8, [&] { refineSeams(p.example, p.target, eight); });
  EXPECT_EQ(one, eight);
  EXPECT_NE(one, p.origins);
}

TEST(RefineSeams, SmallPiecesMayBeTakenButDoNotGrow) {
  Puzzle p = puzzle(2);
  SeamOptions options;
  options.smallest = 7 * 7 * 7 + 1;  // larger than any piece
  const Origins before = p.origins;
  refineSeams(p.example, p.target, p.origins, options);
  EXPECT_EQ(p.origins, before);
}

TEST(RefineSeams, StopsSoundlyWhenCancelled) {
  Puzzle p = puzzle(3);
  CancelAfter cancel(2);
  const std::int64_t before = seamCost(p.example, p.target, p.origins);
  Puzzle all = p;
  refineSeams(all.example, all.target, all.origins);
  EXPECT_THROW(refineSeams(p.example, p.target, p.origins, {}, cancel.progress()), Cancelled);
  EXPECT_TRUE(cancel.happened());
  EXPECT_LE(seamCost(p.example, p.target, p.origins), before);
  EXPECT_NE(p.origins, all.origins);
  for (const Origin& origin : p.origins.values()) ASSERT_TRUE(p.example.contains(origin.cell()));
}

TEST(RefineSeams, DoesNothingInNoPasses) {
  Puzzle p = puzzle(4);
  SeamOptions options;
  options.passes = 0;
  const Origins before = p.origins;
  refineSeams(p.example, p.target, p.origins, options);
  EXPECT_EQ(p.origins, before);
}

}  // namespace
}  // namespace exemplar
