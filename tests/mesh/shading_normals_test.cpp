// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/shading_normals.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <numbers>
#include <set>
#include <sstream>

#include "core/file.h"
#include "mesh/mesh_file.h"
#include "mesh/mesh_health.h"
#include "mesh/primitives.h"
#include "mesh/split_vertices.h"
#include "mesh_samples.h"

namespace exemplar {
namespace {

const std::vector<std::string> kEndings{".obj", ".ply", ".glb", ".gltf"};

double degreesBetween(const Vec3f& a, const Vec3d& b) {
  const Vec3d d = cast<double>(a);
  return std::atan2(length(cross(d, b)), dot(d, b)) * 180 / std::numbers::pi;
}

TriangleMesh soupOf(const TriangleMesh& mesh) {
  TriangleMesh soup;
  for (const auto& triangle : mesh.triangles) {
    const std::uint32_t n = static_cast<std::uint32_t>(soup.positions.size());
    for (const std::uint32_t v : triangle) soup.positions.push_back(mesh.positions[v]);
    soup.triangles.push_back({n, n + 1, n + 2});
  }
  return soup;
}

/// Boxes that touch along an edge and keep vertices of their own there.
TriangleMesh touchingBoxes() {
  TriangleMesh mesh = makeBox({{0, 0, 0}, {1, 1, 1}});
  append(mesh, makeBox({{1, 1, 0}, {2, 2, 1}}));
  return mesh;
}

/// A prism over a regular polygon, whose sides meet at 360 / `sides` degrees.
TriangleMesh prism(int sides) { return makeCylinder({0, 0, 0}, {0, 0, 1}, 1, sides); }

TEST(ShadingNormals, OfASphereArePointingAwayFromItsCenterAndSharedAtVertices) {
  const TriangleMesh sphere = makeSphere({3, 4, 5}, 2, 12);
  const ShadingNormals normals = shadingNormals(sphere, MeshNormals::Crease);
  EXPECT_EQ(normals.normals.size(), sphere.positions.size());
  for (std::size_t t = 0; t < sphere.triangles.size(); ++t) {
    for (int c = 0; c < 3; ++c) {
      const Vec3f n = normals.normals[normals.corners[t][c]];
      EXPECT_NEAR(length(n), 1, 1e-6);
      // Facets lean by up to half an edge's angle, 3 degrees; their mean by much less.
      EXPECT_LT(degreesBetween(n, sphere.positions[sphere.triangles[t][c]] - Vec3d{3, 4, 5}), 1.0);
    }
  }
}

TEST(ShadingNormals, OfABoxAreThoseOfItsFacesWithThreeAtEachVertex) {
  const TriangleMesh box = makeBox({{0, 0, 0}, {1, 2, 3}});
  const ShadingNormals normals = shadingNormals(box, MeshNormals::Crease);
  EXPECT_EQ(normals.normals.size(), 24u);
  for (std::size_t t = 0; t < box.triangles.size(); ++t) {
    for (int c = 0; c < 3; ++c)
      EXPECT_LT(degreesBetween(normals.normals[normals.corners[t][c]], areaNormal(box, t)), 1e-4);
  }
  const ShadingNormals smooth = shadingNormals(box, MeshNormals::Smooth);
  EXPECT_EQ(smooth.normals.size(), 8u);
  // Weighted by angles, each face counts alike however it is cut: along the diagonal.
  for (std::size_t t = 0; t < box.triangles.size(); ++t) {
    for (int c = 0; c < 3; ++c) {
      const Vec3d& p = box.positions[box.triangles[t][c]];
      const Vec3d corner{p.x > 0 ? 1.0 : -1, p.y > 0 ? 1.0 : -1, p.z > 0 ? 1.0 : -1};
      EXPECT_LT(degreesBetween(smooth.normals[smooth.corners[t][c]], corner), 1e-4);
    }
  }
  EXPECT_TRUE(shadingNormals(box, MeshNormals::None).corners.empty());
}

TEST(ShadingNormals, EdgesAreHardAboveFortyDegreesOnly) {
  for (const int sides : {8, 9, 10}) {  // 45, 40 and 36 degrees
    const TriangleMesh mesh = prism(sides);
    const ShadingNormals normals = shadingNormals(mesh, MeshNormals::Crease);
    std::size_t slanted = 0;  // normals of sides that are no facet's
    std::set<std::uint32_t> ofSides;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      if (std::abs(normalized(areaNormal(mesh, t)).z) > 0.5) continue;
      for (int c = 0; c < 3; ++c) {
        ofSides.insert(normals.corners[t][c]);
        if (degreesBetween(normals.normals[normals.corners[t][c]], areaNormal(mesh, t)) > 1)
          ++slanted;
      }
    }
    EXPECT_EQ(slanted == 0, sides == 8) << sides;
    EXPECT_EQ(ofSides.size(), static_cast<std::size_t>(sides == 8 ? 4 * sides : 2 * sides));
  }
}

TEST(ShadingNormals, OfASoupAreThoseOfTheJoinedMesh) {
  for (const TriangleMesh& mesh : {makeSphere({0, 0, 0}, 1, 6), makeBox({{0, 0, 0}, {1, 2, 3}})}) {
    const TriangleMesh soup = soupOf(mesh);
    const ShadingNormals a = shadingNormals(mesh, MeshNormals::Crease),
                         b = shadingNormals(soup, MeshNormals::Crease);
    EXPECT_EQ(a.normals.size(), b.normals.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      for (int c = 0; c < 3; ++c) EXPECT_EQ(a.normals[a.corners[t][c]], b.normals[b.corners[t][c]]);
    }
  }
}

TEST(ShadingNormals, BothSidesOfADoubleSheetKeepTheirOwn) {
  TriangleMesh sheet;
  sheet.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}, {2, 1, 0}, {3, 2, 0}};
  for (const MeshNormals mode : {MeshNormals::Crease, MeshNormals::Smooth}) {
    for (const TriangleMesh& mesh : {sheet, soupOf(sheet)}) {
      const ShadingNormals normals = shadingNormals(mesh, mode);
      EXPECT_EQ(normals.normals.size(), 8u);
      for (std::size_t t = 0; t < 4; ++t) {
        for (int c = 0; c < 3; ++c)
          EXPECT_EQ(normals.normals[normals.corners[t][c]].z, t < 2 ? 1 : -1);
      }
    }
  }
}

TEST(ShadingNormals, TrianglesWithoutAreaHaveUnitNormalsToo) {
  TriangleMesh mesh = makeBox({{0, 0, 0}, {1, 1, 1}});
  mesh.triangles.push_back({0, 0, 1});
  mesh.positions.push_back({5, 5, 5});
  mesh.triangles.push_back({8, 8, 8});
  const ShadingNormals normals = shadingNormals(mesh, MeshNormals::Crease);
  for (const auto& corners : normals.corners) {
    for (const std::uint32_t n : corners) EXPECT_NEAR(length(normals.normals[n]), 1, 1e-6);
  }
}

TEST(ShadingNormals, AreTheSameAtAnyNumberOfThreads) {
  const TriangleMesh mesh = soupOf(plainTorus(200, 50));
  ShadingNormals one, eight;
  tbb::task_arena(1).execute([&] { one = shadingNormals(mesh, MeshNormals::Crease); });
  tbb::task_arena(8).execute([&] { eight = shadingNormals(mesh, MeshNormals::Crease); });
  EXPECT_EQ(one.normals, eight.normals);
  EXPECT_EQ(one.corners, eight.corners);
}

TEST(ShadingNormals, AHubOfManyHardEdgesTakesNoSquareOfThem) {
  // 100,000 blades around one axis, each with a normal of its own at the hub.
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}};
  for (int i = 0; i < 100000; ++i) {
    const double angle = 1e-4 * i;
    const std::uint32_t n = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.push_back({std::cos(angle), std::sin(angle), 0});
    mesh.positions.push_back({std::cos(angle), std::sin(angle), 1});
    mesh.triangles.push_back({0, n, n + 1});
  }
  const SplitVertices split = splitVertices(mesh, shadingNormals(mesh, MeshNormals::Crease));
  EXPECT_EQ(split.source.size(), mesh.positions.size() + 99999);
}

TEST(MeshNormals, WhatIsWrittenReadsBackAsTheSameClosedMesh) {
  const TestFolder folder("normals");
  const std::vector<TriangleMesh> meshes{makeBox({{0, 0, 0}, {1, 2, 4}}), fullMesh(),
                                         touchingBoxes(), makeSphere({0, 0, 0}, 1, 5)};
  for (const std::string& ending : kEndings) {
    for (const MeshNormals mode : {MeshNormals::Crease, MeshNormals::Smooth, MeshNormals::None}) {
      for (TriangleMesh mesh : meshes) {
        // Coordinates that a float holds.
        for (Vec3d& p : mesh.positions) p = cast<double>(cast<float>(p));
        writeMesh(folder / ("m" + ending), mesh, {.normals = mode});
        const TriangleMesh back = readMesh(folder / ("m" + ending));
        EXPECT_EQ(back.positions, mesh.positions) << ending;
        EXPECT_EQ(back.triangles, mesh.triangles) << ending;
        EXPECT_EQ(back.uvs.size(), mesh.uvs.size());
        EXPECT_EQ(back.colors.size(), mesh.colors.size());
        const MeshHealth health = meshHealth(back);
        EXPECT_TRUE(health.closed() && health.manifold()) << ending;
      }
    }
  }
}

TEST(MeshNormals, AreInTheFilesAsTheOptionSays) {
  const TestFolder folder("normals_option");
  const TriangleMesh box = makeBox({{0, 0, 0}, {1, 2, 3}});
  const auto bytesOf = [&](const std::string& ending, MeshNormals mode) {
    writeMesh(folder / ("m" + ending), box, {.normals = mode});
    return readFile(folder / ("m" + ending));
  };
  const std::string marks[] = {"vn ", "property float nz\n", "\"NORMAL\":", "\"NORMAL\":"};
  for (int e = 0; e < 4; ++e) {
    for (const MeshNormals mode : {MeshNormals::Crease, MeshNormals::Smooth, MeshNormals::None}) {
      EXPECT_EQ(bytesOf(kEndings[e], mode).find(marks[e]) != std::string::npos,
                mode != MeshNormals::None)
          << kEndings[e];
    }
  }
  const auto vertices = [](const std::string& ply) {
    return std::stoi(ply.substr(ply.find("element vertex ") + 15));
  };
  EXPECT_EQ(vertices(bytesOf(".ply", MeshNormals::Crease)), 24);
  EXPECT_EQ(vertices(bytesOf(".ply", MeshNormals::Smooth)), 8);
  EXPECT_EQ(vertices(bytesOf(".ply", MeshNormals::None)), 8);
}

TEST(MeshNormals, TurnWithTheUpAxis) {
  const TestFolder folder("normals_up");
  const TriangleMesh box = makeBox({{0, 0, 0}, {1, 2, 3}});
  for (const UpAxis up : {UpAxis::Y, UpAxis::Z}) {
    writeMesh(folder / "m.obj", box, {.up = up});
    // Each face's normal in the file is the cross product of its sides in the file.
    std::istringstream in(readFile(folder / "m.obj"));
    std::vector<Vec3d> v, vn;
    int faces = 0;
    for (std::string key; in >> key;) {
      if (key == "v" || key == "vn") {
        Vec3d p;
        in >> p.x >> p.y >> p.z;
        (key == "v" ? v : vn).push_back(p);
      } else if (key == "f") {
        std::array<Vec3d, 3> p, n;
        for (int c = 0; c < 3; ++c) {
          std::size_t index, normal;
          char slash;
          in >> index >> slash >> slash >> normal;
          p[c] = v[index - 1];
          n[c] = vn[normal - 1];
        }
        ++faces;
        for (const Vec3d& normal : n)
          EXPECT_LT(length(normalized(cross(p[1] - p[0], p[2] - p[0])) - normal), 1e-9);
      }
    }
    EXPECT_EQ(faces, 12);
  }
}

}  // namespace
}  // namespace exemplar
