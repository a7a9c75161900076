// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/field_to_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "core/error.h"
#include "core/random.h"
#include "tests/reconstruct/fields.h"
#include "tests/sdf/cancellation.h"

namespace exemplar {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double kPi = std::numbers::pi;

/// Fields that no surface was ever measured for: everything a synthesis could hand over.
std::vector<std::pair<std::string, DistanceField>> adversarialFields() {
  std::vector<std::pair<std::string, DistanceField>> fields;
  const auto add = [&](const std::string& name, const Vec3i& size, const auto& value) {
    DistanceField field;
    field.values = Array3D<float>(size);
    field.truncation = 3;
    for (std::size_t n = 0; n < field.values.count(); ++n) {
      field.values.values()[n] = static_cast<float>(value(field.values.ijk(n), n));
    }
    fields.emplace_back(name, std::move(field));
  };
  for (const int n : {2, 3, 5, 8, 9, 17, 25}) {
    const Random random(n);
    add("noise " + std::to_string(n), {n, n, n},
        [&](const Vec3i&, std::size_t c) { return random.normal(c); });
  }
  const Random random(99);
  add("noise in a slab", {40, 1, 13},
      [&](const Vec3i&, std::size_t c) { return random.normal(c); });
  add("two values", {13, 20, 9},
      [&](const Vec3i&, std::size_t c) { return random.uniform(c) < 0.5 ? -1.0 : 1.0; });
  add("zeros among them", {13, 20, 9},
      [&](const Vec3i&, std::size_t c) { return random.below(3, c) - 1.0; });
  add("values of all sizes", {12, 12, 12}, [&](const Vec3i&, std::size_t c) {
    return (random.uniform(c) < 0.5 ? -1 : 1) * std::pow(10.0, random.uniform(-30, 30, c, 1));
  });
  add("checkerboard", {10, 10, 10},
      [](const Vec3i& p, std::size_t) { return (p.x + p.y + p.z) % 2 ? -1.0 : 1.0; });
  add("checkerboard of blocks", {35, 35, 35}, [](const Vec3i& p, std::size_t) {
    return ((p.x + 3) / 8 + (p.y + 3) / 8 + (p.z + 3) / 8) % 2 ? -3.0 : 3.0;
  });
  add("voxels that touch along an edge", {6, 6, 6}, [](const Vec3i& p, std::size_t) {
    return p == Vec3i{2, 2, 2} || p == Vec3i{3, 3, 2} ? -1.0 : 1.0;
  });
  add("voxels that touch in a corner", {6, 6, 6}, [](const Vec3i& p, std::size_t) {
    return p == Vec3i{2, 2, 2} || p == Vec3i{3, 3, 3} ? -1.0 : 1.0;
  });
  add("hollows that touch along an edge", {6, 6, 6}, [](const Vec3i& p, std::size_t) {
    return p == Vec3i{2, 2, 2} || p == Vec3i{3, 3, 2} ? 1.0 : -1.0;
  });
  add("one solid sample", {1, 1, 1}, [](const Vec3i&, std::size_t) { return -1.0; });
  return fields;
}

TEST(FieldToMesh, IsSoundWhateverTheFieldHolds) {
  for (const auto& [name, field] : adversarialFields()) {
    for (const bool redistance : {false, true}) {
      for (const bool project : {false, true}) {
        SCOPED_TRACE(name);
        const TriangleMesh mesh =
            fieldToMesh(field, {.redistance = redistance, .project = project, .smallestPiece = 0});
        expectSound(mesh);
        EXPECT_GT(meshHealth(mesh).signedVolume, 0);
      }
    }
  }
}

TEST(FieldToMesh, IsSoundButForItsRimWhereItEndsOpen) {
  for (const auto& [name, field] : adversarialFields()) {
    SCOPED_TRACE(name);
    if (name == "one solid sample") continue;  // has no surface of its own
    const TriangleMesh mesh = fieldToMesh(field, {.close = false, .smallestPiece = 0});
    expectSound(mesh, false);
    // Edges with one triangle lie in the faces of the box.
    const Box3d box = field.box();
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
    for (const auto& t : mesh.triangles) {
      for (int c = 0; c < 3; ++c) ++uses[std::minmax(t[c], t[(c + 1) % 3])];
    }
    for (const auto& [edge, count] : uses) {
      if (count != 1) continue;
      const Vec3d &p = mesh.positions[edge.first], &q = mesh.positions[edge.second];
      bool inFace = false;
      for (int a = 0; a < 3; ++a) {
        for (const double plane : {box.min[a], box.max[a]}) {
          inFace = inFace || (std::abs(p[a] - plane) < 1e-9 && std::abs(q[a] - plane) < 1e-9);
        }
      }
      ASSERT_TRUE(inFace);
    }
  }
}

// A mesh inscribed with edges of about h errs by about h²/8r on average: of the volume, 3/8 (h/r)².
TEST(FieldToMesh, SphereHasItsVolumeAndItsPlace) {
  for (const double radius : {4.0, 8.0, 14.0}) {
    const Vec3d center{0.3, -0.2, 0.45};
    const auto value = [&](const Vec3d& p) { return sphereDistance(p, center, radius * 0.1); };
    const DistanceField field = makeField({40, 40, 40}, 0.1, {-1.95, -1.95, -1.95}, value);
    const TriangleMesh mesh = fieldToMesh(field);
    expectSound(mesh);
    EXPECT_EQ(eulerCharacteristic(mesh), 2);
    const double volume = 4 * kPi / 3 * std::pow(0.1 * radius, 3);
    EXPECT_NEAR(meshHealth(mesh).signedVolume, volume,
                volume * (0.005 + 3.0 / 8 / (radius * radius)));
    // Far below the half voxel that is asked for.
    for (const Vec3d& p : mesh.positions) ASSERT_LT(std::abs(value(p)), 0.05 * 0.1);
  }
}

TEST(FieldToMesh, TorusHasItsVolumeAndOneHole) {
  const auto value = [](const Vec3d& p) { return torusDistance(p, 1.1, 0.4); };
  const DistanceField field = makeField({66, 66, 24}, 0.05, {-1.62, -1.63, -0.58}, value);
  const TriangleMesh mesh = fieldToMesh(field);
  expectSound(mesh);
  EXPECT_EQ(eulerCharacteristic(mesh), 0);
  EXPECT_EQ(meshHealth(mesh).components, 1);
  const double volume = 2 * kPi * kPi * 1.1 * 0.4 * 0.4;
  EXPECT_NEAR(meshHealth(mesh).signedVolume, volume, 0.01 * volume);
  for (const Vec3d& p : mesh.positions) ASSERT_LT(std::abs(value(p)), 0.05 * 0.05);
}

TEST(FieldToMesh, ErrorFallsWithTheSquareOfTheVoxel) {
  const auto worst = [](int n) {
    const double voxel = 2.6 / n;
    const auto value = [](const Vec3d& p) { return sphereDistance(p, {0.01, 0.02, 0.03}, 1); };
    const DistanceField field =
        makeField({n, n, n}, voxel, Vec3d{-1.3, -1.3, -1.3} + Vec3d{1, 1, 1} * (voxel / 2), value);
    double error = 0;
    for (const Vec3d& p : fieldToMesh(field).positions) {
      error = std::max(error, std::abs(value(p)));
    }
    return error;
  };
  // Second order at least: a quarter at half the voxel, with room for luck.
  EXPECT_LT(worst(40), worst(20) / 3);
}

TEST(FieldToMesh, ProjectionKeepsThinThingsFromShrinking) {
  const auto value = [](const Vec3d& p) { return sphereDistance(p, {0.1, 0.2, 0.3}, 3); };
  const DistanceField field = makeField({14, 14, 14}, 1, {-6.5, -6.5, -6.5}, value);
  const double volume = 4 * kPi / 3 * 27;
  const auto loss = [&](bool project) {
    return volume - meshHealth(fieldToMesh(field, {.project = project})).signedVolume;
  };
  EXPECT_LT(loss(true), 0.5 * loss(false));
}

TEST(FieldToMesh, BoxStaysWithinAFractionOfAVoxel) {
  const Vec3d half{0.83, 0.61, 0.47};
  const auto value = [&](const Vec3d& p) { return boxDistance(p, half); };
  const DistanceField field = makeField({42, 32, 26}, 0.05, {-1.02, -0.77, -0.63}, value);
  const TriangleMesh mesh = fieldToMesh(field);
  expectSound(mesh);
  EXPECT_EQ(eulerCharacteristic(mesh), 2);
  const double volume = 8 * half.x * half.y * half.z;
  EXPECT_NEAR(meshHealth(mesh).signedVolume, volume, 0.01 * volume);
  // Edges and corners too: the projection takes their vertices out of the bevel.
  for (const Vec3d& p : mesh.positions) ASSERT_LT(std::abs(value(p)), 0.2 * 0.05);
}

TEST(FieldToMesh, WorldPlacementIsTheFields) {
  const auto value = [](const Vec3d& p) { return sphereDistance(p, {100, -200, 50}, 7); };
  const DistanceField field = makeField({24, 24, 24}, 0.8, {91, -209, 41}, value);
  Box3d box = boundingBox(fieldToMesh(field));
  EXPECT_NEAR(box.center().x, 100, 0.05);
  EXPECT_NEAR(box.center().y, -200, 0.05);
  EXPECT_NEAR(box.center().z, 50, 0.05);
  EXPECT_NEAR(box.size().x, 14, 0.1);
}

// A rod along x, cut by the box on both ends: flat caps in the box's faces with sharp, round rims.
TEST(FieldToMesh, ClosesACutRodWithFlatCapsAndSharpRims) {
  const auto value = [](const Vec3d& p) { return std::hypot(p.y - 0.2, p.z + 0.1) - 4; };
  const DistanceField field = makeField({16, 16, 16}, 1, {-7.5, -7.5, -7.5}, value);
  const TriangleMesh mesh = fieldToMesh(field);
  expectSound(mesh);
  EXPECT_EQ(eulerCharacteristic(mesh), 2);
  const Box3d box = field.box();
  EXPECT_NEAR(meshHealth(mesh).signedVolume, kPi * 16 * 16, 0.02 * kPi * 16 * 16);
  int rim = 0;
  for (const Vec3d& p : mesh.positions) {
    EXPECT_GE(p.x, box.min.x - 1e-12);
    EXPECT_LE(p.x, box.max.x + 1e-12);
    // Nothing between the faces and the first samples: caps are not bevelled.
    EXPECT_TRUE(p.x <= box.min.x + 1e-12 || p.x >= box.min.x + 0.4);
    if (p.x <= box.min.x + 1e-12) {
      EXPECT_LT(value(p), 0.05);
      rim += std::abs(value(p)) < 0.05;
    }
  }
  EXPECT_GT(rim, 20);
}

TEST(FieldToMesh, SolidFieldBecomesItsBox) {
  const DistanceField field =
      makeField({5, 4, 3}, 0.5, {1, 2, 3}, [](const Vec3d&) { return -1.0; });
  const TriangleMesh mesh = fieldToMesh(field);
  expectSound(mesh);
  const Box3d box = boundingBox(mesh), expected = field.box();
  for (int a = 0; a < 3; ++a) {
    EXPECT_NEAR(box.min[a], expected.min[a], 1e-12);
    EXPECT_NEAR(box.max[a], expected.max[a], 1e-12);
  }
  EXPECT_NEAR(meshHealth(mesh).signedVolume, 2.5 * 2 * 1.5, 1e-9);
}

TEST(FieldToMesh, SpecksAndTinyHollowsGoUnlessTheyTouchTheBox) {
  DistanceField field = makeField({24, 24, 24}, 1, {0, 0, 0}, [](const Vec3d& p) {
    return sphereDistance(p, {12, 12, 12}, 6);
  });
  field.values(2, 2, 2) = -0.5f;    // a speck
  field.values(12, 12, 12) = 0.5f;  // a hollow
  field.values(0, 20, 20) = -0.5f;  // cut by the box: may be the end of something
  FieldToMeshReport report;
  const TriangleMesh mesh = fieldToMesh(field, {.redistance = false}, {}, &report);
  EXPECT_EQ(report.droppedPieces, 2);
  EXPECT_EQ(report.health.components, 2);
  EXPECT_EQ(meshHealth(fieldToMesh(field, {.redistance = false, .smallestPiece = 0})).components,
            4);
}

// Two halves of a ball, one taken from 0.8 voxels aside: the true surface steps there, and nowhere
// does the mesh stray from both.
TEST(FieldToMesh, RepairsTheFieldAroundJumps) {
  const auto left = [](const Vec3d& p) { return sphereDistance(p, {0, 0, 0}, 9); };
  const auto right = [](const Vec3d& p) { return sphereDistance(p, {0, 1.5, 0}, 9); };
  const DistanceField field =
      makeField({26, 26, 26}, 1, {-12.5, -12.5, -12.5},
                [&](const Vec3d& p) { return p.x < 0 ? left(p) : right(p); });
  FieldToMeshReport report;
  const TriangleMesh mesh = fieldToMesh(field, {}, {}, &report);
  expectSound(mesh);
  EXPECT_EQ(report.health.components, 1);
  for (const Vec3d& p : mesh.positions) {
    if (std::abs(p.x) < 2) continue;
    ASSERT_LT(std::abs(p.x < 0 ? left(p) : right(p)), 0.1);
  }
}

TEST(FieldToMesh, AScalarThatIsNoDistanceGivesTheSameSurface) {
  const auto value = [](const Vec3d& p) { return sphereDistance(p, {0.2, 0.1, 0}, 8); };
  const DistanceField field = makeField({24, 24, 24}, 1, {-11.5, -11.5, -11.5}, value);
  DistanceField scaled = field;
  for (float& v : scaled.values.values()) v *= 1e-3f;
  const double volume = meshHealth(fieldToMesh(field)).signedVolume;
  EXPECT_NEAR(meshHealth(fieldToMesh(scaled)).signedVolume, volume, 0.005 * volume);
}

TEST(FieldToMesh, IsTheSameAtAnyNumberOfThreads) {
  const Random random(4);
  const DistanceField field = makeField({40, 33, 27}, 0.3, {0, 0, 0}, [&](const Vec3d& p) {
    return std::sin(p.x) + std::cos(p.y * 1.3) + std::sin(p.z * 0.7 + p.x) +
           0.3 * random.normal(static_cast<std::uint64_t>(p.x * 1e4 + p.y * 1e7 + p.z * 1e10));
  });
  TriangleMesh one, eight;
  tbb::task_arena(1).execute([&] { one = fieldToMesh(field); });
  tbb::task_arena(8).execute([&] { eight = fieldToMesh(field); });
  EXPECT_EQ(one.positions, eight.positions);
  EXPECT_EQ(one.triangles, eight.triangles);
}

TEST(FieldToMesh, ReportsItsProgressAndStopsWhereItIsCancelled) {
  // With jumps, so that distances are corrected.
  const DistanceField field = makeField({48, 48, 48}, 1, {0, 0, 0}, [](const Vec3d& p) {
    return sphereDistance(p, {24, p.x < 24 ? 24.0 : 26.0, 24}, 18);
  });
  expectReportsAndStops([&](const Progress& progress) { fieldToMesh(field, {}, progress); }, 20);
}

TEST(FieldToMesh, AFieldWithoutSurfaceIsRefusedWithAdvice) {
  const DistanceField empty = makeField({4, 4, 4}, 1, {}, [](const Vec3d&) { return 1.0; });
  EXPECT_THAT([&] { fieldToMesh(empty); },
              ThrowsMessage<InputError>(HasSubstr("all of its samples are outside")));
  const DistanceField solid = makeField({4, 4, 4}, 1, {}, [](const Vec3d&) { return -1.0; });
  EXPECT_THAT([&] { fieldToMesh(solid, {.close = false}); },
              ThrowsMessage<InputError>(HasSubstr("all of its samples are inside")));
  DistanceField speck = empty;
  speck.values(1, 1, 1) = -0.5f;
  EXPECT_THAT([&] { fieldToMesh(speck); },
              ThrowsMessage<InputError>(HasSubstr("1 specks below `smallestPiece`")));
}

TEST(FieldToMesh, BadOptionsAndSamplesAreRefusedByName) {
  DistanceField field = makeField({4, 4, 4}, 1, {}, [](const Vec3d& p) { return p.x - 1.5; });
  EXPECT_THAT([&] { fieldToMesh(field, {.smallestPiece = -1}); },
              ThrowsMessage<InputError>(HasSubstr("`smallestPiece` is -1")));
  field.values(3, 2, 1) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT([&] { fieldToMesh(field); }, ThrowsMessage<InputError>(HasSubstr("3, 2, 1")));
  EXPECT_THAT([] { fieldToMesh(DistanceField{}); },
              ThrowsMessage<InputError>(HasSubstr("has no samples")));
}

/// A field that is periodic along x and y: waves and balls, cut by the box along z.
DistanceField periodicField(const Vec3i& n) {
  DistanceField field;
  field.voxelSize = 0.5;
  field.origin = {3, 4, 5};
  field.values = Array3D<float>(n);
  for (std::size_t s = 0; s < field.values.count(); ++s) {
    const Vec3i p = field.values.ijk(s);
    const double x = 2 * std::numbers::pi * (p.x + 0.3) / n.x, y = 2 * std::numbers::pi * p.y / n.y;
    const double waves = std::sin(x) + std::cos(2 * y + x) + std::sin(0.9 * p.z);
    field.values.values()[s] = static_cast<float>(waves * 0.5);
  }
  return field;
}

/// How many edges have one triangle if vertices in the same place, periodic copies included, are
/// one.
std::int64_t openWhenTiled(const TriangleMesh& mesh, const Box3d& box, const Axes& wraps) {
  std::map<std::array<std::int64_t, 3>, std::uint32_t> places;
  std::vector<std::uint32_t> place;
  for (const Vec3d& p : mesh.positions) {
    std::array<std::int64_t, 3> key;
    for (int a = 0; a < 3; ++a) {
      double at = p[a];
      if (wraps[a] && at > box.max[a] - 1e-6) at -= box.size()[a];
      key[a] = std::llround(at * 1e5);
    }
    place.push_back(places.emplace(key, static_cast<std::uint32_t>(places.size())).first->second);
  }
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  for (const auto& t : mesh.triangles) {
    for (int c = 0; c < 3; ++c) ++sides[std::minmax(place[t[c]], place[t[(c + 1) % 3]])];
  }
  return std::ranges::count_if(sides, [](const auto& side) { return side.second % 2 != 0; });
}

TEST(FieldToMesh, CopiesJoinWhereTheFieldIsPeriodic) {
  const DistanceField field = periodicField({24, 20, 16});
  const Axes wraps{true, true, false};
  const TriangleMesh closed = fieldToMesh(field);
  const TriangleMesh open = fieldToMesh(field, {.wraps = wraps});
  ASSERT_TRUE(meshHealth(closed).closed());
  EXPECT_FALSE(meshHealth(open).closed());
  // The checker sees that closed copies do not join, and neither do copies that end anywhere.
  EXPECT_EQ(openWhenTiled(open, field.box(), wraps), 0);
  EXPECT_GT(openWhenTiled(open, field.box(), {true, false, false}), 0);
  EXPECT_GT(openWhenTiled(fieldToMesh(field, {.close = false}), field.box(), wraps), 0);
  // Nothing closes the wrapped faces: no triangle lies in the lower one.
  for (const auto& t : open.triangles) {
    for (int a = 0; a < 2; ++a) {
      EXPECT_FALSE(std::ranges::all_of(
          t, [&](std::uint32_t v) { return open.positions[v][a] < field.box().min[a] + 1e-9; }));
    }
  }
  // The box still cuts below and above.
  EXPECT_TRUE(std::ranges::any_of(open.triangles, [&](const auto& t) {
    return std::ranges::all_of(
        t, [&](std::uint32_t v) { return open.positions[v].z < field.box().min.z + 1e-9; });
  }));
}

}  // namespace
}  // namespace exemplar
