// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "fields.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace exemplar::fields {

namespace {

Vec3d randomUnit(const Random& random, std::uint64_t cell) {
  return normalized(Vec3d{random.normal(cell, 0), random.normal(cell, 2), random.normal(cell, 4)});
}

double torusDistance(const Vec3d& p, const Vec3d& center, const Vec3d& axis, double radius,
                     double thickness) {
  const Vec3d d = p - center;
  const double along = dot(d, axis);
  return std::hypot(length(d - along * axis) - radius, along) - thickness;
}

// Value noise with quintic interpolation, in -1..1.
double smoothNoise(const Random& random, double x, double y, int octave) {
  const double fx = std::floor(x), fy = std::floor(y);
  const auto at = [&](int i, int j) {
    const auto u = static_cast<std::uint32_t>(static_cast<int>(fx) + i + 4096);
    const auto v = static_cast<std::uint32_t>(static_cast<int>(fy) + j + 4096);
    return random.uniform(-1, 1, (std::uint64_t{u} << 32) | v, static_cast<std::uint32_t>(octave));
  };
  const auto ease = [](double t) { return t * t * t * (t * (t * 6 - 15) + 10); };
  const double u = ease(x - fx), v = ease(y - fy);
  return (at(0, 0) * (1 - u) + at(1, 0) * u) * (1 - v) + (at(0, 1) * (1 - u) + at(1, 1) * u) * v;
}

template <class Distance>
Array3D<float> sampled(int n, const Distance& distance) {
  Array3D<float> field({n, n, n});
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        field(i, j, k) = static_cast<float>(distance(Vec3d{i + 0.5, j + 0.5, k + 0.5}));
  return field;
}

}  // namespace

Array3D<float> ballPacking(int n, double radius, std::uint64_t seed) {
  const Random random(seed, 0x6261);
  const double side = n / radius;  // in radii
  const auto count =
      static_cast<std::size_t>(0.6 * side * side * side / (4.0 / 3 * std::numbers::pi));
  std::vector<Vec3d> centers(count);
  for (std::size_t b = 0; b < count; ++b)
    centers[b] = {random.uniform(0, side, b, 0), random.uniform(0, side, b, 1),
                  random.uniform(0, side, b, 2)};
  const auto wrapped = [side](double d) { return d - side * std::round(d / side); };
  const auto between = [&](const Vec3d& a, const Vec3d& b) {
    return Vec3d{wrapped(b.x - a.x), wrapped(b.y - a.y), wrapped(b.z - a.z)};
  };
  // Overlapping balls push each other apart until hardly any overlap is left.
  for (int round = 0; round < 400; ++round) {
    std::vector<Vec3d> moves(count);
    for (std::size_t a = 0; a < count; ++a)
      for (std::size_t b = a + 1; b < count; ++b) {
        const Vec3d d = between(centers[a], centers[b]);
        const double l = length(d);
        if (l >= 2.02 || l == 0) continue;
        const Vec3d push = d * (0.35 * (2.02 - l) / l);
        moves[a] -= push;
        moves[b] += push;
      }
    for (std::size_t b = 0; b < count; ++b) {
      centers[b] += moves[b];
      for (int axis = 0; axis < 3; ++axis)
        centers[b][axis] -= side * std::floor(centers[b][axis] / side);
    }
  }
  Array3D<float> field({n, n, n}, static_cast<float>(2 * radius));
  // Each ball reaches the samples within two radii of its surface; pores are smaller than that.
  const double reach = 3 * radius;
  for (const Vec3d& c : centers) {
    const Vec3d center = c * radius;
    const auto first = [&](double x) { return static_cast<int>(std::floor(x - reach)); };
    const auto last = [&](double x) { return static_cast<int>(std::ceil(x + reach)); };
    const auto wrap = [n](int i) { return ((i % n) + n) % n; };
    for (int k = first(center.z); k < std::min(last(center.z), first(center.z) + n); ++k)
      for (int j = first(center.y); j < std::min(last(center.y), first(center.y) + n); ++j)
        for (int i = first(center.x); i < std::min(last(center.x), first(center.x) + n); ++i) {
          const Vec3d p{i + 0.5, j + 0.5, k + 0.5};
          float& value = field(wrap(i), wrap(j), wrap(k));
          value = std::min(value, static_cast<float>(length(p - center) - radius));
        }
  }
  return field;
}

Array3D<float> terrain(int n, std::uint64_t seed) {
  const Random random(seed, 0x7465);
  const auto height = [&](double x, double y) {
    double h = 0, amplitude = 0.22 * n, frequency = 2.5 / n;
    for (int octave = 0; octave < 6; ++octave) {
      const double noise = smoothNoise(random, x * frequency, y * frequency, octave);
      h += amplitude * (0.5 - std::abs(noise));  // folded: sharp ridges
      amplitude *= 0.48;
      frequency *= 2.05;
    }
    return 0.45 * n + h;
  };
  // Columns of the surface every half sample, and for each sample the nearest of their tops, found
  // by passing it on from neighbor to neighbor.
  const int m = 2 * n;
  std::vector<float> heights(static_cast<std::size_t>(m) * m);
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < m; ++i)
      heights[static_cast<std::size_t>(j) * m + i] =
          static_cast<float>(height((i + 0.5) / 2, (j + 0.5) / 2));
  struct Nearest {
    std::int16_t i, j;
    float squared;
  };
  Array3D<Nearest> nearest({n, n, n});
  const auto offer = [&](Nearest& best, const Vec3i& p, int i, int j) {
    if (i < 0 || j < 0 || i >= m || j >= m) return;
    const float dx = static_cast<float>(p.x) + 0.5f - (static_cast<float>(i) + 0.5f) / 2;
    const float dy = static_cast<float>(p.y) + 0.5f - (static_cast<float>(j) + 0.5f) / 2;
    const float dz = static_cast<float>(p.z) + 0.5f - heights[static_cast<std::size_t>(j) * m + i];
    const float squared = dx * dx + dy * dy + dz * dz;
    if (squared < best.squared)
      best = {static_cast<std::int16_t>(i), static_cast<std::int16_t>(j), squared};
  };
  for (std::size_t v = 0; v < nearest.count(); ++v) {
    const Vec3i p = nearest.ijk(v);
    nearest.data()[v] = {0, 0, 1e30f};
    for (int c = 0; c < 4; ++c) offer(nearest.data()[v], p, 2 * p.x + (c & 1), 2 * p.y + (c >> 1));
  }
  for (int round = 0; round < 4; ++round) {
    const int side = round % 2 == 0 ? -1 : 1;
    for (std::size_t v = 0; v < nearest.count(); ++v) {
      const std::size_t at = side < 0 ? v : nearest.count() - 1 - v;
      const Vec3i p = nearest.ijk(at);
      Nearest& best = nearest.data()[at];
      for (const Vec3i& step : {Vec3i{1, 0, 0}, Vec3i{0, 1, 0}, Vec3i{0, 0, 1}}) {
        const Vec3i from = p + step * side;
        if (!nearest.contains(from)) continue;
        const Nearest other = nearest[from];
        offer(best, p, other.i, other.j);
        offer(best, p, other.i - side * step.x, other.j - side * step.y);
      }
    }
  }
  Array3D<float> field({n, n, n});
  for (std::size_t v = 0; v < field.count(); ++v) {
    const Vec3i p = field.ijk(v);
    const float top = heights[static_cast<std::size_t>(2 * p.y) * m + 2 * p.x];
    const float distance = std::sqrt(nearest.data()[v].squared);
    field.data()[v] = static_cast<float>(p.z) + 0.5f < top ? -distance : distance;
  }
  return field;
}

Array3D<float> chainmail(int n, double pitch, std::uint64_t seed) {
  const Random random(seed, 0x6368);
  struct Ring {
    Vec3d center, axis;
  };
  std::vector<Ring> rings;
  const double radius = 0.62 * pitch, thickness = 0.11 * pitch;
  const int across = static_cast<int>(std::ceil(n / pitch)) + 2;
  // Rows half a pitch apart, every other row shifted by half a pitch and leaning the other way.
  for (int row = -2; row < 2 * across; ++row)
    for (int column = -2; column < across; ++column) {
      const std::uint64_t cell = (static_cast<std::uint64_t>(row + 8) << 20) | (column + 8);
      const auto jitter = [&](std::uint32_t draw) { return 0.03 * random.normal(cell, draw); };
      const double lean = row % 2 == 0 ? 0.5 : -0.5;
      rings.push_back({{(column + (row % 2 == 0 ? 0.0 : 0.5) + jitter(0)) * pitch,
                        (0.5 * row + jitter(2)) * pitch, 0.5 * n + jitter(4) * pitch},
                       normalized(Vec3d{jitter(6), std::sin(lean) + jitter(8), std::cos(lean)})});
    }
  return sampled(n, [&](const Vec3d& p) {
    double nearest = n;
    for (const Ring& ring : rings)
      if (length(p - ring.center) < nearest + radius + thickness)
        nearest = std::min(nearest, torusDistance(p, ring.center, ring.axis, radius, thickness));
    return nearest;
  });
}

Array3D<float> shape(int n, Shape kind, std::uint64_t seed) {
  const Random random(seed, 0x7368);
  const Vec3d center{random.uniform(0.3, 0.7, 0) * n, random.uniform(0.3, 0.7, 1) * n,
                     random.uniform(0.3, 0.7, 2) * n};
  const double size = random.uniform(0.15, 0.3, 3) * n;
  const Vec3d axis = randomUnit(random, 4);
  const Vec3d second = normalized(cross(axis, randomUnit(random, 5)));
  const Vec3d third = cross(axis, second);
  return sampled(n, [&](const Vec3d& p) -> double {
    if (kind == Shape::Ball) return length(p - center) - size;
    if (kind == Shape::Torus) return torusDistance(p, center, axis, size, size / 3);
    const Vec3d d = p - center;
    const Vec3d q{std::abs(dot(d, axis)) - size, std::abs(dot(d, second)) - size * 0.7,
                  std::abs(dot(d, third)) - size * 0.4};
    return length(max(q, Vec3d{})) + std::min(0.0, std::max({q.x, q.y, q.z}));
  });
}

Array3D<std::uint8_t> noise(const Vec3i& size, std::uint64_t seed, int levels) {
  const Random random(seed, 0x6e6f);
  Array3D<std::uint8_t> field(size);
  for (std::size_t i = 0; i < field.count(); ++i)
    field.data()[i] =
        static_cast<std::uint8_t>(random.below(static_cast<std::uint32_t>(levels), i));
  return field;
}

Array3D<std::uint8_t> quantized(const Array3D<float>& field, double range) {
  Array3D<std::uint8_t> levels(field.size());
  for (std::size_t i = 0; i < field.count(); ++i)
    levels.data()[i] = static_cast<std::uint8_t>(
        std::lround((std::clamp<double>(field.data()[i], -range, range) + range) / range * 127.5));
  return levels;
}

Array3D<std::uint8_t> withoutOctant(const Vec3i& size, int octant) {
  Array3D<std::uint8_t> known(size, 1);
  for (std::size_t i = 0; i < known.count(); ++i) {
    const Vec3i p = known.ijk(i);
    if ((2 * p.x >= size.x) == ((octant & 1) != 0) && (2 * p.y >= size.y) == ((octant & 2) != 0) &&
        (2 * p.z >= size.z) == ((octant & 4) != 0))
      known.data()[i] = 0;
  }
  return known;
}

Array3D<std::uint8_t> randomMask(const Vec3i& size, double known, std::uint64_t seed) {
  const Random random(seed, 0x6d61);
  Array3D<std::uint8_t> mask(size);
  for (std::size_t i = 0; i < mask.count(); ++i) mask.data()[i] = random.uniform(i) < known;
  return mask;
}

}  // namespace exemplar::fields
