// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/mesh_field.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "engine/engine.h"
#include "engine/realize.h"
#include "mesh/footprint.h"
#include "mesh/primitives.h"
#include "reconstruct/field_to_mesh.h"

namespace exemplar {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kLong = 4, kThick = 0.5, kHigh = 2;

/// A wall along x with a window, or without its ends.
TriangleMesh wall(bool open = false) {
  TriangleMesh mesh = makeBox({{0, 0, 0}, {kLong, kThick, kHigh}});
  if (open) {
    std::erase_if(mesh.triangles, [&](const auto& t) {
      const double x = mesh.positions[t[0]].x;
      return x == mesh.positions[t[1]].x && x == mesh.positions[t[2]].x;
    });
  }
  return mesh;
}

TriangleMesh turned(TriangleMesh mesh, double degrees) {
  turn(mesh, Turn(degrees * kDegree, {1, 1, 0}));
  return mesh;
}

Example read(const TriangleMesh& mesh, const Vec3d& scale, ReadOptions options = {}) {
  if (!options.resolution && !options.holdDetail) options.resolution = 32;
  options.wanted = Extent{.scale = scale, .size = {}};
  return readExample(Source::of(mesh), options);
}

/// Samples of the field's outermost layers across an axis that are inside.
std::size_t solidAtEnds(const DistanceField& field, int axis) {
  std::size_t count = 0;
  for (std::size_t s = 0; s < field.values.count(); ++s) {
    const int at = field.values.ijk(s)[axis];
    count += (at == 0 || at == field.size()[axis] - 1) && field.values.values()[s] < 0;
  }
  return count;
}

/// Three times as long, by the engine that suits.
Surface longer(const Example& example, const Vec3d& scale) {
  Request request;
  request.extent.scale = scale;
  const Result result = engineNamed("geometry").run({&example, 1}, request);
  EXPECT_EQ(result.outcome, Outcome::Complete);
  return realize(result, {&example, 1});
}

TEST(MeshField, AWallGoesOnAlongTheAxesOnWhichItBecomesLonger) {
  for (const bool open : {false, true}) {
    const Example example = read(wall(open), {3, 1, 1});
    EXPECT_EQ(example.goesOn, (Axes{true, false, false}));
    EXPECT_EQ(static_cast<const Vec3i&>(example.padding), (Vec3i{0, 4, 4}));
    EXPECT_EQ(example.field().size().x, 32);
    EXPECT_GT(solidAtEnds(example.field(), 0), 0u);
    EXPECT_EQ(solidAtEnds(example.field(), 1), 0u);
    EXPECT_THAT(example.description, HasSubstr("going on along x"));
    // Nothing ends there: all along x it is the same, to rounding.
    const DistanceField& field = example.field();
    for (std::size_t s = 0; s < field.values.count(); ++s) {
      const Vec3i ijk = field.values.ijk(s);
      ASSERT_NEAR(field.values[ijk], field.values(16, ijk.y, ijk.z), 1e-6);
    }
  }
  // Nowhere where it stays as long as it is, and nowhere unless a result is wanted.
  EXPECT_EQ(read(wall(), {1, 1, 1}).goesOn, Axes::none());
  EXPECT_EQ(readExample(Source::of(wall()), {.resolution = 32}).goesOn, Axes::none());
}

TEST(MeshField, WhatASizeAsksForCountsLikeAScale) {
  ReadOptions options{.resolution = 32};
  options.wanted = Extent{.scale = {}, .size = Vec3i{96, 8, 16}};
  EXPECT_EQ(readExample(Source::of(wall()), options).goesOn, (Axes{true, false, false}));
  options.wanted->size = Vec3i{20, 8, 16};
  EXPECT_EQ(readExample(Source::of(wall()), options).goesOn, Axes::none());
}

TEST(MeshField, ObjectsHaveAirAndSoHasWhatIsScattered) {
  EXPECT_EQ(read(makeSphere({}, 1, 8), {3, 3, 3}).goesOn, Axes::none());
  const Example scattered = read(wall(), {3, 1, 1}, {.scatter = true});
  EXPECT_EQ(scattered.goesOn, Axes::none());
  EXPECT_EQ(static_cast<const Vec3i&>(scattered.padding), (Vec3i{4, 4, 4}));
  // As they are read where nothing is asked for.
  EXPECT_EQ(scattered.field().values,
            readExample(Source::of(wall()), {.resolution = 32}).field().values);
  // What is given counts.
  const Example padded = read(wall(), {3, 1, 1}, {.padding = Vec3i{2, 0, 1}});
  EXPECT_EQ(padded.goesOn, Axes::none());
  EXPECT_EQ(static_cast<const Vec3i&>(padded.padding), (Vec3i{2, 0, 1}));
  EXPECT_EQ(read(wall(), {3, 1, 1}, {.padding = Vec3i{0, 4, 4}}).goesOn.x, true);
  EXPECT_THAT(
      [] {
        read(wall(), {3, 1, 1}, {.padding = 2, .scatter = true});
      },
      ThrowsMessage<InputError>(HasSubstr("give one of the two")));
}

TEST(MeshField, AWallThatLiesTurnedIsReadAsIfItDidNot) {
  const Example straight = read(wall(), {3, 1, 1});
  for (const double degrees : {17.0, 45.0, 133.0, -60.0}) {
    for (const bool open : {false, true}) {
      SCOPED_TRACE(degrees);
      const TriangleMesh mesh = turned(wall(open), degrees);
      const Example example = read(mesh, {3, 1, 1});
      EXPECT_EQ(example.goesOn, (Axes{true, false, false}));
      ASSERT_EQ(example.field().size(), straight.field().size());
      // Upside down is a half turn, which a wall does not show.
      for (std::size_t s = 0; s < straight.field().values.count(); ++s)
        ASSERT_NEAR(example.field().values.values()[s], straight.field().values.values()[s], 1e-4);
      ASSERT_EQ(example.warnings.size(), 1u);
      EXPECT_THAT(example.warnings[0], HasSubstr("its long side along x"));
      // And lies where it was.
      for (std::size_t v = 0; v < mesh.positions.size(); ++v)
        EXPECT_LT(length(example.turn(example.mesh->positions[v]) - mesh.positions[v]), 1e-12);
    }
  }
  const Example as = read(turned(wall(), 17), {3, 1, 1}, {.align = Align::None});
  EXPECT_TRUE(as.turn.none());
  EXPECT_THAT(as.warnings, IsEmpty());
}

TEST(MeshField, AWallThreeTimesAsLongIsOneWallHoweverItLies) {
  for (const double degrees : {0.0, 17.0, 90.0, 133.0}) {
    for (const bool open : {false, true}) {
      SCOPED_TRACE(degrees);
      const Vec3d scale = degrees == 90 ? Vec3d{1, 3, 1} : Vec3d{3, 1, 1};
      const Example example = read(turned(wall(open), degrees), scale);
      const Surface surface = longer(example, scale);
      EXPECT_EQ(surface.health.components, 1u);
      EXPECT_TRUE(surface.health.closed());
      // Within a voxel of the size, and along the example's own direction.
      TriangleMesh straight = surface.mesh;
      turn(straight, Turn(-degrees * kDegree, {1, 1, 0}));
      const Vec3d size = boundingBox(straight).size();
      // Pieces may line up by a sample on each of two levels.
      const double voxel = 2 * example.field().voxelSize;
      EXPECT_NEAR(size.x, 3 * kLong, voxel);
      EXPECT_NEAR(size.y, kThick, voxel);
      EXPECT_NEAR(size.z, kHigh, voxel);
      const Vec3d low = boundingBox(straight).min;
      EXPECT_NEAR(low.y, 0, voxel);
      EXPECT_NEAR(low.z, 0, voxel);
    }
  }
}

TEST(MeshField, AnEllStaysOne) {
  TriangleMesh ell = makeBox({{0, 0, 0}, {4, 0.4, 2}});
  append(ell, makeBox({{0, 0, 0}, {0.4, 3, 2}}));
  for (const double degrees : {0.0, 25.0}) {
    const Example example = read(turned(ell, degrees), {2, 2, 1});
    EXPECT_EQ(example.goesOn, Axes::none());
    EXPECT_NEAR(example.turn.angle(), degrees * kDegree, 1e-9);
  }
}

TEST(MeshField, SaysWhichResolutionHoldsItsDetail) {
  const TriangleMesh panel = makeBox({{0, 0, 0}, {4, 0.04, 2}});
  const Example coarse = read(panel, {2, 1, 1}, {.resolution = 40});
  ASSERT_EQ(coarse.warnings.size(), 1u);
  // It has air where so little of it is there; 0.04 is two voxels where 4 is 200.
  EXPECT_THAT(coarse.warnings[0], HasSubstr("parts of 0.04 are 0.32 samples wide"));
  EXPECT_THAT(coarse.warnings[0], HasSubstr("`resolution` 208"));
  EXPECT_THAT(read(panel, {2, 1, 1}, {.resolution = 208}).warnings, IsEmpty());

  const Example fine = read(panel, {2, 1, 1}, {.holdDetail = true});
  EXPECT_EQ(fine.field().size().x, 200);
  EXPECT_THAT(fine.warnings, IsEmpty());
  EXPECT_TRUE(fine.goesOn.x);
  // Never less than usual.
  EXPECT_EQ(read(wall(), {2, 1, 1}, {.holdDetail = true}).field().size().x, 64);
}

TEST(MeshField, TakesNoMoreSamplesThanAreAffordable) {
  const TriangleMesh panel = makeBox({{0, 0, 0}, {4, 0.002, 3}});
  const Example example = read(panel, {4, 1, 4}, {.holdDetail = true});
  const double samples = static_cast<double>(volume(example.field().size()));
  EXPECT_LE(samples * (1 + 16), 16.5e6);
  ASSERT_EQ(example.warnings.size(), 1u);
  EXPECT_THAT(example.warnings[0], HasSubstr("auto takes"));
}

}  // namespace
}  // namespace exemplar
