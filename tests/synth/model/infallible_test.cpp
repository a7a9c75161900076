// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/infallible.h"

#include <gtest/gtest.h>

#include "synth/model/examples.h"
#include "synth/model/networks.h"
#include "voxelize/hears_cancellation.h"

namespace exemplar {
namespace {

using Verdict = InfallibleProof::Verdict;

LabelGrid checkerboard() { return test::drawnFlat({"abab", "baba", "abab", "baba"}); }

TEST(Infallible, SmallExamplesOfTheThesisAreProved) {
  // Figures 3.1(a) and (b): empty space and a checkerboard.
  for (const LabelGrid& example : {test::drawnFlat({"...", "..."}), checkerboard()}) {
    const Adjacency a = findAdjacency(example);
    EXPECT_TRUE(meetsStatement311(a));
    EXPECT_EQ(proveInfallible(a, {2, 2, 1}).verdict, Verdict::Proved);
  }
}

TEST(Infallible, Figure35IsNotProved) {
  const Adjacency fallible = findAdjacency(test::figure35());
  EXPECT_FALSE(meetsStatement311(fallible));
  EXPECT_FALSE(summarizeRules(fallible).infallible());
}

TEST(Infallible, StatementAndSmallestRegionAgreeOnFlatRules) {
  // With regions of 2 x 2 the proof is statement 3.11 (thesis, section 3.3.7), and what either
  // proves never fails by plain propagation.
  int proved = 0, open = 0;
  for (int trial = 0; trial < 150; ++trial) {
    const Adjacency a = test::randomAdjacency(3 + trial % 3, 0.3 + 0.004 * trial, trial);
    const bool statement = meetsStatement311(a);
    EXPECT_EQ(proveInfallible(a, {2, 2, 1}).verdict == Verdict::Proved, statement) << trial;
    ++(statement ? proved : open);
    if (!statement) continue;
    const ModelOptions o = test::freeOptions({9, 9, 1});
    const ModelProblem problem(a, o);
    for (int seed = 0; seed < 5; ++seed) EXPECT_TRUE(test::plainPass(problem, seed)) << trial;
  }
  EXPECT_GT(proved, 10);
  EXPECT_GT(open, 10);
}

TEST(Infallible, LargerRegionsProveMoreAndNeverWrongly) {
  int more = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Adjacency a = test::randomAdjacency(3, 0.25 + 0.003 * trial, trial);
    const bool small = proveInfallible(a, {2, 2, 1}).verdict == Verdict::Proved;
    const bool large = proveInfallible(a, {2, 3, 1}).verdict == Verdict::Proved;
    EXPECT_TRUE(large || !small) << trial;
    more += large && !small;
    if (!large) continue;
    const ModelOptions o = test::freeOptions({8, 8, 1});
    const ModelProblem problem(a, o);
    for (int seed = 0; seed < 5; ++seed) EXPECT_TRUE(test::plainPass(problem, seed)) << trial;
  }
  EXPECT_GT(more, 0);
}

TEST(Infallible, HearsCancellation) {
  const Adjacency a = findAdjacency(test::figure36());
  test::expectHearsCancellation([&](const Progress& p) { (void)summarizeRules(a, 2000, p); });
}

TEST(Infallible, SpaceIsProvedToo) {
  LabelGrid example;
  example.cells = Array3D<Label>({6, 6, 6});
  example.labels.resize(2);
  for (std::size_t i = 0; i < example.cells.count(); ++i) {
    const Vec3i p = example.cells.ijk(i);
    example.cells.data()[i] = static_cast<Label>((p.x + p.y + p.z) % 2);
  }
  const Adjacency a = findAdjacency(example);
  EXPECT_TRUE(meetsStatement311(a));
  EXPECT_EQ(proveInfallible(a, {2, 2, 2}).verdict, Verdict::Proved);
  EXPECT_EQ(proveInfallible(findAdjacency(test::canyon()), {2, 2, 2}, 50).verdict,
            Verdict::TooMany);
  const RuleSummary city = summarizeRules(findAdjacency(test::city()), 20000);
  EXPECT_GT(city.labels, 90);
  ASSERT_EQ(city.density.size(), 3u);
  for (const double d : city.density) {
    EXPECT_GT(d, 0.01);
    EXPECT_LT(d, 0.2);
  }
}

}  // namespace
}  // namespace exemplar
