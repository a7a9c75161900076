// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// How probable labels are: beside the labels in place, or all over.

#include "synth/model/choose.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "synth/model/examples.h"
#include "synth/model/synthesize.h"
#include "voxelize/violations.h"

namespace exemplar {
namespace {

ModelOptions freeSides(const Vec3i& size, std::uint64_t seed, LabelChoice choice) {
  ModelOptions o{.moves = 0};
  o.size = size;
  o.seed = seed;
  o.choice = choice;
  for (SideRule& side : o.sides) side.kind = SideRule::Kind::Free;
  return o;
}

/// A row of three labels, each of which may follow each, drawn from a chain with given shares.
LabelGrid chain(int cells) {
  const double share[3][3] = {{0.9, 0.05, 0.05}, {0.1, 0.3, 0.6}, {0.4, 0.5, 0.1}};
  const Random random(7);
  LabelGrid grid;
  grid.cells = Array3D<Label>({cells, 1, 1}, 0);
  grid.labels.resize(3);
  for (int i = 1; i < cells; ++i) {
    double rest = random.uniform(static_cast<std::uint64_t>(i), 0);
    Label next = 0;
    while (next < 2 && rest >= share[grid.cells(i - 1, 0, 0)][next]) {
      rest -= share[grid.cells(i - 1, 0, 0)][next++];
    }
    grid.cells(i, 0, 0) = next;
  }
  return grid;
}

/// The largest difference, in standard deviations, between how often a label follows another in a
/// result and how often it should, as in the example.
double worstTransition(const LabelGrid& example, const LabelGrid& result) {
  const Adjacency wanted = findAdjacency(example), found = findAdjacency(result);
  double worst = 0;
  for (Label a = 0; a < 3; ++a) {
    double there = 0, here = 0;
    for (Label b = 0; b < 3; ++b) {
      there += static_cast<double>(wanted.rules[0].count(a, b));
      here += static_cast<double>(found.rules[0].count(a, b));
    }
    for (Label b = 0; b < 3; ++b) {
      const double p = static_cast<double>(wanted.rules[0].count(a, b)) / there;
      const double deviation = std::sqrt(here * p * (1 - p));
      worst = std::max(
          worst, std::abs(static_cast<double>(found.rules[0].count(a, b)) - here * p) / deviation);
    }
  }
  return worst;
}

TEST(LabelChooser, ContinuesARowAsTheExampleDoes) {
  // With one neighbor in place the choice is that of the chain itself: each count of pairs is
  // binomial. Nine of them, ten seeds: beyond 4.5 deviations once in 1600 such tests.
  const LabelGrid example = chain(2000);
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const ModelResult r =
        synthesizeModel(example, freeSides({6000, 1, 1}, seed, LabelChoice::Neighbors));
    ASSERT_EQ(r.outcome, Outcome::Complete);
    EXPECT_LT(worstTransition(example, r.grid()), 4.5) << seed;
  }
  // Chosen by frequency alone, pairs come as often as labels meet by chance.
  const ModelResult r =
      synthesizeModel(example, freeSides({6000, 1, 1}, 0, LabelChoice::Frequency));
  EXPECT_GT(worstTransition(example, r.grid()), 20);
}

/// Ground with posts two cells high, one to about 20 cells, under ten layers of air.
LabelGrid posts() {
  const Random random(3);
  LabelGrid grid;
  grid.cells = Array3D<Label>({24, 24, 13}, 0);
  grid.labels.resize(4);
  for (int x = 0; x < 24; ++x) {
    for (int y = 0; y < 24; ++y) {
      grid.cells(x, y, 0) = 1;
      if (random.below(20, static_cast<std::uint64_t>(24 * x + y)) != 0) continue;
      grid.cells(x, y, 1) = 2;
      grid.cells(x, y, 2) = 3;
    }
  }
  return grid;
}

double share(const LabelGrid& grid, Label label) {
  double count = 0;
  for (const Label b : grid.cells.values()) count += b == label;
  return count / static_cast<double>(grid.cells.count());
}

TEST(LabelChooser, PlacesObjectsAsDenselyAsTheExample) {
  const LabelGrid example = posts();
  const double wanted = share(example, 2);
  for (const ModelMethod method : {ModelMethod::Whole, ModelMethod::Blocks}) {
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      ModelOptions o = freeSides({60, 60, 13}, seed, LabelChoice::Neighbors);
      o.sides[4].kind = o.sides[5].kind = SideRule::Kind::Example;
      o.method = method;
      const ModelResult r = synthesizeModel(example, o);
      ASSERT_EQ(r.outcome, Outcome::Complete);
      EXPECT_EQ(findViolations(r.grid(), example).count, 0);
      // Neighbors are taken each by itself, so the density is not met to the last post; chance
      // alone moves some 180 posts by 13.
      EXPECT_NEAR(share(r.grid(), 2), wanted, 0.4 * wanted)
          << seed << (method == ModelMethod::Whole ? " whole" : " in blocks");
    }
  }
  // By frequency all over, air wins by what is far above; all alike, every second cell is a
  // post.
  const auto shareBy = [&](LabelChoice choice) {
    ModelOptions o = freeSides({60, 60, 13}, 0, choice);
    o.sides[4].kind = o.sides[5].kind = SideRule::Kind::Example;
    return share(synthesizeModel(example, o).grid(), 2);
  };
  EXPECT_LT(shareBy(LabelChoice::Frequency), 0.3 * wanted);
  EXPECT_GT(shareBy(LabelChoice::Uniform), 3 * wanted);
}

TEST(LabelChooser, MultipliesByTheUsersWeights) {
  // A label of twice the weight follows twice as often, compared with each other one.
  const LabelGrid example = chain(2000);
  ModelOptions o = freeSides({6000, 1, 1}, 1, LabelChoice::Neighbors);
  o.weights = {1, 3, 1};
  const ModelResult r = synthesizeModel(example, o);
  const Adjacency wanted = findAdjacency(example), found = findAdjacency(r.grid());
  for (Label a = 0; a < 3; ++a) {
    const auto odds = [&](const Adjacency& in) {
      return static_cast<double>(in.rules[0].count(a, 1)) /
             static_cast<double>(in.rules[0].count(a, 2));
    };
    // The odds of two counts of n and m are good to sqrt(1/n + 1/m) of themselves.
    const double deviation = std::sqrt(1.0 / static_cast<double>(found.rules[0].count(a, 1)) +
                                       1.0 / static_cast<double>(found.rules[0].count(a, 2)));
    EXPECT_NEAR(odds(found) / (3 * odds(wanted)), 1, 4 * deviation);
  }
}

}  // namespace
}  // namespace exemplar
