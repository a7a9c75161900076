// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/surface_likeness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "core/error.h"
#include "core/random.h"

namespace exemplar {
namespace {

/// Ground with ridges of two kinds that cross aslant, so that its mirror image is another ground,
/// and that never repeat exactly.
double ground(double x, double y, double z) {
  return z - 7 - 2 * std::sin(0.5 * x + 0.9 * std::sin(0.13 * y)) -
         1.5 * std::sin(0.37 * x + 0.61 * y + 0.5 * std::sin(0.11 * x));
}

Array3D<float> sampled(const Vec3i& size, const std::function<double(Vec3d)>& value) {
  Array3D<float> grid(size);
  for (std::size_t s = 0; s < grid.count(); ++s)
    grid.values()[s] = static_cast<float>(value(cast<double>(grid.ijk(s))));
  return grid;
}

Array3D<float> example() {
  return sampled({64, 64, 15}, [](const Vec3d& p) { return ground(p.x, p.y, p.z); });
}

/// Patches, each from somewhere in the example, by `place` from (patch, point of it).
std::vector<Array3D<float>> patches(const std::function<Vec3d(int, Vec3d)>& place) {
  std::vector<Array3D<float>> result;
  for (int n = 0; n < 30; ++n) {
    result.push_back(sampled({27, 27, 15}, [&](const Vec3d& p) {
      const Vec3d q = place(n, p);
      return ground(q.x, q.y, q.z);
    }));
  }
  return result;
}

Vec3d corner(int n) {
  const Random random(3);
  return {random.uniform(0, 37, n, 0), random.uniform(0, 37, n, 1), 0};
}
Vec3d wholeCorner(int n) {
  const Vec3d c = corner(n);
  return {std::floor(c.x), std::floor(c.y), 0};
}

TEST(SurfaceLikeness, PiecesOfTheExampleAreAlikeAndTogetherCoverIt) {
  const SurfaceLikeness found = surfaceLikeness(
      patches([](int n, const Vec3d& p) { return p + wholeCorner(n); }), 1, example(), 1);
  EXPECT_GT(found.windows, 100);
  EXPECT_EQ(found.likeness, 1);
  EXPECT_GT(found.coverage, 0.9);
}

/// Thin wires, a part of a sample aside: nothing is like them but on the right grid.
TEST(SurfaceLikeness, WhereTheGridIsIsFound) {
  const auto wires = [](const Vec3d& p) {
    const double x = std::fmod(p.x + 0.9 * std::sin(0.2 * p.y) + 90, 9) - 4.5;
    return std::hypot(x, p.z - 7) - 1.75;
  };
  const Array3D<float> example = sampled({64, 64, 15}, wires);
  constexpr int kPerSample = 4;
  std::vector<Array3D<float>> coarse, fine;
  for (int n = 0; n < 12; ++n) {
    const Vec3d from = corner(n);
    coarse.push_back(sampled({27, 27, 15}, [&](const Vec3d& p) { return wires(p + from); }));
    fine.push_back(sampled({26 * kPerSample + 1, 26 * kPerSample + 1, 15}, [&](const Vec3d& p) {
      return wires(Vec3d{p.x / kPerSample, p.y / kPerSample, p.z} + from);
    }));
  }
  const double moved = surfaceLikeness(coarse, 1, example, 1).likeness;
  const double aligned = surfaceLikeness(fine, kPerSample, example, 1).likeness;
  EXPECT_GT(aligned, moved + 0.3);
  EXPECT_GT(aligned, 0.85);
}

TEST(SurfaceLikeness, TurnedPiecesAreAlikeWhereTurnsAreAllowed) {
  const auto turned = patches([](int n, const Vec3d& p) {
    return wholeCorner(n) + Vec3d{26 - p.y, p.x, p.z};
  });
  EXPECT_EQ(surfaceLikeness(turned, 1, example(), 4).likeness, 1);
  EXPECT_LT(surfaceLikeness(turned, 1, example(), 1).likeness, 0.5);
}

TEST(SurfaceLikeness, AWrongScaleIsNotAlike) {
  const SurfaceLikeness found = surfaceLikeness(
      patches([](int n, const Vec3d& p) { return p * 1.25 + corner(n); }), 1, example(), 1);
  EXPECT_LT(found.likeness, 0.5);
}

TEST(SurfaceLikeness, AMirroredFrameIsNotAlike) {
  const auto mirrored = patches([](int n, const Vec3d& p) {
    return wholeCorner(n) + Vec3d{26 - p.x, p.y, p.z};
  });
  EXPECT_LT(surfaceLikeness(mirrored, 1, example(), 4).likeness, 0.5);
}

TEST(SurfaceLikeness, ScatteredCopiesOfOnePartAreNotAlikeAndDoNotCover) {
  // The same small square again and again, each joint where it happens to be.
  const SurfaceLikeness found =
      surfaceLikeness(patches([](int n, const Vec3d& p) {
                        const Vec3d q = p + wholeCorner(n);
                        return Vec3d{20 + std::fmod(q.x, 9), 20 + std::fmod(q.y, 9), q.z};
                      }),
                      1, example(), 1);
  EXPECT_LT(found.likeness, 0.5);
  EXPECT_LT(found.coverage, 0.5);
  // One place, whole: alike, and less of a cover than many; its ridges come nearly the same again
  // elsewhere in the example.
  const SurfaceLikeness one = surfaceLikeness(patches([](int, const Vec3d& p) {
                                                return p + Vec3d{5, 5, 0};
                                              }),
                                              1, example(), 1);
  EXPECT_EQ(one.likeness, 1);
  EXPECT_LT(one.coverage, 0.75);
}

TEST(SurfaceLikeness, RefusesWhatCannotBeCompared) {
  EXPECT_THROW(surfaceLikeness({}, 1, example(), 1), InputError);
  const std::vector<Array3D<float>> small{Array3D<float>({8, 8, 8})};
  EXPECT_THROW(surfaceLikeness(small, 1, example(), 1), InputError);
  const std::vector<Array3D<float>> good{Array3D<float>({27, 27, 15})};
  EXPECT_THROW(surfaceLikeness(good, 1, example(), 3), InputError);
}

}  // namespace
}  // namespace exemplar
