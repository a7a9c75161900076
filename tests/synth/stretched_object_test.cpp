// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/objects/stretched_object.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/cells.h"
#include "synth/geometry/objects/slice_docking.h"
#include "synth/geometry/objects/slice_path.h"
#include "tests/synth/fields.h"
#include "tests/threads.h"

namespace exemplar {
namespace {

using namespace testing;

/// Two balls of radius 8 on a rod along x, of radius 3.
DistanceField dumbbell() {
  DistanceField field = constant({72, 28, 28}, 0);
  forEachCell(field.size(), [&](const Vec3i& p) {
    const double r = std::hypot(p.y - 13.5, p.z - 13.5);
    double d = std::max(r - 3, std::abs(p.x - 35.5) - 20);
    for (const double x : {15.5, 55.5}) d = std::min(d, std::hypot(p.x - x, r) - 8);
    field.values[p] = static_cast<float>(d);
  });
  return field;
}

/// Twice as long along x, by the path that growth takes.
AxisPlaces twiceAlongX(const DistanceField& example) {
  AxisPlaces places;
  places[0] = stretchedPath(SliceDocking(example, 0), 2 * example.size().x, 1);
  for (std::size_t axis = 1; axis < 3; ++axis)
    for (int i = 0; i < example.size()[static_cast<int>(axis)]; ++i) places[axis].push_back(i);
  return places;
}

/// How long the solid of x beyond a slice of the result is along each axis.
Vec3i extentBefore(const Array3D<float>& values, int slice) {
  CellBox box{values.size(), {0, 0, 0}};
  forEachCell({{0, 0, 0}, {slice, values.size().y, values.size().z}}, [&](const Vec3i& p) {
    if (!(values[p] < 0)) return;
    box.begin = min(box.begin, p);
    box.end = max(box.end, p + Vec3i{1, 1, 1});
  });
  return box.size();
}

/// The first slice after a ball's middle that is no thicker than the rod.
int endOfBall(const Array3D<float>& values, double rod) {
  const Vec3i n = values.size();
  double thickest = 0;
  for (int i = 0; i < n.x; ++i) {
    int thick = 0;
    for (int k = 0; k < n.z; ++k) thick += values(i, n.y / 2, k) < 0;
    if (thickest > 1.5 * rod && thick <= 1.2 * rod) return i;
    thickest = std::max<double>(thickest, thick);
  }
  return n.x;
}

TEST(StretchedObject, HasAsMuchSolidAsTheExample) {
  const DistanceField example = dumbbell();
  AxisPlaces places = twiceAlongX(example);
  EXPECT_NEAR(stretchSpace(example, places).solidRatio(example), 1, kSolidBound + 0.01);
  EXPECT_NEAR(stretchSkeleton(example, places).solidRatio(example), 1, kSolidBound);
  // The rod alone stretched: balls of the same length would leave a quarter of the solid out.
  for (std::size_t i = 0; i < places[0].size(); ++i) {
    const double at = static_cast<double>(i);
    places[0][i] = at < 26 ? at : at > 117 ? at - 72 : 26 + (at - 26) * 19 / 91;
  }
  StretchedObject plain{Array3D<float>({144, 28, 28}), {}};
  forEachCell(plain.values.size(), [&](const Vec3i& p) {
    const auto from = static_cast<int>(std::lround(places[0][static_cast<std::size_t>(p.x)]));
    plain.values[p] = example.values(from, p.y, p.z);
  });
  EXPECT_LT(plain.solidRatio(example), 0.8);
  EXPECT_NEAR(stretchSpace(example, places).solidRatio(example), 1, kSolidBound + 0.01);
  EXPECT_NEAR(stretchSkeleton(example, places).solidRatio(example), 1, kSolidBound);
}

TEST(StretchedObject, StaysRoundAlongItsMedialAxis) {
  const DistanceField example = dumbbell();
  const AxisPlaces places = twiceAlongX(example);
  const auto roundness = [&](const StretchedObject& made) {
    const Vec3i n = made.values.size();
    int rod = 0;
    for (int k = 0; k < n.z; ++k) rod += made.values(n.x / 2, n.y / 2, k) < 0;
    const Vec3i ball = extentBefore(made.values, endOfBall(made.values, rod));
    return static_cast<double>(ball.x) / ball.z;
  };
  // A ball of the example ends in its rod: it is 7/8 as long as it is thick.
  EXPECT_GT(roundness(stretchSpace(example, places)), 1.3);
  // A ball of 12 samples, counted to one at both ends.
  EXPECT_LE(roundness(stretchSkeleton(example, places)), 1 + 2.0 / 12 + 1e-9);
}

TEST(StretchedObject, ShowsTheExampleWhereItIsNotStretched) {
  const DistanceField example = dumbbell();
  AxisPlaces same;
  for (int axis = 0; axis < 3; ++axis)
    for (int i = 0; i < example.size()[axis]; ++i)
      same[static_cast<std::size_t>(axis)].push_back(i);
  const StretchedObject space = stretchSpace(example, same);
  const StretchedObject skeleton = stretchSkeleton(example, same);
  forEachCell(example.size(), [&](const Vec3i& p) {
    EXPECT_NEAR(space.values[p], example.values[p], 1e-4);
    // Medial axes lie between samples: balls are up to half a sample's diagonal smaller.
    if (std::abs(example.values[p]) < 1) {
      EXPECT_NEAR(skeleton.values[p], example.values[p], 0.9);
    }
  });
}

TEST(StretchedObject, IsTheSameAtAnyNumberOfThreads) {
  const DistanceField example = dumbbell();
  const AxisPlaces places = twiceAlongX(example);
  for (const auto stretch : {stretchSpace, stretchSkeleton}) {
    StretchedObject one, eight;
    withThreads(1, [&] { one = stretch(example, places, {}); });
    withThreads(8, [&] { eight = stretch(example, places, {}); });
    EXPECT_EQ(one.values, eight.values);
    EXPECT_EQ(one.places, eight.places);
  }
}

TEST(StretchedObject, MayBeEmpty) {
  const DistanceField air = constant({12, 12, 12}, 1);
  const AxisPlaces places = twiceAlongX(air);
  EXPECT_GT(stretchSpace(air, places).values(3, 3, 3), 0);
  EXPECT_GT(stretchSkeleton(air, places).values(3, 3, 3), 0);
}

}  // namespace
}  // namespace exemplar
