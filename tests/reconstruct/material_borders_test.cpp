// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/material_borders.h"

#include <gtest/gtest.h>

#include <numbers>

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

// A great circle through a fine triangulation: cut, the border is as long as the circle; along
// triangle sides it is a zigzag.
TEST(CutMaterialBorders, PutsBordersWhereTheyAre) {
  const auto plane = [](const Vec3d& p) { return p.x + 0.4 * p.y + 0.05; };
  TriangleMesh mesh = paintedSphere(24, plane);
  const TriangleMesh before = mesh;
  const double zigzag = borderLength(mesh);
  const auto parent = cutMaterialBorders(mesh, [&](const Vec3d& p, const Vec3d&, std::uint32_t) {
    return std::uint32_t{plane(p) > 0};
  });
  const double offset = 0.05 / std::hypot(1, 0.4);
  const double circle = 2 * std::numbers::pi * std::sqrt(1 - offset * offset);
  EXPECT_GT(zigzag, 1.08 * circle);
  EXPECT_NEAR(borderLength(mesh), circle, 0.02 * circle);
  expectSound(mesh);
  validate(mesh, "cut");
  // Every piece lies in its triangle, and the pieces are the whole.
  ASSERT_EQ(parent.size(), mesh.triangles.size());
  std::vector<double> area(before.triangles.size(), 0);
  for (std::size_t t = 0; t < parent.size(); ++t) {
    const Vec3d n = areaNormal(mesh, t), whole = areaNormal(before, parent[t]);
    EXPECT_GT(dot(n, whole), (1 - 1e-9) * length(n) * length(whole));
    area[parent[t]] += length(n);
  }
  for (std::size_t t = 0; t < area.size(); ++t) {
    EXPECT_NEAR(area[t], length(areaNormal(before, t)), 1e-12);
  }
  // A tenth of a side, 0.0053, is as far as a border may be moved.
  for (std::size_t t = 0; t < parent.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Vec3d middle = (mesh.positions[a] + mesh.positions[b] + mesh.positions[c]) / 3.0;
    if (std::abs(plane(middle)) > 0.006) {
      EXPECT_EQ(mesh.triangleMaterials[t], plane(middle) > 0);
    }
  }
}

TEST(CutMaterialBorders, LeavesBordersAlongCreasesAlone) {
  TriangleMesh mesh = makeBox({{0, 0, 0}, {1, 1, 1}});
  mesh.materials.resize(2);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    mesh.triangleMaterials.push_back(areaNormal(mesh, t).z > 0.5);
  }
  const TriangleMesh before = mesh;
  cutMaterialBorders(
      mesh, [](const Vec3d&, const Vec3d& n, std::uint32_t) { return std::uint32_t{n.z > 0.5}; });
  EXPECT_EQ(mesh.positions, before.positions);
  EXPECT_EQ(mesh.triangleMaterials, before.triangleMaterials);
}

TEST(CutMaterialBorders, AnyMaterialsLeaveTheSurfaceSound) {
  const Random random(3);
  TriangleMesh mesh = makeTorus({}, {0, 0, 1}, 2, 0.8, 40, 20);
  const double volume = meshHealth(mesh).signedVolume;
  const auto noise = [&](const Vec3d& p, const Vec3d&, std::uint32_t) {
    return random.below(4, static_cast<std::uint64_t>((p.x + 10) * 1e5) * 1000003 +
                               static_cast<std::uint64_t>((p.y + 10) * 1e5));
  };
  mesh.materials.resize(4);
  for (const auto& t : mesh.triangles)
    mesh.triangleMaterials.push_back(noise(mesh.positions[t[0]], {}, 0));
  cutMaterialBorders(mesh, noise);
  expectSound(mesh);
  EXPECT_NEAR(meshHealth(mesh).signedVolume, volume, 1e-9);
}

}  // namespace
}  // namespace exemplar
