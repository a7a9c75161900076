// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/synthesize.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <set>

#include "core/error.h"
#include "synth/model/examples.h"
#include "synth/model/networks.h"
#include "voxelize/hears_cancellation.h"
#include "voxelize/violations.h"

namespace exemplar {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

struct NamedExample {
  const char* name;
  LabelGrid (*make)();
};
LabelGrid fallibleFigure35() { return test::figure35(); }

class EachExample : public testing::TestWithParam<NamedExample> {};

TEST_P(EachExample, GivesOnlyPairsOfTheExample) {
  const LabelGrid example = GetParam().make();
  const Adjacency adjacency = findAdjacency(example);
  const int height = example.size().z == 1 ? 1 : 8;
  for (const ModelMethod method : {ModelMethod::Whole, ModelMethod::Blocks}) {
    for (const LabelChoice choice : {LabelChoice::Frequency, LabelChoice::Uniform}) {
      for (int seed = 0; seed < 3; ++seed) {
        ModelOptions o{.moves = 0};
        o.size = {17, 14, height};
        o.seed = seed;
        o.method = method;
        o.choice = choice;
        if (method == ModelMethod::Blocks) o.block = {6, 7, 5};
        const ModelResult r = synthesizeModel(std::span(&example, 1), adjacency, o);
        ASSERT_EQ(r.outcome, Outcome::Complete) << seed << " " << r.conflict.text;
        const AdjacencyViolations v = findViolations(r.grid(), example);
        EXPECT_EQ(v.count, 0) << seed;
        const Vec3i n = o.size;
        EXPECT_EQ(v.pairs, 3 * volume(n) - n.y * n.z - n.x * n.z - n.x * n.y);
        // The outermost layers show what the example's do.
        for (std::size_t i = 0; i < r.grid().cells.count(); ++i) {
          const Vec3i p = r.grid().cells.ijk(i);
          for (int s = 0; s < 6; ++s) {
            if (p[s / 2] != (s % 2 ? o.size[s / 2] - 1 : 0)) continue;
            const auto& side = adjacency.sides[s];
            EXPECT_TRUE(std::binary_search(side.begin(), side.end(), r.grid().cells[p]));
          }
        }
      }
    }
  }
}

TEST_P(EachExample, IsTheSameAtAnyNumberOfThreads) {
  const LabelGrid example = GetParam().make();
  const int height = example.size().z == 1 ? 1 : 10;
  struct Way {
    ModelMethod method;
    LabelChoice choice;
  };
  // By resemblance a cell looks at all cells around it, those across edges and corners, too.
  for (const Way way : {Way{ModelMethod::Whole, LabelChoice::Uniform},
                        Way{ModelMethod::Blocks, LabelChoice::Uniform},
                        Way{ModelMethod::Blocks, LabelChoice::Resemblance}}) {
    ModelOptions o{.moves = 0};
    o.size = {25, 22, height};
    o.seed = 5;
    o.method = way.method;
    o.choice = way.choice;
    if (way.method == ModelMethod::Blocks) o.block = {6, 6, 6};
    ModelResult one, eight;
    tbb::task_arena(1).execute([&] { one = synthesizeModel(example, o); });
    tbb::task_arena(8).execute([&] { eight = synthesizeModel(example, o); });
    ASSERT_EQ(one.outcome, Outcome::Complete);
    ASSERT_EQ(eight.outcome, Outcome::Complete);
    EXPECT_EQ(one.grid().cells, eight.grid().cells);
    EXPECT_EQ(one.origins, eight.origins);
    o.seed = 6;
    EXPECT_NE(one.grid().cells, synthesizeModel(example, o).grid().cells);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, EachExample,
                         testing::Values(NamedExample{"Figure35", fallibleFigure35},
                                         NamedExample{"Figure36", test::figure36},
                                         NamedExample{"Canyon", test::canyon},
                                         NamedExample{"City", test::city},
                                         NamedExample{"Gadgets", test::gadgets},
                                         NamedExample{"Parliament", test::parliament},
                                         NamedExample{"Escheresque", test::escheresque}),
                         [](const auto& example) { return example.param.name; });

/// How many of some seeds plain propagation brings to an end.
int plainSuccesses(const LabelGrid& example, const ModelOptions& o, int seeds) {
  const Adjacency a = findAdjacency(example);
  const ModelProblem problem(a, o);
  int count = 0;
  for (int seed = 0; seed < seeds; ++seed) count += test::plainPass(problem, seed);
  return count;
}

TEST(SynthesizeModel, NeverFailsOnFigure35) {
  const LabelGrid example = test::figure35();
  ModelOptions o{.moves = 0};
  o.size = {40, 40, 1};
  o.choice = LabelChoice::Uniform;
  EXPECT_LT(plainSuccesses(example, o, 20), 2);
  for (int seed = 0; seed < 20; ++seed) {
    o.seed = seed;
    const ModelResult r = synthesizeModel(example, o);
    ASSERT_EQ(r.outcome, Outcome::Complete) << seed;
    EXPECT_EQ(findViolations(r.grid(), example).count, 0);
    EXPECT_GT(r.statistics.contradictions, 0);
  }
}

TEST(SynthesizeModel, NeverFailsOnPathsThatNeverEnd) {
  const LabelGrid example = test::escheresque();
  ModelOptions o{.moves = 0};
  o.size = {40, 40, 10};
  o.choice = LabelChoice::Uniform;
  EXPECT_LT(plainSuccesses(example, o, 10), 2);
  for (int seed = 0; seed < 5; ++seed) {
    o.seed = seed;
    const ModelResult r = synthesizeModel(example, o);
    ASSERT_EQ(r.outcome, Outcome::Complete) << seed;
    EXPECT_EQ(findViolations(r.grid(), example).count, 0);
    EXPECT_GT(r.statistics.repairs, 0);
  }
}

TEST(SynthesizeModel, PlainPropagationSucceedsOnTheInfallibleTwin) {
  // Thesis, section 3.3.8: one cell's own label makes figure 3.5 infallible.
  ModelOptions o{.moves = 0};
  o.size = {30, 30, 1};
  o.choice = LabelChoice::Uniform;
  for (SideRule& s : o.sides) s.kind = SideRule::Kind::Free;
  EXPECT_EQ(plainSuccesses(test::figure35(true), o, 20), 20);
  EXPECT_LT(plainSuccesses(test::figure35(false), o, 20), 20);
}

int labelNamed(const LabelGrid& grid, const std::string& name) {
  for (int b = 0; b < grid.labelCount(); ++b) {
    if (grid.labels[b].name == name) return b;
  }
  ADD_FAILURE() << "no label " << name;
  return 0;
}

TEST(SynthesizeModel, ProvesWhatFigure35SaysPropagationMisses) {
  // A '1' two cells above a '2' is in the catalog C but not in C*.
  const LabelGrid example = test::figure35();
  const Label one = static_cast<Label>(labelNamed(example, "1"));
  const Label two = static_cast<Label>(labelNamed(example, "2"));
  ModelOptions o{.moves = 0};
  o.size = {12, 12, 1};
  o.pins = {{{9, 9, 0}, {0}}, {{4, 3, 0}, {two}}};
  const Adjacency a = findAdjacency(example);
  const ModelProblem problem(a, o);
  Catalog catalog(problem.network());
  const LabelSets start = problem.domains(problem.demands());
  for (int c = 0; c < problem.network().cells; ++c) catalog.setDomain(c, start[c]);
  ASSERT_TRUE(catalog.propagateAll());
  const int above = problem.cell(problem.position({4, 5, 0}));
  EXPECT_TRUE(containsLabel(catalog.domain(above), one));

  o.pins.push_back({{4, 5, 0}, {one}});
  const ModelResult r = synthesizeModel(example, o);
  ASSERT_EQ(r.outcome, Outcome::Impossible);
  EXPECT_TRUE(r.frames.empty());
  EXPECT_THAT(r.conflict.pins, ElementsAre(1, 2));
  EXPECT_TRUE(r.conflict.sides.empty());
  EXPECT_THAT(r.conflict.text, HasSubstr("cell (4, 3, 0) must be '2'"));
  EXPECT_THAT(r.conflict.text, HasSubstr("cell (4, 5, 0) must be '1'"));

  o.pins[2].cell = {4, 8, 0};
  EXPECT_EQ(synthesizeModel(example, o).outcome, Outcome::Complete);
}

TEST(SynthesizeModel, TurnsToBlocksWhereTheWholeComesToNothing) {
  // Without patience the first large region that is not labeled ends the pass over the whole.
  const LabelGrid example = test::escheresque();
  int inBlocks = 0;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    ModelOptions o{.moves = 0};
    o.size = {30, 30, 10};
    o.seed = seed;
    o.choice = LabelChoice::Uniform;
    o.patience = 0;
    ModelResult one, eight;
    tbb::task_arena(1).execute([&] { one = synthesizeModel(example, o); });
    ASSERT_EQ(one.outcome, Outcome::Complete);
    EXPECT_EQ(findViolations(one.grid(), example).count, 0);
    if (one.statistics.whole) continue;
    ++inBlocks;
    EXPECT_GT(one.statistics.blocks, 0);
    tbb::task_arena(8).execute([&] { eight = synthesizeModel(example, o); });
    EXPECT_EQ(one.grid().cells, eight.grid().cells);
    // With patience the same seed is labeled in one pass, and so not the same.
    o.patience = 1000;
    const ModelResult whole = synthesizeModel(example, o);
    ASSERT_EQ(whole.outcome, Outcome::Complete);
    EXPECT_TRUE(whole.statistics.whole);
    EXPECT_NE(one.grid().cells, whole.grid().cells);
  }
  EXPECT_GT(inBlocks, 0);
}

TEST(SynthesizeModel, BlocksBeginWithATileThatHasRimsWhereSidesDiffer) {
  // No tile repeats from a left to a right side that are not neighbors of each other; with a column
  // of its own at each side one does.
  const LabelGrid example = test::drawnFlat({"ltmmtr", "lmmmmr", "lmtmmr"});
  ModelOptions o;
  o.size = {40, 30, 1};
  o.block = {6, 6, 2};
  o.method = ModelMethod::Blocks;
  const ModelResult r = synthesizeModel(example, o);
  ASSERT_EQ(r.outcome, Outcome::Complete);
  EXPECT_EQ(findViolations(r.grid(), example).count, 0);
  EXPECT_FALSE(r.statistics.whole);
  EXPECT_GT(r.statistics.blocks, 0);
  EXPECT_EQ(r.statistics.repairs, 0);  // the whole was not labeled first
  for (int y = 0; y < o.size.y; ++y) {
    EXPECT_EQ(r.grid().cells(0, y, 0), example.cells(0, 0, 0));
    EXPECT_EQ(r.grid().cells(o.size.x - 1, y, 0), example.cells(5, 0, 0));
  }
}

TEST(SynthesizeModel, CountsWhatRepairsTakeAndEndsAlikeEverywhere) {
  // Work is counted, not timed: the pass over the whole is left at the same cell by any number of
  // threads, and blocks go on from there with the same bytes.
  const LabelGrid example = test::escheresque();
  int inBlocks = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    ModelOptions o{.moves = 0};
    o.size = {40, 40, 10};
    o.seed = seed;
    o.patience = 1;
    ModelResult one, eight;
    tbb::task_arena(1).execute([&] { one = synthesizeModel(example, o); });
    tbb::task_arena(8).execute([&] { eight = synthesizeModel(example, o); });
    ASSERT_EQ(one.outcome, Outcome::Complete);
    EXPECT_EQ(one.grid().cells, eight.grid().cells);
    EXPECT_EQ(one.statistics.repairs, eight.statistics.repairs);
    EXPECT_EQ(one.statistics.whole, eight.statistics.whole);
    EXPECT_EQ(findViolations(one.grid(), example).count, 0);
    inBlocks += !one.statistics.whole;
  }
  EXPECT_GT(inBlocks, 0);
}

TEST(SynthesizeModel, BlocksBeginWithTheWholeWhereNoTileRepeats) {
  // Pins six cells apart are one cell of a tile of one, two or three cells, and want different
  // labels.
  const LabelGrid example = test::canyon();
  ModelOptions o{.moves = 0};
  o.size = {20, 20, 10};
  o.method = ModelMethod::Blocks;
  const ModelResult free = synthesizeModel(example, o);
  ASSERT_EQ(free.outcome, Outcome::Complete);
  const Label here = free.grid().cells(7, 7, 5), there = free.grid().cells(13, 13, 5);
  Label other = there;
  for (const Label b : free.grid().cells.values()) {
    if (other == here && b != here) other = b;
  }
  o.pins = {{{7, 7, 5}, {here}}, {{13, 13, 5}, {other}}};
  ASSERT_NE(here, other);
  const ModelResult r = synthesizeModel(example, o);
  ASSERT_EQ(r.outcome, Outcome::Complete);
  EXPECT_FALSE(r.statistics.whole);
  EXPECT_GT(r.statistics.blocks, 0);
  EXPECT_EQ(r.grid().cells(7, 7, 5), here);
  EXPECT_EQ(r.grid().cells(13, 13, 5), other);
  EXPECT_EQ(findViolations(r.grid(), example).count, 0);
}

TEST(SynthesizeModel, HearsOfDemandsFarAway) {
  // A row of labels by turns: a pin decides every cell, across all pieces that propagation begins
  // with, and a second one agrees or does not by the parity of their distance.
  LabelGrid example;
  example.cells = Array3D<Label>({4, 1, 1}, 0);
  example.cells(1, 0, 0) = example.cells(3, 0, 0) = 1;
  example.labels.resize(2);
  ModelOptions o{.moves = 0};
  o.size = {30000, 1, 1};
  for (SideRule& side : o.sides) side.kind = SideRule::Kind::Free;
  o.pins = {{{2, 0, 0}, {1}}, {{29998, 0, 0}, {1}}};
  const ModelResult even = synthesizeModel(example, o);
  ASSERT_EQ(even.outcome, Outcome::Complete);
  EXPECT_EQ(even.statistics.contradictions, 0);
  for (int x = 0; x < 30000; ++x) ASSERT_EQ(even.grid().cells(x, 0, 0), 1 - x % 2);
  o.pins[1].cell.x = 29999;
  const ModelResult odd = synthesizeModel(example, o);
  EXPECT_EQ(odd.outcome, Outcome::Impossible);
  EXPECT_EQ(odd.conflict.pins, (std::vector<int>{0, 1}));
}

TEST(SynthesizeModel, ProvesThatThreeEndsDoNotPair) {
  // Thesis, figure 3.6: ends of paths come in pairs, and nothing near any of them says so.
  const LabelGrid example = test::figure36();
  std::vector<Label> ends;
  for (const char* name : {"e", "n", "w", "s"}) {
    ends.push_back(static_cast<Label>(labelNamed(example, name)));
  }
  ModelOptions o{.moves = 0};
  o.size = {7, 7, 1};
  WeightMap elsewhere{ends, Array3D<float>(o.size, 0.f)};
  for (const Vec3i p : {Vec3i{1, 1, 0}, Vec3i{5, 2, 0}, Vec3i{2, 4, 0}}) {
    elsewhere.weight[p] = 1;
    o.pins.push_back({p, ends});
  }
  o.weightMaps.push_back(elsewhere);
  const Adjacency a = findAdjacency(example);
  const ModelProblem problem(a, o);
  Catalog catalog(problem.network());
  const LabelSets start = problem.domains(problem.demands());
  for (int c = 0; c < problem.network().cells; ++c) catalog.setDomain(c, start[c]);
  EXPECT_TRUE(catalog.propagateAll()) << "the catalog is not empty";
  const ModelResult three = synthesizeModel(example, o);
  ASSERT_EQ(three.outcome, Outcome::Impossible);
  EXPECT_THAT(three.conflict.pins, ElementsAre(0, 1, 2));
  EXPECT_EQ(three.conflict.sides.size(), 4u);

  o.weightMaps[0].weight(5, 5, 0) = 1;
  o.pins.push_back({{5, 5, 0}, ends});
  const ModelResult four = synthesizeModel(example, o);
  ASSERT_EQ(four.outcome, Outcome::Complete);
  EXPECT_EQ(findViolations(four.grid(), example).count, 0);
}

TEST(SynthesizeModel, SaysWhyAnExampleThatNeverRepeatsGivesNothing) {
  const LabelGrid example = test::drawnFlat({"abc", "def", "ghi"});
  ModelOptions o{.moves = 0};
  o.size = {5, 5, 1};
  for (SideRule& s : o.sides) s.kind = SideRule::Kind::Free;
  const ModelResult r = synthesizeModel(example, o);
  EXPECT_EQ(r.outcome, Outcome::Impossible);
  EXPECT_THAT(r.conflict.text, HasSubstr("no grid of 5 x 5 x 1 cells"));
  o.size = {3, 3, 1};
  EXPECT_EQ(synthesizeModel(example, o).grid().cells, example.cells);

  LabelGrid one;
  one.cells = Array3D<Label>({1, 1, 1}, 0);
  one.labels.resize(1);
  o.size = {1, 1, 1};
  EXPECT_EQ(synthesizeModel(one, o).outcome, Outcome::Complete);
}

TEST(SynthesizeModel, HearsCancellationWhereverItIs) {
  const LabelGrid example = test::figure36();
  ModelOptions o{.moves = 0};
  o.size = {40, 40, 1};
  o.choice = LabelChoice::Uniform;
  std::vector<Label> ends;
  for (const char* name : {"e", "n", "w", "s"}) {
    ends.push_back(static_cast<Label>(labelNamed(example, name)));
  }
  o.counts = {{ends, 0, 30}};
  for (const ModelMethod method : {ModelMethod::Whole, ModelMethod::Blocks}) {
    o.method = method;
    test::expectHearsCancellation(
        [&](const Progress& progress) { (void)synthesizeModel(example, o, progress); });
  }
  // While a conflict is explained.
  o.counts.clear();
  o.pins = {{{5, 5, 0}, {ends[0]}}, {{6, 5, 0}, {ends[0]}}};
  test::expectHearsCancellation([&](const Progress& progress) {
    EXPECT_EQ(synthesizeModel(example, o, progress).outcome, Outcome::Impossible);
  });
}

}  // namespace
}  // namespace exemplar
