// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "voxelize/violations.h"

#include <gtest/gtest.h>

#include "synth/model/examples.h"
#include "synth/model/synthesize.h"
#include "voxelize/hears_cancellation.h"

namespace exemplar {
namespace {

TEST(FindViolations, AnExampleBreaksNoRuleOfItsOwn) {
  const LabelGrid example = test::city();
  const AdjacencyViolations v = findViolations(example, example);
  EXPECT_EQ(v.count, 0);
  const Vec3i n = example.size();
  EXPECT_EQ(v.pairs, 3 * volume(n) - std::int64_t{n.x} * n.y - std::int64_t{n.y} * n.z -
                         std::int64_t{n.x} * n.z);
}

TEST(FindViolations, FindsEachPlantedOne) {
  const LabelGrid example = test::figure35();
  ModelOptions o;
  o.size = {15, 15, 1};
  const ModelResult r = synthesizeModel(example, o);
  ASSERT_EQ(r.outcome, Outcome::Complete);
  // Two '2's side by side are nowhere in the example.
  LabelGrid broken = r.grid();
  Label two = 0;
  while (broken.labels[two].name != "2") ++two;
  broken.cells(7, 7, 0) = broken.cells(8, 7, 0) = two;
  const AdjacencyViolations v = findViolations(broken, example);
  bool found = false;
  for (const AdjacencyViolation& l : v.listed) {
    found = found || (l.cell == Vec3i{7, 7, 0} && l.offset == CellOffset{1, 0, 0, 0} &&
                      l.first == two && l.second == two);
  }
  EXPECT_TRUE(found);
}

TEST(FindViolations, LooksAcrossPeriodicSidesFramesAndFurtherOffsets) {
  LabelGrid example;
  example.cells = Array3D<Label>({4, 1, 1});
  example.labels.resize(2);
  for (int i = 0; i < 4; ++i) example.cells(i, 0, 0) = i % 2;
  LabelGrid odd = example;
  odd.cells = Array3D<Label>({3, 1, 1});
  odd.cells(1, 0, 0) = 1;
  EXPECT_EQ(findViolations(odd, example).count, 0);
  ViolationOptions periodic;
  periodic.periodic.x = true;
  EXPECT_EQ(findViolations(odd, example, periodic).count, 1);

  ViolationOptions frames;
  frames.adjacency.frames = true;
  std::vector<LabelGrid> same{example, example};
  std::vector<LabelGrid> changing{example, example};
  for (int i = 0; i < 4; ++i) changing[1].cells(i, 0, 0) = 1 - i % 2;
  EXPECT_EQ(findViolations(same, same, frames).count, 0);
  EXPECT_EQ(findViolations(changing, same, frames).count, 4);

  ViolationOptions far;
  far.adjacency.offsets = {{2, 0, 0, 0}};
  LabelGrid unequal = example;
  unequal.cells(3, 0, 0) = 0;
  const AdjacencyViolations v = findViolations(unequal, example, far);
  EXPECT_EQ(v.count, 2);  // 0 beside 0, and 1 two before 0
}

TEST(FindViolations, HearsCancellation) {
  const LabelGrid g = test::figure36();
  test::expectHearsCancellation([&](const Progress& p) { (void)findViolations(g, g, {}, p); });
}

TEST(FindViolations, LeavesHolesOut) {
  LabelGrid example;
  example.cells = Array3D<Label>({2, 1, 1});
  example.cells(1, 0, 0) = 1;
  example.labels.resize(2);
  LabelGrid wrong = example;
  wrong.cells(0, 0, 0) = 1;
  EXPECT_EQ(findViolations(wrong, example).count, 1);
  Array3D<std::uint8_t> mask({2, 1, 1}, 1);
  mask(0, 0, 0) = 0;
  ViolationOptions o;
  o.mask = &mask;
  EXPECT_EQ(findViolations(wrong, example, o).count, 0);
}

}  // namespace
}  // namespace exemplar
