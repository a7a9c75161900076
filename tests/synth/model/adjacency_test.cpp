// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "voxelize/adjacency.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/random.h"
#include "synth/model/examples.h"
#include "voxelize/error_of.h"
#include "voxelize/hears_cancellation.h"

namespace exemplar {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(FindAdjacency, CountsOrderedPairsAlongEachAxis) {
  const LabelGrid g = test::drawn({{"ab", "aa"}, {"bb", "ba"}});  // a is 1, b is 2
  const Adjacency a = findAdjacency(g);
  ASSERT_EQ(a.rules.size(), 3u);
  EXPECT_EQ(a.labelCount, 3);
  EXPECT_EQ(a.rules[0].offset, (CellOffset{1, 0, 0, 0}));
  EXPECT_THAT(a.rules[0].pairs, ElementsAre(LabelPair{1, 1, 1}, LabelPair{1, 2, 1},
                                            LabelPair{2, 1, 1}, LabelPair{2, 2, 1}));
  EXPECT_EQ(a.rules[1].count(1, 1), 1);
  EXPECT_EQ(a.rules[1].count(2, 1), 2);
  EXPECT_EQ(a.rules[1].count(1, 2), 0);
  EXPECT_EQ(a.rules[2].count(1, 2), 2);
  EXPECT_FALSE(a.rules[2].allows(2, 1));
  EXPECT_THAT(a.frequency, ElementsAre(0, 4, 4));
  EXPECT_THAT(a.side(Side::MinZ), ElementsAre(1, 2));
  EXPECT_THAT(a.side(Side::MaxX), ElementsAre(1, 2));
}

TEST(FindAdjacency, GoesAroundWhereTheExampleIsPeriodic) {
  const LabelGrid g = test::drawnFlat({"abc"});
  EXPECT_FALSE(findAdjacency(g).rules[0].allows(3, 1));
  AdjacencyOptions o;
  o.periodic.x = true;
  const Adjacency a = findAdjacency(g, o);
  EXPECT_TRUE(a.rules[0].allows(3, 1));
  EXPECT_TRUE(findAdjacency(g).rules[1].pairs.empty());
}

TEST(FindAdjacency, CountsFurtherOffsetsFramesAndSeveralExamples) {
  AdjacencyOptions o;
  o.offsets = {{1, -1, 0, 0}, {2, 0, 0, 0}};
  const LabelGrid g = test::drawnFlat({"abc", "cab"});
  const Adjacency a = findAdjacency(g, o);
  ASSERT_EQ(a.rules.size(), 5u);
  // The lower row is numbered first: c is 1, a is 2, b is 3.
  EXPECT_EQ(a.rules[3].count(2, 2), 1);  // down to the right
  EXPECT_EQ(a.rules[4].count(1, 3), 1);

  const std::vector<LabelGrid> two{g, g};
  EXPECT_EQ(findAdjacency(two, {}).rules[0].count(2, 3), 4);
  AdjacencyOptions frames;
  frames.frames = true;
  const Adjacency f = findAdjacency(two, frames);
  ASSERT_EQ(f.rules.size(), 4u);
  EXPECT_EQ(f.rules[3].count(1, 1), 2);
  EXPECT_FALSE(f.rules[3].allows(1, 2));
}

TEST(FindAdjacency, TurnsDownWhatIsNoExample) {
  LabelGrid g = test::drawnFlat({"ab"});
  AdjacencyOptions o;
  const auto error = [&](std::span<const LabelGrid> examples) {
    return test::errorOf([&] { return findAdjacency(examples, o); });
  };
  const auto errorAt = [&](const CellOffset& offset) {
    o.offsets = {offset};
    return error(std::span(&g, 1));
  };
  EXPECT_THAT(error({}), HasSubstr("needs an example"));
  EXPECT_THAT(error(std::vector<LabelGrid>(1)), HasSubstr("has no cells"));
  EXPECT_THAT(errorAt({0, 0, 0, 0}), HasSubstr("`offset` (0, 0, 0): a cell is no neighbor"));
  EXPECT_THAT(errorAt({-1, 0, 0, 0}), HasSubstr("`offset` (-1, 0, 0): it, or its opposite"));
  EXPECT_THAT(errorAt({1, 1, 0, 1}), HasSubstr("`offset` (1, 1, 0, 1): it steps through time"));
  o.offsets.clear();
  LabelGrid more = g;
  more.labels.resize(7);
  EXPECT_THAT(error(std::vector<LabelGrid>{g, more}), HasSubstr("must share one numbering"));
  o.frames = true;
  more = test::drawnFlat({"aba"});
  more.labels.resize(g.labels.size());
  EXPECT_THAT(error(std::vector<LabelGrid>{g, more}), HasSubstr("must have the same size"));
  g.cells(0, 0, 0) = 9;
  EXPECT_THAT(error(std::span(&g, 1)), HasSubstr("a cell has label 9"));
}

TEST(FindAdjacency, CountsManyLabelsAsItCountsFew) {
  // Above 1,024 labels pairs are sorted; below they are counted in a table.
  LabelGrid few;
  few.cells = Array3D<Label>({17, 13, 5});
  few.labels.resize(40);
  const Random random(4);
  for (std::size_t i = 0; i < few.cells.count(); ++i) {
    few.cells.data()[i] = static_cast<Label>(random.below(40, i));
  }
  LabelGrid many = few;
  many.labels.resize(2000);
  const Adjacency a = findAdjacency(few), b = findAdjacency(many);
  ASSERT_EQ(a.rules.size(), b.rules.size());
  for (std::size_t r = 0; r < a.rules.size(); ++r) EXPECT_EQ(a.rules[r].pairs, b.rules[r].pairs);
  EXPECT_EQ(a.sides, b.sides);
}

TEST(FindAdjacency, HearsCancellation) {
  const LabelGrid g = test::figure36();
  test::expectHearsCancellation([&](const Progress& p) { (void)findAdjacency(g, {}, p); });
}

}  // namespace
}  // namespace exemplar
