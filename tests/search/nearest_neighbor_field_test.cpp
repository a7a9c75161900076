// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "search/nearest_neighbor_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.h"
#include "fields.h"
#include "tests/progress_checks.h"
#include "tests/threads.h"

namespace exemplar {
namespace {

using Options = NearestNeighborFieldOptions;

// Whole numbers: sums below 2^24 are exact in float, whatever their order, and ties are ties.
Array3D<float> levels(const Array3D<std::uint8_t>& field) {
  Array3D<float> result(field.size());
  std::ranges::copy(field.values(), result.data());
  return result;
}

double patchDistance(const Channels& source, const Vec3i& s, const Channels& target, const Vec3i& t,
                     const Vec3i& patch) {
  double sum = 0;
  for (std::size_t c = 0; c < source.size(); ++c)
    for (int k = 0; k < patch.z; ++k)
      for (int j = 0; j < patch.y; ++j)
        for (int i = 0; i < patch.x; ++i) {
          const Vec3i o{i, j, k};
          const double d = double(source[c][s + o]) - target[c][t + o];
          sum += d * d;
        }
  return sum / double(volume(patch));
}

bool mayUse(const Options& options, const Vec3i& s, const Vec3i& t, const Vec3i& sourceLast,
            const Vec3i& targetLast) {
  if (options.allowed && !(*options.allowed)[s]) return false;
  for (int axis = 0; axis < 3; ++axis) {
    if (options.window[axis] < 0) continue;
    const double center = targetLast[axis] == 0
                              ? sourceLast[axis] / 2
                              : std::round(double(t[axis]) * sourceLast[axis] / targetLast[axis]);
    if (std::abs(s[axis] - center) > options.window[axis]) return false;
  }
  return true;
}

void expectExact(const Channels& source, const Channels& target, const Options& options,
                 bool wholeNumbers) {
  const auto field = nearestNeighborField(source, target, options);
  const Vec3i sourceLast = source[0].size() - options.patch;
  const Vec3i targetLast = target[0].size() - options.patch;
  for (std::size_t n = 0; n < field.position.count(); ++n) {
    const Vec3i t = scaled(field.position.ijk(n), options.stride);
    ASSERT_TRUE(max(t, Vec3i{}) == t && min(t, targetLast) == t);
    Vec3i best{-1, -1, -1};
    double cost = std::numeric_limits<double>::infinity();
    for (int k = 0; k <= sourceLast.z; ++k)
      for (int j = 0; j <= sourceLast.y; ++j)
        for (int i = 0; i <= sourceLast.x; ++i) {
          const Vec3i s{i, j, k};
          if (!mayUse(options, s, t, sourceLast, targetLast)) continue;
          const double w = options.sourceWeight ? (*options.sourceWeight)[s] : 1;
          const double c = w * patchDistance(source, s, target, t, options.patch);
          if (c < cost) {
            cost = c;
            best = s;
          }
        }
    const Vec3i found = field.position.data()[n];
    ASSERT_TRUE(mayUse(options, found, t, sourceLast, targetLast));
    const double distance = patchDistance(source, found, target, t, options.patch);
    EXPECT_NEAR(field.distance.data()[n], distance, 1e-5 * distance + 1e-12);
    if (wholeNumbers) {
      EXPECT_EQ(found, best) << n;
    } else {
      const double w = options.sourceWeight ? (*options.sourceWeight)[found] : 1;
      EXPECT_LE(w * distance, cost * (1 + 1e-5));
    }
  }
}

TEST(NearestNeighborField, ExactFindsTheNearestPatch) {
  for (std::uint64_t trial = 0; trial < 12; ++trial) {
    const Random random(trial, 21);
    const Vec3i patch{1 + int(random.below(9, 0)), 1 + int(random.below(6, 1)),
                      1 + int(random.below(6, 2))};
    const Vec3i stride{1 + int(random.below(3, 3)), 1 + int(random.below(3, 4)),
                       1 + int(random.below(3, 5))};
    const int values = trial % 3 == 0 ? 256 : trial % 3 == 1 ? 2 : 1;
    const Channels source{levels(fields::noise(patch + Vec3i{9, 8, 7}, trial, values))};
    const Channels target{levels(fields::noise(patch + Vec3i{6, 7, 8}, trial + 50, values))};
    expectExact(source, target, {.patch = patch, .stride = stride}, true);
  }
}

TEST(NearestNeighborField, ExactFindsTheNearestPatchOfSmoothFields) {
  const auto a = fields::ballPacking(24, 5, 1), b = fields::ballPacking(24, 5, 2);
  expectExact({a}, {b}, {.patch = {7, 7, 7}, .stride = {3, 3, 3}}, false);
  expectExact({levels(fields::quantized(a, 4))}, {levels(fields::quantized(b, 4))},
              {.patch = {5, 5, 5}, .stride = {4, 4, 4}}, true);
  // An offset far from zero must not let rounding prune the nearest.
  Array3D<float> far = a, farther = b;
  for (float& v : far.values()) v += 1000;
  for (float& v : farther.values()) v += 1001;
  expectExact({far}, {farther}, {.patch = {5, 6, 4}, .stride = {4, 5, 4}}, false);
}

TEST(NearestNeighborField, ExactCountsAllChannels) {
  const Channels source{levels(fields::noise({12, 11, 10}, 1, 20)),
                        levels(fields::noise({12, 11, 10}, 2, 20))};
  const Channels target{levels(fields::noise({10, 10, 10}, 3, 20)),
                        levels(fields::noise({10, 10, 10}, 4, 20))};
  expectExact(source, target, {.patch = {3, 4, 5}}, true);
}

TEST(NearestNeighborField, ExactHonorsMasksWeightsAndWindows) {
  const Channels source{levels(fields::quantized(fields::terrain(20, 1), 4))};
  const Channels target{levels(fields::quantized(fields::terrain(20, 2), 4))};
  const auto allowed = fields::randomMask({20, 20, 20}, 0.4, 1);
  Array3D<float> weight({20, 20, 20});
  // Powers of two: costs stay exact.
  for (std::size_t i = 0; i < weight.count(); ++i)
    weight.data()[i] = std::exp2(float(Random(5).below(5, i)) - 2);
  const Vec3i patch{4, 5, 6}, stride{3, 3, 3};
  expectExact(source, target, {.patch = patch, .stride = stride, .allowed = &allowed}, true);
  expectExact(source, target, {.patch = patch, .stride = stride, .sourceWeight = &weight}, true);
  expectExact(source, target, {.patch = patch, .stride = stride, .window = {-1, 4, 0}}, true);
  expectExact(source, target,
              {.patch = patch,
               .stride = stride,
               .allowed = &allowed,
               .sourceWeight = &weight,
               .window = {9, -1, 3}},
              true);
}

TEST(NearestNeighborField, AWindowWithoutAnAllowedPositionDoesNotCount) {
  const Channels source{levels(fields::noise({12, 12, 12}, 1))};
  Array3D<std::uint8_t> allowed({12, 12, 12}, 0);
  allowed(8, 0, 0) = 1;
  for (auto method : {NeighborMethod::Exact, NeighborMethod::PatchMatch}) {
    const auto field = nearestNeighborField(
        source, source,
        {.patch = {4, 4, 4}, .method = method, .allowed = &allowed, .window = {1, 1, 1}});
    for (const Vec3i& p : field.position.values()) EXPECT_EQ(p, (Vec3i{8, 0, 0}));
  }
}

TEST(NearestNeighborField, EachPatchIsMatchedInItsPlace) {
  const Channels source{levels(fields::noise({20, 14, 12}, 1))},
      target{levels(fields::noise({14, 13, 12}, 2))};
  const CellBox places[] = {{{0, 0, 0}, {6, 11, 9}}, {{9, 2, 1}, {17, 11, 9}}};
  Options options;
  options.patch = {4, 4, 4};
  options.window = {-1, -1, 2};
  options.places = places;
  Array3D<std::uint16_t> placeOf({11, 10, 9});
  forEachCell(placeOf.size(), [&](const Vec3i& p) { placeOf[p] = (p.x / 3 + p.y) % 2; });
  options.placeOf = &placeOf;
  for (const NeighborMethod method : {NeighborMethod::Exact, NeighborMethod::PatchMatch}) {
    options.method = method;
    const auto field = nearestNeighborField(source, target, options);
    forEachCell(placeOf.size(), [&](const Vec3i& p) {
      const CellBox& place = places[placeOf[p]];
      ASSERT_TRUE(place.contains(field.position[p]));
      // The window is one of the place: its middle goes from the place's first layer to its last.
      const double middle = place.begin.z + p.z * (place.end.z - 1 - place.begin.z) / 8.0;
      ASSERT_LE(std::abs(field.position[p].z - middle), 2.5);
      if (method != NeighborMethod::Exact) return;
      double least = std::numeric_limits<double>::infinity();
      forEachCell(place, [&](const Vec3i& q) {
        if (std::abs(q.z - std::lround(middle)) <= 2)
          least = std::min(least, patchDistance(source, q, target, p, options.patch));
      });
      EXPECT_NEAR(field.distance[p], least, 1e-5 * least + 1e-9);
    });
  }
}

TEST(NearestNeighborField, TheSourceMatchesItself) {
  const Channels source{fields::ballPacking(20, 4, 1)};
  const auto field = nearestNeighborField(source, source, {.patch = {5, 5, 5}});
  for (std::size_t i = 0; i < field.position.count(); ++i) {
    EXPECT_EQ(field.distance.data()[i], 0);
  }
}

TEST(NearestNeighborField, PatchMatchIsNearlyAsNear) {
  const Channels source{fields::ballPacking(32, 5, 1)}, target{fields::ballPacking(32, 5, 2)};
  const Options options{.patch = {7, 7, 7}, .stride = {2, 2, 2}};
  Options approximate = options;
  approximate.method = NeighborMethod::PatchMatch;
  const auto exact = nearestNeighborField(source, target, options);
  const auto near = nearestNeighborField(source, target, approximate);
  approximate.iterations = 1;
  const auto once = nearestNeighborField(source, target, approximate);
  double exactSum = 0, nearSum = 0, onceSum = 0;
  for (std::size_t i = 0; i < exact.distance.count(); ++i) {
    EXPECT_GE(near.distance.data()[i], exact.distance.data()[i]);
    exactSum += exact.distance.data()[i];
    nearSum += near.distance.data()[i];
    onceSum += once.distance.data()[i];
  }
  EXPECT_LT(nearSum, 1.6 * exactSum);
  EXPECT_LT(nearSum, onceSum);
  // Started from the answer it stays there.
  approximate.start = &exact;
  EXPECT_EQ(nearestNeighborField(source, target, approximate).distance, exact.distance);
}

TEST(NearestNeighborField, IsTheSameAtOneAndEightThreads) {
  const Channels source{fields::terrain(30, 1)}, target{fields::terrain(30, 2)};
  for (auto method : {NeighborMethod::Exact, NeighborMethod::PatchMatch}) {
    const auto make = [&] {
      return nearestNeighborField(
          source, target, {.patch = {6, 6, 6}, .method = method, .iterations = 2, .seed = 4});
    };
    const auto a = testing::onThreads(1, make), b = testing::onThreads(8, make);
    EXPECT_EQ(a.position, b.position);
    EXPECT_EQ(a.distance, b.distance);
  }
}

TEST(NearestNeighborField, ReportsAndStops) {
  const Channels source{fields::terrain(30, 1)};
  for (auto method : {NeighborMethod::Exact, NeighborMethod::PatchMatch})
    testing::expectReportsAndStops(8, [&](const Progress& progress) {
      return nearestNeighborField(source, source, {.method = method}, progress);
    });
}

TEST(NearestNeighborField, RefusesOptionsOutOfRange) {
  const Channels a{Array3D<float>({9, 9, 9})}, two{a[0], a[0]},
      uneven{a[0], Array3D<float>({9, 9, 8})};
  const Array3D<std::uint8_t> none({9, 9, 9}, 0), small({3, 3, 3}, 1);
  const Array3D<float> zero({9, 9, 9}, 0);
  EXPECT_THROW(nearestNeighborField(a, two), InputError);
  EXPECT_THROW(nearestNeighborField(uneven, uneven), InputError);
  EXPECT_THROW(nearestNeighborField({}, {}), InputError);
  EXPECT_THROW(nearestNeighborField(a, a, {.patch = {10, 7, 7}}), InputError);
  EXPECT_THROW(nearestNeighborField(a, a, {.stride = {0, 1, 1}}), InputError);
  EXPECT_THROW(nearestNeighborField(a, a, {.iterations = 0}), InputError);
  EXPECT_THROW(nearestNeighborField(a, a, {.allowed = &none}), InputError);
  EXPECT_THROW(nearestNeighborField(a, a, {.allowed = &small}), InputError);
  EXPECT_THROW(nearestNeighborField(a, a, {.sourceWeight = &zero}), InputError);
  const Array3D<std::uint16_t> first({3, 3, 3}, 0), second({3, 3, 3}, 1), few({2, 3, 3}, 0);
  const CellBox inside{{0, 0, 0}, {3, 3, 3}}, outside{{1, 0, 0}, {4, 3, 3}}, empty{};
  const auto placed = [&](const CellBox& place, const Array3D<std::uint16_t>& of) {
    nearestNeighborField(a, a, {.places = {&place, 1}, .placeOf = &of});
  };
  placed(inside, first);
  EXPECT_THROW(placed(outside, first), InputError);
  EXPECT_THROW(placed(empty, first), InputError);
  EXPECT_THROW(placed(inside, second), InputError);
  EXPECT_THROW(placed(inside, few), InputError);
}

TEST(NearestNeighborField, PatchesThatAreNotWantedKeepTheirStart) {
  const Channels source{levels(fields::noise({14, 13, 12}, 1))},
      target{levels(fields::noise({15, 12, 11}, 2))};
  Options options;
  options.patch = {4, 3, 3};
  const auto all = nearestNeighborField(source, target, options);
  NearestNeighborField start = all;
  for (Vec3i& p : start.position.values()) p = {1, 2, 3};
  Array3D<std::uint8_t> wanted(all.position.size());
  for (std::size_t n = 0; n < wanted.count(); ++n) wanted.values()[n] = n % 3 == 0;
  options.start = &start;
  options.wanted = &wanted;
  for (const NeighborMethod method : {NeighborMethod::Exact, NeighborMethod::PatchMatch}) {
    options.method = method;
    const auto some = nearestNeighborField(source, target, options);
    for (std::size_t n = 0; n < wanted.count(); ++n) {
      const Vec3i p = wanted.ijk(n);
      const double there = patchDistance(source, {1, 2, 3}, target, p, options.patch);
      if (!wanted[p]) {
        ASSERT_EQ(some.position[p], (Vec3i{1, 2, 3}));
        ASSERT_NEAR(some.distance[p], there, 1e-3 * there + 1e-6);
      } else if (method == NeighborMethod::Exact) {
        ASSERT_EQ(some.distance[p], all.distance[p]);
      } else {
        ASSERT_LE(some.distance[p], there * 1.001 + 1e-6);
      }
    }
  }
  options.start = nullptr;
  EXPECT_THROW(nearestNeighborField(source, target, options), InputError);
  options.start = &start;
  wanted = Array3D<std::uint8_t>({2, 2, 2});
  EXPECT_THROW(nearestNeighborField(source, target, options), InputError);
}

}  // namespace
}  // namespace exemplar
