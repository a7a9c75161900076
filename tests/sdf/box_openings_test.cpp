// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/box_openings.h"

#include <gtest/gtest.h>

#include <functional>

#include "mesh/mesh_health.h"
#include "mesh/primitives.h"
#include "sdf/triangle_soup.h"

namespace exemplar {
namespace {

/// The mesh without the triangles that `gone` says of, by their middle.
TriangleMesh without(TriangleMesh mesh, const std::function<bool(const Vec3d&)>& gone) {
  std::erase_if(mesh.triangles, [&](const auto& t) {
    return gone((mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3.0);
  });
  return mesh;
}

TriangleMesh closed(TriangleMesh mesh) {
  append(mesh, boxOpenings(mesh));
  return mesh;
}

/// The size of the solid: however its triangles face, `makeSoup` turns them alike.
double volumeOf(const TriangleMesh& mesh) {
  const TriangleSoup soup = makeSoup(mesh, {}, 1);
  EXPECT_TRUE(soup.closed);
  double six = 0;
  for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
    const Corners c = cornersOf(soup, t);
    six += dot(c[0], cross(c[1], c[2]));
  }
  return std::abs(six) / 6;
}

const Box3d kWall{{1, 2, 3}, {5, 2.5, 5}};
bool isEnd(const Vec3d& p) { return p.x < 1.001 || p.x > 4.999; }
bool isBottom(const Vec3d& p) { return p.z < 3.001; }

TEST(BoxOpenings, CloseAWallWithoutEndsAndWithoutABottom) {
  const TriangleMesh wall = makeBox(kWall);
  EXPECT_TRUE(boxOpenings(wall).triangles.empty());
  const TriangleMesh noEnds = without(wall, isEnd), noBottom = without(wall, isBottom);
  const TriangleMesh neither = without(noEnds, isBottom);
  ASSERT_EQ(neither.triangles.size(), 6u);
  for (const TriangleMesh& open : {noEnds, noBottom, neither})
    EXPECT_NEAR(volumeOf(closed(open)), 4 * 0.5 * 2, 1e-9);
}

TEST(BoxOpenings, KeepHollowsOpenInside) {
  // A duct: the ends are rings.
  TriangleMesh duct = makeBox(kWall);
  TriangleMesh hollow = makeBox({{1, 2.1, 3.2}, {5, 2.4, 4.8}});
  for (auto& t : hollow.triangles) std::swap(t[1], t[2]);
  append(duct, hollow);
  const TriangleMesh open = without(duct, isEnd);
  EXPECT_NEAR(volumeOf(closed(open)), 4 * (0.5 * 2 - 0.3 * 1.6), 1e-9);
  // Standing on the ground, the ends are arches.
  TriangleMesh arch = makeBox(kWall);
  TriangleMesh way = makeBox({{1, 2.1, 3}, {5, 2.4, 4.8}});
  for (auto& t : way.triangles) std::swap(t[1], t[2]);
  append(arch, way);
  const TriangleMesh standing = without(without(arch, isEnd), isBottom);
  EXPECT_NEAR(volumeOf(closed(standing)), 4 * (0.5 * 2 - 0.3 * 1.8), 1e-9);
}

TEST(BoxOpenings, LeaveOpenWhatIsNoOpeningOfTheBox) {
  const TriangleMesh wall = makeBox(kWall);
  // A hole in a side that is there otherwise.
  TriangleMesh window = wall;
  window.triangles.erase(window.triangles.begin());
  const std::size_t before = window.triangles.size();
  const TriangleMesh kept = closed(window);
  EXPECT_LE(kept.triangles.size(), before + 2);
  // Sheets, and rims that leave the box's faces.
  TriangleMesh sheet = wall;
  std::erase_if(sheet.triangles, [&](const auto& t) {
    for (const std::uint32_t corner : t)
      if (sheet.positions[corner].y > 2.1) return true;
    return false;
  });
  EXPECT_TRUE(boxOpenings(sheet).triangles.empty());
  const TriangleMesh dome =
      without(makeSphere({}, 1, 8), [](const Vec3d& p) { return p.x + p.y + p.z > 1.2; });
  EXPECT_TRUE(boxOpenings(dome).triangles.empty());
}

TEST(BoxOpenings, DoNotCoverWhatIsCovered) {
  // Six panels that were modeled one by one and do not quite meet.
  TriangleMesh panels;
  const TriangleMesh wall = makeBox(kWall);
  for (std::size_t t = 0; t < wall.triangles.size(); ++t) {
    const Vec3d n = normalized(areaNormal(wall, t)) * 1e-4;
    TriangleMesh panel;
    for (const std::uint32_t corner : wall.triangles[t])
      panel.positions.push_back(wall.positions[corner] + n);
    panel.triangles = {{0, 1, 2}};
    append(panels, panel);
  }
  EXPECT_TRUE(boxOpenings(panels).triangles.empty());
}

TEST(BoxOpenings, AllowForRoundedPositions) {
  TriangleMesh open = without(makeBox(kWall), isEnd);
  for (std::size_t v = 0; v < open.positions.size(); ++v) open.positions[v].x += v % 2 ? 5e-4 : 0;
  EXPECT_NEAR(volumeOf(closed(open)), 4, 0.01);
}

}  // namespace
}  // namespace exemplar
