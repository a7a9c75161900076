// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/anneal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "progress_checks.h"
#include "synth/model/block_counts.h"
#include "synth/model/copied_windows.h"
#include "synth/model/examples.h"
#include "synth/model/patch_move.h"
#include "synth/model/start.h"
#include "threads.h"
#include "voxelize/violations.h"

namespace exemplar {
namespace {

/// A request, and a labeling of it without patches.
struct Labeled {
  Labeled(LabelGrid grid, ModelOptions wanted)
      : example(std::move(grid)),
        adjacency(findAdjacency(example)),
        options(std::move(wanted)),
        problem(adjacency, options),
        base(problem.domains(problem.demands())),
        chooser(problem, std::span(&example, 1)),
        sources(patchSources(problem, std::span(&example, 1))) {
    ModelOptions plain = options;
    plain.moves = 0;
    const ModelResult result = synthesizeModel(example, plain);
    for (int c = 0; c < problem.network().cells; ++c)
      labels.push_back(result.grid().cells[problem.cellAt(problem.positionOf(c))]);
  }
  Labeled(const Labeled&) = delete;

  std::vector<Label> grid() const {
    std::vector<Label> shown;
    for (std::int64_t at = 0; at < problem.positions(); ++at)
      shown.push_back(problem.labelAt(at, labels[problem.cell(at)]));
    return shown;
  }
  double energy() const {
    BlockCounts counts(problem, sources);
    counts.count(grid());
    return counts.energy();
  }

  LabelGrid example;
  Adjacency adjacency;
  ModelOptions options;
  ModelProblem problem;
  LabelSets base;
  LabelChooser chooser;
  std::vector<PatchSource> sources;
  std::vector<Label> labels;
};

ModelOptions sized(const Vec3i& size) {
  ModelOptions o;
  o.size = size;
  return o;
}

/// Blocks of `side` cells each way, as lists of labels, with their numbers; single cells at each
/// height by itself.
std::map<std::vector<Label>, double> blocksOf(const Array3D<Label>& cells, int side) {
  std::map<std::vector<Label>, double> blocks;
  const Vec3i places = cells.size() - Vec3i{side - 1, side - 1, side - 1};
  forEachCell(places, [&](const Vec3i& p) {
    std::vector<Label> labels;
    forEachCell(Vec3i{side, side, side}, [&](const Vec3i& q) { labels.push_back(cells[p + q]); });
    if (side == 1) labels.push_back(static_cast<Label>(p.z));
    blocks[labels] += 1;
  });
  return blocks;
}

TEST(BlockCounts, OfTheExampleItselfAreWhatIsWanted) {
  const LabelGrid example = test::city();
  Labeled l(example, sized(example.size()));
  for (int c = 0; c < l.problem.network().cells; ++c)
    l.labels[c] = example.cells[l.problem.cellAt(l.problem.positionOf(c))];
  EXPECT_EQ(l.energy(), 0);
  // A label that does not belong there is one too many, misses where it should be, and makes blocks
  // that are unknown.
  const std::int64_t middle = volume(example.size()) / 2;
  l.labels[middle] = static_cast<Label>((l.labels[middle] + 1) % example.labelCount());
  EXPECT_GT(l.energy(), 2);
}

TEST(BlockCounts, AreThoseCountedOneByOne) {
  const LabelGrid example = test::canyon();
  ModelOptions o = sized({2 * example.size().x, example.size().y, example.size().z});
  o.sides.fill({SideRule::Kind::Free, {}});
  o.sides[4].kind = SideRule::Kind::Example;
  const Labeled l(example, o);
  Array3D<Label> result(o.size);
  const std::vector<Label> grid = l.grid();
  forEachCell(o.size, [&](const Vec3i& p) { result[p] = grid[l.problem.position(p)]; });
  double expected = 0;
  for (int side = 1; side <= 3; ++side) {
    auto shown = blocksOf(result, side);
    const double ratio = double(o.size.x - side + 1) / (example.size().x - side + 1);
    for (const auto& [block, count] : blocksOf(example.cells, side)) {
      expected += (side == 1 ? 3 : 1) * std::abs(shown[block] - count * ratio);
      shown.erase(block);
    }
    for (const auto& [block, count] : shown) expected += (side == 1 ? 3 : 1) * count;
  }
  EXPECT_NEAR(l.energy(), expected, 1e-6 * expected);
}

/// A ground, with a tower of 2 x 2 x 2 cells at each of `places`.
LabelGrid towers(const Vec3i& size, const std::vector<Vec3i>& places) {
  LabelGrid grid = test::drawn({{"g"}, {"t"}, {"."}});  // for the labels' looks
  const Label ground = grid.cells(0, 0, 0), tower = grid.cells(0, 0, 1), air = grid.cells(0, 0, 2);
  grid.cells = Array3D<Label>(size, air);
  forEachCell(size, [&](const Vec3i& p) {
    if (p.z == 0) grid.cells[p] = ground;
  });
  for (const Vec3i& corner : places)
    forEachCell(Vec3i{2, 2, 2}, [&](const Vec3i& p) { grid.cells[corner + p] = tower; });
  return grid;
}

double energyOf(const LabelGrid& example, const LabelGrid& result) {
  Labeled l(example, sized(result.size()));
  for (int c = 0; c < l.problem.network().cells; ++c)
    l.labels[c] = result.cells[l.problem.cellAt(l.problem.positionOf(c))];
  return l.energy();
}

TEST(BlockCounts, AsManyObjectsAreWantedForEachColumnAsInTheExample) {
  // Sides cut off less of a larger result, so there are more than four times as many places for
  // blocks of 3 cells: they are for ground.
  const LabelGrid example = towers({8, 8, 5}, {{3, 3, 1}});
  std::vector<Vec3i> four{{3, 3, 1}, {3, 11, 1}, {11, 3, 1}, {11, 11, 1}};
  const Vec3i size{16, 16, 5};
  EXPECT_NEAR(energyOf(example, towers(size, four)), 0, 1e-9);
  four.push_back({7, 7, 1});
  EXPECT_GT(energyOf(example, towers(size, four)), 50);
}

TEST(BlockCounts, HeightsOfWhatFloatsAreWanted) {
  const LabelGrid example = towers({10, 10, 12}, {{3, 3, 4}});
  // All blocks are alike, and 8 cells are where none should be.
  EXPECT_NEAR(energyOf(example, towers({10, 10, 12}, {{3, 3, 7}})), 3.0 * 8 * 4, 1e-9);
}

TEST(BlockCounts, ChangesAddUpAndCanBeTakenOut) {
  for (const bool periodic : {false, true}) {
    ModelOptions o = sized({14, 13, 8});
    o.periodic = {periodic, periodic, false};
    Labeled l(test::city(), o);
    BlockCounts counts(l.problem, l.sources);
    std::vector<Label> grid = l.grid();
    counts.count(grid);
    BlockCounts::Change change;
    const Random random(7);
    for (std::uint64_t n = 0; n < 40; ++n) {
      std::vector<BlockCounts::Changed> changed;
      std::set<std::int64_t> once;
      for (std::uint32_t i = 0; i < 12; ++i) {
        const auto at =
            static_cast<std::int64_t>(random.below(static_cast<std::uint32_t>(grid.size()), n, i));
        if (!once.insert(at).second) continue;
        changed.push_back({l.problem.cellAt(at), 0, grid[at]});
        grid[at] = static_cast<Label>(random.below(20, n, 100 + i));
      }
      const double before = counts.energy();
      counts.look(grid, changed, change);
      const double more = counts.add(change);
      EXPECT_NEAR(counts.energy(), before + more, 1e-6);
      BlockCounts again(l.problem, l.sources);
      again.count(grid);
      EXPECT_NEAR(counts.energy(), again.energy(), 1e-6);
      if (n % 2 == 0) {
        counts.keep(change);
        continue;
      }
      counts.takeOut(change);
      EXPECT_NEAR(counts.energy(), before, 1e-6);
      for (const auto& c : changed) grid[l.problem.position(c.cell)] = c.before;
    }
  }
}

TEST(BlockCounts, WeightsMultiplyWhatIsWanted) {
  const LabelGrid example = test::city();
  ModelOptions o = sized(example.size());
  o.weights.assign(example.labels.size(), 1);
  const Label rare = example.cells[example.size() / 2];
  o.weights[rare] = 3;
  Labeled l(example, o);
  for (int c = 0; c < l.problem.network().cells; ++c)
    l.labels[c] = example.cells[l.problem.cellAt(l.problem.positionOf(c))];
  // The example has the label once where three times are wanted.
  EXPECT_GE(l.energy(), 2.0 * static_cast<double>(l.adjacency.frequency[rare]));
}

TEST(CopiedWindows, AreAllOfATiledExampleAndNoneOfATurnedOne) {
  const LabelGrid example = test::city();
  const Vec3i n = example.size();
  const Labeled l(example, sized({2 * n.x, n.y, n.z}));
  CopiedWindows copies(l.problem, l.sources);
  std::vector<Label> grid(static_cast<std::size_t>(l.problem.positions()));
  const auto fill = [&](const auto& from) {
    forEachCell(l.options.size,
                [&](const Vec3i& p) { grid[l.problem.position(p)] = example.cells[from(p)]; });
    copies.count(grid);
    return copies.copies();
  };
  const std::int64_t tiled = fill([&](const Vec3i& p) { return Vec3i{p.x % n.x, p.y, p.z}; });
  EXPECT_GE(tiled, 2 * (n.x - 7) * (n.y - 7) * 9 / 10);
  EXPECT_EQ(fill([&](const Vec3i& p) {
              return Vec3i{n.x - 1 - p.x % n.x, n.y - 1 - p.y, p.z};
            }),
            0);
}

TEST(CopiedWindows, ChangesAreThoseOfCountingAgain) {
  const LabelGrid example = test::canyon();
  const Vec3i n = example.size();
  ModelOptions o = sized(n);
  o.periodic = {true, true, false};
  const Labeled l(example, o);
  std::vector<Label> grid(static_cast<std::size_t>(l.problem.positions()));
  forEachCell(n, [&](const Vec3i& p) { grid[l.problem.position(p)] = example.cells[p]; });
  CopiedWindows copies(l.problem, l.sources);
  copies.count(grid);
  CopiedWindows::Change change;
  const Random random(3);
  for (std::uint64_t i = 0; i < 20; ++i) {
    const Vec3i p{static_cast<int>(random.below(n.x, i, 0)),
                  static_cast<int>(random.below(n.y, i, 1)), 0};
    Label& label = grid[l.problem.position(p)];
    label = label == example.cells[p] ? static_cast<Label>(label + 1) : example.cells[p];
    const std::int64_t before = copies.copies();
    const int more = copies.look(grid, p, p + Vec3i{1, 1, 1}, change);
    copies.keep(change);
    EXPECT_EQ(copies.copies(), before + more);
    CopiedWindows again(l.problem, l.sources);
    again.count(grid);
    EXPECT_EQ(copies.copies(), again.copies());
  }
}

TEST(PatchMove, KeepsALabelingConsistentOrAsItWas) {
  for (const auto make : {test::city, test::canyon, test::parliament, test::figure36}) {
    const LabelGrid example = make();
    Labeled l(example, sized({22, 21, example.size().z}));
    PatchMove move(l.problem, l.base, l.chooser, l.sources);
    std::vector<PatchMove::Before> before;
    const Random random(1);
    int made = 0;
    for (std::uint64_t n = 0; n < 200; ++n) {
      const auto at = [&](int size, std::uint32_t draw) {
        return static_cast<int>(random.below(static_cast<std::uint32_t>(size), n, draw));
      };
      const PatchMove::Window window{{at(22, 0), at(21, 1), 0}, 0, 8};
      const PatchMove::Alignment alignment{
          0, {at(example.size().x, 2), at(example.size().y, 3), 0}, 0};
      const int half = 1 + at(3, 4);
      PatchMove::Patch patch{{{-half, -half, 0}, {half, half, example.size().z}}, {}, 1 + at(3, 5)};
      patch.grown = patch.core.grown(at(4, 6));
      const std::vector<Label> old = l.labels;
      const auto outcome = move.make(window, alignment, patch, random.fork(n), l.labels, before,
                                     [] { return true; });
      if (outcome != PatchMove::Outcome::Made) {
        EXPECT_EQ(l.labels, old);
        continue;
      }
      ++made;
      EXPECT_TRUE(consistent(l.problem.network(), l.labels));
      std::vector<Label> back = l.labels;
      for (auto b = before.rbegin(); b != before.rend(); ++b) back[b->cell] = b->label;
      EXPECT_EQ(back, old);
      for (std::size_t c = 0; c < old.size(); ++c) {
        if (l.labels[c] == old[c]) continue;
        const Vec3i p = l.problem.cellAt(l.problem.positionOf(static_cast<int>(c)));
        EXPECT_LE(std::abs(p.x - window.center.x), window.reach);
        EXPECT_LE(std::abs(p.y - window.center.y), window.reach);
      }
    }
    EXPECT_GT(made, 20);
  }
}

struct NamedExample {
  const char* name;
  LabelGrid (*make)();
};
class AnnealEachExample : public ::testing::TestWithParam<NamedExample> {};

TEST_P(AnnealEachExample, BringsTheExamplesStatisticsAndKeepsItsPairs) {
  const LabelGrid example = GetParam().make();
  Labeled l(example, sized({26, 24, example.size().z}));
  const double before = l.energy();
  ModelStatistics statistics;
  annealPatches(l.problem, l.base, l.chooser, std::span(&l.example, 1), l.labels, {}, statistics);
  EXPECT_TRUE(consistent(l.problem.network(), l.labels));
  EXPECT_LT(l.energy(), 0.8 * before);
  EXPECT_GT(statistics.movesKept, 0);
  EXPECT_GE(statistics.moves, static_cast<std::int64_t>(26 * 24 * l.options.moves));
}

TEST_P(AnnealEachExample, IsTheSameAtAnyNumberOfThreads) {
  const LabelGrid example = GetParam().make();
  ModelOptions o = sized({66, 61, example.size().z});  // several moves at once
  o.moves = 2;
  testing::expectSameAtAnyThreads([&] { return synthesizeModel(example, o).grid().cells; });
}

INSTANTIATE_TEST_SUITE_P(Kinds, AnnealEachExample,
                         ::testing::Values(NamedExample{"Figure36", test::figure36},
                                           NamedExample{"Canyon", test::canyon},
                                           NamedExample{"City", test::city},
                                           NamedExample{"Gadgets", test::gadgets},
                                           NamedExample{"Parliament", test::parliament},
                                           NamedExample{"Escheresque", test::escheresque}),
                         [](const auto& example) { return example.param.name; });

TEST(AnnealPatches, KeepsWhatTheRequestDemands) {
  const LabelGrid example = test::city();
  const Adjacency adjacency = findAdjacency(example);
  ModelOptions o = sized({24, 24, 8});
  ModelOptions plain = o;
  plain.moves = 0;
  const LabelGrid some = synthesizeModel(example, plain).grid();
  const std::vector<Vec3i> pinned{{4, 5, 1}, {12, 12, 0}, {12, 12, 3}, {20, 3, 2}};
  for (const Vec3i& p : pinned) o.pins.push_back({p, {some.cells[p]}});
  o.mask = Array3D<std::uint8_t>(o.size, 1);
  for (int z = 0; z < 8; ++z) {
    for (int x = 15; x < 20; ++x) o.mask(x, 16, z) = 0;
  }
  const ModelResult r = synthesizeModel(example, o);
  ASSERT_EQ(r.outcome, Outcome::Complete);
  EXPECT_GT(r.statistics.movesKept, 0);
  for (const Vec3i& p : pinned) EXPECT_EQ(r.grid().cells[p], some.cells[p]);
  for (int x = 15; x < 20; ++x) EXPECT_EQ(r.grid().cells(x, 16, 3), 0);
}

TEST(AnnealPatches, TilesAlongPeriodicAxes) {
  const LabelGrid example = test::canyon();
  ModelOptions o = sized({24, 23, 8});
  o.periodic = {true, true, false};
  const ModelResult r = synthesizeModel(example, o);
  ASSERT_EQ(r.outcome, Outcome::Complete);
  EXPECT_GT(r.statistics.movesKept, 0);
  LabelGrid twice = r.grid();
  twice.cells = Array3D<Label>({48, 46, 8});
  forEachCell(twice.size(),
              [&](const Vec3i& p) { twice.cells[p] = r.grid().cells(p.x % 24, p.y % 23, p.z); });
  EXPECT_EQ(findViolations(twice, example).count, 0);
}

TEST(AnnealPatches, KeepsASymmetry) {
  const LabelGrid example = test::figure36();
  ModelOptions o = sized({30, 30, 1});
  o.symmetry.copies = {2, 1, 1};
  const ModelResult copied = synthesizeModel(example, o);
  ASSERT_EQ(copied.outcome, Outcome::Complete);
  EXPECT_GT(copied.statistics.movesKept, 0);
  for (int x = 0; x < 15; ++x) {
    for (int y = 0; y < 30; ++y)
      EXPECT_EQ(copied.grid().cells(x, y, 0), copied.grid().cells(x + 15, y, 0));
  }
  EXPECT_EQ(findViolations(copied.grid(), example).count, 0);
}

TEST(AnnealPatches, WorksOnFrames) {
  const LabelGrid example = test::figure36();
  std::vector<LabelGrid> frames(4, example);
  const Vec3i n = example.size();
  for (int t = 1; t < 4; ++t) {
    // The picture drifts along x.
    forEachCell(n, [&](const Vec3i& p) {
      frames[t].cells[p] = frames[t - 1].cells[{(p.x + 1) % n.x, p.y, p.z}];
    });
  }
  ModelOptions o = sized({18, 18, 1});
  o.frames = 3;
  o.sides.fill({SideRule::Kind::Free, {}});
  const Adjacency adjacency = findAdjacency(frames, {.frames = true});
  const ModelResult r = synthesizeModel(frames, adjacency, o);
  ASSERT_EQ(r.outcome, Outcome::Complete);
  const PairRule& inTime = adjacency.rules[3];
  for (int t = 0; t < 3; ++t) {
    forEachCell(o.size, [&](const Vec3i& p) {
      const Label then = r.frames[std::min(t + 1, 2)].cells[p];
      EXPECT_TRUE(t == 2 || inTime.allows(r.frames[t].cells[p], then));
      if (p.x + 1 < o.size.x) {
        const Label next = r.frames[t].cells(p.x + 1, p.y, p.z);
        EXPECT_TRUE(adjacency.rules[0].allows(r.frames[t].cells[p], next));
      }
    });
  }
}

TEST(AnnealPatches, KeepsPairsAtFurtherOffsets) {
  const LabelGrid example = test::city();
  AdjacencyOptions further;
  further.offsets = {{1, 1, 0}, {0, 0, 2}};
  const Adjacency adjacency = findAdjacency(example, further);
  ModelOptions o = sized({20, 20, 8});
  const ModelResult r = synthesizeModel(std::span(&example, 1), adjacency, o);
  ASSERT_EQ(r.outcome, Outcome::Complete);
  for (const PairRule& rule : adjacency.rules) {
    const Vec3i step{rule.offset.x, rule.offset.y, rule.offset.z};
    forEachCell(o.size, [&](const Vec3i& p) {
      if (!r.grid().cells.contains(p + step)) return;
      EXPECT_TRUE(rule.allows(r.grid().cells[p], r.grid().cells[p + step]));
    });
  }
}

TEST(AnnealPatches, AHighPriceForCopiesLeavesFewer) {
  const auto copies = [](double price) {
    std::int64_t sum = 0;
    for (const auto make : {test::canyon, test::parliament, test::gadgets, test::figure36}) {
      const LabelGrid example = make();
      ModelOptions o = sized({26, 26, example.size().z});
      o.copyPrice = price;
      Labeled l(example, o);
      ModelStatistics statistics;
      annealPatches(l.problem, l.base, l.chooser, std::span(&l.example, 1), l.labels, {},
                    statistics);
      CopiedWindows windows(l.problem, l.sources);
      windows.count(l.grid());
      sum += windows.copies();
    }
    return sum;
  };
  EXPECT_LT(copies(100), copies(0));
}

TEST(AnnealPatches, ReportsAndStops) {
  const LabelGrid example = test::city();
  Labeled l(example, sized({30, 30, example.size().z}));
  testing::expectReportsAndStops(4, [&](const Progress& progress) {
    std::vector<Label> labels = l.labels;
    ModelStatistics statistics;
    annealPatches(l.problem, l.base, l.chooser, std::span(&l.example, 1), labels, {}, statistics,
                  progress);
  });
}

}  // namespace
}  // namespace exemplar
