// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "search/block_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>

#include "core/cells.h"
#include "core/error.h"
#include "definitions.h"
#include "fields.h"
#include "search/linear_scan.h"
#include "tests/threads.h"

namespace exemplar {
namespace {

using Levels = Array3D<std::uint8_t>;
using Query = BlockQuery<std::uint8_t>;

struct Case {
  const char* name;
  Levels source, target;
};

std::vector<Case> cases() {
  std::vector<Case> result;
  result.push_back({"balls", fields::quantized(fields::ballPacking(30, 5, 1), 5),
                    fields::quantized(fields::ballPacking(30, 5, 2), 5)});
  result.push_back({"narrow band", fields::quantized(fields::ballPacking(30, 9, 3), 1.5),
                    fields::quantized(fields::ballPacking(30, 9, 4), 1.5)});
  result.push_back({"terrain", fields::quantized(fields::terrain(30, 1), 15),
                    fields::quantized(fields::terrain(30, 2), 15)});
  result.push_back({"noise", fields::noise({24, 21, 22}, 1), fields::noise({24, 24, 24}, 2)});
  result.push_back(
      {"two levels", fields::noise({22, 20, 21}, 1, 2), fields::noise({24, 24, 24}, 2, 2)});
  result.push_back({"constant", Levels({19, 20, 21}, 90), Levels({24, 24, 24}, 93)});
  // The same along y: every block is repeated there.
  Levels extruded({26, 25, 24});
  for (std::size_t s = 0; s < extruded.count(); ++s) {
    const Vec3i p = extruded.ijk(s);
    extruded.data()[s] = static_cast<std::uint8_t>(5 * p.x + 3 * (p.z / 4));
  }
  result.push_back({"extruded", extruded, extruded});
  return result;
}

Query masked(Levels samples, std::uint64_t trial) {
  const Vec3i size = samples.size();
  Query query{std::move(samples), {}};
  switch (trial % 6) {
    case 0:
      break;
    case 1:
      query.known = fields::withoutOctant(size, int(trial / 6 % 8));
      break;
    case 2:
      query.known = fields::randomMask(size, 0.9, trial);
      break;
    case 3:
      query.known = fields::randomMask(size, 0.1, trial);
      break;
    case 4:
      query.known = Levels(size, trial % 12 == 4 ? 0 : 1);
      break;
    default:  // a wedge that no cell border follows
      query.known = Levels(size, 1);
      for (std::size_t s = 0; s < query.known.count(); ++s)
        if (query.known.ijk(s).x + 2 * query.known.ijk(s).y > size.x + 1) query.known.data()[s] = 0;
  }
  return query;
}

TEST(BlockIndex, FindsExactlyTheLinearScansMinimum) {
  for (const Case& c : cases())
    for (const Vec3i& block : {Vec3i{8, 8, 8}, Vec3i{16, 16, 16}, Vec3i{7, 7, 7}, Vec3i{4, 9, 6},
                               Vec3i{10, 6, 14}, Vec3i{12, 1, 1}, Vec3i{2, 2, 3}, Vec3i{1, 1, 1}})
      for (int side : {1, 2}) {
        const BlockIndex<std::uint8_t> index(c.source, block, {.boxSide = side});
        for (std::uint64_t trial = 0; trial < 18; ++trial) {
          const Query query = masked(fields::octantQuery(c.target, block, trial).samples, trial);
          EXPECT_EQ(index.findBest(query), linearScan(c.source, query))
              << c.name << ", block " << block.x << ' ' << block.y << ' ' << block.z << ", side "
              << side << ", trial " << trial;
        }
      }
}

TEST(BlockIndex, FindsExactlyTheLinearScansMinimumOfLargeBlocks) {
  // Large enough for features of the cells' eighths.
  const auto source = fields::quantized(fields::ballPacking(48, 9, 1), 9);
  const auto target = fields::quantized(fields::ballPacking(48, 9, 2), 9);
  for (const Vec3i& block : {Vec3i{32, 32, 32}, Vec3i{24, 24, 24}, Vec3i{40, 24, 20}}) {
    const BlockIndex<std::uint8_t> index(source, block, {.boxSide = 2});
    for (std::uint64_t trial = 0; trial < 24; ++trial) {
      const Query query = masked(fields::octantQuery(target, block, trial).samples, trial);
      EXPECT_EQ(index.findBest(query), linearScan(source, query)) << "trial " << trial;
    }
  }
}

TEST(BlockIndex, FindsExactlyTheLinearScansMinimumInFloats) {
  std::vector<std::pair<Array3D<float>, Array3D<float>>> pairs;
  pairs.emplace_back(fields::ballPacking(26, 5, 1), fields::ballPacking(26, 5, 2));
  pairs.emplace_back(fields::terrain(26, 1), fields::terrain(26, 2));
  // Values far from zero, of small range.
  pairs.push_back(pairs[0]);
  for (float& v : pairs[2].first.values()) v = 5000 + v / 50;
  for (float& v : pairs[2].second.values()) v = 5000 + v / 50;
  for (const auto& [source, target] : pairs)
    for (const Vec3i& block : {Vec3i{8, 8, 8}, Vec3i{5, 7, 6}})
      for (int side : {1, 2}) {
        const BlockIndex<float> index(source, block, {.boxSide = side});
        for (std::uint64_t trial = 0; trial < 12; ++trial) {
          auto query = fields::octantQuery(target, block, trial);
          query.known = masked(Levels(block), trial).known;
          EXPECT_EQ(index.findBest(query), linearScan(source, query)) << "trial " << trial;
        }
      }
}

TEST(BlockIndex, FindsItsOwnBlocks) {
  const auto source = fields::quantized(fields::ballPacking(30, 5, 1), 5);
  const BlockIndex<std::uint8_t> index(source, {8, 8, 8});
  for (std::uint64_t trial = 0; trial < 20; ++trial)
    EXPECT_EQ(index.findBest(fields::octantQuery(source, {8, 8, 8}, trial)).distance, 0);
}

// The linear scan's answer over several sources.
BlockMatch scanAll(const std::vector<Levels>& sources, const Query& query) {
  BlockMatch best = linearScan(sources[0], query);
  for (std::size_t s = 1; s < sources.size(); ++s) {
    BlockMatch match = linearScan(sources[s], query);
    match.source = int(s);
    if (match.distance < best.distance) best = match;
  }
  return best;
}

// The nearest of the blocks that a mask allows, by the definition.
BlockMatch nearestAllowed(const Levels& source, const Array3D<std::uint8_t>& allowed,
                          const Query& query, std::int64_t& count) {
  BlockMatch best;
  count = 0;
  forEachCell(blockPositions(source.size(), query.samples.size()), [&](const Vec3i& p) {
    if (!allowed[p]) return;
    const double distance = blockDistance(source, p, query);
    if (count++ == 0 || distance < best.distance) best = {p, distance, 0};
  });
  return best;
}

TEST(BlockIndex, SearchesSeveralSourcesAtOnce) {
  const std::vector<Levels> sources{fields::quantized(fields::ballPacking(20, 5, 1), 5),
                                    fields::quantized(fields::terrain(24, 1), 6),
                                    fields::quantized(fields::ballPacking(20, 5, 1), 5),
                                    fields::noise({17, 16, 15}, 3)};
  const auto target = fields::quantized(fields::ballPacking(20, 5, 2), 5);
  for (int side : {1, 2}) {
    const BlockIndex<std::uint8_t> index(sources, {7, 8, 6}, {.boxSide = side});
    EXPECT_EQ(index.sources(), 4);
    for (std::uint64_t trial = 0; trial < 18; ++trial) {
      const Query query = masked(fields::octantQuery(target, {7, 8, 6}, trial).samples, trial);
      EXPECT_EQ(index.findBest(query), scanAll(sources, query));
    }
  }
}

TEST(BlockIndex, FindsOnlyWhatIsAllowed) {
  for (const Case& c : cases())
    for (int side : {1, 2})
      for (double share : {0.5, 0.01}) {
        auto allowed = fields::randomMask(c.source.size(), share, 7);
        allowed(3, 4, 5) = 1;
        const BlockIndex<std::uint8_t> index(c.source, {8, 8, 8},
                                             {.allowed = {&allowed}, .boxSide = side});
        for (std::uint64_t trial = 0; trial < 12; ++trial) {
          const Query query =
              masked(fields::octantQuery(c.target, {8, 8, 8}, trial).samples, trial);
          std::int64_t count = 0;
          const BlockMatch expected = nearestAllowed(c.source, allowed, query, count);
          EXPECT_EQ(index.positions(), count);
          EXPECT_EQ(index.findBest(query), expected) << c.name << ", trial " << trial;
        }
      }
}

TEST(BlockIndex, HintsNeverChangeTheAnswer) {
  // Large enough for the bounds to pay: nothing is left to a scan.
  const Case c{"balls", fields::quantized(fields::ballPacking(48, 6, 1), 6),
               fields::quantized(fields::ballPacking(48, 6, 2), 6)};
  const BlockIndex<std::uint8_t> index(c.source, {8, 8, 8});
  std::int64_t plain = 0, hinted = 0;
  for (std::uint64_t trial = 0; trial < 30; ++trial) {
    const Query query = fields::octantQuery(c.target, {8, 8, 8}, trial);
    const BlockMatch expected = linearScan(c.source, query);
    const std::vector<BlockMatch> wrong{{{1, 2, 3}, 0, 0},
                                        {{99, 0, 0}, 0, 0},
                                        {{0, 0, 0}, 0, 5},
                                        {{-1, 0, 0}, 0, 0},
                                        {{40, 40, 40}, 0, 0}};
    EXPECT_EQ(index.findBest(query, wrong), expected);
    BlockIndexStatistics without, with;
    index.findBest(query, {}, &without);
    EXPECT_EQ(index.findBest(query, std::vector<BlockMatch>{expected}, &with), expected);
    EXPECT_FALSE(without.scanned);
    plain += without.leaves;
    hinted += with.leaves;
  }
  EXPECT_LT(hinted, plain);
}

TEST(BlockIndex, LooksAtFewBlocksOfSmoothFieldsAndScansNoise) {
  const auto source = fields::quantized(fields::ballPacking(48, 6, 1), 6);
  const auto target = fields::quantized(fields::ballPacking(48, 6, 2), 6);
  const BlockIndex<std::uint8_t> index(source, {8, 8, 8});
  std::int64_t blocks = 0;
  for (std::uint64_t trial = 0; trial < 30; ++trial) {
    BlockIndexStatistics statistics;
    index.findBest(fields::octantQuery(target, {8, 8, 8}, trial), {}, &statistics);
    EXPECT_FALSE(statistics.scanned);
    blocks += statistics.blocks;
  }
  EXPECT_LT(blocks / 30, index.positions() / 500);

  const auto noise = fields::noise({40, 40, 40}, 1);
  const BlockIndex<std::uint8_t> hopeless(noise, {8, 8, 8});
  for (std::uint64_t trial = 0; trial < 3; ++trial) {
    const Query query = fields::octantQuery(fields::noise({40, 40, 40}, 2), {8, 8, 8}, trial);
    BlockIndexStatistics statistics;
    EXPECT_EQ(hopeless.findBest(query, {}, &statistics), linearScan(noise, query));
    EXPECT_TRUE(statistics.scanned);
    // What was spent before the scan took over.
    EXPECT_LT(statistics.blocks, hopeless.positions() / 10);
  }
}

TEST(BlockIndex, TakesAtMostTwelveBytesASample) {
  const auto source = fields::quantized(fields::ballPacking(96, 10, 1), 10);
  for (int n : {8, 16, 32}) {
    const BlockIndex<std::uint8_t> index(source, {n, n, n}, {.boxSide = 2});
    EXPECT_LE(index.bytes(), 12 * std::int64_t(source.count())) << n;
  }
}

TEST(BlockIndex, IsTheSameAtOneAndEightThreads) {
  const Case c = cases()[0];
  for (int side : {1, 2}) {
    const auto make = [&] {
      return BlockIndex<std::uint8_t>(c.source, {8, 8, 8}, {.boxSide = side});
    };
    const auto a = testing::onThreads(1, make), b = testing::onThreads(8, make);
    for (std::uint64_t trial = 0; trial < 30; ++trial) {
      const Query query = fields::octantQuery(c.target, {8, 8, 8}, trial);
      BlockIndexStatistics sa, sb;
      EXPECT_EQ(a.findBest(query, {}, &sa), b.findBest(query, {}, &sb));
      EXPECT_EQ(sa.nodes, sb.nodes);
      EXPECT_EQ(sa.leaves, sb.leaves);
      EXPECT_EQ(sa.blocks, sb.blocks);
    }
  }
}

TEST(BlockIndex, IsNotBuiltWhenCancelled) {
  const Case c = cases()[0];
  const std::atomic<bool> cancel = true;
  EXPECT_THROW(BlockIndex<std::uint8_t>(c.source, {8, 8, 8}, {}, Progress({}, &cancel)), Cancelled);
}

TEST(BlockIndex, RefusesWhatItCannotHonor) {
  const Levels field({20, 20, 20}, 5), none({20, 20, 20}, 0), small({5, 5, 5}, 1);
  using Index = BlockIndex<std::uint8_t>;
  EXPECT_THROW(Index(field, {8, 21, 8}), InputError);
  EXPECT_THROW(Index(field, {8, 0, 8}), InputError);
  EXPECT_THROW(Index(std::vector<Levels>{}, {8, 8, 8}), InputError);
  EXPECT_THROW(Index(field, {8, 8, 8}, {.boxSide = 3}), InputError);
  EXPECT_THROW(Index(field, {8, 8, 8}, {.allowed = {&none}}), InputError);
  EXPECT_THROW(Index(field, {8, 8, 8}, {.allowed = {&small}}), InputError);
  EXPECT_THROW(Index(field, {8, 8, 8}, {.allowed = {nullptr, nullptr}}), InputError);
  const Index index(field, {8, 8, 8});
  EXPECT_THROW(index.findBest({Levels({8, 8, 7}), {}}), InputError);
}

}  // namespace
}  // namespace exemplar
