// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Each figure of terrain fails on the fault that it is there for.

#include "measure/terrain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

#include "core/error.h"
#include "measure/figures.h"
#include "measure/terrain_copies.h"
#include "measure/turned_copies.h"
#include "tests/measure/land.h"
#include "tests/progress_checks.h"
#include "tests/threads.h"

namespace exemplar {
namespace {

using testing::land;

constexpr int kSide = 192;

const Grid<float>& example() {
  static const Grid<float> map = land(kSide, kSide, 1);
  return map;
}
const TerrainLikeness& fresh() {
  static const TerrainLikeness likeness = measureTerrain(example(), land(kSide, kSide, 2));
  return likeness;
}
TerrainLikeness against(const Grid<float>& result) { return measureTerrain(example(), result); }

template <class Body>
Grid<float> changed(Grid<float> map, const Body& body) {
  for (int y = 0; y < map.height(); ++y)
    for (int x = 0; x < map.width(); ++x) body(x, y, map(x, y));
  return map;
}

TEST(Terrain, OfTheExampleItselfIsAllTheSame) {
  const TerrainLikeness self = against(example());
  EXPECT_EQ(self.heights.result, 0);
  EXPECT_EQ(self.slopes.result, 0);
  EXPECT_EQ(self.curvature.result, 0);
  EXPECT_EQ(self.stepRatio, 1);
  EXPECT_EQ(self.verbatimShare, 1);
  EXPECT_EQ(self.copiedShapes.result, 1);
  EXPECT_EQ(self.copiedLayout.result, 1);
  EXPECT_EQ(self.result.valleyLength, self.example.valleyLength);
}

TEST(Terrain, FreshLandPasses) {
  const TerrainLikeness& f = fresh();
  EXPECT_LT(*f.slopes.result, 2 * *f.slopes.floor);
  EXPECT_LT(*f.curvature.result, 2 * *f.curvature.floor);
  EXPECT_EQ(f.result.floodedShare, 0);
  EXPECT_EQ(f.result.depressions, 0);
  EXPECT_NEAR(*f.result.drainageDensity / *f.example.drainageDensity, 1, 0.1);
  EXPECT_NEAR(*f.result.bifurcation / *f.example.bifurcation, 1, 0.2);
  EXPECT_NEAR(*f.result.valleyLength / *f.example.valleyLength, 1, 0.15);
  EXPECT_NEAR(*f.result.ridgeLength / *f.example.ridgeLength, 1, 0.15);
  EXPECT_NEAR(*f.result.spectrumSlope, *f.example.spectrumSlope, 0.2);
  EXPECT_LT(*f.stepRatio, 1.3);
  EXPECT_EQ(f.verbatimShare, 0);
  EXPECT_LT(*f.result.repeatedPeaks, 0.05);
  EXPECT_LT(*f.result.repeatedShapes, *f.example.repeatedShapes + 0.05);
  EXPECT_LT(*f.copiedShapes.result, *f.copiedShapes.floor + 0.05);
  EXPECT_LT(*f.copiedLayout.result, 0.05);
  EXPECT_LT(*f.result.flatShare, 0.001);
}

TEST(Terrain, PitsAreDepressions) {
  int pits = 0;
  const TerrainLikeness t = against(changed(example(), [&](int x, int y, float& h) {
    if (x % 16 == 8 && y % 16 == 8) {
      h -= 8;
      ++pits;
    }
  }));
  EXPECT_NEAR(*t.result.depressions, pits / (kSide * kSide / 1e6), 0.05 * *t.result.depressions);
  EXPECT_GE(*t.result.floodedShare, 0.95 * pits / (kSide * kSide));
  EXPECT_LT(*t.result.valleyReach, 0.9 * *t.example.valleyReach);
}

TEST(Terrain, DammedRiversAreFloodedAndEnd) {
  // Walls across the map in both directions.
  const TerrainLikeness t = against(changed(example(), [](int x, int y, float& h) {
    if (x % 40 == 20 || y % 40 == 20) h += 10;
  }));
  EXPECT_GT(*t.result.floodedShare, 0.1);
  EXPECT_LT(*t.result.valleyLength, 0.8 * *t.example.valleyLength);
}

TEST(Terrain, TerracesAreFlat) {
  const TerrainLikeness t =
      against(changed(example(), [](int, int, float& h) { h = 3 * std::round(h / 3); }));
  EXPECT_GT(*t.result.flatShare, 0.02);
  EXPECT_LT(*t.example.flatShare, 0.001);
  EXPECT_GT(*t.slopes.result, 3 * *t.slopes.floor);
  EXPECT_GT(*t.curvature.result, 3 * *t.curvature.floor);
  EXPECT_LT(*t.heights.result, 2 * *t.heights.floor);  // which does not see them
}

TEST(Terrain, FlattenedLandHasOtherSlopes) {
  const TerrainLikeness t = against(changed(example(), [](int, int, float& h) { h *= 0.7f; }));
  EXPECT_GT(*t.slopes.result, 3 * *t.slopes.floor);
  EXPECT_GT(*t.heights.result, 0.3);
  EXPECT_NEAR(*t.result.relief, 0.7 * *t.example.relief, 1e-4 * *t.example.relief);
  EXPECT_NEAR(*t.result.spectrumSlope, *t.example.spectrumSlope, 1e-4);
}

TEST(Terrain, SmoothedLandHasAnotherSpectrum) {
  Grid<float> smooth = example();
  for (int round = 0; round < 4; ++round) {
    const Grid<float> before = smooth;
    smooth = changed(before, [&](int x, int y, float& h) {
      if (x > 0 && y > 0 && x + 1 < kSide && y + 1 < kSide) {
        h = (before(x - 1, y) + before(x + 1, y) + before(x, y - 1) + before(x, y + 1) + 4 * h) / 8;
      }
    });
  }
  const TerrainLikeness t = against(smooth);
  EXPECT_LT(*t.result.spectrumSlope, *t.example.spectrumSlope - 0.5);
  EXPECT_GT(*t.curvature.result, 3 * *t.curvature.floor);
}

TEST(Terrain, ATilingIsVerbatimAndRepeats) {
  const Grid<float>& e = example();
  Grid<float> tiled(2 * kSide, 2 * kSide);
  for (int y = 0; y < tiled.height(); ++y)
    for (int x = 0; x < tiled.width(); ++x) tiled(x, y) = e(x % kSide, y % kSide);
  const TerrainLikeness t = against(tiled);
  EXPECT_GT(*t.verbatimShare, 0.8);  // the rest lies across its seams
  EXPECT_GT(*t.result.repeatedPeaks, 0.9);
  EXPECT_LT(*t.example.repeatedPeaks, 0.05);
}

TEST(Terrain, ACopyIsOneHoweverItIsTurnedRaisedAndBent) {
  const TerrainLikeness t = against(changed(example(), [](int x, int y, float& h) {
    const double bend = 0.05 * x + 3 * std::sin(y / 40.0);
    h = example()(kSide - 1 - y, x) + 200 + static_cast<float>(bend);
  }));
  EXPECT_GT(*t.verbatimShare, 0.95);
}

/// The height of a map between its cells; the nearest beyond its ends.
float heightAt(const Grid<float>& map, double x, double y) {
  x = std::clamp(x, 0.0, map.width() - 1.001);
  y = std::clamp(y, 0.0, map.height() - 1.001);
  const int u = static_cast<int>(x), v = static_cast<int>(y);
  const double fx = x - u, fy = y - v;
  return static_cast<float>((1 - fy) * ((1 - fx) * map(u, v) + fx * map(u + 1, v)) +
                            fy * ((1 - fx) * map(u, v + 1) + fx * map(u + 1, v + 1)));
}

TEST(Terrain, ACopyIsOneAtAnyAngleMirroredRaisedAndTilted) {
  for (const double degrees : {17.0, 45.0, 71.0}) {
    SCOPED_TRACE(degrees);
    const double angle = degrees * std::numbers::pi / 180, middle = kSide / 2.0;
    const TerrainLikeness t = against(changed(example(), [&](int x, int y, float& h) {
      const double dx = middle - x, dy = y - middle;
      h = heightAt(example(), middle + std::cos(angle) * dx + std::sin(angle) * dy,
                   middle - std::sin(angle) * dx + std::cos(angle) * dy) +
          300 + 0.1f * static_cast<float>(x);
    }));
    // Corners come from beyond the example.
    EXPECT_GT(*t.copiedShapes.result, 0.6);
    EXPECT_GT(*t.copiedLayout.result, 0.4);
    // The figure of quarter turns does not see it.
    EXPECT_LT(*t.verbatimShare, 0.3);
  }
}

TEST(Terrain, RepeatedShapesAreFoundAtAnyAngle) {
  // A disk of land in six places, each at another angle.
  const Grid<float> base = land(kSide, kSide, 5);
  Grid<float> map = base;
  for (int n = 0; n < 6; ++n) {
    const Pixel to{40 + 55 * (n % 3), 50 + 90 * (n / 3)};
    const double angle = 0.4 + 0.9 * n;
    for (int y = -26; y <= 26; ++y) {
      for (int x = -26; x <= 26; ++x) {
        const double weight = std::clamp((26 - std::hypot(x, y)) / 4, 0.0, 1.0);
        const double there = heightAt(base, 96 + std::cos(angle) * x + std::sin(angle) * y,
                                      96 - std::sin(angle) * x + std::cos(angle) * y);
        float& h = map(to.x + x, to.y + y);
        h = static_cast<float>((1 - weight) * h + weight * (there + 30 * n));
      }
    }
  }
  const auto repeated = [](const Grid<float>& heights) {
    return *TerrainShapes(heights, 400).repeated();
  };
  EXPECT_LT(repeated(base), 0.1);
  EXPECT_GT(repeated(map), repeated(base) + 0.15);
  testing::expectSameAtAnyThreads([&] { return repeated(map); });
}

TEST(Terrain, RepeatedPeaksAreFoundRaisedAndMoved) {
  // One massif of fresh land in six places, at other heights and places of the grid.
  const Grid<float> base = land(kSide, kSide, 5);
  const std::vector<Peak> peaks = prominentPeaks(base, 1);
  ASSERT_FALSE(peaks.empty());
  const Pixel from = peaks.front().at;
  Grid<float> map = base;
  int n = 0;
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 3; ++i, ++n) {
      const Pixel to{40 + 55 * i + j, 55 + 75 * j + i};
      for (int y = -24; y <= 24; ++y) {
        for (int x = -24; x <= 24; ++x) {
          const double far = std::hypot(x, y);
          const double weight = std::clamp((24 - far) / 8, 0.0, 1.0);
          const Pixel source{std::clamp(from.x + x, 0, kSide - 1),
                             std::clamp(from.y + y, 0, kSide - 1)};
          float& h = map(to.x + x, to.y + y);
          h = static_cast<float>((1 - weight) * h +
                                 weight * (base(source.x, source.y) + 40 + 5 * n));
        }
      }
    }
  }
  const std::vector<Peak> all = prominentPeaks(map, 400);
  ASSERT_GT(all.size(), 10u);
  EXPECT_GE(*repeatedPeaks(map) * static_cast<double>(all.size()), 5.99);
  EXPECT_LT(*repeatedPeaks(base), 0.03);
}

TEST(Terrain, ACliffIsAStep) {
  Grid<std::uint8_t> seams(kSide, kSide);
  const auto at = [&](double height) {
    return changed(example(), [&](int x, int, float& h) {
      if (x >= kSide / 2) h += static_cast<float>(height);
    });
  };
  for (int y = 0; y < kSide; ++y) seams(kSide / 2 - 1, y) = kSeamRight;
  const TerrainLikeness smooth = measureTerrain(example(), at(0), {}, &seams);
  EXPECT_LE(*smooth.seamStepRatio, 1);
  EXPECT_NEAR(*smooth.seamMeanStepRatio, 1, 0.3);
  const TerrainLikeness cliff = measureTerrain(example(), at(120), {}, &seams);
  EXPECT_GT(*cliff.stepRatio, 3);
  EXPECT_EQ(cliff.seamStepRatio, cliff.stepRatio);
  EXPECT_GT(*cliff.seamMeanStepRatio, 5);
  EXPECT_FALSE(against(at(120)).seamStepRatio);
}

TEST(Terrain, NoiseWithTheRightHistogramFailsElsewhere) {
  Grid<float> shuffled = example();
  const Random random(9);
  for (std::size_t n = shuffled.count(); n-- > 1;)
    std::swap(shuffled[n], shuffled[random.below(static_cast<std::uint32_t>(n + 1), n)]);
  const TerrainLikeness t = against(shuffled);
  EXPECT_LT(*t.heights.result, 0.05);
  EXPECT_GT(*t.slopes.result, 5 * *t.slopes.floor);
  EXPECT_GT(*t.curvature.result, 5 * *t.curvature.floor);
  EXPECT_NEAR(*t.result.spectrumSlope, 0, 0.2);
  EXPECT_LT(*t.example.spectrumSlope, -1.5);
  EXPECT_GT(*t.result.floodedShare, 0.3);
  EXPECT_LT(*t.result.valleyLength, 0.2 * *t.example.valleyLength);
  EXPECT_EQ(t.verbatimShare, 0);
}

TEST(Terrain, LandUpsideDownHasItsHollowsWrong) {
  const TerrainLikeness t = against(negated(example()));
  EXPECT_GT(*t.curvature.result, 3 * *t.curvature.floor);
  EXPECT_GT(*t.result.floodedShare, 0.02);
  EXPECT_NEAR(*t.slopes.result, 0, 1e-6);  // which does not see it
}

TEST(Terrain, CountsInTheUnitsOfTheMap) {
  const Grid<float> map = changed(example(), [](int x, int y, float& h) {
    h *= 30;
    if (x % 32 == 16 && y % 32 == 16) h -= 1000;
  });
  const TerrainFigures plain = terrainFigures(map);
  const TerrainFigures meters = terrainFigures(map, {.cellSize = 30, .meters = true});
  EXPECT_FALSE(plain.depressionsKm2);
  const double km2 = kSide * kSide * 0.03 * 0.03;
  EXPECT_NEAR(*meters.depressionsKm2 * km2, *meters.depressions * kSide * kSide / 1e6, 1e-9);
  EXPECT_DOUBLE_EQ(*meters.valleyLength, 30 * *plain.valleyLength);
  EXPECT_DOUBLE_EQ(*meters.drainageDensity * 30, *plain.drainageDensity);
  EXPECT_EQ(meters.spectrumSlope, plain.spectrumSlope);
}

TEST(Terrain, HolesAreNoLand) {
  const Grid<float> map = changed(example(), [](int x, int y, float& h) {
    if (std::hypot(x - 60, y - 60) < 30) h = std::numeric_limits<float>::quiet_NaN();
  });
  const TerrainLikeness t = measureTerrain(map, map);
  EXPECT_EQ(t.slopes.result, 0);
  EXPECT_EQ(t.result.floodedShare, 0);
  EXPECT_EQ(t.verbatimShare, 1);
  // Nothing but holes, and a map of a few cells, have no figures and do no harm.
  const Grid<float> empty(40, 40, std::numeric_limits<float>::quiet_NaN());
  EXPECT_FALSE(measureTerrain(map, empty).slopes.result);
  EXPECT_FALSE(terrainFigures(empty).floodedShare);
  EXPECT_FALSE(measureTerrain(Grid<float>(3, 2), Grid<float>(1, 1)).verbatimShare);
  EXPECT_EQ(measureTerrain(Grid<float>(80, 80), Grid<float>(80, 80)).slopes.result, 0);
}

TEST(Terrain, IsTheSameAtAnyNumberOfThreads) {
  const Grid<float> result = land(128, 128, 3);
  testing::expectSameAtAnyThreads(
      [&] { return figuresTable(figures(measureTerrain(example(), result))); });
}

TEST(Terrain, ShowsAllFigures) {
  const std::string table = figuresTable(fresh());
  for (const Figure& figure : figures(fresh())) {
    EXPECT_EQ(figure.group, "terrain");
    if (figure.key.find("_example") == std::string::npos &&
        figure.key.find("_half") == std::string::npos &&
        figure.key.find("_floor") == std::string::npos) {
      EXPECT_NE(table.find("  " + figure.key + " "), std::string::npos) << figure.key;
    }
  }
}

TEST(Terrain, RefusesWhatItCannotMeasure) {
  EXPECT_THROW(terrainFigures({}), InputError);
  EXPECT_THROW(terrainFigures(example(), {.cellSize = 0}), InputError);
  const Grid<std::uint8_t> seams(3, 3);
  EXPECT_THROW(measureTerrain(example(), example(), {}, &seams), InputError);
}

TEST(Terrain, CanBeCancelledAndTellsProgress) {
  const Grid<float> small = land(64, 64, 1);
  testing::expectReportsAndStops(
      8, [&](const Progress& progress) { measureTerrain(small, small, {}, nullptr, progress); });
}

}  // namespace
}  // namespace exemplar
