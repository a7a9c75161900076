// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/quilt_labels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "progress_checks.h"
#include "synth/model/anneal.h"
#include "synth/model/examples.h"
#include "synth/model/start.h"
#include "threads.h"
#include "voxelize/violations.h"

namespace exemplar {
namespace {

/// A request, its ground, and a smaller result of the same rules.
struct Quilted {
  Quilted(LabelGrid grid, ModelOptions wanted, const Vec3i& small)
      : example(std::move(grid)),
        adjacency(findAdjacency(example)),
        options(std::move(wanted)),
        problem(adjacency, options),
        base(problem.domains(problem.demands())),
        chooser(problem, std::span(&example, 1)) {
    ModelOptions o = quiltSampleOptions(options);
    o.size = small;
    o.moves = 4;
    sample = synthesizeModel(example, o).grid();
    ModelStatistics statistics;
    labels = findTiledStart(problem, base, chooser, statistics, {}, true).value();
    ground = labels;
  }
  Quilted(const Quilted&) = delete;

  double lay(int pitch) { return quiltLabels(problem, base, chooser, sample, pitch, labels); }
  LabelGrid grid(const std::vector<Label>& shown) const {
    LabelGrid made = example;
    made.cells = Array3D<Label>(options.size, 0);
    for (int c = 0; c < problem.network().cells; ++c)
      made.cells[problem.cellAt(problem.positionOf(c))] = shown[c];
    return made;
  }

  LabelGrid example;
  Adjacency adjacency;
  ModelOptions options;
  ModelProblem problem;
  LabelSets base;
  LabelChooser chooser;
  LabelGrid sample;
  std::vector<Label> labels, ground;
};

ModelOptions sized(const Vec3i& size) {
  ModelOptions o;
  o.size = size;
  return o;
}

/// Of the windows of 4 x 4 columns of a result that are not ground, the share that is in the
/// sample.
double shown(const Quilted& q) {
  const auto window = [](const LabelGrid& g, int x, int y) {
    std::vector<Label> labels;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        for (int z = 0; z < g.size().z; ++z) labels.push_back(g.cells(x + i, y + j, z));
    return labels;
  };
  const LabelGrid grid = q.grid(q.labels), ground = q.grid(q.ground);
  const Vec3i& size = q.sample.size();
  std::set<std::vector<Label>> known;
  for (int x = 0; x + 4 <= size.x; ++x)
    for (int y = 0; y + 4 <= size.y; ++y) known.insert(window(q.sample, x, y));
  double found = 0, all = 0;
  for (int x = 0; x + 4 <= grid.size().x; ++x) {
    for (int y = 0; y + 4 <= grid.size().y; ++y) {
      const std::vector<Label> here = window(grid, x, y);
      if (here == window(ground, x, y)) continue;
      found += known.contains(here);
      ++all;
    }
  }
  return found / all;
}

TEST(QuiltLabels, CoversTheResultWithWindowsOfTheSampleAndKeepsItsPairs) {
  for (const auto make : {test::city, test::canyon, test::parliament}) {
    const LabelGrid example = make();
    Quilted q(example, sized({70, 58, example.size().z}), {40, 36, example.size().z});
    const double covered = q.lay(12);
    EXPECT_TRUE(consistent(q.problem.network(), q.labels));
    EXPECT_GT(covered, 0.5);
    EXPECT_LE(covered, 1);
    // 9 x 9 of 12 x 12 places are within a window; what closes gaps changes some of these.
    EXPECT_GT(shown(q), 0.4);
    std::size_t changed = 0;
    for (std::size_t c = 0; c < q.labels.size(); ++c) changed += q.labels[c] != q.ground[c];
    EXPECT_GT(changed, 0u);
  }
}

TEST(QuiltLabels, HoldsWhatTheRequestAsksForAndStaysWithinPeriodicSides) {
  const LabelGrid example = test::city();
  ModelOptions o = sized({60, 49, example.size().z});
  o.periodic = {true, false, false};
  o.mask = Array3D<std::uint8_t>(o.size, 1);
  for (int x = 20; x < 30; ++x)
    for (int z = 0; z < o.size.z; ++z) o.mask(x, 24, z) = 0;
  Quilted q(example, o, {32, 32, example.size().z});
  q.lay(10);
  EXPECT_TRUE(consistent(q.problem.network(), q.labels));
  for (int c = 0; c < q.problem.network().cells; ++c)
    ASSERT_TRUE(containsLabel(q.base[c], q.labels[c]));
}

TEST(QuiltLabels, IsTheSameAtAnyNumberOfThreads) {
  const LabelGrid example = test::canyon();
  testing::expectSameAtAnyThreads([&] {
    Quilted q(example, sized({66, 64, example.size().z}), {36, 36, example.size().z});
    q.lay(11);
    return q.labels;
  });
}

TEST(QuiltLabels, LargeResultsAreMadeOfASmallerOneAndHoldWhatItHolds) {
  const LabelGrid example = test::city();
  const Vec3i size{130, 100, example.size().z};
  ModelOptions o = sized(size);
  o.moves = 2;
  ASSERT_TRUE(canQuilt(o));
  const ModelResult made = synthesizeModel(example, o);
  ASSERT_EQ(made.outcome, Outcome::Complete);
  EXPECT_EQ(findViolations(made.grid(), example).count, 0);
  // Far fewer moves than two a column are made, and most of the labels are there.
  EXPECT_LT(made.statistics.moves, 130 * 100);
  std::set<Label> labels;
  for (const Label b : made.grid().cells.values()) labels.insert(b);
  EXPECT_GT(labels.size(), 0.9 * example.labelCount());
  // What is said of single cells holds.
  Label rare = 0;
  for (const Label b : made.grid().cells.values()) rare = std::max(rare, b);
  Vec3i place{-1, -1, -1};
  forEachCell(size, [&](const Vec3i& p) {
    if (made.grid().cells[p] == rare) place = p;
  });
  o.pins.push_back({place, {rare}});
  o.seed = 5;
  const ModelResult pinned = synthesizeModel(example, o);
  ASSERT_EQ(pinned.outcome, Outcome::Complete);
  EXPECT_EQ(pinned.grid().cells[place], rare);
}

TEST(QuiltLabels, IsLeftOutWhereASmallerResultDoesNotShowWhatIsWanted) {
  ModelOptions o = sized({400, 400, 10});
  EXPECT_TRUE(canQuilt(o));
  ModelOptions still = o;
  still.moves = 0;
  EXPECT_FALSE(canQuilt(still));
  ModelOptions mirrored = o;
  mirrored.symmetry.mirrorX = true;
  EXPECT_FALSE(canQuilt(mirrored));
  ModelOptions mapped = o;
  mapped.weightMaps.push_back({{1}, Array3D<float>(o.size, 1)});
  EXPECT_FALSE(canQuilt(mapped));
  EXPECT_FALSE(canQuilt(sized({90, 90, 10})));
}

TEST(QuiltLabels, ReportsAndStops) {
  const LabelGrid example = test::city();
  Quilted q(example, sized({60, 60, example.size().z}), {36, 36, example.size().z});
  testing::expectReportsAndStops(2, [&](const Progress& progress) {
    std::vector<Label> labels = q.labels;
    quiltLabels(q.problem, q.base, q.chooser, q.sample, 12, labels, progress);
  });
}

}  // namespace
}  // namespace exemplar
