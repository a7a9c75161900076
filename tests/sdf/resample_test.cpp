// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/resample.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/sdf/shapes.h"

namespace exemplar {
namespace {

using test::inputError;
using test::withThreads;
using testing::HasSubstr;

DistanceField noise(const Vec3i& size, std::uint64_t seed) {
  DistanceField field{Array3D<float>(size), 0.25, {1, 2, 3}, 1};
  const Random random(seed);
  for (std::size_t s = 0; s < field.values.count(); ++s)
    field.values.values()[s] = static_cast<float>(random.uniform(-1, 1, s));
  return field;
}

// The mean of the samples of one cell, the obvious way.
double cellMean(const DistanceField& field, const Vec3i& cell, int factor) {
  double sum = 0;
  int count = 0;
  for (std::size_t s = 0; s < field.values.count(); ++s) {
    const Vec3i p = field.values.ijk(s);
    if (p.x / factor != cell.x || p.y / factor != cell.y || p.z / factor != cell.z) continue;
    sum += field.values.values()[s];
    ++count;
  }
  return sum / count;
}

TEST(BlockAverage, IsTheMeanOfEachCellAlsoWhereTheLastOneIsCutOff) {
  const DistanceField field = noise({7, 5, 9}, 1);
  for (const int factor : {1, 2, 3, 4, 9, 100}) {
    const DistanceField coarse = blockAverage(field, factor);
    const auto cells = [&](int n) { return (n + factor - 1) / factor; };
    ASSERT_EQ(coarse.size(), (Vec3i{cells(7), cells(5), cells(9)}));
    EXPECT_EQ(coarse.voxelSize, 0.25 * factor);
    for (std::size_t s = 0; s < coarse.values.count(); ++s) {
      // Both sum in double and round to float once.
      ASSERT_NEAR(coarse.values.values()[s], cellMean(field, coarse.values.ijk(s), factor), 1e-7);
    }
  }
}

TEST(BlockAverage, OfAFactorOfOneIsTheFieldItself) {
  const DistanceField field = noise({6, 4, 5}, 2);
  EXPECT_EQ(blockAverage(field, 1).values, field.values);
}

TEST(BlockAverage, KeepsTheBoxWhereTheSidesAreMultiples) {
  const DistanceField field = noise({8, 4, 12}, 3);
  const Box3d before = field.box(), after = blockAverage(field, 4).box();
  EXPECT_NEAR(length(before.min - after.min), 0, 1e-12);
  EXPECT_NEAR(length(before.max - after.max), 0, 1e-12);
}

TEST(BlockAverage, OfALinearFieldIsItsValueAtTheCellsCentre) {
  DistanceField field = noise({12, 12, 12}, 4);
  const auto linear = [](const Vec3d& p) { return 0.3 * p.x - 0.7 * p.y + 0.2 * p.z + 0.1; };
  for (std::size_t s = 0; s < field.values.count(); ++s)
    field.values.values()[s] =
        static_cast<float>(linear(field.position(cast<double>(field.values.ijk(s)))));
  const DistanceField coarse = blockAverage(field, 3);
  for (std::size_t s = 0; s < coarse.values.count(); ++s)
    ASSERT_NEAR(coarse.values.values()[s],
                linear(coarse.position(cast<double>(coarse.values.ijk(s)))), 1e-6);
}

TEST(BlockAverage, RefusesAFactorBelowOne) {
  EXPECT_THAT(inputError([] { blockAverage(noise({2, 2, 2}, 5), 0); }), HasSubstr("factor"));
}

TEST(BlockAverage, IsTheSameAtAnyNumberOfThreads) {
  const DistanceField field = noise({33, 31, 29}, 6);
  const auto run = [&] { return blockAverage(field, 3).values; };
  EXPECT_EQ(withThreads(1, run), withThreads(8, run));
}

TEST(SampleTrilinear, MeetsTheSamplesAndIsLinearBetweenThem) {
  const DistanceField field = noise({4, 5, 6}, 7);
  const Random random(8);
  for (std::size_t s = 0; s < field.values.count(); ++s)
    EXPECT_EQ(sampleTrilinear(field, field.position(cast<double>(field.values.ijk(s)))),
              field.values.values()[s]);
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3i a{static_cast<int>(random.below(3, trial, 0)),
                  static_cast<int>(random.below(4, trial, 1)),
                  static_cast<int>(random.below(5, trial, 2))};
    const double t = random.uniform(trial, 3);
    for (int axis = 0; axis < 3; ++axis) {
      Vec3i b = a;
      ++b[axis];
      const Vec3d p = cast<double>(a) + cast<double>(b - a) * t;
      // One rounding to float of values below 1, and index() divides in double.
      ASSERT_NEAR(sampleTrilinear(field, field.position(p)),
                  field.values[a] * (1 - t) + field.values[b] * t, 1e-6);
    }
  }
}

TEST(SampleTrilinear, IsConstantBeyondTheOuterSamples) {
  const DistanceField field = noise({3, 3, 3}, 9);
  EXPECT_EQ(sampleTrilinear(field, field.position({-5, 1, 1})), field.values(0, 1, 1));
  EXPECT_EQ(sampleTrilinear(field, field.position({1e9, 2, -1e9})), field.values(2, 2, 0));
  EXPECT_EQ(sampleTrilinear(noise({1, 1, 1}, 10), {50, -50, 0}),
            noise({1, 1, 1}, 10).values(0, 0, 0));
}

TEST(Quantize, ErrsByAtMostHalfAStepInsideTheRange) {
  const DistanceField field = noise({16, 16, 16}, 12);
  const float range = 0.75f;
  const QuantizedField quantized = quantize(field, range);
  int clamped = 0;
  for (std::size_t s = 0; s < field.values.count(); ++s) {
    const float v = field.values.values()[s];
    const float back = quantized.value(quantized.levels.values()[s]);
    if (std::abs(v) > range) {
      ++clamped;
      ASSERT_EQ(back, v > 0 ? range : -range);
    } else {
      // Half a step is range / 255; the rest is the rounding of floats below 1.
      ASSERT_NEAR(back, v, range / 255 + 1e-6);
    }
  }
  EXPECT_GT(clamped, 0);
}

TEST(Quantize, UsesAllLevelsAndKeepsTheirOrder) {
  DistanceField field{Array3D<float>({256, 1, 1}), 1, {}, 1};
  for (int i = 0; i < 256; ++i) field.values(i, 0, 0) = -1 + 2 * i / 255.0f;
  const QuantizedField quantized = quantize(field, 1);
  for (int i = 0; i < 256; ++i) EXPECT_EQ(quantized.levels(i, 0, 0), i);
}

TEST(Quantize, OfWhatWasQuantizedChangesNothing) {
  const DistanceField field = noise({8, 8, 8}, 13);
  const QuantizedField once = quantize(field, 1);
  DistanceField again = field;
  for (std::size_t s = 0; s < field.values.count(); ++s)
    again.values.values()[s] = once.value(once.levels.values()[s]);
  EXPECT_EQ(quantize(again, 1).levels, once.levels);
}

TEST(Quantize, RefusesARangeThatIsNotPositive) {
  for (const float range : {0.0f, -1.0f, std::nanf(""), std::numeric_limits<float>::infinity()})
    EXPECT_THAT(inputError([&] { quantize(noise({2, 2, 2}, 14), range); }), HasSubstr("range"));
}

TEST(CubicAt, IsExactForQuadraticValuesAndAtSamples) {
  const auto value = [](const Vec3d& p) {
    return 0.3 * p.x * p.x - 0.2 * p.x * p.y + 0.7 * p.z * p.z + p.y - 4;
  };
  Array3D<float> values({9, 8, 7});
  for (std::size_t s = 0; s < values.count(); ++s)
    values.values()[s] = static_cast<float>(value(cast<double>(values.ijk(s))));
  const Random random(4);
  for (std::uint64_t n = 0; n < 200; ++n) {
    const Vec3d p{1 + 6 * random.uniform(n, 0), 1 + 5 * random.uniform(n, 1),
                  1 + 4 * random.uniform(n, 2)};
    EXPECT_NEAR(cubicAt(values, p), value(p), 1e-5);
  }
  EXPECT_EQ(cubicAt(values, {3, 4, 5}), values(3, 4, 5));
  // Beyond the outer samples it is as there.
  EXPECT_EQ(cubicAt(values, {-2, 4, 20}), values(0, 4, 6));
}

/// A wire 3.5 samples thick keeps its thickness, which trilinear values take a part of.
TEST(CubicAt, KeepsThinWires) {
  DistanceField field;
  field.values = Array3D<float>({16, 16, 16});
  field.voxelSize = 1;
  const auto wire = [](const Vec3d& p) { return std::hypot(p.x - 7.3, p.z - 7.6) - 1.75; };
  for (std::size_t s = 0; s < field.values.count(); ++s)
    field.values.values()[s] = static_cast<float>(wire(cast<double>(field.values.ijk(s))));
  const auto share = [&](const auto& at) {
    int inside = 0;
    for (int i = 0; i < 200; ++i)
      for (int k = 0; k < 200; ++k) inside += at(Vec3d{4 + 0.04 * i, 8, 4 + 0.04 * k}) < 0;
    return inside * 0.04 * 0.04 / (std::numbers::pi * 1.75 * 1.75);
  };
  EXPECT_NEAR(share([&](const Vec3d& p) { return sampleCubic(field, p); }), 1, 0.02);
  EXPECT_LT(share([&](const Vec3d& p) { return sampleTrilinear(field, p); }), 0.95);
}

}  // namespace
}  // namespace exemplar
