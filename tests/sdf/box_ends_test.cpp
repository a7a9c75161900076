// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/box_ends.h"

#include <gtest/gtest.h>

#include "core/random.h"
#include "mesh/primitives.h"
#include "sdf/mesh_to_sdf.h"

namespace exemplar {
namespace {

bool goesOn(const TriangleMesh& mesh, int axis, int resolution = 48) {
  MeshToSdfOptions options{.resolution = resolution, .padding = 3};
  options.padding[axis] = 0;
  return looksCut(meshToSdf(mesh, options), axis);
}

/// A wall along x, with blocks on top where `crenels`.
TriangleMesh wall(double thickness, bool crenels = false) {
  TriangleMesh mesh = makeBox({{0, 0, 0}, {4, thickness, 2}});
  for (int n = 0; crenels && n < 4; ++n)
    append(mesh, makeBox({{1.0 * n, 0, 1.9}, {n + 0.5, thickness, 2.5}}));
  return mesh;
}

TEST(BoxEnds, OfWallsLookCut) {
  for (const int resolution : {24, 48, 96}) {
    for (const double thickness : {0.3, 1.5}) {
      EXPECT_TRUE(goesOn(wall(thickness), 0, resolution));
      EXPECT_TRUE(goesOn(wall(thickness, true), 0, resolution));
    }
  }
  // Ground does along both.
  const TriangleMesh ground = makeBox({{0, 0, 0}, {4, 3, 1}});
  EXPECT_TRUE(goesOn(ground, 0));
  EXPECT_TRUE(goesOn(ground, 1));
}

TEST(BoxEnds, OfFencesAndArchesLookCut) {
  // Posts as wide as the fence is high, and rails between them.
  TriangleMesh fence;
  for (const double x : {0.0, 1.9, 3.8}) append(fence, makeBox({{x, 0, 0}, {x + 0.2, 0.3, 1.2}}));
  for (const double z : {0.3, 0.9}) append(fence, makeBox({{0.1, 0.1, z}, {3.9, 0.2, z + 0.15}}));
  EXPECT_TRUE(goesOn(fence, 0));
  TriangleMesh arch = makeBox({{0, 0, 1.6}, {4, 0.6, 2}});
  for (const double x : {0.0, 3.4}) append(arch, makeBox({{x, 0, 0}, {x + 0.6, 0.6, 1.7}}));
  EXPECT_TRUE(goesOn(arch, 0));
}

TEST(BoxEnds, OfRoundThingsAndHeapsDoNot) {
  for (const int axis : {0, 1}) {
    EXPECT_FALSE(goesOn(makeSphere({}, 1, 12), axis));
    // A column, a ring, a tower.
    EXPECT_FALSE(goesOn(makeCylinder({0, 0, 0}, {0, 0, 3}, 1, 32), axis));
    EXPECT_FALSE(goesOn(makeTorus({}, {0, 0, 1}, 2, 0.4, 64, 24), axis));
  }
  TriangleMesh heap;
  const Random random(4);
  for (int b = 0; b < 30; ++b)
    append(heap, makeSphere({random.uniform(0, 3, b, 0), random.uniform(0, 3, b, 1),
                             random.uniform(0, 1, b, 2)},
                            0.35, 6));
  EXPECT_FALSE(goesOn(heap, 0));
  EXPECT_FALSE(goesOn(heap, 1));
}

TEST(BoxEnds, OfAnArmAcrossTheEndDoNot) {
  TriangleMesh ell = makeBox({{0, 0, 0}, {4, 0.4, 2}});
  append(ell, makeBox({{0, 0, 0}, {0.4, 3, 2}}));
  EXPECT_FALSE(goesOn(ell, 0));
  EXPECT_FALSE(goesOn(ell, 1));
}

TEST(BoxEnds, WithAirBeforeThemDoNot) {
  EXPECT_FALSE(looksCut(meshToSdf(wall(0.5), {.resolution = 40, .padding = 2}), 0));
  DistanceField thin;
  thin.values = Array3D<float>({3, 8, 8}, -1);
  EXPECT_FALSE(looksCut(thin, 0));
}

}  // namespace
}  // namespace exemplar
