// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Layers of which a part is given: holes, painted layers; and other ways to compare layers.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/cells.h"
#include "core/error.h"
#include "maps/fill_smoothly.h"
#include "measure/layers.h"
#include "synth/layered/regions.h"
#include "synth/layered/texture_by_numbers.h"
#include "tests/progress_checks.h"
#include "tests/synth/layered/layer_samples.h"
#include "tests/threads.h"

namespace exemplar {
namespace {

using testing::discs;
using testing::noiseLayers;

Shape squareHole(const Vec3i& size, const Vec3i& low, int side) {
  Shape hole(size);
  forEachCell(CellBox{low, low + Vec3i{side, side, 1}}, [&](const Vec3i& p) { hole[p] = 1; });
  return hole;
}

/// A picture of layers, each of a color of its own, with noise.
Map pictureOf(const LayerVolume& layers) {
  const Vec3i& size = layers.size();
  MapLayer picture{"color", std::vector<Grid<float>>(3, Grid<float>(size.x, size.y)), 8};
  const Random random(1);
  for (std::size_t p = 0; p < layers.count(); ++p)
    for (std::uint32_t c = 0; c < 3; ++c)
      picture.planes[c][p] = static_cast<float>(
          std::round(255 * (0.2 * layers.data()[p] + 0.1 * random.uniform(p, c))) / 255);
  return {{picture}};
}

TEST(SynthesizeLayers, FillsAHoleAndNothingElse) {
  const LayerVolume example = noiseLayers(120, 110, 3, 2);
  const Shape hole = squareHole(example.size(), {40, 30, 0}, 36);
  LayerOptions options;
  options.hole = &hole;
  const SynthesizedLayers made = synthesizeLayers(example, example.size(), options);
  std::size_t differing = 0;
  for (std::size_t p = 0; p < hole.count(); ++p) {
    if (hole.data()[p]) {
      differing += made.map.data()[p] != example.data()[p];
    } else {
      ASSERT_EQ(made.map.data()[p], example.data()[p]);
    }
  }
  EXPECT_GT(differing, 50u);
  // The hole holds the known part's share of each layer.
  for (int i = 2; i <= 3; ++i) {
    const Shape wanted = layerShape(example, i), got = layerShape(made.map, i);
    Shape known = hole;
    for (std::uint8_t& v : known.values()) v = !v;
    const double share =
        static_cast<double>(insideOf(wanted, &known)) / static_cast<double>(insideOf(known));
    EXPECT_NEAR(static_cast<double>(insideOf(got, &hole)) / static_cast<double>(insideOf(hole)),
                share, 1e-3);
  }
  EXPECT_EQ(skippingShare(made.map), 0);
}

TEST(SynthesizeLayers, GoesOnFromWhatLiesAroundAHole) {
  const LayerVolume example = noiseLayers(200, 160, 2, 2);
  std::int64_t beside = 0, alike = 0;
  for (const Vec3i& corner : {Vec3i{28, 8, 0}, Vec3i{28, 90, 0}, Vec3i{128, 50, 0}}) {
    const Shape hole = squareHole(example.size(), corner, 44);
    LayerOptions options;
    options.hole = &hole;
    // Where it begins, nearly.
    options.shape.levels = options.shape.iterations = 1;
    const LayerVolume made = synthesizeLayers(example, example.size(), options).map;
    forEachEdgeCell(hole, true, false, [&](const Vec3i& p, std::size_t at) {
      forEachBeside(hole.size(), false, p, at, [&](std::size_t other) {
        if (hole.data()[other]) return;
        ++beside;
        alike += made.data()[at] == made.data()[other];
      });
    });
  }
  // Of neighbors across the edge .92; of a start by chance alone .79.
  EXPECT_GT(static_cast<double>(alike), 0.87 * static_cast<double>(beside));
}

TEST(SynthesizeTexture, KeepsWhatLiesOutsideAHoleToTheBit) {
  const LayerVolume layers = noiseLayers(96, 96, 3, 2);
  const Map map = pictureOf(layers);
  const Shape hole = squareHole(layers.size(), {30, 30, 0}, 28);
  const ControlMaps control = controlMaps(layers, false, layers, false);
  for (const TextureMethod method : {TextureMethod::Patches, TextureMethod::Classic}) {
    const TextureOptions options{.method = method, .guide = 3, .wraps = false};
    const GuidedTexture made =
        synthesizeTexture(map, {control.example}, {control.result}, hole, options);
    for (std::size_t c = 0; c < 3; ++c) {
      const Grid<float>&was = map.layers[0].planes[c], &is = made.map.layers[0].planes[c];
      for (std::size_t p = 0; p < was.count(); ++p) {
        if (!hole.data()[p]) {
          ASSERT_EQ(is[p], was[p]);
        }
      }
    }
    // What fills it comes from elsewhere, and mostly from the right layer.
    std::size_t right = 0;
    for (std::size_t p = 0; p < hole.count(); ++p) {
      if (!hole.data()[p]) continue;
      const Vec3i& from = made.origins.data()[p];
      ASSERT_FALSE(hole[from]);
      right += layers[from] == layers.data()[p];
    }
    EXPECT_GE(static_cast<double>(right), 0.85 * static_cast<double>(insideOf(hole)));
  }
}

TEST(SynthesizeTexture, RefusesAHoleThatLeavesNothing) {
  const LayerVolume layers = noiseLayers(32, 32, 2, 2);
  Shape hole(layers.size(), 1);
  hole(0, 0, 0) = 0;
  const ControlMaps control = controlMaps(layers, false, layers, false);
  for (const TextureMethod method : {TextureMethod::Patches, TextureMethod::Classic}) {
    EXPECT_THROW(synthesizeTexture(pictureOf(layers), {control.example}, {control.result}, hole,
                                   {.method = method, .wraps = false}),
                 InputError);
  }
}

TEST(SynthesizeTexture, FollowsTheLayersInScanOrder) {
  const LayerVolume example = noiseLayers(96, 96, 3, 2), wanted = noiseLayers(112, 96, 3, 5);
  const ControlMaps control = controlMaps(example, false, wanted, true);
  const TextureOptions options{.method = TextureMethod::Classic, .guide = 3};
  const GuidedTexture made =
      synthesizeTexture(pictureOf(example), {control.example}, {control.result}, {}, options);
  std::size_t right = 0, all = 0;
  forEachCell(wanted.size(), [&](const Vec3i& p) {
    bool far = true;
    for (int dy = -4; dy <= 4; ++dy)
      for (int dx = -4; dx <= 4; ++dx)
        far &= wanted[wrappedPlace(p + Vec3i{dx, dy, 0}, wanted.size())] == wanted[p];
    if (!far) return;
    ++all;
    right += example[made.origins[p]] == wanted[p];
  });
  ASSERT_GT(all, 200u);
  EXPECT_GE(static_cast<double>(right), 0.98 * static_cast<double>(all));
}

TEST(SynthesizeLayers, KeepsTheAreaAndThePlaceOfWhatIsPainted) {
  const LayerVolume example = noiseLayers(140, 140, 3, 2);
  // One painted square of the top layer, with nothing around it.
  LayerVolume painted(Vec3i{128, 128, 1}, 1);
  forEachCell(CellBox{{40, 40, 0}, {88, 88, 1}}, [&](const Vec3i& p) { painted[p] = 3; });
  const LayerVolume strips = withStrips(painted, example);
  EXPECT_EQ(skippingShare(strips), 0);
  EXPECT_EQ(insideOf(layerShape(strips, 3)), 48 * 48);
  LayerOptions options;
  options.paint = &strips;
  const LayerVolume made = synthesizeLayers(example, strips.size(), options).map;
  EXPECT_EQ(insideOf(layerShape(made, 3)), 48 * 48);
  EXPECT_EQ(insideOf(layerShape(made, 2)), insideOf(layerShape(strips, 2)));
  EXPECT_EQ(skippingShare(made), 0);
  // It stays where it is, and its outline is no square any more.
  const Shape top = layerShape(made, 3);
  std::int64_t stayed = 0;
  forEachCell(CellBox{{40, 40, 0}, {88, 88, 1}}, [&](const Vec3i& p) { stayed += top[p]; });
  EXPECT_GT(stayed, 48 * 48 * 7 / 10);
  EXPECT_LT(stayed, 48 * 48);
}

TEST(WithStrips, LeavesAloneWhatSkipsNothing) {
  const LayerVolume example = discs(80, 80, 9, 2), other = discs(90, 70, 8, 3);
  EXPECT_TRUE(withStrips(other, example) == other);
}

TEST(SynthesizeLayers, ComparesLayersJointly) {
  // Cores that lie at the right of their discs: what is below says where.
  const LayerVolume whole = discs(160, 160, 10, 1);
  LayerVolume example = whole;
  const Shape disc = layerShape(whole, 2);
  for (std::uint8_t& v : example.values()) v = std::min<std::uint8_t>(v, 2);
  forEachCell(example.size(), [&](const Vec3i& p) {
    if (p.x + 4 < 160 && p.x >= 4 && disc[p] && !disc(p.x + 4, p.y, 0)) example[p] = 3;
  });
  LayerOptions options;
  options.shape.joint = true;
  options.shape.turns = 1;
  const LayerVolume made = synthesizeLayers(example, {160, 160, 1}, options).map;
  // To the right of a core the disc ends within a few cells, or goes on as core.
  const auto endsSoon = [](const LayerVolume& map) {
    double ends = 0, all = 0;
    forEachCell(map.size(), [&](const Vec3i& p) {
      if (map[p] != 3) return;
      ++all;
      ends += map[wrappedPlace(p + Vec3i{6, 0, 0}, map.size())] == 1;
    });
    return ends / all;
  };
  EXPECT_GT(endsSoon(example), 0.9);
  EXPECT_GT(endsSoon(made), 0.75);
}

TEST(SynthesizeLayers, ChoosesThresholdsByAreaAsInThePaper) {
  const LayerVolume example = noiseLayers(120, 120, 2, 2);
  LayerOptions options;
  const LayerVolume byBoundary = synthesizeLayers(example, {120, 120, 1}, options).map;
  options.shape.certainty = CertaintyKind::Area;
  const LayerVolume byArea = synthesizeLayers(example, {120, 120, 1}, options).map;
  const auto off = [&](const LayerVolume& map) {
    return std::abs(*measureLayers(example, false, map).layers[0].boundaryRatio - 1);
  };
  EXPECT_NE(byArea, byBoundary);
  EXPECT_NEAR(areaOf(layerShape(byArea, 2)), areaOf(layerShape(example, 2)), 0.05);
  EXPECT_LE(off(byBoundary), off(byArea));
}

/// Regions without an order: two kinds of discs, apart, on common ground.
LayerVolume twoKinds(int side) {
  LayerVolume map = discs(side, side, 9, 1);
  // Of every other row of discs the color is exchanged; none has a core.
  forEachCell(map.size(), [&](const Vec3i& p) {
    if (map[p] > 1) map[p] = (p.x / 27 + p.y / 27) % 2 == 0 ? 2 : 3;
  });
  return map;
}

TEST(PlacedShare, TellsScenesFromTextures) {
  EXPECT_LT(placedShare(twoKinds(120)), 0.2);
  LayerVolume scene = twoKinds(120);  // ground below a sky
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 120; ++x) scene(x, y, 0) = 4;
  EXPECT_EQ(placedShare(scene), 1);
  EXPECT_EQ(placedShare(LayerVolume(Vec3i{1, 1, 1}, 2)), 0);
}

TEST(SynthesizeRegions, KeepsApartWhatIsApart) {
  const LayerVolume example = twoKinds(162);
  const auto touching = [](const LayerVolume& map) {
    double contacts = 0, steps = 0;
    forEachCell(map.size(), [&](const Vec3i& p) {
      if (p.x == 0) return;
      const std::uint8_t a = map[p], b = map[p - Vec3i{1, 0, 0}];
      steps += a != b;
      contacts += a != b && a != 1 && b != 1;
    });
    return contacts / steps;
  };
  ASSERT_LT(touching(example), 0.01);
  const SynthesizedLayers made = synthesizeRegions(example, {160, 150, 1}, {});
  ASSERT_EQ(made.areaErrors.size(), 3u);
  for (const double error : made.areaErrors) EXPECT_NEAR(error, 0, 1e-3);
  EXPECT_LT(touching(made.map), 0.08);
  const auto again = [&] { return synthesizeRegions(example, {96, 90, 1}, {}).map; };
  EXPECT_EQ(testing::onThreads(1, again), testing::onThreads(8, again));
}

TEST(LayeredSynthesis, ReportsAndHearsCancellationInEachStep) {
  const LayerVolume layers = noiseLayers(72, 64, 3, 2);
  const Map map = pictureOf(layers);
  testing::expectReportsAndStops(2, [&](const Progress& progress) {
    decomposeTexture(map.layers.front(), {.layers = 3, .neighborhood = 5}, 0, progress);
  });
  testing::expectReportsAndStops(3, [&](const Progress& progress) {
    synthesizeRegions(layers, {64, 64, 1}, {}, progress);
  });
  for (const TextureMethod method : {TextureMethod::Patches, TextureMethod::Classic}) {
    testing::expectReportsAndStops(2, [&](const Progress& progress) {
      const ControlMaps control = controlMaps(layers, false, layers, true, progress.part(0, 0.1));
      synthesizeTexture(map, {control.example}, {control.result}, {}, {.method = method},
                        progress.part(0.1, 1));
    });
  }
}

TEST(FillSmoothly, KeepsWhatIsKnownAndStaysBetween) {
  Planes planes(1, Array3D<float>(Vec3i{40, 30, 1}));
  forEachCell(planes[0].size(),
              [&](const Vec3i& p) { planes[0][p] = static_cast<float>(p.x) / 40; });
  const Planes was = planes;
  const Shape hole = squareHole(planes[0].size(), {10, 8, 0}, 14);
  fillSmoothly(planes, hole);
  for (std::size_t p = 0; p < hole.count(); ++p) {
    if (!hole.data()[p]) {
      EXPECT_EQ(planes[0].data()[p], was[0].data()[p]);
    } else {
      EXPECT_GT(planes[0].data()[p], 0);
      EXPECT_LT(planes[0].data()[p], 1);
    }
  }
}

}  // namespace
}  // namespace exemplar
