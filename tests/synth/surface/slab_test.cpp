// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/surface/slab.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "synth/geometry/quilting/repetition.h"
#include "tests/synth/surface/surfaces.h"

namespace exemplar::surface {
namespace {

/// A field of heights: solid below.
DistanceField heights(const Vec3i& size, const std::function<double(double, double)>& height) {
  DistanceField field;
  field.values = Array3D<float>(size);
  field.truncation = 16;
  for (std::size_t s = 0; s < field.values.count(); ++s) {
    const Vec3i p = field.values.ijk(s);
    field.values.values()[s] = static_cast<float>(p.z - height(p.x, p.y));
  }
  return field;
}

TEST(Slab, KnowsGroundFromWhatHangsFree) {
  const Slab mail(chainmail());
  EXPECT_FALSE(mail.grounded());
  EXPECT_GT(mail.low(), 0);
  EXPECT_LT(mail.top(), mail.size().z);
  const Slab rough(metal());
  EXPECT_TRUE(rough.grounded());
  EXPECT_LT(rough.low(), rough.high());
}

TEST(Slab, RefusesWhatIsSolidAtItsTop) {
  DistanceField field = heights({20, 20, 10}, [](double, double) { return 20; });
  EXPECT_THROW(Slab{field}, InputError);
  field = heights({20, 20, 10}, [](double, double) { return -5; });
  EXPECT_THROW(Slab{field}, InputError);
}

TEST(Slab, GoesOnBeyondItsTopAndBottom) {
  const Slab slab(heights({20, 20, 10}, [](double, double) { return 5; }));
  EXPECT_NEAR(slab.value({3.5, 4.25}, 5), 0, 1e-6);
  EXPECT_NEAR(slab.value({3.5, 4.25}, 14), 9, 1e-6);
  EXPECT_NEAR(slab.value({3.5, 4.25}, -4), -9, 1e-6);
}

TEST(SlabSymmetry, ChainmailHasHalfTurnsAboutTheMiddleOfTwoRings) {
  const DistanceField mail = chainmail();
  const Slab slab(mail);
  Lattice lattice = latticeOf(findRepetition(mail.values).basis);
  ASSERT_EQ(lattice.periods, 2);
  const SlabSymmetry symmetry = findSymmetry(slab, lattice);
  EXPECT_EQ(symmetry.turns, 2);
  // Turned about it, the slab is itself: as far as rings are in their places.
  double off = 0, count = 0;
  for (int j = 10; j < 50; j += 3) {
    for (int i = 10; i < 54; i += 3) {
      const Vec2d here{double(i), double(j)};
      Vec2d there = symmetry.middle * 2 - here;
      const Vec2d steps = lattice.basis().inverse() * (there - Vec2d{32, 30});
      there = there - lattice.basis() * Vec2d{std::round(steps.x), std::round(steps.y)};
      for (int k = 0; k < slab.size().z; ++k) {
        off += std::abs(std::clamp(slab.value(here, k), -2.0, 2.0) -
                        std::clamp(slab.value(there, k), -2.0, 2.0));
        ++count;
      }
    }
  }
  EXPECT_LT(off / count, 0.25);
}

TEST(SlabSymmetry, SquareBumpsHaveQuarterTurnsAndSlopingOnesNone) {
  constexpr double kPi = std::numbers::pi;
  const auto bumps = [](double x, double y) {
    return 6 + 2 * std::cos(2 * kPi * x / 12) + 2 * std::cos(2 * kPi * y / 12);
  };
  const DistanceField square = heights({50, 50, 16}, bumps);
  Lattice lattice = latticeOf(findRepetition(square.values).basis);
  ASSERT_EQ(lattice.periods, 2);
  EXPECT_EQ(findSymmetry(Slab(square), lattice).turns, 4);
  EXPECT_EQ(dot(lattice.first, lattice.second), 0);

  // Scales: each rises slowly and falls at once.
  const auto scales = [](double x, double y) {
    const double row = std::floor(y / 10);
    const double across = std::remainder(x + 6 * std::fmod(row, 2), 12);
    return 4 + 0.5 * (y - 10 * row) - 0.05 * across * across;
  };
  const DistanceField sloping = heights({60, 60, 16}, scales);
  Lattice rows = latticeOf(findRepetition(sloping.values).basis);
  ASSERT_GT(rows.periods, 0);
  EXPECT_EQ(findSymmetry(Slab(sloping), rows).turns, 1);
}

TEST(SlabSymmetry, RoughMetalMayBeTurnedAndCombedGroundMayNot) {
  Lattice none;
  EXPECT_EQ(findSymmetry(Slab(metal()), none).turns, 4);
  const auto combed = [](double x, double y) {
    return 6 + 2 * std::sin(x * 0.9 + 0.8 * std::sin(y * 0.05) + 0.3 * std::sin(x * 0.21)) +
           0.03 * std::fmod(y, 17);
  };
  EXPECT_LT(findSymmetry(Slab(heights({64, 64, 16}, combed)), none).turns, 4);
}

}  // namespace
}  // namespace exemplar::surface
