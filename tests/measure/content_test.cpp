// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Each figure of what labels hold fails on the fault that it is there for.

#include "measure/content.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/cells.h"
#include "core/error.h"
#include "core/random.h"
#include "tests/progress_checks.h"
#include "tests/threads.h"

namespace exemplar {
namespace {

enum : Label { kAir, kGrass, kStreet, kWall, kRoof, kTree, kLabels };

LabelGrid emptyTown(const Vec3i& size) {
  LabelGrid town;
  town.cells = Array3D<Label>(size, kAir);
  town.labels.resize(kLabels);
  town.labels[kAir] = emptyLook();
  forEachCell(CellBox{{}, {size.x, size.y, 1}}, [&](const Vec3i& p) { town.cells[p] = kGrass; });
  return town;
}

/// Lots of 6 x 8 columns on a lawn, along streets in x: a house, two trees or nothing in each.
LabelGrid town(const Vec3i& size, std::uint64_t seed, double trees = 0.03) {
  LabelGrid town = emptyTown(size);
  for (int y = 0; y < size.y; y += 8)
    for (int x = 0; x < size.x; ++x) town.cells(x, y, 0) = kStreet;
  const Random random(seed);
  // Trees anywhere on the lawn, so that no two gardens are alike.
  forEachCell(CellBox{{0, 0, 1}, {size.x, size.y, 2}}, [&](const Vec3i& p) {
    const auto cell = static_cast<std::uint64_t>(town.cells.index(p));
    if (town.cells(p.x, p.y, 0) == kGrass && random.uniform(cell, 1) < trees) town.cells[p] = kTree;
  });
  std::uint64_t lot = 0;
  for (int y = 2; y + 5 <= size.y; y += 8) {
    for (int x = 1; x + 5 <= size.x; x += 6) {
      const std::uint64_t draw = random.bits(lot++, 0) >> 32;
      const int width = 2 + static_cast<int>(draw % 3), depth = 2 + static_cast<int>(draw / 3 % 3);
      const int height = 1 + static_cast<int>(draw / 9 % 3);
      if (draw / 27 % 4 == 0) continue;
      if (draw / 27 % 4 == 1) {
        town.cells(x, y, 1) = town.cells(x + 2, y + 1, 1) = kTree;
        continue;
      }
      forEachCell(CellBox{{x, y, 1}, {x + width, y + depth, 1 + height}},
                  [&](const Vec3i& p) { town.cells[p] = kWall; });
      forEachCell(CellBox{{x, y, 1 + height}, {x + width, y + depth, 2 + height}},
                  [&](const Vec3i& p) { town.cells[p] = kRoof; });
    }
  }
  return town;
}

template <class Source>
LabelGrid like(const LabelGrid& grid, const Vec3i& size, const Source& source) {
  LabelGrid made = grid;
  made.cells = Array3D<Label>(size);
  forEachCell(size, [&](const Vec3i& p) { made.cells[p] = grid.cells[source(p)]; });
  return made;
}

const Vec3i kSize{120, 96, 6};
const LabelGrid& example() {
  static const LabelGrid grid = town(kSize, 1);
  return grid;
}

TEST(Content, OfTheExampleItselfIsPerfectButCopied) {
  const Content c = measureContent(example(), example());
  EXPECT_EQ(c.labelsUsed, 1);
  EXPECT_EQ(c.labelShares, 0);
  EXPECT_EQ(c.density, 1);
  for (const double js : c.divergence) EXPECT_NEAR(js, 0, 1e-12);
  EXPECT_EQ(c.known, 1);
  EXPECT_EQ(c.layers, 0);
  EXPECT_EQ(c.objects, c.exampleObjects);
  EXPECT_EQ(c.objectSizes, 0);
  for (const auto& runs : c.runs) EXPECT_EQ(runs, 1);
  EXPECT_EQ(c.copied, 1);
}

TEST(Content, OfAFreshSampleOfTheSameProcessIsGoodAndNew) {
  const Content c = measureContent(example(), town({180, 144, 6}, 2));
  EXPECT_EQ(c.labelsUsed, 1);
  EXPECT_LT(c.labelShares, 0.03);
  EXPECT_NEAR(*c.density, 1, 0.25);
  EXPECT_LT(c.divergence[0], 0.02);
  EXPECT_LT(*c.layers, 0.3);
  EXPECT_NEAR(c.objects / c.exampleObjects, 1, 0.25);
  EXPECT_LT(*c.objectSizes, 0.35);
  for (const auto& runs : c.runs) EXPECT_NEAR(*runs, 1, 0.35);
  EXPECT_LT(c.copied, 0.2);
  // Its blocks are as the example's halves are to each other, or better.
  for (std::size_t side = 0; side < 3; ++side)
    EXPECT_LT(c.divergence[side], *c.halvesDivergence[side] + 0.05);
}

TEST(Content, OfAnEmptyLawnIsNothing) {
  const Content c = measureContent(example(), emptyTown(kSize));
  EXPECT_EQ(c.density, 0);
  EXPECT_EQ(c.layers, 1);
  EXPECT_NEAR(c.labelsUsed, 2.0 / 6, 1e-12);
  EXPECT_EQ(c.objects, 0);
  EXPECT_FALSE(c.objectSizes);
  EXPECT_EQ(c.divergence[2], 1);
}

TEST(Content, OfOneLabelEverywhereUsesOneLabel) {
  LabelGrid walls = example();
  std::ranges::fill(walls.cells.values(), Label{kWall});
  const Content c = measureContent(example(), walls);
  EXPECT_NEAR(c.labelsUsed, 1.0 / 6, 1e-12);
  EXPECT_GT(*c.density, 5);
  EXPECT_GT(c.labelShares, 0.8);
  EXPECT_GT(c.divergence[0], 0.2);
  EXPECT_EQ(c.objectSizes, 1);
}

TEST(Content, OfTheExampleTiledIsCopied) {
  const LabelGrid tiled = like(example(), {240, 192, 6}, [](const Vec3i& p) {
    return Vec3i{p.x % kSize.x, p.y % kSize.y, p.z};
  });
  const Content c = measureContent(example(), tiled);
  EXPECT_NEAR(*c.density, 1, 1e-12);
  // All windows but those across a joint.
  EXPECT_GT(c.copied, 0.7);
}

TEST(Content, OfATransposedResultHasOtherRunsAndBlocks) {
  const LabelGrid turned = like(example(), {kSize.y, kSize.x, kSize.z}, [](const Vec3i& p) {
    return Vec3i{p.y, p.x, p.z};
  });
  const Content c = measureContent(example(), turned);
  EXPECT_NEAR(*c.density, 1, 1e-12);
  EXPECT_EQ(c.labelsUsed, 1);
  EXPECT_LT(*c.runs[0], 0.8);
  EXPECT_GT(*c.runs[1], 1.25);
  EXPECT_LT(c.known, 0.75);
  EXPECT_GT(c.divergence[2], 0.1);
}

TEST(Content, OfMergedHousesHasOtherObjects) {
  // Every other column of air between the lots filled: the same labels, fewer and larger objects.
  LabelGrid merged = example();
  for (int y = 2; y < kSize.y; y += 8)
    for (int x = 0; x < kSize.x; ++x)
      if (merged.cells(x, y, 1) == kAir) merged.cells(x, y, 1) = kWall;
  const Content c = measureContent(example(), merged);
  EXPECT_LT(c.objects, c.exampleObjects / 2);
  EXPECT_GT(*c.objectSizes, 0.2);
}

TEST(Content, CountsHousesThatAStreetJoinsOneByOne) {
  // A raised street that touches every house: from the layer above it, houses are houses again.
  LabelGrid joined = town(kSize, 1, 0);
  for (int y = 2; y < kSize.y; y += 8)
    for (int x = 0; x < kSize.x; ++x)
      if (joined.cells(x, y, 1) == kAir) joined.cells(x, y, 1) = kStreet;
  const Content c = measureContent(joined, joined);
  EXPECT_EQ(c.objectsFrom, 2);
  EXPECT_GT(c.exampleObjects, 0.5);
}

TEST(Content, OfATownCutOffDiffersByHeight) {
  LabelGrid low = example();
  forEachCell(CellBox{{0, 0, 2}, kSize}, [&](const Vec3i& p) { low.cells[p] = kAir; });
  const Content c = measureContent(example(), low);
  // What is gone is all the difference.
  EXPECT_GT(*c.layers, 0.3);
  EXPECT_NEAR(*c.layers, 1 - *c.density, 1e-12);
}

TEST(Content, TakesFlatGridsAndSmallOnes) {
  const LabelGrid flat = like(example(), {40, 40, 1}, [](const Vec3i& p) { return p; });
  const Content c = measureContent(flat, flat);
  EXPECT_EQ(c.density, 1);
  EXPECT_FALSE(c.runs[2]);
  EXPECT_EQ(c.copied, 1);
  const LabelGrid one = like(example(), {1, 1, 1}, [](const Vec3i& p) { return p; });
  const Content tiny = measureContent(one, one);
  EXPECT_EQ(tiny.labelsUsed, 1);
  EXPECT_FALSE(tiny.density);
  EXPECT_FALSE(tiny.halvesDivergence[0]);
}

TEST(Content, OfSeveralExamplesCountsThemTogether) {
  const LabelGrid second = town(kSize, 3);
  const LabelGrid* const both[] = {&example(), &second};
  EXPECT_EQ(measureContent(both, second).known, 1);
  EXPECT_LT(measureContent(example(), second).known, 1);
}

TEST(Content, RefusesOtherNumberings) {
  LabelGrid other = example();
  other.labels.emplace_back();
  EXPECT_THROW(measureContent(example(), other), InputError);
  other = example();
  other.cells = {};
  EXPECT_THROW(measureContent(example(), other), InputError);
}

}  // namespace
}  // namespace exemplar
