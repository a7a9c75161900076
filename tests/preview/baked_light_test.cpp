// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "preview/baked_light.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "mesh/primitives.h"
#include "tests/progress_checks.h"
#include "tests/threads.h"

namespace exemplar {
namespace {

/// A ball of radius 1 that floats well above the floor that a small triangle defines.
TriangleMesh ballOverFloor() {
  TriangleMesh mesh = makeSphere({0, 0, 20}, 1);
  append(mesh, makeSphere({100, 0, 0}, 0.5));
  return mesh;
}

BakedLight lightAt(const TriangleMesh& mesh, const Vec3d& position, const Vec3f& normal,
                   const BakeOptions& options = {}) {
  const LightProbe probe{position, normal};
  return bakeLight(mesh, {&probe, 1}, options).at(0);
}

TEST(BakedLight, OpenPointsSeeTheWholeSky) {
  BakeOptions options;
  options.picture.ground = false;
  const Vec3d key = keyDirection(options.picture);
  EXPECT_NEAR(length(key), 1, 1e-12);
  const BakedLight top =
      lightAt(ballOverFloor(), Vec3d{0, 0, 20} + key * 1.01, cast<float>(key), options);
  EXPECT_EQ(top.sky, 255);
  EXPECT_EQ(top.key, 255);
}

TEST(BakedLight, WhatTurnsAwayFromTheKeyHasNoneOfIt) {
  const Vec3d key = keyDirection({});
  EXPECT_EQ(lightAt(ballOverFloor(), Vec3d{0, 0, 20} - key * 1.01, cast<float>(-key)).key, 0);
}

TEST(BakedLight, AShadowFallsAlongTheKeysDirection) {
  // Far enough below the ball, in line with the key; and the same point moved out of its shadow.
  const TriangleMesh mesh = ballOverFloor();
  const Vec3d key = keyDirection({});
  const Vec3d shaded = Vec3d{0, 0, 20} - key * 4;
  EXPECT_EQ(lightAt(mesh, shaded, {0, 0, 1}).key, 0);
  EXPECT_EQ(lightAt(mesh, shaded + Vec3d{3, 0, 0}, {0, 0, 1}).key, 255);
}

TEST(BakedLight, TheFloorBelowCountsHalf) {
  const TriangleMesh mesh = ballOverFloor();
  // Straight down from the side of the ball that faces the floor: every ray reaches the floor.
  EXPECT_NEAR(lightAt(mesh, {0, 0, 18.9}, {0, 0, -1}).sky, 255 * 0.5, 1);
}

TEST(BakedLight, OfARightAngledCornerIsHalf) {
  // At the foot of a tall wall half of the cosine-weighted sky is hidden.
  TriangleMesh wall;
  wall.positions = {{0, -100, -100}, {0, 100, -100}, {0, 100, 100}, {0, -100, 100}};
  wall.triangles = {{0, 1, 2}, {0, 2, 3}};
  BakeOptions options;
  options.rays = 1024;
  // The lattice's error with 1024 points is far below 2 %; the wall's finite height hides less
  // than all by about (1 / 100)².
  EXPECT_NEAR(lightAt(wall, {0.01, 0, 0}, {0, 0, 1}, options).sky, 127.5, 5);
}

TEST(BakedLight, IsTheSameAtOneAndEightThreads) {
  const TriangleMesh mesh = makeSphere({0, 0, 0}, 1);
  std::vector<LightProbe> probes;
  for (int n = 0; n < 3000; ++n) {
    const Vec3d d = normalized(Vec3d{std::sin(n * 1.0), std::cos(n * 1.7), std::sin(n * 0.3)});
    probes.push_back({d * (n % 2 ? 1.0 : 0.7), cast<float>(d)});
  }
  testing::expectSameAtAnyThreads([&] { return bakeLight(mesh, probes); });
  const auto light = bakeLight(mesh, probes);
  EXPECT_NE(light[0], light[1]);
}

TEST(BakedLight, ReportsAndStops) {
  const TriangleMesh mesh = makeSphere({0, 0, 0}, 1);
  const std::vector<LightProbe> probes(4096, {{2, 0, 0}, {1, 0, 0}});
  testing::expectReportsAndStops(
      4, [&](const Progress& progress) { return bakeLight(mesh, probes, {.rays = 4}, progress); });
}

TEST(BakedLight, RefusesWhatIsOutOfRange) {
  const TriangleMesh mesh = makeSphere({0, 0, 0}, 1);
  const LightProbe probe{{2, 0, 0}, {1, 0, 0}};
  BakeOptions none;
  none.rays = 0;
  EXPECT_THROW(bakeLight(mesh, {&probe, 1}, none), InputError);
  EXPECT_THROW(bakeLight(TriangleMesh{}, {&probe, 1}), InputError);
}

}  // namespace
}  // namespace exemplar
