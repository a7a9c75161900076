// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Layers in space.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/cells.h"
#include "core/random.h"
#include "maps/distance_transform.h"
#include "measure/layers.h"
#include "synth/layered/layers.h"
#include "synth/layered/texture_by_numbers.h"
#include "tests/threads.h"

namespace exemplar {
namespace {

/// Balls of one radius on a jittered lattice, each with a core.
LayerVolume balls(int side, double radius, std::uint64_t seed) {
  LayerVolume map(Vec3i{side, side, side}, 1);
  const Random random(seed);
  const double step = 3.2 * radius;
  const int count = static_cast<int>(side / step);
  std::uint64_t n = 0;
  forEachCell(Vec3i{count, count, count}, [&](const Vec3i& cell) {
    Vec3d center = (cast<double>(cell) + Vec3d{0.5, 0.5, 0.5}) * step;
    for (int axis = 0; axis < 3; ++axis)
      center[axis] += random.uniform(-0.3, 0.3, n, static_cast<std::uint32_t>(axis)) * radius;
    ++n;
    forEachCell(map.size(), [&](const Vec3i& p) {
      const Vec3d d = cast<double>(p) - center;
      const double far = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
      if (far <= radius) map[p] = far <= 0.5 * radius ? 3 : 2;
    });
  });
  return map;
}

LayerOptions volumeOptions(std::uint64_t seed = 0) {
  LayerOptions options;
  options.shape.patch = 9;
  options.seed = seed;
  return options;
}

TEST(LayersInSpace, KeepVolumesNestingAndLikeness) {
  const LayerVolume example = balls(40, 5, 1);
  const SynthesizedLayers made = synthesizeLayers(example, {48, 48, 48}, volumeOptions());
  for (int i = 2; i <= 3; ++i)
    EXPECT_NEAR(areaOf(layerShape(made.map, i)), areaOf(layerShape(example, i)),
                1.0 / static_cast<double>(made.map.count()));
  EXPECT_EQ(skippingShare(example), 0);
  EXPECT_EQ(skippingShare(made.map), 0);
  for (const LayerLikeness& layer : measureLayers(example, false, made.map).layers) {
    // A patch of 9 x 9 x 9 cells over a ball of radius 5 differs in 3 % for a shift by half a cell.
    EXPECT_LE(*layer.toExample, 0.08) << layer.layer;
    EXPECT_LE(*layer.toResult, 0.08) << layer.layer;
    EXPECT_NEAR(*layer.boundaryRatio, 1, 0.12) << layer.layer;
  }
}

TEST(LayersInSpace, ACrustStaysAtTheSurface) {
  // One large ball, whose middle no patch of its boundary reaches, with squares of crust on its
  // upper half, two cells thick.
  LayerVolume example(Vec3i{44, 44, 44}, 1);
  forEachCell(example.size(), [&](const Vec3i& p) {
    const Vec3i d = p - Vec3i{22, 22, 22};
    if (d.x * d.x + d.y * d.y + d.z * d.z <= 18 * 18) example[p] = 2;
  });
  const auto depthsOf = [](const LayerVolume& layers) {
    Shape outside(layers.size());
    for (std::size_t p = 0; p < layers.count(); ++p) outside.data()[p] = layers.data()[p] < 2;
    return distanceTo(outside, true);
  };
  const Array3D<float> depths = depthsOf(example);
  forEachCell(example.size(), [&](const Vec3i& p) {
    const Vec3i up = example.clamped(p + Vec3i{0, 0, 2});
    if (depths[p] > 0 && depths[p] <= 2 && example[up] == 1 && (p.x / 5 + p.y / 5) % 2 == 0)
      example[p] = 3;
  });
  const LayerVolume made = synthesizeLayers(example, {44, 44, 44}, volumeOptions()).map;
  const Array3D<float> madeDepths = depthsOf(made);
  std::int64_t crust = 0;
  for (std::size_t p = 0; p < made.count(); ++p) {
    if (made.data()[p] != 3) continue;
    ++crust;
    ASSERT_LE(madeDepths.data()[p], 2) << p;
  }
  EXPECT_EQ(crust, insideOf(layerShape(example, 3)));
}

TEST(LayersInSpace, AreTheSameAtAnyNumberOfThreads) {
  const LayerVolume example = balls(28, 4, 2);
  const auto make = [&] { return synthesizeLayers(example, {32, 28, 24}, volumeOptions(3)).map; };
  const LayerVolume one = testing::onThreads(1, make);
  EXPECT_EQ(testing::onThreads(8, make), one);
  EXPECT_NE(synthesizeLayers(example, {32, 28, 24}, volumeOptions(4)).map, one);
}

TEST(LayersInSpace, AFlatVolumeIsAPicture) {
  // The same code: a volume one cell thick has the patches of a picture.
  const LayerVolume cube = balls(28, 4, 2);
  LayerVolume slice(Vec3i{28, 28, 1});
  forEachCell(slice.size(), [&](const Vec3i& p) { slice[p] = cube(p.x, p.y, 6); });
  const BoundaryPatches patches(layerShape(slice, 2), boundaryOf(layerShape(slice, 2), true), 9, 4,
                                true);
  EXPECT_EQ(patches.cells(), 81);
  const BoundaryPatches solid(layerShape(cube, 2), boundaryOf(layerShape(cube, 2), true), 9, 4,
                              true);
  EXPECT_EQ(solid.cells(), 729);
}

TEST(LayersInSpace, NearestPatchesAreThoseOfAFullSearch) {
  const LayerVolume example = balls(24, 4, 2), result = balls(26, 3.5, 3);
  const auto planesOf = [](const LayerVolume& layers) {
    return std::vector<Shape>{layerShape(layers, 2), layerShape(layers, 3)};
  };
  const std::vector<Shape> theirs = planesOf(example), ours = planesOf(result);
  std::vector<Vec3i> few = boundaryOf(ours[0], true);
  few.resize(40);
  // One plane, and a second at half weight; sides with blocks of a byte, and without.
  for (const auto& [joint, side] : {std::pair{false, 9}, {true, 9}, {false, 21}}) {
    ShapePlanes of(ours[0]), among(theirs[0]);
    if (joint) {
      of.shapes.push_back(&ours[1]);
      among.shapes.push_back(&theirs[1]);
    }
    const BoundaryPatches set(of, few, side, 1, true);
    const BoundaryPatches examples(among, boundaryOf(theirs[0], true), side, 4, true);
    const NearestPatches nearest(examples);
    for (std::size_t s = 0; s < set.count(); s += 7) {
      std::vector<std::pair<int, std::uint32_t>> all;
      for (std::uint32_t e = 0; e < examples.count(); ++e) {
        int least = 1 << 30;
        for (int t = 0; t < 4; ++t) least = std::min(least, patchDistance(set, s, examples, e, t));
        all.emplace_back(least, e);
      }
      std::ranges::sort(all);
      std::vector<BoundaryMatch> found;
      nearest.find(set, s, 8, {}, found);
      ASSERT_EQ(found.size(), 8u);
      for (std::size_t n = 0; n < 8; ++n) {
        EXPECT_EQ(found[n].distance, all[n].first) << joint << side;
        EXPECT_EQ(found[n].patch, all[n].second) << joint << side;
      }
    }
  }
}

TEST(LayersInSpace, DistancesAreThoseToTheNearestCells) {
  const Random random(3);
  for (const bool wraps : {false, true}) {
    Shape shape(Vec3i{9, 7, 6});
    for (std::size_t p = 0; p < shape.count(); ++p) shape.data()[p] = random.uniform(p) < 0.02;
    const Array3D<float> distance = distanceTo(shape, wraps);
    forEachCell(shape.size(), [&](const Vec3i& p) {
      double least = 1e9;
      forEachCell(shape.size(), [&](const Vec3i& q) {
        if (!shape[q]) return;
        double sum = 0;
        for (int axis = 0; axis < 3; ++axis) {
          double d = std::abs(q[axis] - p[axis]);
          if (wraps) d = std::min(d, shape.size()[axis] - d);
          sum += d * d;
        }
        least = std::min(least, std::sqrt(sum));
      });
      EXPECT_NEAR(distance[p], least, 1e-4);
    });
  }
}

TEST(LayersInSpace, EveryCellComesFromItsOwnLayer) {
  const LayerVolume example = balls(28, 4, 2);
  const LayerVolume made = synthesizeLayers(example, {32, 32, 32}, volumeOptions()).map;
  const ControlMaps control = controlMaps(example, false, made, true);
  TextureTask task;
  task.exampleGuide.push_back(control.example);
  task.guide.push_back(control.result);
  const TextureOptions options{.patch = 3, .rounds = 2, .guide = 3};
  const TextureOrigins from =
      layerOrigins(matchTexture(task, options), task, example, made, options);
  std::size_t together = 0, steps = 0;
  forEachCell(made.size(), [&](const Vec3i& p) {
    ASSERT_EQ(example[from[p]], made[p]);
    if (p.x == 0) return;
    ++steps;
    together += from[p] - from[p - Vec3i{1, 0, 0}] == Vec3i{1, 0, 0};
  });
  // Origins go on from cell to cell: a random choice within layers would do so in one of thousands.
  EXPECT_GT(together, steps / 4);
}

TEST(MeasureLayers, TellsVolumesApart) {
  const LayerVolume example = balls(28, 5, 1);
  const LayersLikeness itself = measureLayers(example, true, example);
  for (const LayerLikeness& layer : itself.layers) {
    EXPECT_EQ(layer.toExample, 0);
    EXPECT_EQ(layer.boundaryRatio, 1);
  }
  LayerVolume noise(Vec3i{28, 28, 28});
  const Random random(1);
  for (std::size_t p = 0; p < noise.count(); ++p)
    noise.data()[p] = static_cast<std::uint8_t>(1 + random.below(3, p));
  const LayersLikeness ofNoise = measureLayers(example, true, noise);
  EXPECT_GT(*ofNoise.layers[0].toExample, 0.2);
  EXPECT_GT(*ofNoise.layers[0].boundaryRatio, 3);
  // The example twice.
  LayerVolume twice(Vec3i{56, 28, 28});
  forEachCell(twice.size(), [&](const Vec3i& p) { twice[p] = example(p.x % 28, p.y, p.z); });
  EXPECT_GT(*measureLayers(example, true, twice).repeated, 0.5);
}

}  // namespace
}  // namespace exemplar
