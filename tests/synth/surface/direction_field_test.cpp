// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/surface/direction_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "core/turn.h"
#include "tests/synth/surface/surfaces.h"
#include "tests/threads.h"

namespace exemplar::surface {
namespace {

constexpr double kPi = std::numbers::pi;

std::int64_t indexSum(const DirectionField& field) {
  std::int64_t sum = 0;
  for (const Singularity& s : field.singularities) sum += s.index;
  return sum;
}

/// The least angle between any of the field's directions at a node and one in space.
double angleTo(const Sheet& sheet, const DirectionField& field, std::uint32_t v, const Vec3d& d) {
  double least = kPi;
  for (int k = 0; k < field.symmetry; ++k) {
    const Vec3d there = sheet.directionOf(v, field.angle[v] + 2 * kPi * k / field.symmetry);
    least = std::min(least, std::acos(std::clamp(dot(there, normalized(d)), -1.0, 1.0)));
  }
  return least;
}

TEST(DirectionField, IsParallelOnAPlane) {
  const Sheet sheet = makeSheet(planeMesh(1, 10), {.edge = 0.1});
  for (const int symmetry : {1, 2, 4, 6}) {
    const DirectionField field = smoothestField(sheet, symmetry);
    EXPECT_TRUE(field.singularities.empty());
    const Vec3d first = sheet.directionOf(0, field.angle[0]);
    for (std::uint32_t v = 0; v < sheet.positions.size(); ++v)
      EXPECT_NEAR(angleTo(sheet, field, v, first), 0, 1e-6);
  }
}

TEST(DirectionField, IndicesAreWholeAndSumToTheEulerCharacteristic) {
  const TriangleMesh surfaces[] = {makeSphere({0, 0, 0}, 1, 8),
                                   makeTorus({0, 0, 0}, {0, 0, 1}, 1, 0.4), genusThreeMesh(),
                                   bodyMesh(), makeBox({{0, 0, 0}, {1, 2, 1}})};
  for (const TriangleMesh& mesh : surfaces) {
    const Sheet sheet = makeSheet(mesh, {.edge = 0.12});
    for (const int symmetry : {1, 2, 4, 6}) {
      const DirectionField field = smoothestField(sheet, symmetry);
      EXPECT_LT(field.residual, 1e-9);
      EXPECT_EQ(indexSum(field), symmetry * sheet.eulerCharacteristic());
    }
  }
}

TEST(DirectionField, ASphereHasTwoSingularitiesAndATorusNone) {
  const Sheet sphere = makeSheet(makeSphere({0, 0, 0}, 1, 10), {.edge = 0.15});
  EXPECT_EQ(smoothestField(sphere, 1).singularities.size(), 2u);
  const Sheet torus = makeSheet(makeTorus({0, 0, 0}, {0, 0, 1}, 1, 0.4, 60, 30), {.edge = 0.15});
  EXPECT_TRUE(smoothestField(torus, 1).singularities.empty());
}

TEST(DirectionField, TurnsWithTheSurface) {
  TriangleMesh mesh = bodyMesh(0.1);
  const Sheet before = makeSheet(mesh, {.edge = 0.2});
  const Turn turn(0.7, {0, 0, 0});
  for (Vec3d& p : mesh.positions) p = turn(p);
  const Sheet after = makeSheet(mesh, {.edge = 0.2});
  const DirectionField a = smoothestField(before, 2), b = smoothestField(after, 2);
  ASSERT_EQ(a.angle.size(), b.angle.size());
  // Up to what they share: an eigenvector has no phase of its own.
  const double all = b.angle[0] - a.angle[0];
  std::size_t same = 0;
  for (std::size_t v = 0; v < a.angle.size(); ++v)
    same += std::abs(std::remainder(b.angle[v] - a.angle[v] - all, kPi)) < 1e-3;
  EXPECT_GT(same, a.angle.size() * 99 / 100);
}

TEST(DirectionField, FollowsADirectionWhereItLiesInTheSurface) {
  const Sheet sheet = makeSheet(cylinderMesh(1, 4, 60, 30), {.edge = 0.2});
  const Guidance up = along(sheet, {0, 0, 1}, 0.5);
  const DirectionField field = smoothestField(sheet, 1, &up);
  for (std::uint32_t v = 0; v < sheet.positions.size(); ++v)
    if (!sheet.atBorder[v]) {
      EXPECT_LT(angleTo(sheet, field, v, {0, 0, 1}), 0.01);
    }
}

/// A bumpy tube from the origin along `way`, 3 long, with round ends.
TriangleMesh bumpyTube(const Vec3d& way, double bumps) {
  return implicitMesh({{-3.6, -3.6, -3.6}, {3.6, 3.6, 3.6}}, 0.09, [&](const Vec3d& p) {
    const Vec3d off = p - way * std::clamp(dot(p, way), 0.0, 3.0);
    return length(off) - 0.4 + bumps * std::sin(11 * p.x) * std::sin(12 * p.y) * std::sin(13 * p.z);
  });
}

TEST(DirectionField, FollowsLimbsWhereverTheyPoint) {
  for (const Vec3d& way : {Vec3d{0, 0, 1}, Vec3d{1, 0, 0.2}, Vec3d{0.6, -0.8, 0.1}}) {
    for (const double bumps : {0.0, 0.02}) {
      const Sheet sheet = makeSheet(bumpyTube(normalized(way), bumps), {.edge = 0.12});
      const Guidance limb = alongLeastCurvature(sheet, 0.5);
      const DirectionField field = smoothestField(sheet, 2, &limb);
      double off = 0, looked = 0;
      for (std::uint32_t v = 0; v < sheet.positions.size(); ++v) {
        const double at = dot(sheet.positions[v], normalized(way));
        if (at < 0.8 || at > 2.2) continue;  // the ends are round
        off += angleTo(sheet, field, v, way);
        ++looked;
      }
      EXPECT_GT(looked, 100);
      EXPECT_LT(off / looked, bumps == 0 ? 0.06 : 0.2);
    }
  }
}

TEST(DirectionField, FollowsStrokesWithinFiveDegrees) {
  const Sheet sheet = makeSheet(planeMesh(4, 40), {.edge = 0.15});
  const std::vector<std::vector<Vec3d>> strokes{{{1, 0.5, 0}, {1.5, 2, 0}, {1.2, 3.5, 0}},
                                                {{3, 0.5, 0}, {3, 3.5, 0}}};
  const Guidance guidance = alongStrokes(sheet, strokes, 0.1, 0.1);
  const DirectionField field = smoothestField(sheet, 1, &guidance);
  std::size_t on = 0;
  for (std::uint32_t v = 0; v < sheet.positions.size(); ++v) {
    if (guidance.confidence[v] < 1) continue;
    // Where a line bends both of its parts are near.
    if (std::abs(sheet.positions[v].y - 2) < 0.3) continue;
    ++on;
    const double off = std::remainder(field.angle[v] - guidance.angle[v], 2 * kPi);
    EXPECT_LT(std::abs(off), 5 * kPi / 180);
  }
  EXPECT_GT(on, 50u);
}

TEST(DirectionField, IsTheSameAtAnyNumberOfThreads) {
  const Sheet sheet = makeSheet(makeSphere({0, 0, 0}, 1, 6), {.edge = 0.2});
  testing::expectSameAtAnyThreads([&] { return smoothestField(sheet, 4).angle; });
}

}  // namespace
}  // namespace exemplar::surface
