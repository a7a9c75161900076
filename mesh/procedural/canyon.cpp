// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <algorithm>
#include <array>
#include <cmath>

#include "mesh/procedural/piece_kit.h"
#include "mesh/procedural/piece_scenes.h"

namespace exemplar {
namespace {

/// Heights at the corners of cells: the river's bed is 0, the plateau 4.
const Plan kHeights({
    "44444444444444444444444",  //
    "44444444444444444444444",  //
    "44444333334444444444444",  //
    "44443322233444333444444",  //
    "44433211123333222334444",  //
    "44432100112222111233444",  //
    "44432100011111110123444",  //
    "44433210000011100123444",  //
    "44443321110000001123444",  //
    "44444333221100012233444",  //
    "44444332221100122334444",  //
    "44443321110001123324444",  //
    "44433210000111233224444",  //
    "44432100011122333444444",  //
    "44432110112233344444444",  //
    "44433222223344444444444",  //
    "44443333334444444444444",  //
    "44444444444444444444444",  //
    "44444444444444444444444",  //
});
constexpr int kFine = 4;  ///< parts of a cell's side
constexpr int kPlateau = 4;
constexpr double kWater = 1.25;  ///< the river's level: what lies lower is water
/// Rows that ropes cross, from plateau to plateau.
constexpr int kBridges[] = {3, 12};

/// Between two whole heights the rock stands steep in the middle and flat at its ends.
double terraced(double h) {
  const double whole = std::floor(h), t = h - whole;
  const double at[] = {0, 0.05, 0.5, 0.95, 1};
  const int i = std::min(3, static_cast<int>(t * 4));
  return whole + at[i] + (at[i + 1] - at[i]) * (t * 4 - i);
}

class Canyon {
 public:
  ProcessSample make() {
    for (int y = 0; y < depth(); ++y) {
      for (int x = 0; x < width(); ++x) {
        kit_.at({x, y, 0});
        rock(x, y);
        walls(x, y);
        plants(x, y);
      }
    }
    for (const int y : kBridges) bridge(y);
    return kit_.take();
  }

 private:
  static int width() { return kHeights.width() - 1; }
  static int depth() { return kHeights.depth() - 1; }
  static int corner(int x, int y) { return kHeights(x, y) - '0'; }
  static int lowest(int x, int y) {
    return std::min({corner(x, y), corner(x + 1, y), corner(x, y + 1), corner(x + 1, y + 1)});
  }
  static int highest(int x, int y) {
    return std::max({corner(x, y), corner(x + 1, y), corner(x, y + 1), corner(x + 1, y + 1)});
  }

  Vec3d surface(int x, int y, int i, int j) const {
    const double u = static_cast<double>(i) / kFine, v = static_cast<double>(j) / kFine;
    const double h = (corner(x, y) * (1 - u) + corner(x + 1, y) * u) * (1 - v) +
                     (corner(x, y + 1) * (1 - u) + corner(x + 1, y + 1) * u) * v;
    return {u, v, std::max(kWater, 1 + terraced(h))};
  }

  void rock(int x, int y) {
    for (int j = 0; j < kFine; ++j) {
      for (int i = 0; i < kFine; ++i) {
        const Vec3d a = surface(x, y, i, j), b = surface(x, y, i + 1, j),
                    c = surface(x, y, i + 1, j + 1), d = surface(x, y, i, j + 1);
        // Cut along the diagonal that joins the nearer heights.
        if (std::abs(a.z - c.z) <= std::abs(b.z - d.z)) {
          part(a, b, c);
          part(a, c, d);
        } else {
          part(a, b, d);
          part(b, c, d);
        }
      }
    }
  }

  void part(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    const Vec3d normal = normalized(cross(b - a, c - a));
    const double z = (a.z + b.z + c.z) / 3, t = z - std::floor(z);
    std::uint32_t material = t < 0.5 ? dark_ : pale_;
    if (std::max({a.z, b.z, c.z}) == kWater) return kit_.face(std::array{a, b, c}, water_);
    if (normal.z > 0.8) material = z > kPlateau + 0.9 ? grass_ : sand_;
    kit_.face(std::array{a, b, c}, material);
  }

  /// The sides and the bottom, where the scene ends.
  void walls(int x, int y) {
    const std::array<bool, 4> ends{x + 1 == width(), y + 1 == depth(), x == 0, y == 0};
    // A layer of rock is of one color wherever the scene ends: layers follow in their order.
    for (int layer = 0; layer <= kPlateau; ++layer) {
      const double a = std::max(0.5, 1.0 * layer), b = layer + 1;
      const std::uint32_t rock = strata_[layer];
      if (ends[0]) {
        kit_.face(std::array{Vec3d{1, 0, a}, Vec3d{1, 1, a}, Vec3d{1, 1, b}, Vec3d{1, 0, b}}, rock);
      }
      if (ends[1]) {
        kit_.face(std::array{Vec3d{1, 1, a}, Vec3d{0, 1, a}, Vec3d{0, 1, b}, Vec3d{1, 1, b}}, rock);
      }
      if (ends[2]) {
        kit_.face(std::array{Vec3d{0, 1, a}, Vec3d{0, 0, a}, Vec3d{0, 0, b}, Vec3d{0, 1, b}}, rock);
      }
      if (ends[3]) {
        kit_.face(std::array{Vec3d{0, 0, a}, Vec3d{1, 0, a}, Vec3d{1, 0, b}, Vec3d{0, 0, b}}, rock);
      }
    }
    kit_.face(std::array{Vec3d{0, 0, 0.5}, Vec3d{0, 1, 0.5}, Vec3d{1, 1, 0.5}, Vec3d{1, 0, 0.5}},
              dark_);
  }

  void plants(int x, int y) {
    const int low = lowest(x, y);
    if (low != highest(x, y) || low == 0 || x == 0 || y == 0 || x + 1 == width() ||
        y + 1 == depth()) {
      return;
    }
    const double z = 1 + low;
    if (low == kPlateau && (3 * x + 5 * y) % 7 == 0) {
      kit_.column(0.5, 0.5, 0.06, z, z + 0.4, 6, bark_);
      kit_.spire(0.5, 0.5, 0.34, z + 0.3, z + 0.9, 7, leaves_);
      kit_.spire(0.5, 0.5, 0.26, z + 0.65, z + 1.25, 7, leaves_);
    } else if (low == kPlateau && (x + 2 * y) % 9 == 0) {
      kit_.ball({0.5, 0.5, z + 0.1}, {0.2, 0.2, 0.16}, leaves_, 1);
    } else if (low < kPlateau && (x + y) % 3 == 0) {
      // A cactus with two arms.
      kit_.column(0.5, 0.5, 0.07, z, z + 0.7, 8, cactus_);
      kit_.box({0.3, 0.47, z + 0.3}, {0.7, 0.53, z + 0.36}, cactus_);
      kit_.column(0.31, 0.5, 0.04, z + 0.3, z + 0.55, 6, cactus_);
      kit_.column(0.69, 0.5, 0.04, z + 0.3, z + 0.62, 6, cactus_);
    }
  }

  /// Planks on ropes over the cells of a row that are lower than the plateau.
  void bridge(int y) {
    const double z = 1 + kPlateau;
    for (int x = 1; x + 1 < width(); ++x) {
      const auto isOpen = [&](int i) { return lowest(i, y) < kPlateau; };
      kit_.at({x, y, 0});
      if (isOpen(x)) {
        for (int plank = 0; plank < 4; ++plank) {
          const double a = 0.04 + 0.25 * plank;
          kit_.box({a, 0.3, z + 0.06}, {a + 0.17, 0.7, z + 0.1}, wood_);
        }
        for (const double side : {0.3, 0.68}) {
          kit_.box({0, side, z + 0.1}, {1, side + 0.02, z + 0.13}, rope_, kMinX | kMaxX);
          kit_.box({0, side, z + 0.42}, {1, side + 0.02, z + 0.45}, rope_, kMinX | kMaxX);
          kit_.box({0.49, side, z + 0.13}, {0.51, side + 0.02, z + 0.42}, rope_);
        }
      } else if (isOpen(x - 1) || isOpen(x + 1)) {
        kit_.at({x, y, 0}, isOpen(x + 1) ? 0 : 2);
        for (const double side : {0.28, 0.66}) {
          kit_.box({0.6, side, z}, {0.68, side + 0.08, z + 0.6}, wood_);
        }
        for (const double side : {0.3, 0.68}) {
          kit_.box({0.68, side, z + 0.1}, {1, side + 0.02, z + 0.13}, rope_, kMaxX);
          kit_.box({0.68, side, z + 0.42}, {1, side + 0.02, z + 0.45}, rope_, kMaxX);
        }
        kit_.box({0.75, 0.3, z + 0.06}, {0.96, 0.7, z + 0.1}, wood_);
      }
    }
  }

  PieceKit kit_{{width(), depth(), 8}};
  std::uint32_t pale_ = kit_.material("pale rock", {0.6f, 0.34f, 0.17f}),
                dark_ = kit_.material("red rock", {0.42f, 0.17f, 0.08f}),
                sand_ = kit_.material("sand", {0.66f, 0.5f, 0.3f}),
                grass_ = kit_.material("dry grass", {0.36f, 0.34f, 0.12f}),
                water_ = kit_.material("water", {0.05f, 0.2f, 0.24f}, 0.1f),
                bark_ = kit_.material("bark", {0.16f, 0.09f, 0.05f}),
                leaves_ = kit_.material("pine", {0.07f, 0.17f, 0.06f}),
                cactus_ = kit_.material("cactus", {0.1f, 0.26f, 0.1f}),
                wood_ = kit_.material("planks", {0.32f, 0.19f, 0.09f}),
                rope_ = kit_.material("rope", {0.5f, 0.4f, 0.24f});
  std::array<std::uint32_t, kPlateau + 1> strata_{kit_.material("stratum 1", {0.3f, 0.14f, 0.09f}),
                                                  kit_.material("stratum 2", {0.42f, 0.18f, 0.09f}),
                                                  kit_.material("stratum 3", {0.52f, 0.27f, 0.14f}),
                                                  kit_.material("stratum 4", {0.46f, 0.2f, 0.1f}),
                                                  kit_.material("stratum 5", {0.6f, 0.36f, 0.2f})};
};

}  // namespace

ProcessSample makeCanyon() { return Canyon().make(); }

}  // namespace exemplar
