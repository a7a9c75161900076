// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "search/search_tree.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "definitions.h"
#include "fields.h"
#include "search/linear_scan.h"

namespace exemplar {
namespace {

using Levels = Array3D<std::uint8_t>;
using Query = BlockQuery<std::uint8_t>;

struct NamedField {
  const char* name;
  Levels source, target;
};

std::vector<NamedField> inputs() {
  std::vector<NamedField> result;
  result.push_back({"balls", fields::quantized(fields::ballPacking(28, 5, 1), 5),
                    fields::quantized(fields::ballPacking(28, 5, 2), 5)});
  result.push_back({"terrain", fields::quantized(fields::terrain(28, 1), 4),
                    fields::quantized(fields::terrain(28, 2), 4)});
  result.push_back({"chainmail", fields::quantized(fields::chainmail(28, 10, 1), 2),
                    fields::quantized(fields::chainmail(28, 10, 2), 2)});
  result.push_back({"noise", fields::noise({22, 19, 20}, 1), fields::noise({20, 20, 20}, 2)});
  result.push_back(
      {"two levels", fields::noise({20, 18, 17}, 1, 2), fields::noise({20, 20, 20}, 2, 2)});
  result.push_back({"constant", Levels({18, 17, 19}, 90), Levels({20, 20, 20}, 93)});
  return result;
}

Query masked(Levels samples, std::uint64_t trial) {
  const Vec3i size = samples.size();
  switch (trial % 5) {
    case 0:
      return {std::move(samples), {}};
    case 1:
      return {std::move(samples), fields::withoutOctant(size, int(trial / 5 % 8))};
    case 2:
      return {std::move(samples), fields::randomMask(size, 0.9, trial)};
    case 3:
      return {std::move(samples), fields::randomMask(size, 0.15, trial)};
    default: {
      // A slab that no cell border follows.
      Levels known(size, 1);
      for (std::size_t i = 0; i < known.count(); ++i)
        if (known.ijk(i).x + 2 * known.ijk(i).y > size.x + 1) known.data()[i] = 0;
      return {std::move(samples), std::move(known)};
    }
  }
}

TEST(SearchTree, FindsExactlyTheLinearScansMinimum) {
  for (const NamedField& field : inputs())
    for (int n : {2, 4, 8, 16}) {
      const SearchTree tree(field.source, n);
      for (std::uint64_t trial = 0; trial < 15; ++trial) {
        const Query query =
            masked(fields::octantQuery(field.target, {n, n, n}, trial).samples, trial);
        EXPECT_EQ(tree.findBest(query), linearScan(field.source, query))
            << field.name << ", block " << n << ", trial " << trial;
      }
    }
}

TEST(SearchTree, ANodesBoundNeverExceedsTheDistanceOfABlockBelow) {
  for (const NamedField& field : inputs())
    for (int n : {1, 4, 8}) {
      const SearchTree tree(field.source, n);
      for (std::uint64_t trial = 0; trial < 10; ++trial) {
        const Query query =
            masked(fields::octantQuery(field.target, {n, n, n}, trial).samples, trial);
        const Vec3i positions = blockPositions(field.source.size(), query.samples.size());
        const Random random(trial, 12);
        for (std::uint64_t sample = 0; sample < 60; ++sample) {
          const Vec3i position{int(random.below(positions.x, sample, 0)),
                               int(random.below(positions.y, sample, 1)),
                               int(random.below(positions.z, sample, 2))};
          const double distance = blockDistance(field.source, position, query);
          const auto bounds = tree.boundsAlongPath(query, position);
          // Integers, divided once: the last bound is the distance to the last bit.
          EXPECT_EQ(bounds.back(), distance) << field.name;
          for (std::size_t b = 0; b < bounds.size(); ++b) {
            EXPECT_LE(bounds[b], distance) << field.name << ", node " << b;
            if (b > 0) {
              EXPECT_LE(bounds[b - 1], bounds[b]) << field.name << ", node " << b;
            }
          }
        }
      }
    }
}

TEST(SearchTree, FindsTheBlockItself) {
  const auto source = fields::quantized(fields::ballPacking(28, 5, 1), 5);
  const SearchTree tree(source, 8);
  for (std::uint64_t trial = 0; trial < 10; ++trial) {
    const auto match = tree.findBest({fields::octantQuery(source, {8, 8, 8}, trial).samples, {}});
    EXPECT_EQ(match.distance, 0);
  }
}

TEST(SearchTree, PruningByEquation3ChangesTheQueueAndNotTheAnswer) {
  const auto packing = fields::ballPacking(28, 5, 1);
  const auto other = fields::ballPacking(28, 5, 2);
  const SearchTree tree(fields::quantized(packing, 5), 8);
  const auto target = fields::quantized(other, 5);
  std::int64_t pruned = 0, plainQueue = 0, prunedQueue = 0;
  for (std::uint64_t trial = 0; trial < 20; ++trial) {
    const Query query{fields::octantQuery(target, {8, 8, 8}, trial).samples, {}};
    TreeSearchStatistics plain, measured, lipschitz;
    const auto expected = tree.findBest(query, {}, &plain);
    EXPECT_EQ(expected, tree.findBest(query, {.pruning = QueuePruning::Measured}, &measured));
    // 25.5 levels a sample's spacing, and at most one level for rounding at both ends.
    EXPECT_EQ(
        expected,
        tree.findBest(query, {.pruning = QueuePruning::Lipschitz, .lipschitz = 26.5}, &lipschitz));
    pruned += measured.prunedEntries;
    plainQueue += plain.largestQueue;
    prunedQueue += measured.largestQueue;
    EXPECT_LE(lipschitz.largestQueue, plain.largestQueue);
  }
  EXPECT_GT(pruned, 0);
  EXPECT_LT(prunedQueue, plainQueue);
}

TEST(SearchTree, PruningByMeasuredDeviationsIsRightOnAnyField) {
  for (const NamedField& field : inputs()) {
    const SearchTree tree(field.source, 4);
    for (std::uint64_t trial = 0; trial < 15; ++trial) {
      const Query query =
          masked(fields::octantQuery(field.target, {4, 4, 4}, trial).samples, trial);
      EXPECT_EQ(tree.findBest(query, {.pruning = QueuePruning::Measured}),
                linearScan(field.source, query))
          << field.name;
    }
  }
}

TEST(SearchTree, PruningByAFalsePromiseCanBeWrong) {
  // Checkerboards among constants: their averages agree with a checkerboard's and a constant's
  // alike.
  Levels source({24, 8, 8}, 128);
  for (std::size_t i = 0; i < source.count(); ++i) {
    const Vec3i p = source.ijk(i);
    if (p.x >= 12) source.data()[i] = (p.x + p.y + p.z) % 2 ? 228 : 28;
  }
  Query query{fields::block(source, {14, 2, 2}, {4, 4, 4}), {}};
  query.samples.values()[0] = 100;  // no block of the source is the query
  const SearchTree tree(source, 4);
  const auto expected = linearScan(source, query);
  EXPECT_EQ(tree.findBest(query), expected);
  EXPECT_NE(tree.findBest(query, {.pruning = QueuePruning::Lipschitz, .lipschitz = 0.01}),
            expected);
}

// A linear scan over the field that a tree without its lowest leaves searches: blocks of cells of
// 2^levels samples.
BlockMatch scanSubsampled(const SearchTree& tree, const Query& query, int stride) {
  const Levels& averages = tree.pyramid().averages(tree.droppedLevels());
  const int step = 1 << tree.droppedLevels(), n = tree.blockSize();
  const Vec3i positions = averages.size() - Vec3i{n * step - 1, n * step - 1, n * step - 1};
  BlockMatch best{{}, 1e300, 0};
  for (int k = 0; k < positions.z; k += stride)
    for (int j = 0; j < positions.y; j += stride)
      for (int i = 0; i < positions.x; i += stride) {
        double sum = 0, known = 0;
        for (std::size_t s = 0; s < query.samples.count(); ++s) {
          if (!query.known.empty() && !query.known.data()[s]) continue;
          const double d = double(averages[Vec3i{i, j, k} + query.samples.ijk(s) * step]) -
                           query.samples.data()[s];
          sum += d * d;
          ++known;
        }
        const double distance = known > 0 ? sum / known : 0;
        if (distance < best.distance) best = {{i, j, k}, distance, 0};
      }
  return best;
}

TEST(SearchTree, DroppingLeavesGivesTheTreeOfTheSubsampledField) {
  for (const NamedField& field : inputs()) {
    const SearchTree tree(field.source, 16);
    for (int levels : {1, 2, 3}) {
      const SearchTree coarse = tree.dropLeaves(levels);
      const int n = 16 >> levels;
      EXPECT_EQ(coarse.blockSize(), n);
      EXPECT_LE(coarse.nodes(), tree.nodes());
      for (std::uint64_t trial = 0; trial < 5; ++trial) {
        const Query query =
            masked(fields::octantQuery(field.target, {n, n, n}, trial).samples, trial);
        for (int stride : {1, 1 << levels}) {
          const auto expected = scanSubsampled(coarse, query, stride);
          EXPECT_EQ(coarse.findBest(query, {.positionStride = stride}), expected)
              << field.name << ", " << levels << " levels dropped, stride " << stride;
          EXPECT_EQ(
              tree.dropLeaves(levels - 1).dropLeaves(1).findBest(query, {.positionStride = stride}),
              expected);
        }
        EXPECT_EQ(coarse.findBest(query, {.pruning = QueuePruning::Measured}),
                  scanSubsampled(coarse, query, 1));
      }
    }
  }
}

TEST(SearchTree, GroupsIdenticalBlocks) {
  // All blocks of a constant field are one leaf; level 1 of any field has at most 256 nodes.
  EXPECT_EQ(SearchTree(Levels({20, 20, 20}, 3), 8).nodes(), 1);
  const SearchTree one(fields::noise({16, 16, 16}, 1), 1);
  EXPECT_LE(one.nodes(), 1 + 256);
  // Periodic in x with period 4: a period's blocks are all there are.
  Levels stripes({32, 9, 9});
  for (std::size_t i = 0; i < stripes.count(); ++i)
    stripes.data()[i] = static_cast<std::uint8_t>(60 * (stripes.ijk(i).x % 4));
  EXPECT_LE(SearchTree(stripes, 8).nodes(), 8);
}

TEST(SearchTree, VisitsFarFewerNodesThanThereAreBlocks) {
  const auto source = fields::quantized(fields::ballPacking(48, 6, 1), 6);
  const auto target = fields::quantized(fields::ballPacking(48, 6, 2), 6);
  const SearchTree tree(source, 8);
  std::int64_t visited = 0;
  for (std::uint64_t trial = 0; trial < 20; ++trial) {
    TreeSearchStatistics statistics;
    tree.findBest(fields::octantQuery(target, {8, 8, 8}, trial), {}, &statistics);
    visited += statistics.visitedNodes;
  }
  EXPECT_LT(visited / 20, 41 * 41 * 41 / 10);
}

TEST(SearchTree, RefusesWhatItCannotHonor) {
  EXPECT_THROW(SearchTree(Levels({20, 20, 20}), 12), InputError);
  EXPECT_THROW(SearchTree(Levels({20, 20, 7}), 8), InputError);
  const SearchTree tree(Levels({20, 20, 20}), 4);
  EXPECT_THROW(tree.findBest({Levels({8, 8, 8}), {}}), InputError);
  EXPECT_THROW(tree.findBest({Levels({4, 4, 4}), {}}, {.positionStride = 0}), InputError);
  EXPECT_THROW(
      tree.findBest({Levels({4, 4, 4}), {}}, {.pruning = QueuePruning::Lipschitz, .lipschitz = 0}),
      InputError);
  EXPECT_THROW(tree.dropLeaves(3), InputError);
}

}  // namespace
}  // namespace exemplar
