// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "report/marks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "measure/seams.h"
#include "mesh/primitives.h"
#include "tests/progress_checks.h"

namespace exemplar {
namespace {

/// Bumpy ground of nx x ny x 16 samples.
DistanceField ground(int nx, int ny) {
  DistanceField field;
  field.values = Array3D<float>({nx, ny, 16});
  field.truncation = 8;
  for (std::size_t n = 0; n < field.values.count(); ++n) {
    const Vec3i p = field.values.ijk(n);
    field.values.values()[n] =
        static_cast<float>(p.z - 7 - 1.5 * std::sin(p.x * 0.37) * std::cos(p.y * 0.29));
  }
  return field;
}

DistanceField gathered(const DistanceField& example, const Origins& origins) {
  DistanceField field = example;
  field.values = Array3D<float>(origins.size());
  for (std::size_t n = 0; n < origins.count(); ++n)
    field.values.values()[n] = example.values[origins.values()[n].cell()];
  return field;
}

Camera cameraFrom(const char* view, const Vec3d& size) {
  RenderOptions options;
  options.view = viewFromName(view);
  return pictureCamera(makeBox({{0, 0, 0}, size}), options);
}

std::vector<Mark> ofKind(const std::vector<Mark>& marks, Mark::Kind kind) {
  std::vector<Mark> own;
  std::copy_if(marks.begin(), marks.end(), std::back_inserter(own),
               [&](const Mark& m) { return m.kind == kind; });
  return own;
}

/// Thirty columns of the example, and thirty that begin at its tenth, put up by `rise`: a seam
/// between samples 29 and 30, where the example goes on to both sides.
Origins twice(const DistanceField& example, int rise) {
  const Vec3i n = example.size();
  Origins origins({60, n.y, n.z});
  for (std::size_t o = 0; o < origins.count(); ++o) {
    Vec3i p = origins.ijk(o);
    if (p.x >= 30) p = {p.x - 20, p.y, std::clamp(p.z - rise, 0, n.z - 1)};
    origins.values()[o] = Origin(p);
  }
  return origins;
}

TEST(Marks, SeamsAreWhereItJumps) {
  const DistanceField example = ground(40, 40);
  const Origins origins = twice(example, 3);
  const DistanceField result = gathered(example, origins);
  const Array3D<float> jumps = seamJumps(example, result, origins);
  const auto marks =
      ofKind(findMarks(example, result, origins, jumps, cameraFrom("top", {60, 40, 16})),
             Mark::Kind::Seam);
  ASSERT_FALSE(marks.empty());
  for (const Mark& mark : marks) {
    EXPECT_NEAR(mark.position.x, 29.5, 1);
    EXPECT_GE(mark.value, 1);
  }
  EXPECT_LE(marks.size(), 6u);
}

TEST(Marks, ACopyIsMarkedAndIsNoSeam) {
  const DistanceField example = ground(40, 40);
  Origins origins(example.size());
  for (std::size_t n = 0; n < origins.count(); ++n) origins.values()[n] = Origin(origins.ijk(n));
  const Array3D<float> jumps = seamJumps(example, example, origins);
  const auto marks = findMarks(example, example, origins, jumps, cameraFrom("top", {40, 40, 16}));
  ASSERT_EQ(marks.size(), 1u);
  EXPECT_EQ(marks[0].kind, Mark::Kind::Copy);
  EXPECT_DOUBLE_EQ(marks[0].value, 1);
  ASSERT_TRUE(marks[0].at);
  // All of the ground is seen from above: its outline spans the picture's shorter side but for the
  // margins.
  double low = 1, high = 0;
  for (const auto& p : marks[0].outline) low = std::min(low, p[1]), high = std::max(high, p[1]);
  EXPECT_LT(low, 0.15);
  EXPECT_GT(high, 0.85);
}

TEST(Marks, ARepeatedPartIsFoundInAllItsPlaces) {
  // One corner of the example, 16 x 16, tiles a result; a strip shows the rest of the example once.
  const DistanceField example = ground(64, 64);
  Origins origins({64, 96, 16});
  for (std::size_t n = 0; n < origins.count(); ++n) {
    const Vec3i p = origins.ijk(n);
    origins.values()[n] = Origin(p.y < 32 ? Vec3i{p.x % 16, p.y % 16, p.z} : p - Vec3i{0, 32, 0});
  }
  const DistanceField result = gathered(example, origins);
  const Array3D<float> jumps = seamJumps(example, result, origins);
  MarkOptions all;
  all.places = 20;
  const auto marks =
      ofKind(findMarks(example, result, origins, jumps, cameraFrom("top", {64, 96, 16}), all),
             Mark::Kind::Repeat);
  ASSERT_FALSE(marks.empty());
  const auto first =
      std::count_if(marks.begin(), marks.end(), [](const Mark& m) { return m.group == 0; });
  // Eight tiles and the original: nine places of each cell of the corner; and nine times as often
  // as once, while the average is 64 * 96 / (64 * 64) = 1.5.
  EXPECT_EQ(first, 9);
  EXPECT_NEAR(marks[0].value, 9 / 1.5, 0.6);
  for (const Mark& mark : marks) EXPECT_TRUE(mark.position.y < 48) << mark.position.y;
}

TEST(Marks, WhatIsHiddenHasNoPlaceInThePicture) {
  const DistanceField example = ground(40, 40);
  const Origins origins = twice(example, 3);
  const DistanceField result = gathered(example, origins);
  const Array3D<float> jumps = seamJumps(example, result, origins);
  const auto from = [&](const char* view) {
    const auto marks = findMarks(example, result, origins, jumps, cameraFrom(view, {60, 40, 16}));
    return std::count_if(marks.begin(), marks.end(),
                         [](const Mark& m) { return m.at.has_value(); });
  };
  EXPECT_GT(from("top"), 0);
  EXPECT_EQ(from("bottom"), 0);  // through the ground
}

TEST(Marks, ReportAndStop) {
  const DistanceField example = ground(40, 40);
  const Origins origins = twice(example, 3);
  const DistanceField result = gathered(example, origins);
  const Array3D<float> jumps = seamJumps(example, result, origins);
  const Camera camera = cameraFrom("top", {60, 40, 16});
  testing::expectReportsAndStops(10, [&](const Progress& progress) {
    return findMarks(example, result, origins, jumps, camera, {}, 0, progress);
  });
}

TEST(Marks, RefuseWhatDoesNotFit) {
  const DistanceField example = ground(16, 16);
  const Camera camera = cameraFrom("top", {16, 16, 16});
  Origins origins(example.size());
  EXPECT_THROW(
      findMarks(example, example, Origins({2, 2, 2}), Array3D<float>({16, 16, 16}), camera),
      InputError);
  EXPECT_THROW(findMarks(example, example, origins, Array3D<float>({2, 2, 2}), camera), InputError);
}

TEST(ConvexHull, HoldsAllPointsAndTurnsOneWay) {
  std::vector<std::array<double, 2>> points;
  for (int n = 0; n < 300; ++n)
    points.push_back({std::sin(n * 12.9898) * std::cos(n * 3.1), std::sin(n * 78.233)});
  const auto hull = convexHull(points);
  ASSERT_GT(hull.size(), 3u);
  for (std::size_t a = 0; a < hull.size(); ++a) {
    const auto& p = hull[a];
    const auto& q = hull[(a + 1) % hull.size()];
    for (const auto& r : points)
      EXPECT_GE((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]), -1e-12);
  }
  EXPECT_EQ(convexHull({{0, 0}, {1, 1}, {2, 2}}).size(), 2u);
  EXPECT_EQ(convexHull({{1, 2}, {1, 2}}).size(), 1u);
  EXPECT_TRUE(convexHull({}).empty());
}

}  // namespace
}  // namespace exemplar
