// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/stretch_example.h"

#include <gtest/gtest.h>

#include <map>

#include "synth/model/examples.h"
#include "synth/model/free_sides.h"
#include "threads.h"

namespace exemplar {
namespace {

struct Request : test::FreeSides {
  using FreeSides::FreeSides;

  std::optional<std::vector<Label>> stretched() const {
    const Prepared p(*this);
    auto labels = stretchExample(p.problem, p.base, p.chooser, std::span(&example, 1));
    if (labels) test::expectSound(p, *labels);
    return labels;
  }
};

/// A wall with a tower, cut off at both ends, along x between grass.
LabelGrid cutWall() {
  return test::drawn({{"gggggggg", "wwwwTwww", "gggggggg"},
                      {"........", "wwwwTwww", "........"},
                      {"........", "....t...", "........"}});
}

TEST(StretchExample, WhatRunsOverTheSidesRunsThroughTheResult) {
  const Request request(cutWall(), {30, 9, 3});
  const auto labels = request.stretched();
  ASSERT_TRUE(labels);
  std::map<Label, int> count;
  for (const Label label : *labels) ++count[label];
  const LabelGrid& example = request.example;
  const Label wall = example.cells(0, 1, 0), tower = example.cells(4, 1, 1);
  EXPECT_GE(count[wall], 40);
  // The tower comes back, not the wall alone made longer.
  EXPECT_GE(count[tower], 4);
}

TEST(StretchExample, KeepsToRulesOfSidesAndTiles) {
  Request request(cutWall(), {30, 9, 3});
  request.options.sides[2].kind = request.options.sides[3].kind = SideRule::Kind::Example;
  EXPECT_TRUE(request.stretched());
  request.options.periodic.x = true;
  EXPECT_TRUE(request.stretched());
  request.options.periodic.x = false;
  request.options.sides[0] = {SideRule::Kind::Labels, {request.example.cells(4, 1, 2)}};
  EXPECT_FALSE(request.stretched());  // no plane is of tower tops alone
}

TEST(StretchExample, WhereNoPlaneCanComeTwiceThereIsNone) {
  const Request request(test::drawn({{"abcde"}, {"....."}}), {9, 1, 2});
  EXPECT_FALSE(request.stretched());
  const Request asLarge(test::drawn({{"abcde"}, {"....."}}), {5, 1, 2});
  EXPECT_TRUE(asLarge.stretched());
}

TEST(StretchExample, SeedsDiffer) {
  Request request(cutWall(), {30, 9, 3});
  const auto first = request.stretched();
  request.options.seed = 1;
  const auto second = request.stretched();
  EXPECT_NE(first, second);
  EXPECT_EQ(second, request.stretched());
}

}  // namespace
}  // namespace exemplar
