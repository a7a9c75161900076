// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/mesh_to_sdf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "mesh/mesh_file.h"
#include "mesh/primitives.h"
#include "sdf/triangle_tree.h"
#include "tests/sdf/cancellation.h"
#include "tests/sdf/meshes.h"
#include "tests/sdf/shapes.h"

namespace exemplar {
namespace {

using test::countInside;
using test::countParts;
using test::fineSphere;
using test::inputError;
using test::joined;
using test::moved;
using test::Rotation;
using test::Shape;
using test::steepest;
using test::withThreads;
using testing::HasSubstr;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(MeshToSdf, AgreesWithTheAnalyticDistanceInEveryBand) {
  struct Case {
    const char* name;
    TriangleMesh mesh;
    Shape shape;
  };
  const Box3d box{{-0.9, -0.5, -0.31}, {0.83, 0.52, 0.4}};
  const std::vector<Case> cases{
      {"sphere", fineSphere(), test::sphere({}, 1)},
      {"torus", makeTorus({}, {0, 0, 1}, 0.7, 0.25, 192, 96), test::torus({}, 0.7, 0.25)},
      {"box", makeBox(box), test::box(box)}};
  for (const Case& c : cases)
    for (const double halfWidth : {0.5, 1.0, 3.0, 8.0, kInfinity}) {
      const DistanceField field =
          meshToSdf(c.mesh, {.resolution = 30, .padding = 5, .halfWidth = halfWidth});
      // Half a voxel is promised; what is left is the tessellation.
      EXPECT_LT(test::worstError(field, c.shape), 0.02) << c.name << ", half width " << halfWidth;
    }
}

TEST(MeshToSdf, TheCheckerSeesHalfAVoxel) {
  const DistanceField field = meshToSdf(fineSphere(), {.resolution = 30, .padding = 5});
  EXPECT_GT(test::worstError(field, test::sphere({}, 1 + 0.5 * field.voxelSize)), 0.48);
}

TEST(MeshToSdf, IsExactOnBoxesAtAnyAngle) {
  const Box3d box{{-0.9, -0.5, -0.2}, {0.9, 0.5, 0.2}};
  for (int trial = 0; trial < 8; ++trial) {
    const Rotation turn(trial);
    const DistanceField field = meshToSdf(moved(makeBox(box), turn),
                                          {.resolution = 24, .padding = 3, .halfWidth = kInfinity});
    const Shape shape = [&](const Vec3d& p) { return test::box(box)(turn.inverse(p)); };
    // Planes are met exactly; floats of a few voxels have steps of 2e-7.
    EXPECT_LT(test::worstError(field, shape), 1e-5) << trial;
  }
}

TEST(MeshToSdf, IsTheDistanceOfTheNearestTriangle) {
  // Against brute force on a soup without any structure.
  const Random random(3);
  TriangleMesh soup;
  for (std::uint32_t t = 0; t < 60; ++t) {
    const Vec3d at{random.uniform(t, 0), random.uniform(t, 1), random.uniform(t, 2)};
    for (std::uint32_t c = 0; c < 3; ++c) {
      soup.positions.push_back(at + Vec3d{random.uniform(-0.2, 0.2, t, 3 + c),
                                          random.uniform(-0.2, 0.2, t, 6 + c),
                                          random.uniform(-0.2, 0.2, t, 9 + c)});
    }
    soup.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  // Ray parity leaves out no triangle, so that the size is that of the nearest one.
  const DistanceField field =
      meshToSdf(soup, {.resolution = 24, .halfWidth = kInfinity, .sign = SignSource::RayParity});
  for (std::size_t s = 0; s < field.values.count(); ++s) {
    const Vec3d p = field.position(cast<double>(field.values.ijk(s)));
    double nearest = kInfinity;
    for (const auto& [a, b, c] : soup.triangles)
      nearest = std::min(
          nearest, squaredDistance(p, {soup.positions[a], soup.positions[b], soup.positions[c]}));
    ASSERT_NEAR(std::abs(field.values.values()[s]), std::sqrt(nearest), 1e-6);
  }
}

TEST(MeshToSdf, PutsSamplesAtTheCentresOfTheBoxsVoxels) {
  const Box3d box{{1, 2, 3}, {2, 3.5, 3.3}};
  const DistanceField field = meshToSdf(makeBox(box), {.resolution = 15});
  EXPECT_DOUBLE_EQ(field.voxelSize, 0.1);
  EXPECT_EQ(field.size(), (Vec3i{10, 15, 3}));
  EXPECT_NEAR(length(field.origin - Vec3d{1.05, 2.05, 3.05}), 0, 1e-12);
  const DistanceField padded = meshToSdf(makeBox(box), {.voxelSize = 0.2, .padding = 2});
  EXPECT_EQ(padded.size(), (Vec3i{9, 12, 6}));  // sides of 5, 7.5 and 1.5 voxels, rounded up
  EXPECT_NEAR(length(padded.origin - Vec3d{0.7, 1.7, 2.7}), 0, 1e-12);
  EXPECT_FLOAT_EQ(padded.truncation, 0.6f);
}

TEST(MeshToSdf, GeometryOutsideTheBoxCounts) {
  const TriangleMesh torus = makeTorus({}, {0, 0, 1}, 0.7, 0.25);
  const DistanceField whole =
      meshToSdf(torus, {.voxelSize = 0.05, .box = Box3d{{-1, -1, -0.5}, {1, 1, 0.5}}});
  const Box3d window{{0.2, -0.3, -0.1}, {0.6, 0.4, 0.2}};
  const DistanceField part = meshToSdf(torus, {.voxelSize = 0.05, .box = window});
  ASSERT_EQ(part.size(), (Vec3i{8, 14, 6}));
  EXPECT_GT(countInside(part), 0);
  for (std::size_t s = 0; s < part.values.count(); ++s) {
    const Vec3i at = part.values.ijk(s) + Vec3i{24, 14, 8};
    ASSERT_NEAR(part.values.values()[s], whole.values[at], 1e-7);
  }
  // All the surface is outside this box: a corner cut out of the middle of a ball, and one beside
  // it.
  const DistanceField inner =
      meshToSdf(fineSphere(), {.resolution = 8, .box = Box3d{{-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}}});
  EXPECT_EQ(countInside(inner), 512);
  const DistanceField outer =
      meshToSdf(fineSphere(),
                {.resolution = 8, .box = Box3d{{9, 9, 9}, {10, 10, 10}}, .halfWidth = kInfinity});
  EXPECT_LT(test::worstError(outer, test::sphere({}, 1)), 0.02);
}

TEST(MeshToSdf, HasGradientOneInTheBand) {
  const DistanceField field =
      meshToSdf(makeTorus({}, {0.2, 0.3, 1}, 0.7, 0.3, 128, 64), {.resolution = 48, .padding = 4});
  const auto& v = field.values;
  int count = 0;
  for (int k = 1; k + 1 < v.size().z; ++k)
    for (int j = 1; j + 1 < v.size().y; ++j)
      for (int i = 1; i + 1 < v.size().x; ++i) {
        if (std::abs(v(i, j, k)) > field.truncation - 1.1 * field.voxelSize) continue;
        const Vec3d g{v(i + 1, j, k) - v(i - 1, j, k), v(i, j + 1, k) - v(i, j - 1, k),
                      v(i, j, k + 1) - v(i, j, k - 1)};
        // The band stays 4 voxels from the wire's center, where curvature is 1 / 4 a voxel: central
        // differences miss by (1 / 4)^2 / 6 = 0.01; facets of 0.4 voxels add as much.
        ASSERT_NEAR(length(g) / (2 * field.voxelSize), 1, 0.03);
        ++count;
      }
  EXPECT_GT(count, 5000);
}

TEST(MeshToSdf, IsClampedToTheTruncationAndReachesIt) {
  const DistanceField field =
      meshToSdf(fineSphere(), {.resolution = 32, .padding = 6, .halfWidth = 2.5});
  EXPECT_FLOAT_EQ(field.truncation, static_cast<float>(2.5 * field.voxelSize));
  int low = 0, high = 0;
  for (const float v : field.values.values()) {
    ASSERT_LE(std::abs(v), field.truncation);
    low += v == -field.truncation;
    high += v == field.truncation;
  }
  EXPECT_GT(low, 1000);
  EXPECT_GT(high, 1000);
}

TEST(MeshToSdf, OfAQuarterOfTheMeshIsAQuarterOfTheField) {
  const TriangleMesh mesh = makeTorus({1, 2, 3}, {1, 2, 3}, 0.7, 0.3);
  const DistanceField field = meshToSdf(mesh, {.resolution = 32});
  const DistanceField quarter =
      meshToSdf(moved(mesh, [](const Vec3d& p) { return p * 0.25; }), {.resolution = 32});
  ASSERT_EQ(field.size(), quarter.size());
  // Powers of two scale without rounding.
  for (std::size_t s = 0; s < field.values.count(); ++s)
    ASSERT_EQ(quarter.values.values()[s], field.values.values()[s] * 0.25f);
}

TEST(MeshToSdf, IsTheSameAtAnyScaleAndFarFromTheOrigin) {
  const TriangleMesh mesh = makeBox({{0, 0, 0}, {2, 3, 4}});
  const MeshToSdfOptions options{.resolution = 16, .padding = 2};
  const DistanceField field = meshToSdf(mesh, options);
  for (const double scale : {1e-20, 1e-7, 1e-4, 1e6})
    for (const double far : {0.0, 1e8}) {
      const DistanceField other = meshToSdf(moved(mesh,
                                                  [&](const Vec3d& p) {
                                                    return (p + Vec3d{far, -far, far}) * scale;
                                                  }),
                                            options);
      ASSERT_EQ(other.size(), field.size()) << scale << ", " << far;
      // Steps of doubles at 1e8 are 1.5e-8, 6e-8 voxels.
      for (std::size_t s = 0; s < field.values.count(); ++s)
        ASSERT_NEAR(other.values.values()[s] / scale, field.values.values()[s], 1e-6)
            << scale << ", " << far;
    }
}

TEST(MeshToSdf, FollowsARotationOfTheMesh) {
  const TriangleMesh mesh = joined(makeTorus({0.1, 0, 0}, {0, 0, 1}, 0.6, 0.2),
                                   makeBox({{-0.2, -0.3, -0.4}, {0.5, 0.3, 0.1}}));
  const TriangleTree tree([&] {
    std::vector<Corners> t;
    for (const auto& [a, b, c] : mesh.triangles)
      t.push_back({mesh.positions[a], mesh.positions[b], mesh.positions[c]});
    return t;
  }());
  const Box3d box{{-1, -1, -1}, {1, 1, 1}};
  for (int trial = 0; trial < 4; ++trial) {
    const Rotation turn(trial);
    const DistanceField field = meshToSdf(moved(mesh, turn), {.resolution = 32, .box = box});
    for (std::size_t s = 0; s < field.values.count(); ++s) {
      const Vec3d p = turn.inverse(field.position(cast<double>(field.values.ijk(s))));
      const double exact = tree.distance(p, field.truncation);
      const float v = field.values.values()[s];
      // Triangles buried in the other solid are not part of the surface, so the size may be larger.
      ASSERT_GE(std::abs(v), exact - 1e-6);
      const bool inside = std::abs(tree.windingNumber(p)) > 0.5;
      if (exact > 1e-6) {
        ASSERT_EQ(v < 0, inside);
      }
    }
  }
}

TEST(MeshToSdf, PadsAndCutsAxisByAxis) {
  // A wall of 4 by 0.5 by 2, cut across x only; its end is between samples.
  const TriangleMesh wall = makeBox({{0, 0, 0}, {4.03, 0.5, 2}});
  const DistanceField field = meshToSdf(wall, {.voxelSize = 0.1,
                                               .padding = Vec3i{0, 2, 3},
                                               .halfWidth = kInfinity,
                                               .cutByBox = {.x = true}});
  EXPECT_EQ(field.size(), (Vec3i{40, 9, 26}));
  EXPECT_NEAR(length(field.box().min - Vec3d{0, -0.2, -0.3}), 0, 1e-12);
  const Shape bar = test::box({{-100, 0, 0}, {100, 0.5, 2}});
  EXPECT_LT(test::worstError(field, bar), 1e-4);
}

TEST(MeshToSdf, MeasuresNoDistanceFromWhereTheBoxCutIt) {
  // Ground that fills the box's floor, its sides and bottom closed by the cut; one wall of it is
  // inside the box, and a surface.
  const TriangleMesh ground = makeBox({{0, 0.3, 0}, {1, 1, 0.45}});
  const Shape corner = [](const Vec3d& p) {
    const double up = p.z - 0.45, out = 0.3 - p.y;
    return up > 0 && out > 0 ? std::hypot(up, out) : std::max(up, out);
  };
  for (const SignSource sign : {SignSource::Automatic, SignSource::Flood, SignSource::RayParity}) {
    MeshToSdfOptions options{
        .resolution = 20, .box = Box3d{{0, 0, 0}, {1, 1, 1}}, .halfWidth = 30, .sign = sign};
    options.cutByBox = Axes::every();
    const DistanceField window = meshToSdf(ground, options);
    options.cutByBox = {};
    const DistanceField object = meshToSdf(ground, options);
    double different = 0;
    for (std::size_t s = 0; s < window.values.count(); ++s) {
      const Vec3d p = window.position(cast<double>(window.values.ijk(s)));
      ASSERT_NEAR(window.values.values()[s], corner(p), 1e-6);
      different = std::max(different, std::abs(object.values.values()[s] - corner(p)));
    }
    EXPECT_GT(different, 0.3);  // deep in the ground, the cut is near
  }
  EXPECT_THAT(inputError([&] { meshToSdf(ground, {.padding = 1, .cutByBox = Axes::every()}); }),
              HasSubstr("`padding` must be 0"));
}

TEST(MeshToSdf, IsTheSameAtAnyNumberOfThreads) {
  TriangleMesh overlapping =
      joined(makeSphere({-0.3, 0, 0}, 0.6, 12), makeTorus({0.2, 0, 0}, {0, 1, 1}, 0.6, 0.2));
  TriangleMesh open = overlapping;
  open.triangles.resize(open.triangles.size() - 300);
  for (const TriangleMesh* mesh : {&overlapping, &open})
    for (const SignSource sign :
         {SignSource::Automatic, SignSource::Flood, SignSource::RayParity}) {
      const auto run = [&] {
        return meshToSdf(*mesh, {.resolution = 32, .padding = 2, .sign = sign}).values;
      };
      EXPECT_EQ(withThreads(1, run), withThreads(8, run));
    }
}

TEST(MeshToSdf, ReportsItsProgressAndStopsWhereItIsCancelled) {
  // Spheres that cross each other; the same without some of their triangles; and each with
  // every source of signs.
  TriangleMesh crossing;
  for (int s = 0; s < 5; ++s) append(crossing, makeSphere({0.4 * s, 0.2 * s, 0}, 0.5, 12));
  TriangleMesh open = crossing;
  open.triangles.resize(open.triangles.size() - 40);
  for (const TriangleMesh* mesh : {&crossing, &open})
    for (const SignSource sign :
         {SignSource::WindingNumber, SignSource::Flood, SignSource::RayParity}) {
      SCOPED_TRACE(static_cast<int>(sign));
      expectReportsAndStops(
          [&](const Progress& progress) {
            meshToSdf(*mesh, {.resolution = 32, .padding = 2, .sign = sign}, progress);
          },
          20);
    }
}

TEST(MeshToSdf, RefusesOptionsOutOfRangeInOneLine) {
  const TriangleMesh mesh = makeBox({{0, 0, 0}, {1, 1, 1}});
  const auto error = [&](const MeshToSdfOptions& options) {
    return inputError([&] { meshToSdf(mesh, options); });
  };
  EXPECT_THAT(error({.resolution = 100000}),
              HasSubstr("`resolution` is 100000; it must be 1..4096"));
  EXPECT_THAT(error({.resolution = 0}), HasSubstr("`resolution` is 0"));
  EXPECT_THAT(error({.voxelSize = -1}), HasSubstr("`voxelSize` is -1"));
  EXPECT_THAT(error({.voxelSize = std::nan("")}), HasSubstr("`voxelSize` is"));
  EXPECT_THAT(error({.voxelSize = kInfinity}), HasSubstr("`voxelSize` is"));
  EXPECT_THAT(error({.padding = -1}), HasSubstr("`padding` is -1"));
  EXPECT_THAT(error({.halfWidth = 0}), HasSubstr("`halfWidth` is 0"));
  EXPECT_THAT(error({.halfWidth = std::nan("")}), HasSubstr("`halfWidth` is nan"));
  EXPECT_THAT(error({.box = Box3d{}}), HasSubstr("box"));
  EXPECT_THAT(error({.box = Box3d{{0, 0, 0}, {kInfinity, 1, 1}}}), HasSubstr("box"));
  EXPECT_THAT(error({.box = Box3d{{1, 1, 1}, {1, 1, 1}}}), HasSubstr("box"));
  for (const MeshToSdfOptions& options :
       {MeshToSdfOptions{.voxelSize = 1e-5}, MeshToSdfOptions{.voxelSize = 1e-300},
        MeshToSdfOptions{.resolution = 4096}, MeshToSdfOptions{.padding = 2000000000}}) {
    EXPECT_THAT(error(options), HasSubstr("lower `resolution`"));
    EXPECT_THAT(error(options), testing::Not(HasSubstr("\n")));
  }
}

TEST(MeshToSdf, RefusesMeshesThatAreNone) {
  EXPECT_THAT(inputError([] { meshToSdf(TriangleMesh{}); }), testing::Not(""));
  TriangleMesh mesh = makeBox({{0, 0, 0}, {1, 1, 1}});
  mesh.positions[3].y = std::nan("");
  EXPECT_THAT(inputError([&] { meshToSdf(mesh); }), testing::Not(""));
}

TEST(MeshToSdf, LeavesRealModelsWhole) {
  const std::filesystem::path data = std::filesystem::path(EXEMPLAR_SOURCE_DIR) / "../shared/data";
  struct Case {
    const char* file;
    int resolution;
  };
  for (const Case& c : {Case{"meshes/towerruins.obj", 64}, Case{"kaykit/column.obj", 64},
                        Case{"kaykit/wall_broken.obj", 64}, Case{"kaykit/stairs_walled.obj", 64}}) {
    if (!std::filesystem::exists(data / c.file))
      GTEST_SKIP() << "no " << (data / c.file) << " beside the checkout";
    const DistanceField field =
        meshToSdf(readMesh(data / c.file), {.resolution = c.resolution, .padding = 2});
    EXPECT_EQ(countParts(field).first, 1) << c.file;
    EXPECT_LT(steepest(field), 1.9) << c.file;
  }
}

}  // namespace
}  // namespace exemplar
