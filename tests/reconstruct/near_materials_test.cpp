// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/near_materials.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "core/random.h"
#include "reconstruct/example_surface.h"

namespace exemplar {
namespace {

constexpr double kReach = 0.75;

/// A field that only says where samples are: 20 a side, 0.5 apart, from (-3, -3, -3) on.
DistanceField frame() { return {Array3D<float>({20, 20, 20}), 0.5, {-3, -3, -3}, 1}; }

/// Triangles with corners at most `size` (world) apart along each axis, within and beside the
/// field's box.
TriangleMesh randomTriangles(int count, double size, std::vector<std::uint32_t>& materials) {
  const Random random(7);
  TriangleMesh mesh;
  for (int t = 0; t < count; ++t) {
    const auto draw = [&](int n) { return random.uniform(t, n); };
    const Vec3d at{draw(0) * 13 - 4.5, draw(1) * 13 - 4.5, draw(2) * 13 - 4.5};
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int c = 0; c < 3; ++c) {
      mesh.positions.push_back(at +
                               Vec3d{draw(3 + 3 * c), draw(4 + 3 * c), draw(5 + 3 * c)} * size);
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
    materials.push_back(random.below(3, t, 20));
  }
  return mesh;
}

TEST(NearMaterials, KnowNothingThatATriangleInReachContradicts) {
  for (const auto& [size, cells] : {std::pair{0.3, 1}, {1.0, 2}, {1.0, 1}, {9.0, 3}}) {
    std::vector<std::uint32_t> materials;
    const TriangleMesh mesh = randomTriangles(size > 5 ? 12 : 60, size, materials);
    const DistanceField field = frame();
    const NearMaterials near(mesh, materials, field, kReach, cells);
    const ExampleSurface surface(mesh);
    const Random random(8);
    int known = 0;
    for (int n = 0; n < 20000; ++n) {
      const Vec3d index{random.uniform(n, 0) * 24 - 2, random.uniform(n, 1) * 24 - 2,
                        random.uniform(n, 2) * 24 - 2};
      const std::uint32_t only = near.only(index);
      if (only == NearMaterials::kUnknown) continue;
      ++known;
      const Vec3d point = field.position(index);
      for (std::uint32_t t = 0; t < materials.size(); ++t) {
        if (surface.distance(point, t) > kReach * field.voxelSize) continue;
        ASSERT_EQ(materials[t], only) << "size " << size << ", point " << n;
      }
    }
    EXPECT_GT(known, 100);  // there is something to contradict
  }
}

TEST(NearMaterials, KnowWhatLiesApart) {
  // Two squares, 3 voxels apart.
  TriangleMesh mesh;
  for (const double z : {0.0, 1.5}) {
    const auto v = static_cast<std::uint32_t>(mesh.positions.size());
    for (const Vec3d& p : {Vec3d{0, 0, z}, {4, 0, z}, {4, 4, z}, {0, 4, z}}) {
      mesh.positions.push_back(p);
    }
    mesh.triangles.push_back({v, v + 1, v + 2});
    mesh.triangles.push_back({v, v + 2, v + 3});
  }
  const std::vector<std::uint32_t> materials{5, 5, 2, 2};
  const DistanceField field = frame();
  const NearMaterials near(mesh, materials, field, kReach, 1);
  for (const double x : {0.1, 2.0, 3.9}) {
    for (const double y : {0.1, 2.0, 3.9}) {
      EXPECT_EQ(near.only(field.index({x, y, 0.1})), 5u);
      EXPECT_EQ(near.only(field.index({x, y, 1.4})), 2u);
    }
  }
  EXPECT_EQ(near.only(field.index({2, 2, 5})), NearMaterials::kUnknown);   // nothing there
  EXPECT_EQ(near.only(field.index({2, 2, 90})), NearMaterials::kUnknown);  // beside the field
  EXPECT_EQ(near.triangleNear(field.index({4.0 / 3, 8.0 / 3, 0})), 1u);
  EXPECT_EQ(near.triangleNear(field.index({2, 2, 5})), NearMaterials::kUnknown);
}

TEST(NearMaterials, AreNotKeptFromKnowingByTheBoxesOfLargeTriangles) {
  // A needle along the diagonal: the corners of its box are far from it.
  TriangleMesh mesh;
  mesh.positions = {{-3, -3, -3}, {6, 6, 6}, {6, 6, 5.9}};
  mesh.triangles = {{0, 1, 2}};
  const std::vector<std::uint32_t> materials{1};
  const DistanceField field = frame();
  const NearMaterials near(mesh, materials, field, kReach, 1);
  EXPECT_EQ(near.only(field.index({1, 1, 1})), 1u);
  EXPECT_EQ(near.only(field.index({5, -2, 1})), NearMaterials::kUnknown);
}

}  // namespace
}  // namespace exemplar
