// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/surface/sheet_seams.h"

#include <gtest/gtest.h>

#include "synth/geometry/quilting/repetition.h"
#include "tests/synth/surface/surfaces.h"
#include "tests/threads.h"

namespace exemplar::surface {
namespace {

/// Metal, or chainmail in step, placed on a ball.
struct Placed {
  DistanceField example;
  Slab slab{example};
  Lattice lattice;
  SlabSymmetry symmetry;
  Sheet sheet = makeSheet(makeSphere({0, 0, 0}, 1, 10), {.edge = 0.09});
  Coordinates coordinates;
  LocalMapper mapper;
  Placements placements;

  explicit Placed(DistanceField field, std::uint64_t seed = 0)
      : example(std::move(field)),
        lattice(latticeOf(findRepetition(example.values).basis)),
        symmetry(findSymmetry(slab, lattice)),
        coordinates(integrate(sheet, smoothestField(sheet, symmetry.turns), lattice, 0.06)),
        mapper(sheet, coordinates, {.sample = 0.06, .radius = 18, .leastRadius = 12}),
        placements(place(mapper, slab, {.seed = seed, .symmetry = symmetry})) {}
};

TEST(Placements, CoverEveryNodeBySomeoneWhoIsThere) {
  for (const DistanceField& example : {metal(), chainmail()}) {
    const Placed placed(example);
    std::size_t possible = 0;
    for (std::uint32_t v = 0; v < placed.sheet.positions.size(); ++v) {
      const Placements::Membership* m = placed.placements.find(v, placed.placements.owner[v]);
      ASSERT_TRUE(m);
      possible += m->possible;
    }
    EXPECT_GT(possible, placed.sheet.positions.size() * 98 / 100);
  }
}

TEST(Placements, WhatRepeatsStaysInStep) {
  const Placed placed(chainmail());
  std::vector<double> all;
  for (const Placement& p : placed.placements.all)
    if (p.met) all.push_back(p.disagreement);
  ASSERT_GT(all.size(), 8u);
  std::sort(all.begin(), all.end());
  // Chainmail one period on disagrees by about 0.1 with itself, at random by 0.7.
  EXPECT_LT(all[all.size() / 2], 0.25);
}

TEST(SheetSeams, CutsNeverCostMoreAndOwnersStayWhereTheyCan) {
  for (const DistanceField& example : {metal(), chainmail()}) {
    Placed placed(example);
    const std::vector<std::uint32_t> before = placed.placements.owner;
    std::int64_t last = -1;
    for (int pass = 0; pass < 3; ++pass) {
      const SheetSeams seams =
          cutSeams(placed.sheet, placed.slab, placed.placements, {.passes = 1});
      EXPECT_LE(seams.after, seams.before);
      if (last >= 0) {
        EXPECT_EQ(seams.before, last);
      }
      last = seams.after;
      if (pass == 0) {
        EXPECT_LT(seams.after, seams.before * 9 / 10);
      }
    }
    for (std::uint32_t v = 0; v < before.size(); ++v) {
      const std::uint32_t owner = placed.placements.owner[v];
      if (owner != before[v]) {
        EXPECT_TRUE(placed.placements.find(v, owner)->possible);
      }
    }
  }
}

TEST(SheetSeams, AreTheSameAtAnyNumberOfThreads) {
  testing::expectSameAtAnyThreads([] {
    Placed placed(metal());
    cutSeams(placed.sheet, placed.slab, placed.placements);
    return placed.placements.owner;
  });
}

}  // namespace
}  // namespace exemplar::surface
