// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include "tests/example_shapes.h"

/// Free-standing shapes on which nothing was tuned: no constant of the engine was chosen by them.
/// They are measured as those of `example_shapes.h` are, and show how far its figures hold.
namespace exemplar::testing {

/// A bridge: a deck with two parapets on piers in a row, joined by round arches.
inline DistanceField bridge(int side = 64, std::uint64_t seed = 0) {
  const Random random(seed, 90);
  const double s = side, a = kShapeAir;
  const Vec3i size{side, static_cast<int>(s * 0.36), static_cast<int>(s * 0.45)};
  const double x1 = size.x - 1 - a, y1 = size.y - 1 - a, z1 = size.z - 1 - a;
  const int spans = 3 + static_cast<int>(seed % 2);
  const double span = (x1 - a) / spans, pier = s * random.uniform(0.035, 0.05, 0);
  const double deck = z1 - 0.08 * s;
  return shapeField(size, [&](const Vec3d& p) {
    double d = boxDistance(p, {a, a + 2, a}, {x1, y1 - 2, deck});
    for (int n = 0; n < spans; ++n) {
      const double middle = a + (n + 0.5) * span, radius = span / 2 - pier;
      const double arch =
          std::hypot(p.x - middle, std::max(0.0, p.z - (deck - radius - 4))) - radius;
      d = std::max(d, -arch);
    }
    d = std::min(d, boxDistance(p, {a, a, deck - 3}, {x1, y1, deck}));
    for (const double y : {a, y1 - 2}) {
      const double bars = std::abs(std::fmod(p.x - a, 6.0) - 3) - 1.2;
      d = std::min(d, std::max(boxDistance(p, {a, y, deck - 1}, {x1, y + 2, z1 - 1}), bars));
      d = std::min(d, boxDistance(p, {a, y, z1 - 2}, {x1, y + 2, z1}));
    }
    return d;
  });
}

/// A chair: four legs, a seat, a back of slats, and rungs between the legs.
inline DistanceField chair(int side = 64, std::uint64_t seed = 0) {
  const Random random(seed, 91);
  const double s = side, a = kShapeAir;
  const Vec3i size{static_cast<int>(s * 0.6), static_cast<int>(s * 0.6), side};
  const double x1 = size.x - 1 - a, y1 = size.y - 1 - a, z1 = size.z - 1 - a;
  const double seat = a + s * random.uniform(0.36, 0.44, 0), r = 0.032 * s + 0.5;
  const int slats = 3 + static_cast<int>(seed % 3);
  return shapeField(size, [&](const Vec3d& p) {
    double d = boxDistance(p, {a, a, seat}, {x1, y1, seat + 0.06 * s});
    for (const double x : {a + r + 1, x1 - r - 1})
      for (const double y : {a + r + 1, y1 - r - 1}) {
        const bool back = y > s * 0.3;
        d = std::min(d, limbDistance(p, {x, y, a + r}, {x, y, back ? z1 - r : seat}, r, r));
      }
    const double y = y1 - r - 1;
    for (int n = 0; n < slats; ++n) {
      const double z = seat + 0.14 * s + n * (z1 - seat - 0.2 * s) / std::max(1, slats - 1);
      d = std::min(
          d, boxDistance(p, {a + r, y - 1.5, z - 0.025 * s}, {x1 - r, y + 1.5, z + 0.025 * s}));
    }
    const double rung = a + 0.18 * s;
    for (const double x : {a + r + 1, x1 - r - 1})
      d = std::min(d, limbDistance(p, {x, a + r, rung}, {x, y1 - r, rung}, 1.4, 1.4));
    return d;
  });
}

/// A pagoda: stories that become narrower, each with a roof that hangs over, and a spire.
inline DistanceField pagoda(int side = 72, std::uint64_t seed = 0) {
  const Random random(seed, 92);
  const double s = side, a = kShapeAir;
  const Vec3i size{static_cast<int>(s * 0.62), static_cast<int>(s * 0.62), side};
  const double cx = (size.x - 1) / 2.0, cy = (size.y - 1) / 2.0, z1 = size.z - 1 - a;
  const int stories = 4 + static_cast<int>(seed % 2);
  const double shrink = random.uniform(0.84, 0.9, 0);
  return shapeField(size, [&](const Vec3d& p) {
    const double reach = cx - a, high = (z1 - a - 0.16 * s) / stories;
    const double out = std::max(std::abs(p.x - cx), std::abs(p.y - cy));
    double d = std::max({out - reach, a - p.z, p.z - a - 3});
    double wide = reach - 1;
    for (int n = 0; n < stories; ++n, wide *= shrink) {
      const double low = a + 2 + n * high;
      d = std::min(d, std::max({out - 0.6 * wide, low - p.z, p.z - low - high}));
      const double eaves = low + 0.62 * high;
      const double roof = (out - wide + 1.3 * (p.z - eaves)) * 0.6;
      d = std::min(d, std::max({roof, eaves - p.z, p.z - low - high - 1}));
    }
    return std::min(d, limbDistance(p, {cx, cy, z1 - 0.2 * s}, {cx, cy, z1 - 1}, 2.5, 1));
  });
}

/// A coral: branches of even thickness that fork again and again from one foot.
inline DistanceField coral(int side = 64, std::uint64_t seed = 0) {
  struct Branch {
    Vec3d a, b;
    double ra, rb;
  };
  const Random random(seed, 93);
  const double s = side, a = kShapeAir;
  const Vec3i size{side, side, static_cast<int>(s * 0.85)};
  const double top = size.z - 1 - a;
  std::vector<Branch> branches{
      {{s / 2, s / 2, a + 0.06 * s}, {s / 2, s / 2, a + 0.2 * s}, 0.075 * s, 0.06 * s}};
  for (std::size_t from = 0; from < branches.size() && branches.size() < 60; ++from) {
    const Branch parent = branches[from];
    for (std::uint32_t fork = 0; fork < 2 + (from == 0 ? 2U : 0U); ++fork) {
      const Vec3d way = parent.b - parent.a;
      Vec3d turned{way.x + random.uniform(-0.19, 0.19, from, 3 * fork) * s,
                   way.y + random.uniform(-0.19, 0.19, from, 3 * fork + 1) * s,
                   std::abs(way.z) * random.uniform(0.5, 1.1, from, 3 * fork + 2) + 0.02 * s};
      turned = turned * (0.16 * s / std::max(1e-9, length(turned)));
      const Vec3d end = parent.b + turned;
      const double r = std::max(2.0, parent.rb * 0.87);
      if (std::min({end.x, end.y, s - 1 - end.x, s - 1 - end.y, top - end.z}) < a + r) continue;
      branches.push_back({parent.b, end, parent.rb, r});
    }
  }
  return shapeField(size, [&](const Vec3d& p) {
    double d = std::max(columnDistance(p, s / 2, s / 2, a, a + 0.07 * s, 0.13 * s), a - p.z);
    for (const Branch& b : branches) d = std::min(d, limbDistance(p, b.a, b.b, b.ra, b.rb));
    return d;
  });
}

inline const std::vector<ShapeKind>& heldOutKinds() {
  static const std::vector<ShapeKind> kinds{{"bridge", bridge, 64, true},
                                            {"chair", chair, 64, true},
                                            {"pagoda", pagoda, 72, true},
                                            {"coral", coral, 64, true}};
  return kinds;
}

}  // namespace exemplar::testing
