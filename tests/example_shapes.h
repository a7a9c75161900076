// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "core/cells.h"
#include "core/random.h"
#include "sdf/distance_field.h"

/// One example of each kind that people bring, made from formulas: free-standing objects with air
/// on all sides (vase, tree, village, stairs, arch, boulder, temple), materials that fill their box
/// (porous, packing), and ground that is cut at its sides (terrain).
///
/// Voxels have length 1, distances are clamped to ±16 and right in sign; they are exact or a lower
/// bound where parts blend. `side` is the longest side of the box in samples, at least 32; another
/// `seed` is another sample of the same process.
namespace exemplar::testing {

inline constexpr double kShapeTruncation = 16;  ///< voxels
inline constexpr int kShapeAir = 4;             ///< voxels of air around a free-standing object

/// The field whose sample at p is `phi(p)`, clamped.
template <class Phi>
DistanceField shapeField(const Vec3i& size, const Phi& phi) {
  DistanceField field;
  field.values = Array3D<float>(size);
  field.truncation = static_cast<float>(kShapeTruncation);
  parallelForEachCell(size, [&](const Vec3i& p) {
    field.values[p] =
        static_cast<float>(std::clamp(phi(cast<double>(p)), -kShapeTruncation, kShapeTruncation));
  });
  return field;
}

// Solids, as distances.

inline double boxDistance(const Vec3d& p, const Vec3d& low, const Vec3d& high) {
  const Vec3d q = max(low - p, p - high);
  return length(max(q, Vec3d{})) + std::min(0.0, std::max({q.x, q.y, q.z}));
}
/// A cone from a to b with rounded ends; a capsule where the radii are equal.
inline double limbDistance(const Vec3d& p, const Vec3d& a, const Vec3d& b, double ra, double rb) {
  const Vec3d ab = b - a;
  const double t = std::clamp(dot(p - a, ab) / std::max(1e-9, dot(ab, ab)), 0.0, 1.0);
  return length(p - a - ab * t) - (ra + (rb - ra) * t);
}
/// An upright cylinder.
inline double columnDistance(const Vec3d& p, double x, double y, double z0, double z1, double r) {
  const double side = std::hypot(p.x - x, p.y - y) - r, end = std::max(z0 - p.z, p.z - z1);
  return std::hypot(std::max(side, 0.0), std::max(end, 0.0)) + std::min(0.0, std::max(side, end));
}
/// A gabled roof over the rectangle low..high (x, y), whose ridge runs along x.
inline double gableDistance(const Vec3d& p, const Vec3d& low, const Vec3d& high) {
  const double half = (high.y - low.y) / 2, rise = high.z - low.z;
  const double slope =
      (std::abs(p.y - (low.y + half)) * rise + (p.z - low.z) * half - rise * half) /
      std::hypot(rise, half);
  return std::max({slope, low.z - p.z, low.x - p.x, p.x - high.x});
}

/// Smooth noise of about -1..1 with features of `scale` voxels: random values at the corners of a
/// lattice, blended by a quintic.
inline double shapeNoise(const Vec3d& p, double scale, std::uint64_t seed) {
  const Random random(seed, 81);
  const Vec3d q = p / scale;
  const Vec3i c{static_cast<int>(std::floor(q.x)), static_cast<int>(std::floor(q.y)),
                static_cast<int>(std::floor(q.z))};
  const auto fade = [](double t) { return t * t * t * (t * (6 * t - 15) + 10); };
  const Vec3d f{fade(q.x - c.x), fade(q.y - c.y), fade(q.z - c.z)};
  double sum = 0;
  for (int n = 0; n < 8; ++n) {
    const int i = n & 1, j = n >> 1 & 1, k = n >> 2;
    const auto key = [](int v) { return static_cast<std::uint64_t>(v + 1024) & 4095; };
    const std::uint64_t cell = key(c.x + i) | key(c.y + j) << 12 | key(c.z + k) << 24;
    sum += random.uniform(-1, 1, cell) * (i ? f.x : 1 - f.x) * (j ? f.y : 1 - f.y) *
           (k ? f.z : 1 - f.z);
  }
  return sum;
}

// Free-standing objects.

/// A thin shell: a fluted vase, open above, with walls of about three voxels and one handle.
inline DistanceField vase(int side = 64, std::uint64_t seed = 0) {
  const Random random(seed, 82);
  const double s = side, bottom = kShapeAir, top = s - 1 - kShapeAir, axis = (s - 1) * 0.42;
  const double belly = s * random.uniform(0.27, 0.31, 0), neck = s * random.uniform(0.12, 0.16, 1);
  const double phase = random.uniform(0, 2 * std::numbers::pi, 2);
  const auto radius = [=](double z, double angle) {
    const double t = std::clamp((z - bottom) / (top - bottom), 0.0, 1.0);
    const double bulge = std::sin(std::numbers::pi * std::pow(t, 0.75) * 1.12);
    const double r = neck + (belly - neck) * std::max(0.0, bulge) + 0.04 * s * t * t * t;
    return r + 0.012 * s * std::cos(11 * angle + phase) * std::sin(std::numbers::pi * t);
  };
  constexpr double kHalf = 1.5;  // of the wall
  return shapeField({side, static_cast<int>(side * 0.85), side}, [&](const Vec3d& p) {
    const double x = p.x - axis, y = p.y - axis, r = std::hypot(x, y);
    double wall = std::abs(r - radius(p.z, std::atan2(y, x))) - kHalf;
    wall = std::max({wall, bottom - p.z, p.z - top});
    const double floor = std::max({r - radius(bottom, 0), bottom - p.z, p.z - bottom - 2 * kHalf});
    // The handle: half a ring beside the neck.
    const double cz = bottom + 0.66 * (top - bottom), reach = 0.17 * s;
    const double cx = axis + neck + 0.11 * s;
    const double ring =
        std::hypot(std::hypot(p.x - cx, p.z - cz) - reach, p.y - axis) - 0.03 * s - 0.5;
    const double handle = std::max(ring, radius(p.z, 0) + axis - p.x);
    return std::min({wall, floor, handle});
  });
}

/// A tree on a trunk: tapering limbs that fork, with clumps of leaves at their ends.
inline DistanceField tree(int side = 64, std::uint64_t seed = 0) {
  struct Limb {
    Vec3d a, b;
    double ra, rb;
  };
  const Random random(seed, 83);
  const double s = side, middle = (s * 0.9 - 1) / 2;
  std::vector<Limb> limbs;
  std::vector<Vec3d> ends;
  std::uint64_t draw = 0;
  const std::function<void(Vec3d, Vec3d, double, double, int)> grow =
      [&](Vec3d from, Vec3d direction, double reach, double r, int depth) {
        const Vec3d to = from + direction * reach;
        limbs.push_back({from, to, r, r * 0.7});
        if (depth == 0) return ends.push_back(to);
        const int forks = depth == 3 ? 4 : 2;
        const double turn = random.uniform(0, 2 * std::numbers::pi, draw++);
        for (int f = 0; f < forks; ++f) {
          const double angle =
              turn + (f + random.uniform(-0.2, 0.2, draw++)) * 2 * std::numbers::pi / forks;
          const double lean = random.uniform(0.5, 0.9, draw++);
          const Vec3d side2{std::cos(angle) * lean, std::sin(angle) * lean, 0};
          grow(to, normalized(direction + side2), reach * random.uniform(0.55, 0.7, draw++),
               std::max(1.2, r * 0.65), depth - 1);
        }
      };
  grow({middle, middle, kShapeAir + 0.05 * s}, {0, 0, 1}, 0.32 * s, 0.055 * s, 3);
  const Vec3i size{static_cast<int>(s * 0.9), static_cast<int>(s * 0.9), side};
  return shapeField(size, [&](const Vec3d& p) {
    double d = std::numeric_limits<double>::infinity();
    for (const Limb& l : limbs) d = std::min(d, limbDistance(p, l.a, l.b, l.ra, l.rb));
    for (std::size_t e = 0; e < ends.size(); ++e)
      d = std::min(d, length(p - ends[e]) - s * (0.045 + 0.02 * random.uniform(e, 9)));
    // The foot, and room around the crown.
    d = std::min(d, columnDistance(p, middle, middle, kShapeAir, kShapeAir + 0.06 * s, 0.085 * s));
    const Vec3d low{kShapeAir, kShapeAir, kShapeAir}, most = cast<double>(size) - Vec3d{1, 1, 1};
    return std::max(d, boxDistance(p, low, most - low));
  });
}

/// Houses on a plate: walls, gabled roofs, a chimney each, in rows that are not quite straight.
inline DistanceField village(int side = 64, std::uint64_t seed = 0) {
  struct House {
    Vec3d low, high;
    double roof;
    bool turned;
  };
  const Random random(seed, 84);
  const double s = side;
  const Vec3i size{side, side, std::max(24, side * 7 / 16)};
  const double plate = kShapeAir + 3;
  std::vector<House> houses;
  const double lot = (s - 2 * kShapeAir) / 3;
  for (int n = 0; n < 9; ++n) {
    if (n == 4) continue;  // a square in the middle
    const auto u = [&](double a, double b, int d) { return random.uniform(a, b, n, d); };
    const double x = kShapeAir + (n % 3 + 0.5) * lot + u(-0.06, 0.06, 0) * lot;
    const double y = kShapeAir + (n / 3 + 0.5) * lot + u(-0.06, 0.06, 1) * lot;
    const double w = u(0.24, 0.36, 2) * lot, d = u(0.2, 0.3, 3) * lot;
    const double h = u(0.09, 0.16, 4) * s;
    houses.push_back(
        {{x - w, y - d, plate - 1}, {x + w, y + d, plate + h}, 0.09 * s, u(0, 1, 5) < 0.5});
  }
  return shapeField(size, [&](const Vec3d& p) {
    double d = boxDistance(p, {kShapeAir, kShapeAir, kShapeAir},
                           {s - 1 - kShapeAir, s - 1 - kShapeAir, plate});
    for (const House& h : houses) {
      Vec3d q = p;
      if (h.turned) {  // about its own middle
        const Vec3d c = (h.low + h.high) * 0.5;
        q = {c.x + (p.y - c.y), c.y - (p.x - c.x), p.z};
      }
      d = std::min(d, boxDistance(q, h.low, h.high));
      d = std::min(d, gableDistance(q, {h.low.x - 1, h.low.y - 1.5, h.high.z - 0.5},
                                    {h.high.x + 1, h.high.y + 1.5, h.high.z + h.roof}));
      const double cx = h.low.x + (h.high.x - h.low.x) * 0.75;
      d = std::min(d, boxDistance(q, {cx - 1.5, h.low.y + 2, h.high.z},
                                  {cx + 1.5, h.low.y + 5, h.high.z + h.roof + 1}));
    }
    return d;
  });
}

/// A flight of steps along x on two stringers, with posts and a rail.
inline DistanceField stairs(int side = 64, std::uint64_t seed = 0) {
  const double s = side, bottom = kShapeAir;
  const Vec3i size{side, static_cast<int>(side * 0.45), static_cast<int>(side * 0.8)};
  const double low = kShapeAir, high = size.y - 1 - kShapeAir;
  const int steps = 8 + static_cast<int>(seed % 3);
  const double run = (s - 1 - 2 * kShapeAir) / steps,
               rise = (size.z - 2 * kShapeAir - 0.24 * s) / steps;
  return shapeField(size, [&](const Vec3d& p) {
    double d = std::numeric_limits<double>::infinity();
    for (int n = 0; n < steps; ++n) {
      const double x = kShapeAir + n * run, z = bottom + (n + 1) * rise;
      // Each tread stands on the last but one, so that the flight is solid but hollow below.
      const double below = std::max(bottom, z - 3 * rise);
      d = std::min(d, boxDistance(p, {x, low, below}, {x + run, high, z}));
      if (n % 2 == 0)
        d = std::min(d, columnDistance(p, x + run / 2, high - 2, z - 1, z + 0.16 * s, 1.4));
    }
    const Vec3d from{kShapeAir + run / 2, high - 2, bottom + rise + 0.16 * s};
    const int last = (steps - 1) / 2 * 2;
    const Vec3d to = from + Vec3d{last * run, 0, last * rise};
    return std::min(d, limbDistance(p, from, to, 1.6, 1.6));
  });
}

/// An arch of cut stones on two piers.
inline DistanceField arch(int side = 64, std::uint64_t seed = 0) {
  const Random random(seed, 86);
  const double s = side, depth = s * random.uniform(0.1, 0.13, 0);
  const double outer = s / 2 - kShapeAir - 0.5, inner = outer * random.uniform(0.6, 0.66, 1);
  const Vec3i size{side, static_cast<int>(2 * depth + 2 * kShapeAir + 1),
                   static_cast<int>(s * 0.95)};
  const double cx = (s - 1) / 2, cy = (size.y - 1) / 2.0, cz = size.z - 1 - kShapeAir - outer;
  const int stones = 9;
  return shapeField(size, [&](const Vec3d& p) {
    const double r = std::hypot(p.x - cx, p.z - cz);
    const double face = std::abs(p.y - cy) - depth;
    double ring = std::max({r - outer, inner - r, cz - p.z, face});
    // Grooves between the stones.
    const double angle = std::atan2(p.z - cz, p.x - cx) / std::numbers::pi * stones;
    const double joint = std::abs(angle - std::round(angle)) / stones * std::numbers::pi * r;
    ring = std::max(ring, std::min(0.9 - joint, r - outer + 2));
    double pier = std::numeric_limits<double>::infinity();
    const double wide = (outer - inner) / 2, x0 = (outer + inner) / 2;
    for (const double side2 : {-1.0, 1.0}) {
      const double x = cx + side2 * x0;
      pier = std::min(pier, boxDistance(p, {x - wide, cy - depth, kShapeAir},
                                        {x + wide, cy + depth, cz + 0.5}));
      pier = std::min(pier, boxDistance(p, {x - wide - 1.5, cy - depth - 1.5, kShapeAir + 0.0},
                                        {x + wide + 1.5, cy + depth + 1.5, kShapeAir + 4}));
    }
    return std::min(ring, pier);
  });
}

/// A boulder: one lump with facets, ridges and grain.
inline DistanceField boulder(int side = 64, std::uint64_t seed = 0) {
  const double s = side, middle = (s - 1) / 2, radius = s * 0.31;
  const Vec3i size{side, side, static_cast<int>(s * 0.9)};
  const Vec3d center{middle, middle, (size.z - 1) / 2.0};
  return shapeField(size, [&](const Vec3d& p) {
    const Vec3d q = p - center;
    const double r = length(Vec3d{q.x, q.y * 1.1, q.z * 1.2});
    const double rough = 0.075 * s * shapeNoise(p, s / 4, seed) +
                         0.035 * s * std::abs(shapeNoise(p, s / 8, seed + 1)) +
                         0.9 * shapeNoise(p, 4, seed + 2);
    return std::max((r - radius + rough) * 0.8, boxDistance(p, {kShapeAir, kShapeAir, kShapeAir},
                                                            cast<double>(size) - Vec3d{5, 5, 5}));
  });
}

/// A temple: steps, a ring of columns, an entablature, a gabled roof and a cella within.
inline DistanceField temple(int side = 72, std::uint64_t seed = 0) {
  const double s = side;
  const Vec3i size{side, static_cast<int>(s * 0.7), static_cast<int>(s * 0.66)};
  const double a = kShapeAir, x1 = size.x - 1 - a, y1 = size.y - 1 - a, z1 = size.z - 1 - a;
  const double base = a + 6, beam = z1 - 0.2 * s;
  const int along = 5 + static_cast<int>(seed % 3), across = along - 2;
  const double r = std::max(1.6, 0.032 * s), in = a + 5;
  return shapeField(size, [&](const Vec3d& p) {
    double d = std::numeric_limits<double>::infinity();
    for (int n = 0; n < 3; ++n)
      d = std::min(d, boxDistance(p, {a + n * 1.5, a + n * 1.5, a},
                                  {x1 - n * 1.5, y1 - n * 1.5, a + 2.0 * (n + 1)}));
    for (int i = 0; i < along; ++i)
      for (int j = 0; j < across; ++j) {
        if (i > 0 && j > 0 && i < along - 1 && j < across - 1) continue;
        const double x = in + r + i * (x1 - a - 10 - 2 * r) / (along - 1);
        const double y = in + r + j * (y1 - a - 10 - 2 * r) / (across - 1);
        d = std::min(d, columnDistance(p, x, y, base - 1, beam + 1, r));
        d = std::min(d, columnDistance(p, x, y, beam - 2, beam + 1, r + 1));
      }
    d = std::min(d, boxDistance(p, {in - 1, in - 1, beam}, {x1 - 4, y1 - 4, beam + 3.5}));
    d = std::min(d, gableDistance(p, {in - 2.5, in - 2.5, beam + 3}, {x1 - 2.5, y1 - 2.5, z1}));
    const Vec3d low{in + 0.2 * s, in + 0.17 * s, base - 1},
        high{x1 - 5 - 0.2 * s, y1 - 5 - 0.17 * s, beam};
    double cella = boxDistance(p, low, high);
    cella = std::max(cella, -boxDistance(p, low + Vec3d{-9, 3, 1}, high - Vec3d{3, 3, 1}));
    return std::min(d, cella);
  });
}

// Materials that fill their box.

/// A porous block, as cheese is: solid with holes of several sizes that open into each other.
inline DistanceField porous(int side = 64, std::uint64_t seed = 0) {
  struct Hole {
    Vec3d center;
    double radius;
  };
  const Random random(seed, 88);
  std::vector<Hole> holes;
  const double s = side, reach = 8;
  const int count = static_cast<int>((s + 2 * reach) * (s + 2 * reach) * (s + 2 * reach) / 900);
  for (int n = 0; n < count; ++n) {
    Hole h;
    for (int axis = 0; axis < 3; ++axis)
      h.center[axis] = random.uniform(-reach, s + reach, n, axis);
    h.radius = random.uniform(2.5, 7.5, n, 3);
    holes.push_back(h);
  }
  return shapeField({side, side, side}, [&](const Vec3d& p) {
    double d = std::numeric_limits<double>::infinity();
    for (const Hole& h : holes) d = std::min(d, length(p - h.center) - h.radius);
    return -d;
  });
}

/// A packing of equal balls that do not touch, cut by the box.
inline DistanceField packing(int side = 64, std::uint64_t seed = 0) {
  const Random random(seed, 89);
  const double radius = 5, least = 2 * radius + 0.5;
  std::vector<Vec3d> centers;
  for (int attempt = 0; attempt < side * side; ++attempt) {
    Vec3d c;
    for (int axis = 0; axis < 3; ++axis)
      c[axis] = random.uniform(-radius, side - 1 + radius, attempt, axis);
    if (std::ranges::none_of(centers,
                             [&](const Vec3d& o) { return dot(c - o, c - o) < least * least; }))
      centers.push_back(c);
  }
  return shapeField({side, side, side}, [&](const Vec3d& p) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vec3d& c : centers) nearest = std::min(nearest, dot(p - c, p - c));
    return std::sqrt(nearest) - radius;
  });
}

// Ground.

/// Rolling ground with ridges, solid below, cut at its four sides.
inline DistanceField terrain(int side = 96, std::uint64_t seed = 0) {
  const Vec3i size{side, side, std::max(24, side / 3)};
  return shapeField(size, [&](const Vec3d& p) {
    const Vec3d q{p.x, p.y, 0};
    const double height = size.z * (0.42 + 0.2 * shapeNoise(q, side / 3.0, seed) -
                                    0.14 * std::abs(shapeNoise(q, side / 6.0, seed + 1)) +
                                    0.05 * shapeNoise(q, side / 14.0, seed + 2));
    return (p.z - height) * 0.85;
  });
}

/// A wall with battlements at equal distances and towers at these places, in a box of this length:
/// no kind of example, but one with a landmark.
inline DistanceField castle(int length, std::initializer_list<double> towers) {
  return shapeField({length, 32, 48}, [&](const Vec3d& p) {
    double d = boxDistance(p, {4, 12, 3}, {length - 5.0, 19, 16});
    d = std::min(d, std::max(boxDistance(p, {4, 12, 15}, {length - 5.0, 19, 19}),
                             std::abs(std::fmod(p.x, 6.0) - 3) - 1.5));
    for (const double x : towers) {
      d = std::min(d, columnDistance(p, x, 15.5, 3, 30, 7));
      d = std::min(d, std::max(std::hypot(p.x - x, p.y - 15.5) - 0.7 * (43 - p.z), 30 - p.z));
    }
    return d;
  });
}

/// A kind of example, by name.
struct ShapeKind {
  const char* name;
  DistanceField (*make)(int side, std::uint64_t seed);
  int side;           ///< its default
  bool freeStanding;  ///< with air on all sides
};

/// All kinds, free-standing ones first.
inline const std::vector<ShapeKind>& shapeKinds() {
  static const std::vector<ShapeKind> kinds{
      {"vase", vase, 64, true},        {"tree", tree, 64, true},
      {"village", village, 64, true},  {"stairs", stairs, 64, true},
      {"arch", arch, 64, true},        {"boulder", boulder, 64, true},
      {"temple", temple, 72, true},    {"porous", porous, 64, false},
      {"packing", packing, 64, false}, {"terrain", terrain, 96, false}};
  return kinds;
}

}  // namespace exemplar::testing
