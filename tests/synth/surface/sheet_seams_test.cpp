// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/surface/sheet_seams.h"

#include <gtest/gtest.h>

#include "synth/geometry/quilting/repetition.h"
#include "tests/synth/surface/surfaces.h"
#include "tests/threads.h"

namespace exemplar::surface {
namespace {

/// An example placed on a ball of radius 1, a sample of it `sample` long.
struct Placed {
  DistanceField example;
  Slab slab{example};
  Lattice lattice;
  SlabSymmetry symmetry;
  Sheet sheet;
  Coordinates coordinates;
  LocalMapper mapper;
  Placements placements;

  Placed(DistanceField field, double sample)
      : example(std::move(field)),
        lattice(latticeOf(findRepetition(example.values).basis)),
        symmetry(findSymmetry(slab, lattice)),
        sheet(makeSheet(makeSphere({0, 0, 0}, 1, 10), {.edge = 1.5 * sample})),
        coordinates(integrate(sheet, smoothestField(sheet, symmetry.turns), lattice, sample)),
        mapper(sheet, coordinates, {.sample = sample, .radius = 12, .leastRadius = 10}),
        placements(place(mapper, slab, {.symmetry = symmetry})) {}
  // The mapper refers to the sheet beside it.
  Placed(const Placed&) = delete;
};

Placed placedMetal() { return {littleMetal(), 0.09}; }
Placed placedChainmail() { return {littleChainmail(), 0.07}; }

TEST(Placements, CoverEveryNodeBySomeoneWhoIsThere) {
  for (const Placed& placed : {placedMetal(), placedChainmail()}) {
    std::size_t possible = 0;
    for (std::uint32_t v = 0; v < placed.sheet.positions.size(); ++v) {
      const Placements::Membership* m = placed.placements.find(v, placed.placements.owner[v]);
      ASSERT_TRUE(m);
      possible += m->possible;
    }
    EXPECT_GT(possible, placed.sheet.positions.size() * 97 / 100);
  }
}

TEST(Placements, WhatRepeatsStaysInStep) {
  const Placed placed = placedChainmail();
  std::vector<double> all;
  for (const Placement& p : placed.placements.all)
    if (p.met) all.push_back(p.disagreement);
  ASSERT_GT(all.size(), 8u);
  std::sort(all.begin(), all.end());
  // Chainmail one period on disagrees by about 0.1 with itself, at random by 0.7.
  EXPECT_LT(all[all.size() / 2], 0.25);
}

TEST(SheetSeams, CutsNeverCostMoreAndOwnersStayWhereTheyCan) {
  for (const auto make : {placedMetal, placedChainmail}) {
    Placed placed = make();
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
    Placed placed = placedMetal();
    cutSeams(placed.sheet, placed.slab, placed.placements);
    return placed.placements.owner;
  });
}

}  // namespace
}  // namespace exemplar::surface
