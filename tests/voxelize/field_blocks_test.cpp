// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "voxelize/field_blocks.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/error.h"

namespace exemplar {
namespace {

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
      EXPECT_TRUE(std::ranges::count(blocks.members[l], blocks.medoid[l]) == 1);
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
}

TEST(FieldBlocks, RefuseWhatTheyCannotHonour) {
  const DistanceField field = ground({24, 24, 16});
  EXPECT_THROW(cutIntoBlocks(field, {.block = {1, 8, 8}}), InputError);
  EXPECT_THROW(cutIntoBlocks(field, {.block = {65, 8, 8}}), InputError);
  EXPECT_THROW(cutIntoBlocks(field, {.block = {32, 8, 8}}), InputError);
  EXPECT_THROW(cutIntoBlocks(field, {.block = {8, 8, 8}, .phase = Vec3i{8, 0, 0}}), InputError);
  EXPECT_THROW(cutIntoBlocks(field, {.tolerance = -1}), InputError);
  EXPECT_THROW(cutIntoBlocks(field, {.tolerance = std::nan("")}), InputError);
  EXPECT_THROW(cutIntoBlocks(field, {.truncation = 0}), InputError);
  const FieldBlocks blocks = cutIntoBlocks(field, {.block = {8, 8, 8}});
  EXPECT_THROW(placeBlocks(field, blocks, {}), InputError);
  EXPECT_THROW(placeBlocks(field, blocks, Array3D<Label>({2, 2, 2}, 60000)), InputError);
}

}  // namespace
}  // namespace exemplar
