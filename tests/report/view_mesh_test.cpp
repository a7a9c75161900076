// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "report/view_mesh.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <set>

#include "core/error.h"
#include "core/random.h"
#include "mesh/primitives.h"
#include "tests/progress_checks.h"
#include "tests/threads.h"

namespace exemplar {
namespace {

/// What a browser does with a packed view, as view_mesh.h says it (web/surface.js is the other
/// reader).
class Unpacked {
 public:
  Unpacked(const std::string& packed, std::size_t vertices, std::size_t triangles)
      : bytes_(40 * vertices + 20 * triangles + 100000, '\0') {
    uLongf size = bytes_.size();
    EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(bytes_.data()), &size,
                         reinterpret_cast<const Bytef*>(packed.data()), packed.size()),
              Z_OK);
    bytes_.resize(size);
    view.vertices.resize(vertices);
    for (std::size_t a = 0; a < 3; ++a)
      words(vertices, [&](std::size_t v, unsigned x) {
        view.vertices[v].position[a] = static_cast<std::uint16_t>(x);
      });
    const auto plane = [&](const auto& member) {
      bytes(vertices, [&](std::size_t v, std::uint8_t x) { member(view.vertices[v]) = x; });
    };
    for (std::size_t a = 0; a < 2; ++a)
      bytes(vertices, [&](std::size_t v, std::uint8_t x) {
        view.vertices[v].normal[a] = static_cast<std::int8_t>(x);
      });
    for (std::size_t a = 0; a < 3; ++a)
      plane([a](ViewVertex& v) -> std::uint8_t& { return v.color[a]; });
    plane([](ViewVertex& v) -> std::uint8_t& { return v.metallic; });
    plane([](ViewVertex& v) -> std::uint8_t& { return v.roughness; });
    plane([](ViewVertex& v) -> std::uint8_t& { return v.glow; });
    plane([](ViewVertex& v) -> std::uint8_t& { return v.light.sky; });
    plane([](ViewVertex& v) -> std::uint8_t& { return v.light.key; });
    for (std::size_t a = 0; a < 3; ++a)
      plane([a](ViewVertex& v) -> std::uint8_t& { return v.source[a]; });
    plane([](ViewVertex& v) -> std::uint8_t& { return v.jump; });
    std::uint32_t next = 0;
    for (std::size_t t = 0; t < triangles; ++t) {
      std::array<std::uint32_t, 3>& triangle = view.triangles.emplace_back();
      for (std::uint32_t& corner : triangle) {
        std::uint32_t below = 0;
        for (int shift = 0;; shift += 7) {
          const unsigned byte = static_cast<std::uint8_t>(bytes_.at(at_++));
          below |= (byte & 127) << shift;
          if (byte < 128) break;
        }
        corner = next - below;
        next = std::max(next, corner + 1);
      }
    }
    view.floor.light.resize(ViewFloor::kSide * ViewFloor::kSide);
    bytes(view.floor.light.size(), [&](std::size_t v, std::uint8_t x) { view.floor.light[v] = x; });
    EXPECT_EQ(at_, bytes_.size());
  }

  ViewMesh view;

 private:
  template <class Put>
  void bytes(std::size_t count, const Put& put) {
    std::uint8_t value = 0;
    for (std::size_t v = 0; v < count; ++v)
      put(v,
          value = static_cast<std::uint8_t>(value + static_cast<std::uint8_t>(bytes_.at(at_++))));
  }
  template <class Put>
  void words(std::size_t count, const Put& put) {
    unsigned value = 0;
    for (std::size_t v = 0; v < count; ++v) {
      const unsigned low = static_cast<std::uint8_t>(bytes_.at(at_ + v));
      const unsigned high = static_cast<std::uint8_t>(bytes_.at(at_ + count + v));
      const unsigned zigzag = low | high << 8;
      value = (value + ((zigzag >> 1) ^ (zigzag & 1 ? 0xFFFFu : 0u))) & 0xFFFFu;
      put(v, value);
    }
    at_ += 2 * count;
  }

  std::string bytes_;
  std::size_t at_ = 0;
};

/// The world position of a corner.
Vec3d positionOf(const ViewMesh& view, const ViewVertex& vertex) {
  const Vec3d share{vertex.position[0] / 65535.0, vertex.position[1] / 65535.0,
                    vertex.position[2] / 65535.0};
  return view.box.min + scaled(view.box.size(), share);
}

TriangleMesh twoMaterials() {
  TriangleMesh mesh = makeSphere({0, 0, 0}, 2, 24);
  mesh.materials = {{"red", {0.8f, 0, 0, 1}}, {"blue", {0, 0, 0.8f, 1}, 1.0f, 0.25f}};
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    double z = 0;
    for (const std::uint32_t v : mesh.triangles[t]) z += mesh.positions[v].z;
    mesh.triangleMaterials.push_back(z > 0 ? 0 : 1);
  }
  return mesh;
}

TEST(Octahedral, ComesBackAsTheSameDirection) {
  const Random random(2);
  for (int n = 0; n < 500; ++n) {
    const Vec3d d =
        normalized(Vec3d{random.normal(n, 0), random.normal(n, 2), random.normal(n, 4)});
    const auto [x, y] = octahedral(d);
    Vec3d back{x, y, 1 - std::abs(x) - std::abs(y)};
    if (back.z < 0)
      back = {(1 - std::abs(y)) * (x < 0 ? -1 : 1), (1 - std::abs(x)) * (y < 0 ? -1 : 1), back.z};
    EXPECT_LT(length(normalized(back) - d), 1e-9);
  }
}

TEST(ViewMesh, OfFewTrianglesIsTheSurfaceItself) {
  const TriangleMesh ball = makeSphere({1, 2, 3}, 2, 40);
  // Its edges are too short to be cut.
  const ViewMesh view = makeViewMesh({ball});
  EXPECT_EQ(view.triangles.size(), ball.triangles.size());
  EXPECT_EQ(view.ofTriangles, static_cast<std::int64_t>(ball.triangles.size()));
  EXPECT_EQ(view.vertices.size(), ball.positions.size());  // smooth: one corner a vertex
  for (const ViewVertex& v : view.vertices)
    // Positions are exact to half a step of 65,535 along each side.
    EXPECT_NEAR(length(positionOf(view, v) - Vec3d{1, 2, 3}), 2, 4.0 / 65535);
}

TEST(ViewMesh, OfManyIsSimplifiedAndStaysTheShape) {
  const TriangleMesh ball = makeSphere({0, 0, 0}, 2, 60);  // 72,000
  const ViewMesh view = makeViewMesh({ball}, {.triangles = 5000});
  EXPECT_LE(view.triangles.size(), 6250u);
  EXPECT_GT(view.triangles.size(), 3000u);
  EXPECT_EQ(view.ofTriangles, 72000);
  for (const ViewVertex& v : view.vertices) EXPECT_NEAR(length(positionOf(view, v)), 2, 0.02);
}

TEST(ViewMesh, LightIsKeptInsideOfLargeTriangles) {
  // A tall box whose corners are in the ground and in a roof: its sides are lit all the same.
  TriangleMesh tower = makeBox({{-1, -1, -0.5}, {1, 1, 6}});
  append(tower, makeBox({{-9, -9, -1}, {9, 9, 0}}));
  append(tower, makeBox({{-1.2, -1.2, 5.5}, {1.2, 1.2, 7}}));
  const ViewMesh view = makeViewMesh({tower});
  double sky = 0, count = 0;
  for (const ViewVertex& v : view.vertices) {
    const Vec3d p = positionOf(view, v);
    if (std::abs(std::max(std::abs(p.x), std::abs(p.y)) - 1) > 0.01 || p.z < 2 || p.z > 4) continue;
    sky += v.light.sky;
    ++count;
  }
  ASSERT_GT(count, 100);
  // Half of what a wall sees is sky, half the floor, which counts half.
  EXPECT_GT(sky / count, 120);
}

TEST(ViewMesh, BordersOfMaterialsStaySharp) {
  for (const std::int64_t triangles : {100000, 3000}) {
    SCOPED_TRACE(triangles);
    const ViewMesh view = makeViewMesh({twoMaterials()}, {.triangles = triangles});
    std::set<std::array<std::uint8_t, 3>> colors;
    for (const auto& t : view.triangles) {
      // Each triangle has one material, and so one color, and it is the one of its side.
      EXPECT_EQ(view.vertices[t[0]].color, view.vertices[t[1]].color);
      EXPECT_EQ(view.vertices[t[0]].color, view.vertices[t[2]].color);
      double z = 0;
      for (const std::uint32_t v : t) z += positionOf(view, view.vertices[v]).z / 3;
      const ViewVertex& corner = view.vertices[t[0]];
      colors.insert(corner.color);
      if (std::abs(z) < 0.2) continue;
      EXPECT_EQ(corner.color[0] > 0, z > 0);
      EXPECT_EQ(corner.metallic, z > 0 ? 0 : 255);
      EXPECT_EQ(corner.roughness, z > 0 ? 204 : 64);  // 0.8 and 0.25 of 255
    }
    EXPECT_EQ(colors.size(), 2u);
  }
}

TEST(ViewMesh, TakesASoup) {
  TriangleMesh soup;
  const TriangleMesh ball = twoMaterials();
  for (const auto& t : ball.triangles) {
    const auto n = static_cast<std::uint32_t>(soup.positions.size());
    for (const std::uint32_t v : t) soup.positions.push_back(ball.positions[v]);
    soup.triangles.push_back({n, n + 1, n + 2});
  }
  soup.materials = ball.materials;
  soup.triangleMaterials = ball.triangleMaterials;
  const ViewMesh view = makeViewMesh({soup}, {.triangles = 4000});
  EXPECT_LE(view.triangles.size(), 5000u);
  EXPECT_GT(view.triangles.size(), 500u);
}

/// A field of 16³ samples whose surface is a ball, made of two halves of an example of 20³.
struct Halves {
  Halves() {
    example.values = Array3D<float>({20, 20, 20}, 1);
    example.voxelSize = 0.5;
    example.origin = {10, 10, 10};
    example.truncation = 8;
    field = example;
    field.values = Array3D<float>({16, 16, 16}, 1);
    field.origin = {0, 0, 0};
    origins = Origins({16, 16, 16});
    for (std::size_t n = 0; n < origins.count(); ++n) {
      const Vec3i p = origins.ijk(n);
      origins.values()[n] = Origin(p.x < 8 ? p : p + Vec3i{4, 2, 1});
    }
    jumps = Array3D<float>({16, 16, 16});
    for (std::size_t n = 0; n < jumps.count(); ++n) {
      const int x = jumps.ijk(n).x;
      jumps.values()[n] = x == 7 || x == 8 ? 1.5f : 0;
    }
    mesh = makeSphere(field.position({7.5, 7.5, 7.5}), 2.5, 20);
  }
  DistanceField example, field;
  Origins origins;
  Array3D<float> jumps;
  TriangleMesh mesh;
};

TEST(ViewMesh, TellsWhereEachPointCameFrom) {
  const Halves h;
  ViewSource source{h.mesh, &h.field, &h.origins, &h.example, &h.jumps};
  const ViewMesh view = makeViewMesh(source);
  const Box3d box = h.example.box();
  for (const auto& t : view.triangles) {
    Vec3d middle{};
    for (const std::uint32_t v : t) middle += positionOf(view, view.vertices[v]) * (1.0 / 3);
    const double x = h.field.index(middle).x;
    if (std::abs(x - 7.5) < 0.01) continue;
    for (const std::uint32_t v : t) {
      const ViewVertex& vertex = view.vertices[v];
      Vec3d from = h.field.index(positionOf(view, vertex));
      if (x > 7.5) from += Vec3d{4, 2, 1};
      const Vec3d at = h.example.position(from);
      for (int axis = 0; axis < 3; ++axis) {
        // A byte has 254 steps along a side; half a step, and what positions are off.
        const double share = (at[axis] - box.min[axis]) / box.size()[axis];
        EXPECT_NEAR((vertex.source[axis] - 1) / 254.0, share, 0.51 / 254 + 1e-4);
      }
      const double cell = std::floor(h.field.index(positionOf(view, vertex)).x);
      EXPECT_EQ(vertex.jump, cell >= 6 && cell <= 8 ? 48 : 0) << cell;  // 1.5 * 32
    }
  }
}

TEST(ViewMesh, AnExampleCameFromWhereItIs) {
  const Halves h;
  ViewSource source{h.mesh};
  source.example = &h.field;
  const ViewMesh view = makeViewMesh(source);
  for (const ViewVertex& vertex : view.vertices)
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR((vertex.source[axis] - 1) / 254.0,
                  (positionOf(view, vertex)[axis] - h.field.box().min[axis]) / 8,
                  0.51 / 254 + 1e-4);
  EXPECT_EQ(makeViewMesh({h.mesh}).vertices[0].source, (std::array<std::uint8_t, 3>{}));
}

TEST(ViewMesh, SourcesInOtherExamplesAreUnknown) {
  Halves h;
  for (Origin& o : h.origins.values()) o.example = 1;
  const ViewMesh view = makeViewMesh({h.mesh, &h.field, &h.origins, &h.example});
  for (const ViewVertex& v : view.vertices) EXPECT_EQ(v.source, (std::array<std::uint8_t, 3>{}));
}

TEST(ViewMesh, IsUnpackedAsItWasPacked) {
  const Halves h;
  const ViewMesh view = makeViewMesh({h.mesh, &h.field, &h.origins, &h.example, &h.jumps});
  const Unpacked back(packViewMesh(view), view.vertices.size(), view.triangles.size());
  EXPECT_EQ(back.view.vertices, view.vertices);
  EXPECT_EQ(back.view.triangles, view.triangles);
  EXPECT_EQ(back.view.floor.light, view.floor.light);
}

TEST(ViewMesh, PacksHostileNumbersToo) {
  ViewMesh view;
  view.floor.light.assign(ViewFloor::kSide * ViewFloor::kSide, 7);
  const Random random(5);
  for (std::uint32_t n = 0; n < 40000; ++n) {
    ViewVertex v;
    for (std::uint32_t a = 0; a < 3; ++a)
      v.position[a] = n % 2 ? static_cast<std::uint16_t>(random.bits(n, a)) : (n % 4 ? 65535 : 0);
    v.normal = {static_cast<std::int8_t>(n % 2 ? -127 : 127), static_cast<std::int8_t>(n)};
    v.jump = static_cast<std::uint8_t>(random.bits(n, 9));
    view.vertices.push_back(v);
  }
  view.triangles = {{0, 1, 39999}, {39999, 0, 20000}, {128, 127, 16384}, {39871, 39872, 2}};
  const Unpacked back(packViewMesh(view), view.vertices.size(), view.triangles.size());
  EXPECT_EQ(back.view.vertices, view.vertices);
  EXPECT_EQ(back.view.triangles, view.triangles);
}

TEST(ViewMesh, IsTheSameAtOneAndEightThreads) {
  const TriangleMesh mesh = twoMaterials();
  testing::expectSameAtAnyThreads(
      [&] { return packViewMesh(makeViewMesh({mesh}, {.triangles = 4000})); });
}

TEST(ViewMesh, ReportsAndStops) {
  const TriangleMesh mesh = twoMaterials();
  testing::expectReportsAndStops(10, [&](const Progress& progress) {
    return makeViewMesh({mesh}, {.triangles = 4000}, progress);
  });
}

TEST(ViewMesh, RefusesWhatDoesNotFit) {
  const Halves h;
  EXPECT_THROW(makeViewMesh({h.mesh}, {.triangles = 10}), InputError);
  EXPECT_THROW(makeViewMesh({TriangleMesh{}}), InputError);
  EXPECT_THROW(makeViewMesh({h.mesh, nullptr, &h.origins}), InputError);
  EXPECT_THROW(makeViewMesh({h.mesh, &h.example, &h.origins, &h.example}), InputError);
  EXPECT_THROW(makeViewMesh({h.mesh, &h.example, nullptr, &h.example, &h.jumps}), InputError);
}

}  // namespace
}  // namespace exemplar
