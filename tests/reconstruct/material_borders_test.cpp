// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/material_borders.h"

#include <gtest/gtest.h>

#include "core/random.h"
#include "mesh/primitives.h"
#include "reconstruct/adjacency.h"
#include "tests/reconstruct/fields.h"

namespace exemplar {
namespace {

/// A sphere whose material is 1 where `value` of a triangle's middle is positive.
template <class Value>
TriangleMesh paintedSphere(int frequency, const Value& value) {
  TriangleMesh mesh = makeSphere({}, 1, frequency);
  mesh.materials.resize(2);
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3d middle = (mesh.positions[a] + mesh.positions[b] + mesh.positions[c]) / 3.0;
    mesh.triangleMaterials.push_back(value(middle) > 0);
  }
  return mesh;
}

/// The total length of the edges between materials.
double borderLength(const TriangleMesh& mesh) {
  const auto mates = mateHalfedges(mesh.triangles, mesh.positions.size());
  double sum = 0;
  for (std::uint32_t h = 0; h < mates.size(); ++h) {
    if (mesh.triangleMaterials[h / 3] == mesh.triangleMaterials[mates[h] / 3]) continue;
    sum += length(mesh.positions[toVertex(mesh.triangles, h)] -
                  mesh.positions[fromVertex(mesh.triangles, h)]) /
           2;
  }
  return sum;
}

TEST(CleanMaterialBorders, RemovesSingleTrianglesAndKeepsAreas) {
  const Random random(2);
  TriangleMesh mesh = paintedSphere(20, [](const Vec3d& p) { return p.x; });
  const std::vector<std::uint32_t> painted = mesh.triangleMaterials;
  const double clean = borderLength(mesh);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (random.uniform(t) < 0.03) mesh.triangleMaterials[t] ^= 1;
  }
  ASSERT_GT(borderLength(mesh), 3 * clean);
  cleanMaterialBorders(mesh, 3);
  EXPECT_LT(borderLength(mesh), 1.3 * clean);
  int different = 0;
  for (std::size_t t = 0; t < painted.size(); ++t)
    different += painted[t] != mesh.triangleMaterials[t];
  EXPECT_LT(different, 0.02 * painted.size());
}

TEST(CleanMaterialBorders, NoRoundsChangeNothing) {
  TriangleMesh mesh = paintedSphere(8, [](const Vec3d& p) { return std::sin(20 * p.x * p.y); });
  const auto before = mesh.triangleMaterials;
  cleanMaterialBorders(mesh, 0);
  EXPECT_EQ(mesh.triangleMaterials, before);
}

TEST(StraightenMaterialBorders, ShortensBordersAndLeavesTheSurfaceWhereItIs) {
  TriangleMesh mesh = paintedSphere(24, [](const Vec3d& p) { return p.x + 0.4 * p.y; });
  const TriangleMesh before = mesh;
  const double edge = 1.26 / 24;
  straightenMaterialBorders(mesh, 0.5 * edge);
  // A great circle, cut along triangle edges, is a zigzag of up to 1.15 times its length.
  EXPECT_LT(borderLength(mesh), 0.97 * borderLength(before));
  expectSound(mesh);
  int moved = 0;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const double far = length(mesh.positions[v] - before.positions[v]);
    EXPECT_LE(far, 0.5 * edge * (1 + 1e-9));
    // Along the surface: off the sphere by far² / 2, and as much again for the normal's error.
    EXPECT_NEAR(length(mesh.positions[v]), 1, 1.2 * far * far + 1e-12);
    moved += far > 0;
  }
  EXPECT_GT(moved, 30);
}

TEST(StraightenMaterialBorders, LeavesCreasesAlone) {
  TriangleMesh mesh = makeBox({{0, 0, 0}, {1, 1, 1}});
  mesh.materials.resize(2);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    mesh.triangleMaterials.push_back(areaNormal(mesh, t).z > 0.5);
  }
  const auto before = mesh.positions;
  straightenMaterialBorders(mesh, 0.5);
  EXPECT_EQ(mesh.positions, before);
}

}  // namespace
}  // namespace exemplar
