// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/limits.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "synth/model/examples.h"
#include "synth/model/synthesize.h"
#include "voxelize/violations.h"

namespace exemplar {
namespace {

std::vector<Label> named(const LabelGrid& grid, const std::vector<std::string>& names) {
  std::vector<Label> labels;
  for (int b = 0; b < grid.labelCount(); ++b) {
    for (const std::string& n : names) {
      if (grid.labels[b].name == n) labels.push_back(static_cast<Label>(b));
    }
  }
  return labels;
}

std::int64_t count(const LabelGrid& grid, const std::vector<Label>& set) {
  std::int64_t n = 0;
  for (const Label b : grid.cells.values()) n += std::count(set.begin(), set.end(), b);
  return n;
}

/// The pieces of a set of labels, by flooding.
int pieces(const LabelGrid& grid, const std::vector<Label>& set) {
  Array3D<int> seen(grid.size(), 0);
  const auto in = [&](const Vec3i& p) {
    return grid.cells.contains(p) && seen[p] == 0 &&
           std::count(set.begin(), set.end(), grid.cells[p]) > 0;
  };
  int found = 0;
  for (std::size_t i = 0; i < grid.cells.count(); ++i) {
    std::vector<Vec3i> stack{grid.cells.ijk(i)};
    if (!in(stack[0])) continue;
    ++found;
    seen[stack[0]] = 1;
    while (!stack.empty()) {
      const Vec3i p = stack.back();
      stack.pop_back();
      for (const Vec3i d : {Vec3i{1, 0, 0}, Vec3i{-1, 0, 0}, Vec3i{0, 1, 0}, Vec3i{0, -1, 0},
                            Vec3i{0, 0, 1}, Vec3i{0, 0, -1}}) {
        if (!in(p + d)) continue;
        seen[p + d] = 1;
        stack.push_back(p + d);
      }
    }
  }
  return found;
}

TEST(Limits, CountsAreKept) {
  const LabelGrid example = test::figure36();
  ModelOptions o{.moves = 0};
  o.size = {22, 22, 1};
  const std::vector<Label> ends = named(example, {"e", "n", "w", "s"});
  const std::vector<Label> bends = named(example, {"en", "nw", "sw", "es"});
  ASSERT_EQ(ends.size(), 4u);
  for (int seed = 0; seed < 3; ++seed) {
    o.seed = seed;
    o.counts.clear();
    const ModelResult before = synthesizeModel(example, o);
    ASSERT_EQ(before.outcome, Outcome::Complete);
    ASSERT_GT(count(before.grid(), ends), 10);
    o.counts = {{ends, 0, 10}, {bends, count(before.grid(), bends) + 15, std::nullopt}};
    const ModelResult after = synthesizeModel(example, o);
    ASSERT_EQ(after.outcome, Outcome::Complete);
    EXPECT_LE(count(after.grid(), ends), 10);
    EXPECT_GE(count(after.grid(), bends), o.counts[1].least);
    EXPECT_EQ(findViolations(after.grid(), example).count, 0);
  }
}

TEST(Limits, ChosenLabelsFormOnePiece) {
  const LabelGrid example = test::figure36();
  ModelOptions o{.moves = 0};
  o.size = {20, 20, 1};
  std::vector<Label> paths;
  for (int b = 1; b < example.labelCount(); ++b) paths.push_back(static_cast<Label>(b));
  o.weights.assign(example.labelCount(), 1);
  o.weights[0] = 8;
  for (int seed = 0; seed < 3; ++seed) {
    o.seed = seed;
    o.connected.clear();
    ASSERT_GT(pieces(synthesizeModel(example, o).grid(), paths), 1);
    o.connected = {paths};
    const ModelResult r = synthesizeModel(example, o);
    ASSERT_EQ(r.outcome, Outcome::Complete);
    EXPECT_EQ(pieces(r.grid(), paths), 1);
    EXPECT_EQ(findViolations(r.grid(), example).count, 0);
  }
}

TEST(Limits, CountsThatTheSetsExcludeAreProvedImpossible) {
  // Sides of the flat example are its own: 'a' all around, and 'b' occurs only within.
  const LabelGrid example = test::drawnFlat({"aaaaa", "abbba", "abcba", "abbba", "aaaaa"});
  const Label a = example.cells(0, 0, 0), b = example.cells(1, 1, 0), c = example.cells(2, 2, 0);
  ModelOptions o;
  o.size = {8, 6, 1};
  ASSERT_EQ(synthesizeModel(example, o).outcome, Outcome::Complete);
  const auto why = [&](std::vector<CountLimit> counts) {
    o.counts = std::move(counts);
    const ModelResult r = synthesizeModel(example, o);
    EXPECT_EQ(r.frames.empty(), r.outcome != Outcome::Complete);
    return r.outcome == Outcome::Impossible ? r.conflict.text : "";
  };
  using testing::HasSubstr;
  EXPECT_THAT(why({{{a, b, c}, 49, std::nullopt}}), HasSubstr("of 48 only 48"));
  EXPECT_THAT(why({{{b}, 25, std::nullopt}}), HasSubstr("of 48 only 24"));
  EXPECT_THAT(why({{{a}, 0, 23}}), HasSubstr("24 must"));
  EXPECT_THAT(why({{{a}, 30, std::nullopt}, {{b, c}, 19, std::nullopt}}),
              HasSubstr("49 cells together, and there are 48"));
  EXPECT_EQ(why({{{a}, 24, 48}}), "");
  // A label without weight does not occur.
  o.weights.assign(static_cast<std::size_t>(example.labelCount()), 1.0);
  o.weights[c] = 0;
  EXPECT_THAT(why({{{c}, 1, std::nullopt}}), HasSubstr("only 0"));
}

TEST(Limits, WhatCannotBeCountedUpEndsUnfinished) {
  const LabelGrid example = test::figure36();
  ModelOptions o{.moves = 0};
  o.size = {6, 6, 1};
  o.budget = 300;
  // Propagation alone knows in which cells an end to the east may be; in all of them at once there
  // is none, since each has another label beside it.
  ModelResult r;
  std::int64_t least = 36;
  do {
    o.counts = {{named(example, {"e"}), least--, std::nullopt}};
    r = synthesizeModel(example, o);
  } while (r.outcome == Outcome::Impossible && least > 0);
  EXPECT_EQ(r.outcome, Outcome::Unfinished);
  EXPECT_TRUE(r.frames.empty());
}

TEST(Metropolis, DrawsLabelsToWhereTheirWeightIs) {
  const LabelGrid example = test::figure36();
  ModelOptions o{.moves = 0};
  o.size = {30, 30, 1};
  o.block = {5, 5, 2};
  o.rounds = 20;
  o.metropolis = true;
  WeightMap empty{{0}, Array3D<float>(o.size, 1.f)};
  for (int i = 0; i < 30; ++i) {
    for (int j = 0; j < 30; ++j) empty.weight(i, j, 0) = i < 15 ? 3.f : 0.5f;
  }
  o.weightMaps.push_back(empty);
  const ModelResult r = synthesizeModel(example, o);
  ASSERT_EQ(r.outcome, Outcome::Complete);
  EXPECT_EQ(findViolations(r.grid(), example).count, 0);
  EXPECT_GT(r.statistics.blocksKept, 0);
  int left = 0, right = 0;
  for (int i = 1; i < 29; ++i) {
    for (int j = 1; j < 29; ++j) (i < 15 ? left : right) += r.grid().cells(i, j, 0) != 0;
  }
  EXPECT_GT(right, 2 * left);
}

TEST(Resemblance, CountsThePlacesThatDifferLeast) {
  // Beside 'a' on its left, 'b' occurs twice and 'c' once; nothing else is known.
  const LabelGrid example = test::drawnFlat({"abxabxacx"});
  ModelOptions o{.moves = 0};
  o.size = {3, 1, 1};
  for (SideRule& s : o.sides) s.kind = SideRule::Kind::Free;
  const Adjacency a = findAdjacency(example);
  const ModelProblem problem(a, o);
  const Resemblance resemblance(problem, std::span(&example, 1));
  LabelSets all(example.labelCount(), 1);
  for (int b = 0; b < example.labelCount(); ++b) addLabel(all[0], b);
  const auto placed = [](int cell) { return cell == 0 ? 1 : -1; };
  const std::vector<double> l = resemblance.likeness(1, all[0], placed);
  EXPECT_EQ(l, (std::vector<double>{0, 0, 2, 0, 1}));
  // Where nothing resembles what is there, the least different count.
  const std::vector<double> rest = resemblance.likeness(1, all[0], [](int cell) {
    return cell == 0 ? 4 : cell == 2 ? 4 : -1;
  });
  EXPECT_EQ(rest, (std::vector<double>{0, 1, 0, 1, 0}));
}

TEST(Resemblance, MakesResultsMoreLikeTheExample) {
  // How many 3 x 3 surroundings of a result occur in the example.
  const LabelGrid example = test::figure36();
  const auto windows = [](const LabelGrid& g) {
    std::vector<std::array<Label, 9>> list;
    for (int i = 1; i + 1 < g.size().x; ++i) {
      for (int j = 1; j + 1 < g.size().y; ++j) {
        std::array<Label, 9> w;
        for (int n = 0; n < 9; ++n) w[n] = g.cells(i + n % 3 - 1, j + n / 3 - 1, 0);
        list.push_back(w);
      }
    }
    std::sort(list.begin(), list.end());
    return list;
  };
  const auto known = windows(example);
  std::array<int, 2> alike{};
  for (int seed = 0; seed < 3; ++seed) {
    for (int r = 0; r < 2; ++r) {
      ModelOptions o{.moves = 0};
      o.size = {24, 24, 1};
      o.seed = seed;
      o.choice = r ? LabelChoice::Resemblance : LabelChoice::Frequency;
      const ModelResult result = synthesizeModel(example, o);
      ASSERT_EQ(result.outcome, Outcome::Complete);
      for (const auto& w : windows(result.grid())) {
        alike[r] += std::binary_search(known.begin(), known.end(), w);
      }
    }
  }
  EXPECT_GT(alike[1], alike[0] * 5 / 4);
}

}  // namespace
}  // namespace exemplar
