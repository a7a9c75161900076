// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "voxelize/field_blocks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "core/error.h"
#include "tests/voxelize/error_of.h"
#include "tests/voxelize/hears_cancellation.h"
#include "voxelize/violations.h"

namespace exemplar {
namespace {

using testing::HasSubstr;

DistanceField makeField(const Vec3i& size, const std::function<double(const Vec3i&)>& distance) {
  DistanceField field;
  field.values = Array3D<float>(size);
  field.voxelSize = 0.25;
  field.origin = {1, 2, 3};
  field.truncation = 100;
  for (std::size_t s = 0; s < field.values.count(); ++s)
    field.values.data()[s] = static_cast<float>(distance(field.values.ijk(s)) * field.voxelSize);
  return field;
}

/// Balls on a lattice of this period, each at `offset` from its cell's corner.
DistanceField lattice(const Vec3i& size, const Vec3i& period, const Vec3i& offset) {
  return makeField(size, [&](const Vec3i& p) {
    double squared = 0;
    for (int a = 0; a < 3; ++a) {
      const double x = std::remainder(p[a] - offset[a] - period[a] / 2.0, period[a]);
      squared += x * x;
    }
    return std::sqrt(squared) - 3;
  });
}

/// Waves that grow shorter along x and y: nothing repeats there.
DistanceField ground(const Vec3i& size) {
  return makeField(size, [&](const Vec3i& p) {
    return p.z - size.z / 2.0 - 3 * std::sin(0.1 * p.x + 0.005 * p.x * p.x + 0.1 * p.y) -
           2 * std::sin(0.1 * p.y + 0.007 * p.y * p.y);
  });
}

double truncatedAt(const DistanceField& field, const Vec3i& p, double truncation) {
  return std::clamp(field.values[p] / field.voxelSize, -truncation, truncation);
}

Vec3i times(const Vec3i& a, const Vec3i& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

TEST(FieldBlocks, FindThePeriodOfALattice) {
  const DistanceField field = lattice({60, 54, 48}, {10, 9, 12}, {3, 0, 7});
  EXPECT_EQ(findBlockSize(field), (Vec3i{10, 9, 12}));
  const FieldBlocks blocks = cutIntoBlocks(field);
  EXPECT_EQ(blocks.grid.labelCount(), 1);
  EXPECT_NEAR(blocks.repetition, 1, 0.02);
}

TEST(FieldBlocks, TakeAnAxisThatIsThinAsOneBlock) {
  const DistanceField field = lattice({40, 40, 12}, {10, 10, 12}, {0, 0, 0});
  EXPECT_EQ(findBlockSize(field), (Vec3i{10, 10, 12}));
}

TEST(FieldBlocks, OfWhatDoesNotRepeatAreOfTheUsualSize) {
  // Along z the ground ends in air and in earth; x and y have no period.
  const Vec3i found = findBlockSize(ground({64, 64, 32}));
  EXPECT_EQ(found.x, 8);
  EXPECT_EQ(found.y, 8);
}

TEST(FieldBlocks, FindThePhaseAtWhichMostRepeats) {
  // A lattice with every second plane of cells solid: only one phase along x separates them.
  const Vec3i period{8, 8, 8};
  const DistanceField balls = lattice({48, 32, 32}, period, {0, 0, 0});
  const DistanceField field = makeField({48, 32, 32}, [&](const Vec3i& p) {
    return (p.x + 3) / 8 % 2 == 1 ? -2.0 : truncatedAt(balls, {(p.x + 3) % 48, p.y, p.z}, 2);
  });
  const FieldBlocks best = cutIntoBlocks(field, {.block = {8, 8, 8}});
  for (int phase = 0; phase < 8; ++phase)
    EXPECT_GE(best.repetition,
              cutIntoBlocks(field, {.block = {8, 8, 8}, .phase = Vec3i{phase, 0, 0}}).repetition);
  EXPECT_EQ(best.grid.labelCount(), 2);
}

TEST(FieldBlocks, ShareALabelOnlyWithinTheTolerance) {
  const DistanceField field = ground({64, 48, 32});
  for (const double tolerance : {0.0, 0.3, 1.0}) {
    const FieldBlocks blocks =
        cutIntoBlocks(field, {.block = {4, 4, 4}, .tolerance = tolerance, .truncation = 1.5});
    std::int64_t cells = 0;
    double farthest = 0;
    for (std::size_t l = 0; l < blocks.members.size(); ++l) {
      cells += static_cast<std::int64_t>(blocks.members[l].size());
      const Vec3i first = blocks.phase + times(blocks.members[l][0], blocks.block);
      for (const Vec3i& member : blocks.members[l]) {
        EXPECT_EQ(blocks.grid.cells[member], l);
        const Vec3i at = blocks.phase + times(member, blocks.block);
        for (int s = 0; s < 64; ++s) {
          const Vec3i o{s % 4, s / 4 % 4, s / 16};
          farthest = std::max(farthest, std::abs(truncatedAt(field, first + o, 1.5) -
                                                 truncatedAt(field, at + o, 1.5)));
        }
      }
      EXPECT_EQ(std::ranges::count(blocks.members[l], blocks.medoid[l]), 1);
    }
    EXPECT_LE(farthest, tolerance + 1e-5);
    EXPECT_EQ(cells, static_cast<std::int64_t>(blocks.grid.cells.count()));
  }
}

TEST(FieldBlocks, PutBackAsTheyStoodAreTheExample) {
  const DistanceField field = ground({40, 33, 26});
  // Without tolerance members are equal where it counts; medoids of one member are themselves.
  const FieldBlocks blocks =
      cutIntoBlocks(field, {.block = {6, 5, 7}, .tolerance = 0, .truncation = 50});
  const PlacedBlocks placed = placeBlocks(field, blocks, blocks.grid.cells);
  ASSERT_EQ(placed.field.size(), times(blocks.grid.size(), blocks.block));
  for (std::size_t s = 0; s < placed.field.values.count(); ++s) {
    const Vec3i p = placed.field.values.ijk(s);
    ASSERT_EQ(placed.field.values[p], field.values[blocks.phase + p]);
  }
  EXPECT_EQ(placed.field.voxelSize, field.voxelSize);
}

TEST(FieldBlocks, OriginsSayWhereEverySampleCameFrom) {
  const DistanceField field = lattice({50, 50, 50}, {10, 10, 10}, {4, 4, 4});
  const FieldBlocks blocks = cutIntoBlocks(field);
  Array3D<Label> labels({7, 3, 2});
  const PlacedBlocks placed = placeBlocks(field, blocks, labels);
  EXPECT_EQ(placed.field.size(), (Vec3i{70, 30, 20}));
  for (std::size_t s = 0; s < placed.origins.count(); ++s)
    ASSERT_EQ(placed.field.values.data()[s], field.values[placed.origins.data()[s].cell()]);
}

TEST(FieldBlocks, ChooseTheMemberThatAgreesWithItsNeighbors) {
  // A sheet at four heights that differ by less than the tolerance, one in each quarter along y:
  // each row of a result keeps to the height it began with.
  const DistanceField field = makeField(
      {32, 32, 12}, [](const Vec3i& p) { return std::abs(p.z - 6.0 - 0.1 * (p.y / 8)) - 1.5; });
  const FieldBlocks blocks = cutIntoBlocks(field, {.block = {8, 8, 12}, .tolerance = 0.4});
  ASSERT_EQ(blocks.grid.labelCount(), 1);
  const PlacedBlocks placed = placeBlocks(field, blocks, Array3D<Label>({5, 1, 1}));
  for (int i = 0; i < 40; ++i)
    EXPECT_EQ(placed.field.values(i, 3, 5), placed.field.values(0, 3, 5));
}

TEST(FieldBlocks, ThatOverlapMayStandWhereTheirSharedSamplesAgree) {
  // Hills without a period; blocks at every place along x and y.
  const DistanceField field = ground({28, 24, 20});
  const FieldBlocks blocks = cutIntoBlocks(
      field, {.block = {6, 5, 20}, .tolerance = 0.25, .truncation = 1.5, .overlap = 2});
  EXPECT_EQ(blocks.stride, (Vec3i{4, 3, 20}));
  EXPECT_EQ(blocks.step, (Vec3i{1, 1, 20}));
  EXPECT_EQ(blocks.grid.size(), (Vec3i{23, 20, 1}));
  const int labels = blocks.grid.labelCount();
  ASSERT_EQ(blocks.adjacency.labelCount, labels);
  EXPECT_TRUE(blocks.adjacency.rules[2].pairs.empty());  // one block high
  const auto sample = [&](Label l, const Vec3i& p) {
    return truncatedAt(field, blocks.phase + times(blocks.members[l][0], blocks.step) + p, 1.5);
  };
  for (int axis = 0; axis < 2; ++axis) {
    const PairRule& rule = blocks.adjacency.rules[axis];
    std::int64_t allowed = 0;
    for (Label a = 0; a < labels; ++a)
      for (Label b = 0; b < labels; ++b) {
        // Brute force over the samples that b shares with a, a stride before it.
        double farthest = 0;
        Vec3i size = blocks.block;
        size[axis] = 2;
        for (int n = 0; n < volume(size); ++n) {
          const Vec3i p{n % size.x, n / size.x % size.y, n / (size.x * size.y)};
          Vec3i q = p;
          q[axis] += blocks.stride[axis];
          farthest = std::max(farthest, std::abs(sample(a, q) - sample(b, p)));
        }
        if (std::abs(farthest - 0.5) < 1e-3) continue;  // rounding decides
        ASSERT_EQ(rule.allows(a, b), farthest < 0.5) << axis << ": " << a << ", " << b;
        allowed += rule.allows(a, b);
      }
    EXPECT_GT(allowed, labels);
    EXPECT_LT(allowed, std::int64_t{labels} * labels / 4);
  }
  // Every pair that the example shows is one of them, as often as it shows it.
  std::int64_t shown = 0;
  for (std::size_t c = 0; c < blocks.grid.cells.count(); ++c) {
    const Vec3i cell = blocks.grid.cells.ijk(c), next = cell + Vec3i{4, 0, 0};
    if (!blocks.grid.cells.contains(next)) continue;
    ++shown;
    ASSERT_TRUE(blocks.adjacency.rules[0].allows(blocks.grid.cells[cell], blocks.grid.cells[next]));
  }
  std::int64_t counted = 0;
  for (const LabelPair& pair : blocks.adjacency.rules[0].pairs) counted += pair.count;
  EXPECT_GE(counted, shown);
}

TEST(FieldBlocks, ThatOverlapAreTakenLessDenselyWhereThereAreTooMany) {
  const DistanceField field = ground({72, 72, 12});  // 65² places
  const FieldBlocks blocks =
      cutIntoBlocks(field, {.block = {8, 8, 12}, .tolerance = 0, .overlap = 2});
  EXPECT_EQ(blocks.step, (Vec3i{2, 2, 12}));
  EXPECT_LE(blocks.grid.labelCount(), 4096);
}

TEST(FieldBlocks, ThatOverlapArePutBackByTheirStride) {
  const DistanceField field = ground({30, 28, 20});
  const FieldBlocks blocks =
      cutIntoBlocks(field, {.block = {6, 6, 20}, .tolerance = 0, .truncation = 50, .overlap = 2});
  // Every fourth place of the example, as it is there.
  Array3D<Label> labels({6, 5, 1});
  for (std::size_t c = 0; c < labels.count(); ++c)
    labels.data()[c] = blocks.grid.cells[times(labels.ijk(c), {4, 4, 1})];
  const PlacedBlocks placed = placeBlocks(field, blocks, labels);
  ASSERT_EQ(placed.field.size(), (Vec3i{24, 20, 20}));
  for (std::size_t s = 0; s < placed.field.values.count(); ++s)
    ASSERT_EQ(placed.field.values.data()[s], field.values[placed.field.values.ijk(s)]);
}

TEST(FieldBlocks, AreRecognizedInTheExampleAndInPartsOfIt) {
  const DistanceField field = ground({64, 48, 32});
  const FieldBlocks blocks = cutIntoBlocks(field, {.block = {8, 8, 32}});
  const RecognizedBlocks whole = recognizeBlocks(field, field, blocks);
  EXPECT_EQ(whole.unknown, 0);
  EXPECT_EQ(whole.phase, blocks.phase);
  EXPECT_EQ(whole.grid.cells, blocks.grid.cells);
  EXPECT_EQ(findViolations(whole.grid, blocks.grid).count, 0);

  // Cut off elsewhere: the phase moves along.
  const Vec3i from{3, 5, 0};
  DistanceField part = makeField(
      {50, 40, 32}, [&](const Vec3i& p) { return field.values[p + from] / field.voxelSize; });
  const RecognizedBlocks found = recognizeBlocks(part, field, blocks);
  EXPECT_EQ(found.unknown, 0);
  EXPECT_EQ(findViolations(found.grid, blocks.grid).count, 0);
}

TEST(FieldBlocks, ThatAnExampleHasNotAreUnknown) {
  const DistanceField field = ground({64, 48, 32});
  const FieldBlocks blocks = cutIntoBlocks(field, {.block = {8, 8, 32}});
  DistanceField other = field;
  // A shaft through one block: it is none of the example's, nor are its pairs.
  for (int z = 0; z < 32; ++z)
    for (int y = 18; y < 21; ++y)
      for (int x = 19; x < 22; ++x) other.values[Vec3i{x, y, z}] = 1;
  const RecognizedBlocks found = recognizeBlocks(other, field, blocks);
  EXPECT_EQ(found.unknown, 1);
  EXPECT_EQ(findViolations(found.grid, blocks.grid).count, 4);
  // Two blocks of the example, exchanged: known, but strangers to their neighbors.
  DistanceField exchanged = field;
  for (int z = 0; z < 32; ++z)
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x)
        std::swap(exchanged.values[blocks.phase + Vec3i{x, y, z}],
                  exchanged.values[blocks.phase + Vec3i{x + 32, y + 24, z}]);
  const RecognizedBlocks swapped = recognizeBlocks(exchanged, field, blocks);
  EXPECT_EQ(swapped.unknown, 0);
  // One is at a corner, with two neighbors; the other has four. No pair is the example's.
  EXPECT_EQ(findViolations(swapped.grid, blocks.grid).count, 6);
}

TEST(FieldBlocks, KnowTheSidesWhereTheirExampleIsCut) {
  using Sides = std::array<bool, 6>;
  EXPECT_EQ(cutSides(ground({24, 24, 24})), (Sides{true, true, true, true, true, false}));
  const DistanceField ball = lattice({20, 20, 20}, {20, 20, 20}, {0, 0, 0});
  EXPECT_EQ(cutSides(ball), Sides{});
}

TEST(FieldBlocks, AreTheSameAtOneAndEightThreads) {
  const DistanceField field = ground({48, 48, 24});
  tbb::task_arena one(1), eight(8);
  const auto cut = [&] { return cutIntoBlocks(field, {.tolerance = 1}); };
  const FieldBlocks a = one.execute(cut), b = eight.execute(cut);
  EXPECT_EQ(a.grid.cells, b.grid.cells);
  EXPECT_EQ(a.phase, b.phase);
  EXPECT_EQ(a.medoid, b.medoid);
  const auto overlapped = [&] {
    return cutIntoBlocks(field, {.block = {6, 6, 24}, .tolerance = 0.5, .overlap = 2});
  };
  const FieldBlocks c = one.execute(overlapped), d = eight.execute(overlapped);
  EXPECT_EQ(c.grid.cells, d.grid.cells);
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_EQ(c.adjacency.rules[axis].pairs, d.adjacency.rules[axis].pairs);
  const auto recognize = [&] { return recognizeBlocks(field, field, a); };
  EXPECT_EQ(one.execute(recognize).grid.cells, eight.execute(recognize).grid.cells);
}

TEST(FieldBlocks, RefuseWhatTheyCannotHonor) {
  const DistanceField field = ground({24, 24, 16});
  const auto error = [&](const FieldBlocksOptions& options) {
    return test::errorOf([&] { return cutIntoBlocks(field, options); });
  };
  EXPECT_THAT(error({.block = {1, 8, 8}}), HasSubstr("`block` 1: each side must be 2 to 64"));
  EXPECT_THAT(error({.block = {65, 8, 8}}), HasSubstr("`block` 65"));
  EXPECT_THAT(error({.block = {32, 8, 8}}), HasSubstr("`block` 32: larger than the field"));
  EXPECT_THAT(error({.block = {8, 8, 8}, .phase = Vec3i{8, 0, 0}}), HasSubstr("`phase` 8"));
  EXPECT_THAT(error({.tolerance = -1}), HasSubstr("`tolerance`: must be 0 voxels or more"));
  EXPECT_THAT(error({.tolerance = std::nan("")}), HasSubstr("`tolerance`"));
  EXPECT_THAT(error({.truncation = 0}), HasSubstr("`truncation`: must be more than 0"));
  EXPECT_THAT(error({.block = {8, 8, 8}, .overlap = 8}), HasSubstr("`overlap` 8: blocks of 8"));
  EXPECT_THAT(error({.block = {8, 8, 8}, .overlap = -1}), HasSubstr("`overlap` -1: must be 0 to"));
  const FieldBlocks overlapping = cutIntoBlocks(field, {.block = {8, 8, 16}, .overlap = 4});
  EXPECT_THAT(test::errorOf([&] { return recognizeBlocks(field, field, overlapping); }),
              HasSubstr("cannot be recognized"));
  const FieldBlocks blocks = cutIntoBlocks(field, {.block = {8, 8, 8}});
  const DistanceField thin = ground({4, 24, 16});
  EXPECT_THAT(test::errorOf([&] { return recognizeBlocks(thin, field, blocks); }),
              HasSubstr("smaller than a block of 8 samples"));
  EXPECT_THAT(test::errorOf([&] { return placeBlocks(field, blocks, {}); }),
              HasSubstr("has no cells"));
  const Array3D<Label> unknown({2, 2, 2}, 60000);
  EXPECT_THAT(test::errorOf([&] { return placeBlocks(field, blocks, unknown); }),
              HasSubstr("label 60000"));
}

TEST(FieldBlocks, EveryStepHearsCancellation) {
  const DistanceField field = ground({24, 24, 16});
  const FieldBlocks blocks = cutIntoBlocks(field, {.block = {8, 8, 8}});
  test::expectHearsCancellation([&](const Progress& p) { (void)cutIntoBlocks(field, {}, p); });
  test::expectHearsCancellation([&](const Progress& p) {
    (void)cutIntoBlocks(field, {.block = {8, 8, 16}, .overlap = 4}, p);
  });
  test::expectHearsCancellation(
      [&](const Progress& p) { (void)recognizeBlocks(field, field, blocks, p); });
  test::expectHearsCancellation(
      [&](const Progress& p) { (void)placeBlocks(field, blocks, blocks.grid.cells, p); });
}

}  // namespace
}  // namespace exemplar
