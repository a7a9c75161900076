// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/closest_point.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/random.h"

namespace exemplar {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Vec3d randomPoint(const Random& random, std::uint64_t n) {
  return {random.uniform(n, 0), random.uniform(n, 1), random.uniform(n, 2)};
}

// What a point of `t` that `closestPoint` returns must be, besides near.
void expectConsistent(const Vec3d& p, const Corners& t) {
  const auto [weights, offset] = closestPoint(p, t);
  EXPECT_NEAR(weights[0] + weights[1] + weights[2], 1, 1e-12);
  for (const double weight : weights) EXPECT_GE(weight, -1e-12);
  const Vec3d at = t[0] * weights[0] + t[1] * weights[1] + t[2] * weights[2];
  EXPECT_NEAR(length(p - at - offset), 0, 1e-12);
  EXPECT_EQ(squaredDistance(p, t), dot(offset, offset));
}

TEST(ClosestPoint, IsTheNearestOfTheTriangle) {
  const Random random(1);
  for (std::uint64_t trial = 0; trial < 100; ++trial) {
    const Corners t{randomPoint(random, 4 * trial), randomPoint(random, 4 * trial + 1),
                    randomPoint(random, 4 * trial + 2)};
    const Vec3d p = randomPoint(random, 4 * trial + 3) * 2 - Vec3d{0.5, 0.5, 0.5};
    expectConsistent(p, t);
    const double d = std::sqrt(squaredDistance(p, t));
    double sampled = kInfinity;
    constexpr int n = 200;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j) {
        const Vec3d q = t[0] + (t[1] - t[0]) * (double(i) / n) + (t[2] - t[0]) * (double(j) / n);
        sampled = std::min(sampled, length(p - q));
      }
    EXPECT_LE(d, sampled + 1e-12);
    EXPECT_GE(d, sampled - 2 * std::sqrt(3.0) / n);  // edges are below sqrt(3) long
  }
}

TEST(ClosestPoint, IsExactWhereCornersCoincide) {
  const Random random(2);
  for (std::uint64_t trial = 0; trial < 100; ++trial) {
    const Vec3d a = randomPoint(random, 3 * trial), b = randomPoint(random, 3 * trial + 1);
    const Vec3d p = randomPoint(random, 3 * trial + 2) * 2 - Vec3d{0.5, 0.5, 0.5};
    const double share = std::clamp(dot(p - a, b - a) / dot(b - a, b - a), 0.0, 1.0);
    const double toSegment = length(p - (a + (b - a) * share));
    for (const Corners& t : {Corners{a, a, b}, Corners{a, b, a}, Corners{b, a, a}}) {
      expectConsistent(p, t);
      EXPECT_NEAR(std::sqrt(squaredDistance(p, t)), toSegment, 1e-12);
    }
    expectConsistent(p, {a, a, a});
    EXPECT_NEAR(std::sqrt(squaredDistance(p, {a, a, a})), length(p - a), 1e-12);
  }
}

TEST(SquaredDistance, AnswersForTrianglesWithoutArea) {
  const Vec3d p{0, 1, 0};
  EXPECT_DOUBLE_EQ(squaredDistance(p, {Vec3d{-1, 0, 0}, Vec3d{1, 0, 0}, Vec3d{0, 0, 0}}), 1);
  EXPECT_DOUBLE_EQ(squaredDistance(p, {Vec3d{2, 1, 0}, Vec3d{2, 1, 0}, Vec3d{2, 1, 0}}), 4);
  EXPECT_DOUBLE_EQ(squaredDistance(p, {Vec3d{1, 1, 0}, Vec3d{1, 1, 0}, Vec3d{3, 1, 0}}), 1);
}

}  // namespace
}  // namespace exemplar
