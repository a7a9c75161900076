// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/start_over_sides.h"

#include <gtest/gtest.h>

#include "synth/model/anneal.h"
#include "synth/model/examples.h"
#include "synth/model/free_sides.h"
#include "synth/model/repeat_example.h"
#include "synth/model/start.h"
#include "synth/model/stretch_example.h"
#include "threads.h"

namespace exemplar {
namespace {

using test::expectSound;
using Request = test::FreeSides;

/// Walls that run out of the box at places that do not face each other, and a pond; no order of
/// planes is longer than the example.
LabelGrid cutWalls() {
  return test::drawn({{"ggggwggg", "ggggwggg", "wwwwwggg", "gggggggg", "gggggwww", "gppggwgg",
                       "gppggwgg", "gggggwgg"}});
}

TEST(RepeatExample, CopiesGoOnFromEachOther) {
  const Request request(cutWalls(), {30, 27, 1});
  Request::Prepared p(request);
  const auto labels = repeatExample(p.problem, p.base, p.chooser, request.example, p.statistics);
  ASSERT_TRUE(labels);
  expectSound(p, *labels);
  // A pond in each copy that is whole: three by three of at most 12 columns a side fit at least
  // four times.
  const Label pond = request.example.cells(1, 5, 0);
  EXPECT_GE(std::ranges::count(*labels, pond), 4 * 4);
}

TEST(RepeatExample, OfAResultThatIsNotLargerThereIsNone) {
  const Request request(cutWalls(), {8, 27, 1});
  Request::Prepared p(request);
  EXPECT_FALSE(repeatExample(p.problem, p.base, p.chooser, request.example, p.statistics));
}

TEST(StartOverSides, IsSoundAndTheSameAtAnyNumberOfThreads) {
  const Request request(cutWalls(), {40, 40, 1});
  const auto start = [&] {
    Request::Prepared p(request);
    auto labels =
        startOverSides(p.problem, p.base, p.chooser, std::span(&request.example, 1), p.statistics);
    EXPECT_TRUE(labels);
    expectSound(p, *labels);
    return *labels;
  };
  EXPECT_EQ(testing::onThreads(1, start), testing::onThreads(8, start));
}

TEST(StartOverSides, WhatOnlyOpenSidesShowIsThere) {
  // A fence along all sides, and a wall that runs out through two of them: what is open there is
  // fenced all the same.
  Request request(test::drawn({{"ffffffff", "fggggggf", "fggggggf", "wwwwwwww", "fggggggf",
                                "fgggpggf", "ffffffff"}}),
                  {20, 20, 1});
  for (const int side : {0, 1}) request.options.sides[side].kind = SideRule::Kind::Open;
  for (const int side : {2, 3}) request.options.sides[side].kind = SideRule::Kind::Example;
  Request::Prepared p(request);
  const auto labels =
      startOverSides(p.problem, p.base, p.chooser, std::span(&request.example, 1), p.statistics);
  ASSERT_TRUE(labels);
  expectSound(p, *labels);
  const Label fence = request.example.cells(0, 0, 0);
  int fenced = 0;
  for (int y = 0; y < 20; ++y) fenced += (*labels)[p.problem.position({0, y, 0})] == fence;
  EXPECT_GE(fenced, 12);
}

TEST(StartOverSides, OfSeveralStartsTheNearestIsTaken) {
  const Request request(cutWalls(), {40, 40, 1});
  Request::Prepared p(request);
  const std::span<const LabelGrid> examples(&request.example, 1);
  const auto best = startOverSides(p.problem, p.base, p.chooser, examples, p.statistics);
  auto repeated = repeatExample(p.problem, p.base, p.chooser, request.example, p.statistics);
  ASSERT_TRUE(best && repeated);
  const PatchGoal goal(p.problem, examples);
  const auto energyOf = [&](std::vector<Label> labels, double moves) {
    return annealPatches(p.problem, p.base, p.chooser, goal, request.options.seed, labels,
                         {.moves = moves}, p.statistics);
  };
  EXPECT_LE(energyOf(*best, 0), energyOf(*repeated, request.options.moves / 20) + 1e-6);
}

}  // namespace
}  // namespace exemplar
