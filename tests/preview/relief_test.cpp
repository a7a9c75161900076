// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "preview/relief.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.h"
#include "preview/render.h"
#include "tests/progress_checks.h"
#include "tests/threads.h"

namespace exemplar {
namespace {

constexpr double kEast = std::numbers::pi / 2, kWest = -kEast, kNorth = 0;

/// A roof whose ridge runs from north to south.
Grid<float> roof(int width, int height) {
  Grid<float> map(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) map(x, y) = static_cast<float>(-std::abs(x - width / 2));
  return map;
}

Image8 drawn(const Grid<float>& map, const ReliefOptions& options) {
  const ReliefMap shown{&map, 1};
  return renderRelief({&shown, 1}, options);
}

int brightness(const Image8& image, int x, int y) {
  const std::uint8_t* p = image.at(x, y);
  return p[0] + p[1] + p[2];
}

TEST(Relief, IsBrightWhereItFacesTheLight) {
  const Grid<float> map = roof(64, 32);
  const Image8 east = drawn(map, {.azimuths = {kEast}, .tint = false, .longest = 128});
  EXPECT_EQ(east.width, 128);
  EXPECT_EQ(east.height, 64);
  EXPECT_GT(brightness(east, 96, 32), brightness(east, 32, 32) + 100);
  const Image8 west = drawn(map, {.azimuths = {kWest}, .tint = false, .longest = 128});
  EXPECT_GT(brightness(west, 32, 32), brightness(west, 96, 32) + 100);
  // From the north both sides are lit alike.
  const Image8 north = drawn(map, {.azimuths = {kNorth}, .tint = false, .longest = 128});
  EXPECT_EQ(brightness(north, 32, 32), brightness(north, 96, 32));
}

TEST(Relief, ShowsMapsAtOneScaleAndARowForEachLight) {
  const Grid<float> small = roof(32, 32), large = roof(64, 64);
  const ReliefMap maps[] = {{&small, 1}, {&large, 1}};
  const Image8 image =
      renderRelief(maps, {.azimuths = {kEast, kNorth}, .tint = false, .longest = 64});
  EXPECT_EQ(image.width, 32 + 8 + 64);
  EXPECT_EQ(image.height, 64 + 8 + 64);
  // The same slopes are as bright in both.
  EXPECT_EQ(brightness(image, 24, 32), brightness(image, 40 + 48, 32));
  // A map of cells of half the size is drawn half as large.
  const ReliefMap finer[] = {{&large, 1}, {&large, 0.5}};
  EXPECT_EQ(renderRelief(finer, {.longest = 64}).width, 64 + 8 + 32);
}

TEST(Relief, AveragesWhatIsFinerThanThePicture) {
  Grid<float> bumpy(512, 512);
  for (int y = 0; y < 512; ++y)
    for (int x = 0; x < 512; ++x) bumpy(x, y) = static_cast<float>((x + y) % 2);
  const Image8 image = drawn(bumpy, {.exaggeration = 1, .tint = false, .longest = 64});
  EXPECT_EQ(image.width, 64);
  for (int x = 1; x < 64; ++x) EXPECT_EQ(brightness(image, x, 30), brightness(image, 0, 30));
}

TEST(Relief, DrawsStreamsWhereWaterRuns) {
  Grid<float> valley(64, 64);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) valley(x, y) = static_cast<float>(std::abs(x - 32) + 0.1 * y);
  ReliefOptions options{.tint = false, .longest = 64};
  const Image8 dry = drawn(valley, options);
  options.streamCells = 200;
  const Image8 wet = drawn(valley, options);
  const auto isBlue = [](const Image8& image, int x, int y) {
    return image.at(x, y)[2] > image.at(x, y)[0] + 60;
  };
  EXPECT_TRUE(isBlue(wet, 32, 20));
  EXPECT_FALSE(isBlue(dry, 32, 20));
  for (int x : {4, 20, 44, 60}) EXPECT_FALSE(isBlue(wet, x, 20)) << x;
}

TEST(Relief, HolesAreBackground) {
  Grid<float> map = roof(32, 32);
  map(8, 8) = std::numeric_limits<float>::quiet_NaN();
  const Image8 image = drawn(map, {.longest = 32});
  for (int c = 0; c < 3; ++c) EXPECT_EQ(image.at(8, 8)[c], kBackground[c]);
  EXPECT_NE(image.at(9, 8)[0], 0);
  // All holes, and one height, are pictures, too.
  drawn(Grid<float>(8, 8, std::numeric_limits<float>::quiet_NaN()), {.streamCells = 2});
  drawn(Grid<float>(8, 8, 3), {.streamCells = 2});
}

TEST(Relief, IsTheSameAtAnyNumberOfThreads) {
  const Grid<float> map = roof(100, 90);
  testing::expectSameAtAnyThreads(
      [&] { return drawn(map, {.streamCells = 20, .longest = 300}).pixels; });
}

TEST(Relief, RefusesWhatItCannotDraw) {
  const Grid<float> map = roof(8, 8);
  EXPECT_THROW(renderRelief({}), InputError);
  EXPECT_THROW(drawn({}, {}), InputError);
  EXPECT_THROW(drawn(map, {.azimuths = {}}), InputError);
  EXPECT_THROW(drawn(map, {.elevation = 0}), InputError);
  EXPECT_THROW(drawn(map, {.longest = 1}), InputError);
  testing::expectReportsAndStops(3, [&](const Progress& progress) {
    const ReliefMap shown{&map, 1};
    renderRelief({&shown, 1}, {.streamCells = 2}, progress);
  });
}

}  // namespace
}  // namespace exemplar
