// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/objects/stretched_object.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>

#include "core/cells.h"
#include "core/parallel.h"
#include "sdf/resample.h"

namespace exemplar {
namespace {

// What these constants trade and what chose them: docs/synthesis.md, "Constants".

/// Halvings of what is searched for.
constexpr int kHalvings = 7;
/// A place is on the medial axis where no ball so far away, samples, is larger by as much as this
/// share of the way: across a face it would be 1, at a square edge it is 0.7.
constexpr int kBallReach = 2;
constexpr double kCovers = 0.93;
/// Balls are this share of their radius apart: stretched to twice that, the surface between two of
/// them is within 1.5 % of it.
constexpr double kApart = 1.0 / 6;
/// Distances are known up to here, voxels.
constexpr float kFar = 6;

struct Ball {
  Vec3d from;     ///< its center in the example, samples
  Vec3d to;       ///< and in the result
  double radius;  ///< in the example, voxels
};

Vec3i sizeOf(const AxisPlaces& places) {
  Vec3i size;
  for (int axis = 0; axis < 3; ++axis)
    size[axis] = static_cast<int>(places[static_cast<std::size_t>(axis)].size());
  return size;
}

/// Where in the result a place of the example is, along one axis.
double placeOf(const std::vector<double>& places, double at) {
  const auto above = std::lower_bound(places.begin(), places.end(), at);
  if (above == places.begin()) return at - places.front();
  const auto last = static_cast<double>(places.size()) - 1;
  if (above == places.end()) return last + at - places.back();
  const double low = *(above - 1), high = *above;
  return static_cast<double>(above - places.begin()) - (high - at) / (high - low);
}

double solidShare(const Array3D<float>& values) {
  const std::int64_t solid =
      std::count_if(values.values().begin(), values.values().end(), [](float v) { return v < 0; });
  return static_cast<double>(solid) / static_cast<double>(values.count());
}

/// Places drawn toward even ones by a share.
AxisPlaces evened(const AxisPlaces& places, const Vec3i& example, double share) {
  AxisPlaces mixed = places;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!isInOrder(places[axis])) continue;
    const auto count = static_cast<double>(places[axis].size());
    const double n = example[static_cast<int>(axis)];
    for (std::size_t i = 0; i < mixed[axis].size(); ++i) {
      const double even = std::clamp((static_cast<double>(i) + 0.5) * n / count - 0.5, 0.0, n - 1);
      mixed[axis][i] = std::lerp(places[axis][i], even, share);
    }
  }
  return mixed;
}

Vec3d placeAt(const AxisPlaces& places, const Vec3i& p) {
  Vec3d at;
  for (int axis = 0; axis < 3; ++axis)
    at[axis] = places[static_cast<std::size_t>(axis)][static_cast<std::size_t>(p[axis])];
  return at;
}

/// The solid share of an example stretched as space is, from every other sample.
double stretchedShare(const Array3D<float>& example, const AxisPlaces& places) {
  constexpr int kStride = 2;
  const Vec3i size = sizeOf(places);
  std::int64_t solid = 0, all = 0;
  for (int k = 0; k < size.z; k += kStride)
    for (int j = 0; j < size.y; j += kStride)
      for (int i = 0; i < size.x; i += kStride, ++all) {
        const Vec3d at = placeAt(places, {i, j, k});
        solid += example[{static_cast<int>(std::lround(at.x)), static_cast<int>(std::lround(at.y)),
                          static_cast<int>(std::lround(at.z))}] < 0;
      }
  return static_cast<double>(solid) / static_cast<double>(all);
}

/// Of large balls, which have many others near them, leaves one in each cube of a share of their
/// radius.
void thinOut(const DistanceField& example, Array3D<std::uint8_t>& medial) {
  std::set<std::array<int, 4>> filled;
  forEachCell(medial.size(), [&](const Vec3i& p) {
    if (!medial[p]) return;
    const int side = static_cast<int>(-example.values[p] / example.voxelSize * kApart);
    if (side < 2) return;
    medial[p] = filled.insert({side, p.x / side, p.y / side, p.z / side}).second;
  });
}

/// The balls of an object's medial axis, and those halfway between neighbors, so that there are no
/// gaps where they move apart.
std::vector<Ball> medialBalls(const DistanceField& example, const AxisPlaces& places) {
  const Array3D<float>& values = example.values;
  const double voxel = example.voxelSize;
  const Vec3i n = values.size();
  Array3D<std::uint8_t> medial(n);
  parallelForEachCell(n, [&](const Vec3i& p) {
    if (!(values[p] < 0)) return;
    bool covered = false;
    forEachCell(CellBox{p, p + Vec3i{1, 1, 1}}.grown(kBallReach), [&](const Vec3i& q) {
      if (covered || q == p || !values.contains(q)) return;
      const Vec3i d = q - p;
      const double way = std::sqrt(static_cast<double>(dot(d, d)));
      covered = (values[p] - values[q]) / voxel >= kCovers * way;
    });
    medial[p] = !covered;
  });
  thinOut(example, medial);
  std::vector<Ball> balls;
  const auto add = [&](const Vec3d& from, double radius) {
    Ball ball{from, {}, radius};
    for (int axis = 0; axis < 3; ++axis)
      ball.to[axis] = placeOf(places[static_cast<std::size_t>(axis)], from[axis]);
    balls.push_back(ball);
  };
  forEachCell(n, [&](const Vec3i& p) {
    if (!medial[p]) return;
    const double radius = -values[p] / voxel;
    add(cast<double>(p), radius);
    forEachCell(CellBox{p, p + Vec3i{1, 1, 1}}.grown(1), [&](const Vec3i& q) {
      // Each pair once.
      if (!values.contains(q) || !medial[q] ||
          values.index(q.x, q.y, q.z) <= values.index(p.x, p.y, p.z))
        return;
      add((cast<double>(p) + cast<double>(q)) * 0.5, (radius - values[q] / voxel) / 2);
    });
  });
  return balls;
}

/// The union of balls that are `larger`, on every `stride`-th sample of a result.
StretchedObject unionOf(const std::vector<Ball>& balls, double larger, const Vec3i& size,
                        int stride) {
  const Vec3i coarse{(size.x + stride - 1) / stride, (size.y + stride - 1) / stride,
                     (size.z + stride - 1) / stride};
  StretchedObject made{Array3D<float>(coarse, kFar), Array3D<Vec3f>(coarse)};
  Array3D<std::uint32_t> nearest(coarse, static_cast<std::uint32_t>(balls.size()));
  parallelFor(0, static_cast<std::size_t>(coarse.z), 1, [&](std::size_t low, std::size_t high) {
    for (std::size_t b = 0; b < balls.size(); ++b) {
      const Ball& ball = balls[b];
      const double radius = larger * ball.radius, reach = radius + kFar;
      CellBox box{{0, 0, static_cast<int>(low)}, {coarse.x, coarse.y, static_cast<int>(high)}};
      for (int axis = 0; axis < 3; ++axis) {
        const double first = (ball.to[axis] - reach) / stride,
                     last = (ball.to[axis] + reach) / stride;
        box.begin[axis] = std::max(box.begin[axis], static_cast<int>(std::ceil(first)));
        box.end[axis] = std::min(box.end[axis], static_cast<int>(std::floor(last)) + 1);
      }
      for (int axis = 0; axis < 3; ++axis)
        if (box.begin[axis] >= box.end[axis]) box = {};
      forEachCell(box, [&](const Vec3i& p) {
        const auto d = static_cast<float>(length(cast<double>(p * stride) - ball.to) - radius);
        if (d >= made.values[p]) return;
        made.values[p] = d;
        nearest[p] = static_cast<std::uint32_t>(b);
      });
    }
  });
  parallelForEachCell(coarse, [&](const Vec3i& p) {
    if (nearest[p] == balls.size()) return;
    const Ball& ball = balls[nearest[p]];
    made.places[p] = cast<float>(ball.from + (cast<double>(p * stride) - ball.to) * (1 / larger));
  });
  return made;
}

}  // namespace

double StretchedObject::solidRatio(const DistanceField& example) const {
  return solidShare(values) / std::max(1e-12, solidShare(example.values));
}

StretchedObject stretchSpace(const DistanceField& example, const AxisPlaces& places,
                             const Progress& progress) {
  const double wanted = solidShare(example.values);
  const auto off = [&](const AxisPlaces& of) {
    return std::abs(stretchedShare(example.values, of) / std::max(1e-12, wanted) - 1);
  };
  AxisPlaces drawn = places;
  if (off(drawn) > kSolidBound) {
    double low = 0, high = 1;
    for (int halving = 0; halving < kHalvings; ++halving) {
      progress.check();
      const double middle = (low + high) / 2;
      (off(evened(places, example.size(), middle)) > kSolidBound ? low : high) = middle;
    }
    drawn = evened(places, example.size(), high);
  }
  const Vec3i size = sizeOf(places);
  StretchedObject made{Array3D<float>(size), Array3D<Vec3f>(size)};
  parallelForEachCell(size, [&](const Vec3i& p) {
    const Vec3d at = placeAt(drawn, p);
    made.values[p] = static_cast<float>(cubicAt(example.values, at) / example.voxelSize);
    made.places[p] = cast<float>(at);
  });
  return made;
}

StretchedObject stretchSkeleton(const DistanceField& example, const AxisPlaces& places,
                                const Progress& progress) {
  const std::vector<Ball> balls = medialBalls(example, places);
  const Vec3i size = sizeOf(places);
  const double wanted = solidShare(example.values);
  double low = 1, high = 1;
  for (int axis = 0; axis < 3; ++axis)
    high = std::max(high, static_cast<double>(size[axis]) / example.size()[axis]);
  for (int halving = 0; halving < kHalvings; ++halving) {
    progress.check();
    const double middle = (low + high) / 2;
    const StretchedObject made = unionOf(balls, middle, size, 2);
    (solidShare(made.values) < wanted ? low : high) = middle;
  }
  StretchedObject made = unionOf(balls, (low + high) / 2, size, 1);
  // Far from all balls a sample shows what space would.
  parallelForEachCell(size, [&](const Vec3i& p) {
    if (made.values[p] >= kFar) made.places[p] = cast<float>(placeAt(places, p));
  });
  return made;
}

}  // namespace exemplar
