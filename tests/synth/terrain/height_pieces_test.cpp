// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/terrain/height_pieces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>

#include "maps/halved.h"
#include "synth/terrain/bent_heights.h"
#include "tests/synth/terrain/height_samples.h"
#include "tests/threads.h"

namespace exemplar {
namespace {

using testing::ridges;

/// Whether `b` is, within so many samples, what `a` goes on with after a step.
bool goesOn(const HeightOrigin& a, const HeightOrigin& b, Pixel step, int within) {
  const HeightOrigin on = stepped(a, step);
  return on.example == b.example && on.turn == b.turn && std::abs(on.x - b.x) <= within &&
         std::abs(on.y - b.y) <= within;
}

/// A result's coarse heights that are a copy of the example from (4, 3) on.
struct Copied {
  Grid<float> heights{40, 36};
  Grid<HeightOrigin> origins{40, 36};

  explicit Copied(const Grid<float>& example) {
    for (int y = 0; y < 36; ++y) {
      for (int x = 0; x < 40; ++x) {
        origins(x, y) = {static_cast<std::int16_t>(x + 4), static_cast<std::int16_t>(y + 3), 0, 0};
        heights(x, y) = example(x + 4, y + 3);
      }
    }
  }
};

TEST(HeightPieces, EveryPlaceBelongsToTheNearestMiddle) {
  const Grid<float> example = ridges(60, 50, 1);
  const HeightSource sources[] = {heightSource(example)};
  const Copied coarse(example);
  for (const bool wraps : {false, true}) {
    const HeightPieces pieces = choosePieces(sources, coarse.heights, coarse.origins, {79, 72},
                                             {.tries = 20, .wrapsX = wraps, .wrapsY = wraps}, {});
    ASSERT_EQ(pieces.middles.size(), pieces.origins.size());
    for (int y = 0; y < 72; ++y) {
      for (int x = 0; x < 79; ++x) {
        const auto [piece, step] = pieces.over({x, y});
        const int distance = step.x * step.x + step.y * step.y;
        for (const Pixel middle : pieces.middles) {
          int dx = std::abs(x - middle.x), dy = std::abs(y - middle.y);
          if (wraps) dx = std::min(dx, 79 - dx), dy = std::min(dy, 72 - dy);
          // Those two cells away may be nearer by a sample or two where cells' middles are at
          // opposite sides: pieces only have to be compact.
          ASSERT_LE(distance, (std::hypot(dx, dy) + 4) * (std::hypot(dx, dy) + 4));
        }
        Pixel from{pieces.middles[piece].x + step.x, pieces.middles[piece].y + step.y};
        if (wraps) from = {(from.x + 79) % 79, (from.y + 72) % 72};
        ASSERT_EQ(from, (Pixel{x, y}));
      }
    }
  }
}

TEST(HeightPieces, NoneGoesOnWithWhatLiesThereOrWithAnother) {
  const Grid<float> example = ridges(60, 50, 2);
  const HeightSource sources[] = {heightSource(example)};
  const Copied coarse(example);
  const HeightPieces pieces =
      choosePieces(sources, coarse.heights, coarse.origins, {80, 72}, {.turns = {0, 3, 6}}, {});
  for (std::size_t p = 0; p < pieces.middles.size(); ++p) {
    const Pixel at = pieces.middles[p];
    // The copy's fine sample (x, y) is the example's (x + 8, y + 6); a copy moved by a sample or
    // two of the coarse resolution would be the same to the eye.
    const HeightOrigin copy{8, 6, 0, 0};
    EXPECT_FALSE(goesOn(copy, pieces.origins[p], at, 4)) << p;
    for (std::size_t q = 0; q < p; ++q) {
      const Pixel step{at.x - pieces.middles[q].x, at.y - pieces.middles[q].y};
      if (std::abs(step.x) > 16 || std::abs(step.y) > 16) continue;
      EXPECT_FALSE(goesOn(pieces.origins[q], pieces.origins[p], step, 4)) << p << " " << q;
    }
  }
}

TEST(HeightPieces, NoneIsThePlaceOfWhichABentCopyLiesThere) {
  const Grid<float> fine = ridges(120, 100, 5);
  const Bend bend{.angle = 0.1, .strain = 0.05, .seed = 2};
  HeightSource sources[] = {heightSource(halved(fine, false)), heightSource(bentHalf(fine, bend))};
  sources[1].from = bentPlaces({60, 50}, bend);
  const Grid<Pixel> from = sources[1].from;
  // The result's coarse heights are a part of the copy.
  const Pixel corner{8, 8};
  Grid<float> heights(36, 30);
  Grid<HeightOrigin> origins(36, 30);
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 36; ++x) {
      origins(x, y) = {static_cast<std::int16_t>(x + corner.x),
                       static_cast<std::int16_t>(y + corner.y), 1, 0};
      heights(x, y) = sources[1].heights(x + corner.x, y + corner.y);
      ASSERT_FALSE(std::isnan(heights(x, y)));
    }
  }
  const auto same = [&] {
    const HeightPieces pieces =
        choosePieces(sources, heights, origins, {72, 60}, {.sources = 1, .turns = {0, 5}}, {});
    int count = 0;
    for (std::size_t p = 0; p < pieces.middles.size(); ++p) {
      const Pixel at = pieces.middles[p];
      const HeightOrigin& origin = pieces.origins[p];
      EXPECT_EQ(origin.example, 0);
      const Pixel place = from(at.x / 2 + corner.x, at.y / 2 + corner.y);
      count += std::abs(origin.x / 2 - place.x) <= 1 && std::abs(origin.y / 2 - place.y) <= 1;
    }
    return count;
  };
  EXPECT_EQ(same(), 0);
  // Where it is not known what the copy is of, its places are the nearest.
  sources[1].from = {};
  EXPECT_GT(same(), 5);
}

TEST(HeightPieces, AreLikeWhatLiesThere) {
  // Of the places of a far larger example, one much like any can be found: nearer than one at
  // random by far.
  const Grid<float> example = ridges(160, 150, 3);
  const HeightSource sources[] = {heightSource(example)};
  const Copied coarse(ridges(60, 50, 40));
  const auto cost = [&](int tries) {
    const HeightPieces pieces =
        choosePieces(sources, coarse.heights, coarse.origins, {80, 72},
                     {.tries = tries, .turns = {0, 1, 2, 3, 4, 5, 6, 7}}, {});
    double sum = 0;
    for (std::size_t p = 0; p < pieces.middles.size(); ++p) {
      // The coarse samples beside the middle, without their mean.
      const Pixel at{pieces.middles[p].x / 2, pieces.middles[p].y / 2};
      double difference = 0, squares = 0;
      int count = 0;
      for (int dy = -2; dy <= 2; ++dy) {
        for (int dx = -2; dx <= 2; ++dx) {
          if (!coarse.heights.contains(at.x + dx, at.y + dy)) continue;
          const HeightOrigin origin = stepped(
              pieces.origins[p],
              {2 * (at.x + dx) - pieces.middles[p].x, 2 * (at.y + dy) - pieces.middles[p].y});
          if (!example.contains(origin.x / 2, origin.y / 2)) continue;
          const double d =
              example(origin.x / 2, origin.y / 2) - coarse.heights(at.x + dx, at.y + dy);
          difference += d;
          squares += d * d;
          ++count;
        }
      }
      if (count > 0) sum += squares - difference * difference / count;
    }
    return sum;
  };
  EXPECT_LT(cost(1000), 0.5 * cost(1));
}

TEST(HeightPieces, TakeNothingFromHolesAndAreTheSameAtAnyThreads) {
  Grid<float> example = ridges(60, 50, 4);
  for (int y = 10; y < 30; ++y)
    for (int x = 20; x < 40; ++x) example(x, y) = std::numeric_limits<float>::quiet_NaN();
  const HeightSource sources[] = {heightSource(example)};
  const Copied coarse(ridges(60, 50, 41));
  const auto made = [&] {
    return choosePieces(sources, coarse.heights, coarse.origins, {80, 72}, {.turns = {0, 5}}, {});
  };
  for (const HeightOrigin& origin : made().origins) {
    const int x = origin.x / 2, y = origin.y / 2;
    ASSERT_FALSE(x >= 21 && x < 39 && y >= 11 && y < 29) << x << " " << y;
  }
  testing::expectSameAtAnyThreads([&] { return made().origins; });
}

}  // namespace
}  // namespace exemplar
