// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/arc_consistency.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/cells.h"
#include "synth/model/catalog.h"
#include "synth/model/examples.h"
#include "threads.h"

namespace exemplar {
namespace {

ModelOptions sized(const Vec3i& size) {
  ModelOptions o;
  o.size = size;
  return o;
}

/// What is left of each cell's labels by plain propagation; no sets where a cell has none.
LabelSets propagated(const ModelProblem& problem) {
  LabelSets sets = problem.domains(problem.demands());
  Catalog catalog(problem.network());
  for (int c = 0; c < problem.network().cells; ++c) catalog.setDomain(c, sets[c]);
  if (!catalog.propagateAll()) return {};
  for (int c = 0; c < problem.network().cells; ++c)
    std::ranges::copy(catalog.domain(c), sets[c].begin());
  return sets;
}

LabelSets consistent(const ModelProblem& problem) {
  const ModelOptions& o = problem.options();
  LabelSets sets = problem.domains(problem.demands());
  const bool possible = makeArcConsistent(problem.network(), sets, o.size.z * o.frames);
  return possible ? sets : LabelSets{};
}

/// A hill that climbs one layer in `run` columns along x, flat before, on top and behind: how high
/// it may be depends on how far both sides are.
LabelGrid hill(int run) {
  constexpr int kFlat = 3, kHeight = 5;
  const int slope = run * (kHeight - 1);
  LabelGrid grid;
  grid.cells = Array3D<Label>({3 * kFlat + 2 * slope, 3, kHeight}, 0);
  // Labels: 0 air, 1 rock, 2 flat ground, then the columns of a step up, and those of a step down.
  grid.labels.resize(static_cast<std::size_t>(3 + 2 * run));
  grid.labels[0] = emptyLook();
  for (int x = 0; x < grid.size().x; ++x) {
    const int up = x - kFlat, down = grid.size().x - 1 - x - kFlat;
    int level = up < 0 || down < 0 ? 0 : kHeight - 1, surface = 2;
    if (up >= 0 && up < slope) level = up / run, surface = 3 + up % run;
    if (down >= 0 && down < slope) level = down / run, surface = 3 + run + down % run;
    for (int y = 0; y < 3; ++y) {
      for (int z = 0; z < level; ++z) grid.cells(x, y, z) = 1;
      grid.cells(x, y, level) = static_cast<Label>(surface);
    }
  }
  return grid;
}

TEST(ArcConsistency, LeavesTheSetsOfPlainPropagation) {
  // More cells than a piece has; the hill's sides reach through all of it.
  for (const LabelGrid& example : {test::canyon(), test::city(), hill(4)}) {
    const Adjacency adjacency = findAdjacency(example);
    for (const bool periodic : {false, true}) {
      ModelOptions o = sized({70, 31, example.size().z});
      o.periodic.x = periodic;
      const ModelProblem problem(adjacency, o);
      EXPECT_GT(propagated(problem).rows(), 0U);
      EXPECT_EQ(consistent(problem), propagated(problem)) << periodic;
    }
  }
}

TEST(ArcConsistency, KeepsToPinsHolesAndSymmetry) {
  const LabelGrid example = test::canyon();
  const Adjacency adjacency = findAdjacency(example);
  ModelOptions o = sized({60, 40, example.size().z});
  const LabelSets free = consistent(ModelProblem(adjacency, o));
  // The rarest label of the example, at its height.
  Vec3i rarest{};
  forEachCell(example.size(), [&](const Vec3i& p) {
    const auto count = [&](const Vec3i& q) { return adjacency.frequency[example.cells[q]]; };
    if (count(p) < count(rarest)) rarest = p;
  });
  o.pins.push_back({{30, 20, rarest.z}, {example.cells[rarest]}});
  const ModelProblem pinned(adjacency, o);
  EXPECT_EQ(consistent(pinned), propagated(pinned));
  EXPECT_NE(consistent(pinned), free);
  EXPECT_GT(consistent(pinned).rows(), 0U);
  o.pins.clear();
  o.mask = Array3D<std::uint8_t>(o.size, 1);
  for (int x = 10; x < 20; ++x) o.mask(x, 7, 0) = 0;
  const ModelProblem holed(adjacency, o);
  EXPECT_EQ(consistent(holed), propagated(holed));
  EXPECT_GT(propagated(holed).rows(), 0U);
  o.mask = {};
  o.symmetry.mirrorX = true;
  const ModelProblem mirrored(adjacency, o);
  EXPECT_EQ(consistent(mirrored), propagated(mirrored));
}

TEST(ArcConsistency, FindsWhereNothingFits) {
  const LabelGrid example = test::canyon();
  const Adjacency adjacency = findAdjacency(example);
  ModelOptions o = sized({60, 40, example.size().z});
  const Label air = example.cells(0, 0, example.size().z - 1);
  o.pins.push_back({{30, 20, 0}, {air}});
  const ModelProblem problem(adjacency, o);
  EXPECT_EQ(consistent(problem).rows(), 0U);
  EXPECT_EQ(propagated(problem).rows(), 0U);
}

TEST(ArcConsistency, IsTheSameAtAnyNumberOfThreads) {
  const LabelGrid example = test::city();
  const Adjacency adjacency = findAdjacency(example);
  const ModelOptions o = sized({70, 31, example.size().z});
  const ModelProblem problem(adjacency, o);
  testing::expectSameAtAnyThreads([&] { return consistent(problem); });
}

TEST(ArcConsistency, SetsOfATileAreConsistentAndWithinThoseOfTheWhole) {
  for (const LabelGrid& example : {test::canyon(), hill(4)}) {
    const Adjacency adjacency = findAdjacency(example);
    const ModelOptions o = sized({130, 110, example.size().z});
    const ModelProblem problem(adjacency, o);
    LabelSets sets = problem.domains(problem.demands());
    ASSERT_TRUE(makeConsistentByTile(problem, sets));
    const LabelSets most = propagated(problem);
    for (int c = 0; c < problem.network().cells; ++c) {
      ASSERT_GT(labelsIn(sets[c]), 0);
      forEachLabel(sets[c], [&](int label) { ASSERT_TRUE(containsLabel(most[c], label)); });
    }
    // Nothing more goes.
    Catalog catalog(problem.network());
    for (int c = 0; c < problem.network().cells; ++c) catalog.setDomain(c, sets[c]);
    ASSERT_TRUE(catalog.propagateAll());
    for (int c = 0; c < problem.network().cells; ++c)
      ASSERT_TRUE(std::ranges::equal(catalog.domain(c), sets[c]));
  }
}

}  // namespace
}  // namespace exemplar
