// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/smooth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include "core/error.h"
#include "core/random.h"
#include "mesh/primitives.h"
#include "reconstruct/adjacency.h"
#include "reconstruct/field_to_mesh.h"
#include "tests/reconstruct/fields.h"
#include "tests/sdf/cancellation.h"

namespace exemplar {
namespace {

using testing::HasSubstr;

/// Mean squared distance of the vertices from the middle of their neighbors.
double roughness(const TriangleMesh& mesh) {
  const VertexCorners corners = vertexCorners(mesh.triangles, mesh.positions.size());
  double sum = 0;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    Vec3d ring{};
    for (const std::uint32_t c : corners.at(v)) {
      ring += mesh.positions[toVertex(mesh.triangles, c)];
      ring += mesh.positions[apexVertex(mesh.triangles, c)];
    }
    const Vec3d d = ring / (2.0 * corners.at(v).size()) - mesh.positions[v];
    sum += dot(d, d);
  }
  return sum / mesh.positions.size();
}

TriangleMesh noisy(TriangleMesh mesh, double amplitude) {
  const Random random(7);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    for (int a = 0; a < 3; ++a) {
      mesh.positions[v][a] += random.uniform(-amplitude, amplitude, v, a);
    }
  }
  return mesh;
}

TEST(Smooth, KeepsVolumeAndLowersRoughness) {
  TriangleMesh mesh = noisy(makeTorus({}, {0, 0, 1}, 2, 0.8, 60, 30), 0.03);
  append(mesh, noisy(makeSphere({5, 0, 0}, 1, 12), 0.03));
  const double before = roughness(mesh), volume = meshHealth(mesh).signedVolume;
  smooth(mesh);
  EXPECT_LT(roughness(mesh), 0.2 * before);
  EXPECT_NEAR(meshHealth(mesh).signedVolume, volume, 1e-3 * volume);
  expectSound(mesh);
}

// Without its growing step and the volume's correction the filter shrinks: the checks above can
// fail.
TEST(Smooth, ShrinksWithoutCorrectionByLessThanPlainAveraging) {
  const TriangleMesh ball = makeSphere({}, 1, 6);
  const double volume = meshHealth(ball).signedVolume;
  TriangleMesh filtered = ball, averaged = ball;
  SmoothOptions options;
  options.keepVolume = false;
  smooth(filtered, options);
  const VertexCorners corners = vertexCorners(ball.triangles, ball.positions.size());
  for (int n = 0; n < 10; ++n) {
    const TriangleMesh last = averaged;
    for (std::size_t v = 0; v < ball.positions.size(); ++v) {
      Vec3d ring{};
      for (const std::uint32_t c : corners.at(v)) {
        ring += last.positions[toVertex(ball.triangles, c)];
      }
      averaged.positions[v] =
          last.positions[v] * 0.5 + ring * (0.5 / static_cast<double>(corners.at(v).size()));
    }
  }
  const double filteredLoss = std::abs(volume - meshHealth(filtered).signedVolume);
  const double averagedLoss = volume - meshHealth(averaged).signedVolume;
  EXPECT_GT(averagedLoss, 0.05 * volume);
  EXPECT_LT(filteredLoss, 0.3 * averagedLoss);
  smooth(filtered);
}

TEST(Smooth, WeightsOfZeroHoldVerticesStill) {
  const TriangleMesh before = noisy(makeSphere({}, 1, 10), 0.03);
  TriangleMesh mesh = before;
  SmoothOptions options;
  for (const Vec3d& p : before.positions) options.weights.push_back(p.z > 0 ? 1.0f : 0.0f);
  smooth(mesh, options);
  int moved = 0;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    if (before.positions[v].z > 0) {
      moved += !(mesh.positions[v] == before.positions[v]);
    } else {
      EXPECT_EQ(mesh.positions[v], before.positions[v]);
    }
  }
  EXPECT_GT(moved, 100);
}

TEST(Smooth, MovesNothingFartherThanAsked) {
  const TriangleMesh before = noisy(makeSphere({}, 1, 10), 0.05);
  TriangleMesh free = before, held = before;
  smooth(free);
  smooth(held, {.most = 0.01});
  double farthest = 0;
  for (std::size_t v = 0; v < before.positions.size(); ++v) {
    farthest = std::max(farthest, length(free.positions[v] - before.positions[v]));
    EXPECT_LE(length(held.positions[v] - before.positions[v]), 0.01 * (1 + 1e-9));
  }
  EXPECT_GT(farthest, 0.03);
  EXPECT_LT(roughness(held), roughness(before));
}

TEST(Smooth, VerticesInTheBoxesFacesStayInThem) {
  const DistanceField field = makeField({16, 16, 16}, 1, {0, 0, 0}, [](const Vec3d& p) {
    return std::hypot(p.y - 7.3, p.z - 7.6) - 4 + 0.3 * std::sin(p.x * 2);
  });
  TriangleMesh mesh = fieldToMesh(field);
  const TriangleMesh before = mesh;
  SmoothOptions options;
  options.box = field.box();
  smooth(mesh, options);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    if (std::abs(before.positions[v].x + 0.5) < 1e-9) {
      EXPECT_EQ(mesh.positions[v].x, before.positions[v].x);
    }
  }
  EXPECT_NEAR(meshHealth(mesh).signedVolume, meshHealth(before).signedVolume, 0.5);
}

TEST(Smooth, OpenRimsStayInTheirPlace) {
  // A square sheet with a wavy middle: its straight rim stays straight.
  TriangleMesh mesh;
  const Random random(3);
  constexpr int n = 12;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const bool rim = i == 0 || j == 0 || i == n || j == n;
      mesh.positions.push_back(
          {double(i), double(j), rim ? 0 : random.uniform(-0.3, 0.3, j * 100 + i)});
    }
  }
  for (std::uint32_t j = 0; j < n; ++j) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = j * (n + 1) + i, b = a + n + 1;
      mesh.triangles.insert(mesh.triangles.end(), {{a, a + 1, b + 1}, {a, b + 1, b}});
    }
  }
  const double before = roughness(mesh);
  smooth(mesh);
  EXPECT_LT(roughness(mesh), before);
  for (int i = 0; i <= n; ++i) {
    EXPECT_NEAR(mesh.positions[i].y, 0, 0.3);  // corners may round a little
    EXPECT_EQ(mesh.positions[i].z, 0);
  }
}

TEST(Smooth, TakesMeshesWhoseSheetsTouch) {
  // Two spheres that share a vertex.
  TriangleMesh mesh = makeSphere({0, 0, 0}, 1, 4);
  const TriangleMesh other = makeSphere({2, 0, 0}, 1, 4);
  const auto shift = static_cast<std::uint32_t>(mesh.positions.size());
  append(mesh, other);
  std::uint32_t right = 0, left = shift;
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    if (v < shift && mesh.positions[v].x > mesh.positions[right].x) right = v;
    if (v >= shift && mesh.positions[v].x < mesh.positions[left].x) left = v;
  }
  for (auto& t : mesh.triangles) {
    for (std::uint32_t& v : t) v = v == left ? right : v;
  }
  ASSERT_EQ(meshHealth(mesh).nonManifoldVertices, 1);
  const double volume = meshHealth(mesh).signedVolume;
  smooth(mesh);
  for (const Vec3d& p : mesh.positions) EXPECT_TRUE(isFinite(p));
  EXPECT_NEAR(meshHealth(mesh).signedVolume, volume, 0.01 * volume);
}

TEST(Smooth, IsTheSameAtAnyNumberOfThreads) {
  const TriangleMesh mesh = noisy(makeTorus({}, {0, 0, 1}, 2, 0.8, 80, 40), 0.03);
  TriangleMesh one = mesh, eight = mesh;
  tbb::task_arena(1).execute([&] { smooth(one); });
  tbb::task_arena(8).execute([&] { smooth(eight); });
  EXPECT_EQ(one.positions, eight.positions);
}

TEST(Smooth, BadOptionsAreRefused) {
  TriangleMesh mesh = makeSphere({}, 1, 2);
  const auto refusal = [&](const SmoothOptions& options) -> std::string {
    try {
      smooth(mesh, options);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(refusal({.iterations = -1}), HasSubstr("`iterations` is -1"));
  EXPECT_THAT(refusal({.strength = 0.9}), HasSubstr("`strength` is 0.9"));
  EXPECT_THAT(refusal({.weights = {1, 2}}), HasSubstr("2 weights for"));
  EXPECT_THAT(refusal({.most = -1}), HasSubstr("`most` is -1"));
}

TEST(Smooth, ReportsItsProgressAndStopsWhereItIsCancelled) {
  const TriangleMesh mesh = noisy(makeTorus({}, {0, 0, 1}, 2, 0.8, 80, 40), 0.03);
  expectReportsAndStops(
      [&](const Progress& progress) {
        TriangleMesh smoothed = mesh;
        smooth(smoothed, {}, progress);
      },
      10);
}

TEST(SeamWeights, AreOneAtSeamsAndZeroAwayFromThem) {
  const DistanceField field = makeField({32, 16, 16}, 0.5, {0, 0, 0}, [](const Vec3d& p) {
    return std::hypot(p.y - 3.7, p.z - 3.8) - 2;
  });
  Origins origins = identityOrigins(field.size());
  for (std::size_t n = 0; n < origins.count(); ++n) {
    const Vec3i c = origins.ijk(n);
    if (c.x >= 16) origins.values()[n] = Origin(c - Vec3i{7, 0, 0});
  }
  const TriangleMesh mesh = fieldToMesh(field);
  const auto weights = seamWeights(mesh, field, origins);
  int ones = 0;
  for (std::size_t v = 0; v < weights.size(); ++v) {
    const double fromSeam = std::abs(field.index(mesh.positions[v]).x - 15.5);
    if (fromSeam > 3) {
      EXPECT_EQ(weights[v], 0);
    }
    if (fromSeam < 0.3) {
      EXPECT_GT(weights[v], 0.8);
      ++ones;
    }
  }
  EXPECT_GT(ones, 10);
  for (const float w : seamWeights(mesh, field, identityOrigins(field.size()))) EXPECT_EQ(w, 0);
}

}  // namespace
}  // namespace exemplar
