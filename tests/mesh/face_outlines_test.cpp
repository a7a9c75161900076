// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/face_outlines.h"

#include <gtest/gtest.h>

#include <set>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/file.h"
#include "mesh/mesh_health.h"
#include "mesh/primitives.h"

namespace exemplar {
namespace {

/// A box, whose triangles come in pairs, and the number of each one's side.
struct Sides {
  TriangleMesh mesh = makeBox({{0, 0, 0}, {1, 2, 3}});
  std::vector<std::uint32_t> faces;

  Sides() {
    // Triangles of one side have one normal.
    std::vector<Vec3d> normals;
    TriangleMesh sorted = mesh;
    sorted.triangles.clear();
    for (int side = 0; side < 6; ++side) {
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Vec3d n = areaNormal(mesh, t);
        const int axis = n.x != 0 ? 0 : n.y != 0 ? 1 : 2;
        if (2 * axis + (n[axis] > 0) != side) continue;
        sorted.triangles.push_back(mesh.triangles[t]);
        faces.push_back(static_cast<std::uint32_t>(side));
      }
    }
    mesh = sorted;
  }
};

TEST(FaceOutlines, JoinsTheTrianglesOfAFace) {
  const Sides box;
  const auto outlines = faceOutlines(box.mesh, box.faces, 100);
  ASSERT_EQ(outlines.size(), 6u);
  for (const auto& outline : outlines) {
    ASSERT_EQ(outline.size(), 4u);
    // It runs as its triangles do.
    Vec3d sum;
    const auto at = [&](std::size_t n) {
      const TriangleCorner& c = outline[n % 4];
      return box.mesh.positions[box.mesh.triangles[c.triangle][c.corner]];
    };
    for (std::size_t n = 0; n < 4; ++n) sum += cross(at(n), at(n + 1));
    EXPECT_GT(dot(sum, areaNormal(box.mesh, outline[0].triangle)), 0);
  }
}

TEST(FaceOutlines, LeavesTrianglesWhereThereIsNoSimpleOutline) {
  const Sides box;
  EXPECT_EQ(faceOutlines(box.mesh, {}, 100).size(), 12u);
  EXPECT_EQ(faceOutlines(box.mesh, box.faces, 3).size(), 12u);
}

TEST(FaceOutlines, CutsAFaceWithAHoleIntoFewPolygons) {
  // A square with a square hole, in eight triangles around it.
  TriangleMesh ring;
  for (const double side : {3.0, 1.0})
    for (int c = 0; c < 4; ++c)
      ring.positions.push_back({c == 1 || c == 2 ? side : -side, c >= 2 ? side : -side, 0});
  for (std::uint32_t c = 0; c < 4; ++c) {
    const std::uint32_t next = (c + 1) % 4;
    ring.triangles.push_back({c, next, 4 + next});
    ring.triangles.push_back({c, 4 + next, 4 + c});
  }
  const auto outlines = faceOutlines(ring, std::vector<std::uint32_t>(8, 0), 100);
  EXPECT_EQ(outlines.size(), 2u);
  // None visits a corner twice, and together they have the area of the ring.
  double area = 0;
  for (const auto& outline : outlines) {
    std::set<std::uint32_t> corners;
    Vec3d sum;
    const auto vertex = [&](std::size_t n) {
      const TriangleCorner& c = outline[n % outline.size()];
      return ring.triangles[c.triangle][c.corner];
    };
    for (std::size_t n = 0; n < outline.size(); ++n) {
      corners.insert(vertex(n));
      sum += cross(ring.positions[vertex(n)], ring.positions[vertex(n + 1)]);
    }
    EXPECT_EQ(corners.size(), outline.size());
    EXPECT_GT(sum.z, 0);
    area += sum.z / 2;
  }
  EXPECT_NEAR(area, 36 - 4, 1e-12);
}

TEST(WritePolygons, ReadsBackAsTheSameSolid) {
  const Sides box;
  for (const char* ending : {".obj", ".ply", ".off", ".stl"}) {
    const std::filesystem::path file =
        std::filesystem::path(testing::TempDir()) / (std::string("polygons") + ending);
    writePolygons(file, box.mesh, box.faces);
    const MeshHealth health = meshHealth(readMesh(file));
    EXPECT_TRUE(health.closed()) << ending;
    EXPECT_TRUE(health.oriented()) << ending;
    EXPECT_EQ(health.triangles, 12) << ending;
    EXPECT_NEAR(health.signedVolume, 6, 1e-6) << ending;
  }
  const std::string obj = readFile(std::filesystem::path(testing::TempDir()) / "polygons.obj");
  std::istringstream lines(obj);
  int faces = 0;
  for (std::string line; std::getline(lines, line);) faces += line.starts_with("f ");
  EXPECT_EQ(faces, 6);
}

}  // namespace
}  // namespace exemplar
