// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/height_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "maps/height_map_file.h"
#include "mesh/mesh_health.h"
#include "sdf/triangle_tree.h"
#include "tests/maps/made_maps.h"
#include "tests/sdf/cancellation.h"
#include "tests/sdf/shapes.h"

namespace exemplar {
namespace {

using test::hills;
using test::inputError;
using test::makeMap;
using test::TemporaryFolder;
using test::withThreads;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The distance to the surface, by brute force over its triangles far past the map's sides.
double exactDistance(const HeightMap& map, const Vec3d& p) {
  const auto mirror = [](int i, int n) {
    while (i < 0 || i >= n) i = i < 0 ? -i : 2 * (n - 1) - i;
    return i;
  };
  const auto point = [&](int c, int r) {
    return Vec3d{c * map.cellSize, r * map.cellSize,
                 map.at(mirror(c, map.width()), map.height() - 1 - mirror(r, map.height()))};
  };
  double nearest = kInfinity;
  for (int r = -map.height(); r < 2 * map.height(); ++r)
    for (int c = -map.width(); c < 2 * map.width(); ++c) {
      const Vec3d p00 = point(c, r), p10 = point(c + 1, r), p01 = point(c, r + 1),
                  p11 = point(c + 1, r + 1);
      const bool rising = std::abs(p00.z - p11.z) <= std::abs(p10.z - p01.z);
      nearest = std::min(
          {nearest, squaredDistance(p, rising ? Corners{p00, p10, p11} : Corners{p00, p10, p01}),
           squaredDistance(p, rising ? Corners{p00, p11, p01} : Corners{p10, p11, p01})});
    }
  return std::sqrt(nearest);
}

TEST(HeightMapToSdf, IsTheTrueDistanceOfGroundThatGoesOn) {
  const HeightMap map = makeMap(12, 9, 0.5, hills);
  for (const double halfWidth : {3.0, kInfinity}) {
    const DistanceField field = heightMapToSdf(map, {.resolution = 20, .halfWidth = halfWidth});
    int inside = 0;
    for (std::size_t s = 0; s < field.values.count(); ++s) {
      const Vec3d p = field.position(cast<double>(field.values.ijk(s)));
      const float v = field.values.values()[s];
      ASSERT_NEAR(std::abs(v), std::min<double>(exactDistance(map, p), field.truncation), 1e-5);
      inside += v < 0;
    }
    EXPECT_GT(inside, 500);
  }
}

TEST(HeightMapToSdf, HasNoWallsAndNoFloor) {
  const HeightMap map = makeMap(40, 30, 0.25, hills);
  const DistanceField field = heightMapToSdf(map, {.resolution = 40});
  const Vec3i n = field.size();
  for (int j = 0; j < n.y; ++j)
    for (int i = 0; i < n.x; ++i) {
      // Down at the floor all is ground, far from any surface; up at the ceiling all is air.
      EXPECT_EQ(field.values(i, j, 0), -field.truncation);
      EXPECT_EQ(field.values(i, j, n.z - 1), field.truncation);
      // And each column goes from one to the other once.
      int changes = 0;
      for (int k = 0; k + 1 < n.z; ++k)
        changes += (field.values(i, j, k) < 0) != (field.values(i, j, k + 1) < 0);
      EXPECT_EQ(changes, 1);
    }
}

TEST(HeightMapToSdf, SizesTheBoxByTheReliefAndTheOptions) {
  const HeightMap map =
      makeMap(41, 21, 0.1, [](double x, double) { return 7 + x / 4; });  // 4 x 2 x 1
  const DistanceField field = heightMapToSdf(map, {.resolution = 40, .air = 5, .ground = 3});
  EXPECT_NEAR(field.voxelSize, 0.1, 1e-9);
  EXPECT_EQ(field.size(), (Vec3i{40, 20, 18}));
  const Box3d box = field.box();
  EXPECT_NEAR(length(box.min - Vec3d{0, 0, 7 - 0.3}), 0, 1e-6);
  // Where the relief is the longest side, it and its air and ground have the samples.
  const HeightMap steep = makeMap(5, 5, 1, [](double x, double) { return 10 * x; });
  const DistanceField tall = heightMapToSdf(steep, {.resolution = 48});
  EXPECT_EQ(tall.size().z, 48);
  EXPECT_NEAR(tall.voxelSize, 1, 1e-9);
  EXPECT_NEAR(heightMapToSdf(map, {.voxelSize = 0.2}).voxelSize, 0.2, 1e-12);
}

TEST(HeightMapToSdf, AndBackIsWithinHalfAVoxel) {
  const HeightMap map = makeMap(50, 40, 0.2, hills);
  for (const int resolution : {25, 49, 120}) {
    const DistanceField field = heightMapToSdf(map, {.resolution = resolution});
    const HeightMap back = sdfToHeightMap(field);
    ASSERT_EQ(back.width(), field.size().x);
    ASSERT_EQ(back.height(), field.size().y);
    EXPECT_EQ(back.cellSize, field.voxelSize);
    for (int row = 0; row < back.height(); ++row)
      for (int column = 0; column < back.width(); ++column) {
        const Vec3d p = field.position({double(column), double(back.height() - 1 - row), 0});
        ASSERT_NEAR(back.at(column, row), hills(p.x, p.y), 0.5 * field.voxelSize);
      }
  }
}

TEST(HeightMapToSdf, AveragesMapsThatAreMuchFinerThanTheSamples) {
  // Noise of one cell on a slope: what is left of it at the samples' scale is small.
  const Random random(4);
  HeightMap map = makeMap(320, 240, 0.01, [](double x, double) { return 0.3 * x; });
  for (std::size_t p = 0; p < map.heights.count(); ++p)
    map.heights[p] += static_cast<float>(random.uniform(-0.05, 0.05, p));
  const DistanceField field = heightMapToSdf(map, {.resolution = 32});
  const HeightMap back = sdfToHeightMap(field);
  for (int column = 2; column + 2 < back.width(); ++column)
    EXPECT_NEAR(back.at(column, 5), 0.3 * field.position({double(column), 0, 0}).x,
                0.25 * field.voxelSize);
}

TEST(HeightMapToSdf, IsTheSameAtAnyNumberOfThreads) {
  const HeightMap map = makeMap(60, 50, 0.2, hills);
  const auto run = [&] { return heightMapToSdf(map, {.resolution = 48}).values; };
  EXPECT_EQ(withThreads(1, run), withThreads(8, run));
}

TEST(HeightMapToSdf, RefusesOptionsAndMapsThatMakeNoSense) {
  const HeightMap map = makeMap(4, 4, 1, hills);
  const auto error = [&](const HeightMapToSdfOptions& options) {
    return inputError([&] { heightMapToSdf(map, options); });
  };
  EXPECT_THAT(error({.resolution = 0}), HasSubstr("resolution"));
  EXPECT_THAT(error({.resolution = 100000}), HasSubstr("1..4096"));
  EXPECT_THAT(error({.voxelSize = -1}), HasSubstr("voxelSize"));
  EXPECT_THAT(error({.voxelSize = 1e-9}), HasSubstr("lower `resolution`"));
  EXPECT_THAT(error({.air = -1}), HasSubstr("air"));
  EXPECT_THAT(error({.halfWidth = 0}), HasSubstr("halfWidth"));
  EXPECT_THAT(inputError([] { heightMapToSdf({}); }), HasSubstr("2 x 2"));
  HeightMap broken = map;
  broken.heights[3] = std::nanf("");
  EXPECT_THAT(inputError([&] { heightMapToSdf(broken); }), HasSubstr("finite"));
  broken = map;
  broken.cellSize = 0;
  EXPECT_THAT(inputError([&] { heightMapToSdf(broken); }), HasSubstr("cellSize"));
}

TEST(SdfToHeightMap, TakesTheTopmostSurface) {
  // Ground below 1, a slab from 2 to 3 above half of it.
  const test::Shape shape = [](const Vec3d& p) {
    const double slab = std::max({std::abs(p.z - 2.5) - 0.5, p.x - 2.0});
    return std::min(p.z - 1.0, slab);
  };
  const DistanceField field = test::sampled(shape, {40, 5, 45}, 0.1, {0.05, 0.05, -0.45}, 0.3);
  const HeightMap map = sdfToHeightMap(field);
  EXPECT_NEAR(map.at(5, 2), 3, 1e-5);
  EXPECT_NEAR(map.at(35, 2), 1, 1e-5);
}

TEST(SdfToHeightMap, OfColumnsWithoutACrossingIsTheFloorOrTheCeiling) {
  DistanceField field{Array3D<float>({2, 1, 3}, 1), 0.5, {0, 0, 10}, 1};
  for (int k = 0; k < 3; ++k) field.values(1, 0, k) = -1;
  const HeightMap map = sdfToHeightMap(field);
  EXPECT_FLOAT_EQ(map.at(0, 0), 9.75f);
  EXPECT_FLOAT_EQ(map.at(1, 0), 11.25f);
}

TEST(SdfToHeightMap, PutsTheNorthFirst) {
  const test::Shape slope = [](const Vec3d& p) { return (p.z - p.y) / std::sqrt(2.0); };
  const HeightMap map = sdfToHeightMap(test::sampled(slope, {4, 10, 20}, 0.1, {0, 0, -0.5}, 10));
  EXPECT_NEAR(map.at(2, 0), 0.9, 1e-5);
  EXPECT_NEAR(map.at(2, 9), 0, 1e-5);
}

TEST(HeightMapToSdf, ReportsItsProgressAndStopsWhereItIsCancelled) {
  HeightMap map;
  map.heights = Grid<float>(40, 40);
  for (int p = 0; p < 40 * 40; ++p) {
    map.heights[p] = static_cast<float>(3 * std::sin(p % 40 * 0.3));
  }
  DistanceField field;
  expectReportsAndStops(
      [&](const Progress& progress) { field = heightMapToSdf(map, {.resolution = 40}, progress); },
      10);
  expectReportsAndStops([&](const Progress& progress) { sdfToHeightMap(field, progress); }, 10);
}

TEST(HeightMapToSdf, TakesRealTerrain) {
  const std::filesystem::path file = std::filesystem::path(EXEMPLAR_SOURCE_DIR) /
                                     "../shared/data/terrain/bigtujunga_srtm_30m_400.pgm";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file << " beside the checkout";
  const HeightMap map = readHeightMap(file);
  EXPECT_EQ(map.width(), 400);
  EXPECT_EQ(map.height(), 400);
  const auto [low, high] = std::ranges::minmax_element(map.heights.values());
  EXPECT_NEAR((*high - *low) / (399 * map.cellSize), 0.2, 1e-6);
  const HeightMap back = sdfToHeightMap(heightMapToSdf(map, {.resolution = 128}));
  EXPECT_EQ(back.width(), 128);
}

}  // namespace
}  // namespace exemplar
