// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/surface/local_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/synth/surface/surfaces.h"

namespace exemplar::surface {
namespace {

constexpr double kSample = 0.05;

LocalMapOptions options(double radius) {
  return {.sample = kSample, .radius = radius, .leastRadius = radius};
}

std::uint32_t nearest(const Sheet& sheet, const Vec3d& p) {
  std::uint32_t best = 0;
  for (std::uint32_t v = 0; v < sheet.positions.size(); ++v)
    if (length(sheet.positions[v] - p) < length(sheet.positions[best] - p)) best = v;
  return best;
}

TEST(LocalMap, IsThePositionOnAPlane) {
  const Sheet sheet = makeSheet(planeMesh(2, 30), {.edge = 0.08});
  const Guidance up = along(sheet, {1, 0, 0}, 1);
  const DirectionField field = smoothestField(sheet, 1, &up);
  const Coordinates c = integrate(sheet, field, {}, kSample);
  std::vector<StretchShare> stretch;
  const std::uint32_t seed = nearest(sheet, {1, 1, 0});
  const LocalMap map = LocalMapper(sheet, c, options(12)).map(seed, &stretch);
  EXPECT_GT(map.nodes.size(), 150u);
  for (std::size_t k = 0; k < map.nodes.size(); ++k) {
    const Vec3d off = (sheet.positions[map.nodes[k]] - sheet.positions[seed]) / kSample;
    EXPECT_NEAR(map.at[k].x, off.x, 1e-4);
    EXPECT_NEAR(map.at[k].y, off.y, 1e-4);
    EXPECT_LE(length(map.at[k]), 12 + 1e-9);
  }
  for (const StretchShare& s : stretch) {
    EXPECT_NEAR(s.least, 1, 1e-5);
    EXPECT_NEAR(s.most, 1, 1e-5);
  }
}

TEST(LocalMap, DoesNotStretchADevelopableSurface) {
  const Sheet sheet = makeSheet(cylinderMesh(1, 3, 100, 40), {.edge = 0.08});
  const Guidance up = along(sheet, {0, 0, 1}, 1);
  const DirectionField field = smoothestField(sheet, 1, &up);
  const Coordinates c = integrate(sheet, field, {}, kSample);
  std::vector<StretchShare> stretch;
  LocalMapper(sheet, c, options(14)).map(nearest(sheet, {1, 0, 1.5}), &stretch);
  ASSERT_GT(stretch.size(), 200u);
  for (const StretchShare& s : stretch) {
    EXPECT_NEAR(s.least, 1, 0.01);
    EXPECT_NEAR(s.most, 1, 0.01);
  }
}

TEST(LocalMap, HasNoFlippedTrianglesOnABody) {
  const Sheet sheet = makeSheet(bodyMesh(), {.edge = 0.06});
  const DirectionField field = smoothestField(sheet, 4);
  const Coordinates c = integrate(sheet, field, {}, 0.04);
  const LocalMapper mapper(sheet, c, {.sample = 0.04, .radius = 10, .leastRadius = 6});
  double flipped = 0, all = 0;
  for (std::uint32_t seed = 5; seed < sheet.positions.size(); seed += 211) {
    const LocalMap map = mapper.map(seed);
    EXPECT_LE(map.radius, 10);
    EXPECT_GE(map.radius, 6);
    for (std::uint32_t k = 0; k < map.nodes.size(); ++k) {
      if (!map.inner[k]) continue;
      for (const std::uint32_t t : sheet.trianglesAt(map.nodes[k])) {
        std::array<Vec2d, 3> at;
        for (int corner = 0; corner < 3; ++corner)
          at[corner] = map.at[map.find(sheet.triangles[t][corner])];
        const Vec2d u = at[1] - at[0], v = at[2] - at[0];
        flipped += u.x * v.y - u.y * v.x <= 0;
        ++all;
      }
    }
  }
  EXPECT_GT(all, 5000);
  EXPECT_EQ(flipped, 0);
}

TEST(LocalMap, MapsDifferByWholePeriodsWhereTheyOverlap) {
  const Sheet sheet = makeSheet(bodyMesh(), {.edge = 0.06});
  const DirectionField field = smoothestField(sheet, 2);
  const Coordinates c = integrate(sheet, field, {2, {12, 0}, {0, 7}}, 0.04);
  const LocalMapper mapper(sheet, c, {.sample = 0.04, .radius = 12, .leastRadius = 12});
  const Mat2d toPeriods = c.lattice.basis().inverse();
  int overlaps = 0;
  for (std::uint32_t seed = 5; seed + 40 < sheet.positions.size(); seed += 211) {
    const LocalMap a = mapper.map(seed), b = mapper.map(sheet.links(seed)[0].node);
    for (std::uint32_t k = 0; k < a.nodes.size(); ++k) {
      const std::uint32_t there = b.find(a.nodes[k]);
      if (there == LocalMap::kNowhere || !a.inner[k] || !b.inner[there]) continue;
      const int turn = (a.turns[k] - b.turns[there] + 2) % 2;
      const Vec2d off = toPeriods * (a.at[k] - rotation(turn, 2) * b.at[there]);
      EXPECT_NEAR(off.x, std::round(off.x), 1e-6);
      EXPECT_NEAR(off.y, std::round(off.y), 1e-6);
      ++overlaps;
    }
  }
  EXPECT_GT(overlaps, 1000);
}

TEST(LocalMap, IsCutBehindASingularity) {
  const Sheet sheet = makeSheet(makeSphere({0, 0, 0}, 1, 10), {.edge = 0.08});
  const DirectionField field = smoothestField(sheet, 1);
  ASSERT_FALSE(field.singularities.empty());
  const std::uint32_t t = field.singularities[0].triangle;
  const Coordinates c = integrate(sheet, field, {}, kSample);
  const LocalMapper mapper(sheet, c, options(14));
  const std::uint32_t seed = sheet.triangles[t][0];
  const auto far = mapper.near(seed, 8 * kSample);
  const LocalMap map = mapper.map(far.back().first);
  // Nobody can show the singular triangle.
  int inside = 0;
  for (const std::uint32_t v : sheet.triangles[t]) {
    const std::uint32_t k = map.find(v);
    inside += k != LocalMap::kNowhere && map.inner[k];
  }
  EXPECT_EQ(inside, 0);
  // What is inside has one place each, next to its neighbors'.
  for (std::uint32_t k = 0; k < map.nodes.size(); ++k) {
    if (!map.inner[k]) continue;
    for (const Sheet::Link& link : sheet.links(map.nodes[k])) {
      const std::uint32_t other = map.find(link.node);
      ASSERT_NE(other, LocalMap::kNowhere);
      EXPECT_LT(length(map.at[k] - map.at[other]), 3 * 0.08 / kSample);
    }
  }
}

}  // namespace
}  // namespace exemplar::surface
