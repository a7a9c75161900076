// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/terrain/height_patches.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/synth/terrain/height_samples.h"
#include "tests/threads.h"

namespace exemplar {
namespace {

using testing::ridges;

/// A part of an example, turned and lifted: sample (x, y) comes from `from` plus the step turned
/// back.
Grid<float> piece(const Grid<float>& example, int width, int height, const HeightOrigin& from,
                  float lift) {
  Grid<float> heights(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const HeightOrigin origin = stepped(from, {x, y});
      heights(x, y) = example(origin.x, origin.y) + lift;
    }
  }
  return heights;
}

TEST(HeightOrigin, StepsThereAndBack) {
  for (std::uint8_t turn = 0; turn < 8; ++turn) {
    const HeightOrigin origin{20, 30, 0, turn};
    for (const Pixel step : {Pixel{3, 0}, Pixel{0, 5}, Pixel{-2, 7}}) {
      EXPECT_EQ(stepped(stepped(origin, step), {-step.x, -step.y}), origin);
      const Pixel turned = turnedStep(turnedStep(step, turn), turnedBackBy(turn));
      EXPECT_EQ(turned, step);
    }
  }
}

TEST(HeightField, FindsWhatItWasCopiedFromInEveryOrientationAndHeight) {
  const Grid<float> example = ridges(60, 50, 1);
  const HeightSource sources[] = {heightSource(example)};
  for (std::uint8_t turn = 0; turn < 8; ++turn) {
    SCOPED_TRACE(static_cast<int>(turn));
    const HeightOrigin from{30, 25, 0, turn};
    const Grid<float> wanted = piece(example, 20, 18, from, 128.0f);
    HeightField field(20, 18, {.level = 0, .evenness = 0, .turns = {0, 1, 2, 3, 4, 5, 6, 7}});
    field.searchAll(sources, wanted, {});
    const Grid<HeightOrigin> origins = field.origins({});
    for (int y = 0; y < 18; ++y)
      for (int x = 0; x < 20; ++x) ASSERT_EQ(origins(x, y), stepped(from, {x, y}));
    // Votes are exact up to rounding at heights of about 1000.
    const Grid<float> voted = field.vote(sources, wanted, {});
    for (std::size_t s = 0; s < voted.count(); ++s) ASSERT_NEAR(voted[s], wanted[s], 1e-2);
  }
}

TEST(HeightField, RandomSearchComesNearTheBest) {
  const Grid<float> example = ridges(80, 70, 2);
  const HeightSource sources[] = {heightSource(example)};
  const Grid<float> wanted = ridges(48, 40, 77);
  const HeightMatching matching{.evenness = 0, .turns = {0, 1, 2, 3, 4, 5, 6, 7}};
  HeightField best(48, 40, matching), found(48, 40, matching);
  best.searchAll(sources, wanted, {});
  for (std::uint64_t round = 0; round < 12; ++round)
    found.search(sources, wanted, 5, round, 12, {});
  double least = 0, cost = 0;
  for (std::size_t n = 0; n < best.matches().count(); ++n) {
    EXPECT_GE(found.matches()[n].cost, best.matches()[n].cost);
    least += best.matches()[n].cost;
    cost += found.matches()[n].cost;
  }
  EXPECT_LT(cost, 1.3 * least);
}

TEST(HeightField, TakesNothingFromHoles) {
  Grid<float> example = ridges(50, 50, 3);
  for (int y = 20; y < 24; ++y)
    for (int x = 0; x < 40; ++x) example(x, y) = std::numeric_limits<float>::quiet_NaN();
  const HeightSource sources[] = {heightSource(example)};
  EXPECT_EQ(sources[0].places, 43u * 13 + 43u * 19 + 3u * 11);
  const Grid<float> wanted = ridges(32, 32, 4);
  HeightField field(32, 32, {});
  for (HeightMatch& match : field.matches().values()) match = {10, 18};
  field.leaveHoles(sources);
  for (const HeightMatch& match : field.matches().values())
    ASSERT_TRUE(sources[0].whole(match.x, match.y));
  field.search(sources, wanted, 1, 0, 8, {});
  const Grid<float> voted = field.vote(sources, wanted, {});
  for (const float h : voted.values()) ASSERT_FALSE(std::isnan(h));
}

TEST(HeightField, ATorusIsCoveredEverywhere) {
  const Grid<float> example = ridges(60, 60, 8);
  const HeightSource sources[] = {heightSource(example)};
  const Grid<float> wanted = ridges(33, 30, 9);
  HeightField field(33, 30, {.wrapsX = true, .wrapsY = true});
  field.searchAll(sources, wanted, {});
  const Grid<float> voted = field.vote(sources, wanted, {});
  for (const float h : voted.values()) ASSERT_TRUE(std::isfinite(h));
}

TEST(HeightField, GivesTheSameMatchesAtAnyNumberOfThreads) {
  const Grid<float> example = ridges(60, 60, 8);
  const HeightSource sources[] = {heightSource(example)};
  const Grid<float> wanted = ridges(70, 64, 9);
  testing::expectSameAtAnyThreads([&] {
    HeightField field(70, 64, {.turns = {0, 3, 5}});
    for (std::uint64_t round = 0; round < 3; ++round)
      field.search(sources, wanted, 3, round, 4, {});
    return field.vote(sources, wanted, {});
  });
}

}  // namespace
}  // namespace exemplar
