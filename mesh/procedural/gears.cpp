// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "mesh/procedural/piece_kit.h"
#include "mesh/procedural/piece_scenes.h"

namespace exemplar {
namespace {

constexpr int kTeeth = 16;
constexpr double kFront = 0.25, kBack = 0.5;  ///< of wheels, within their row

/// A row of wheels that stand upright: the lowest corners of those of 2 x 2 cells, and belts from
/// pulley to pulley.
struct Row {
  int y;
  std::vector<std::array<int, 2>> wheels;  ///< x and z
  std::vector<std::array<int, 3>> belts;   ///< from x to x at z
};
const std::vector<Row> kRows{
    {2,
     {{2, 1}, {4, 1}, {4, 3}, {6, 3}, {8, 3}, {8, 1}, {8, 5}, {2, 5}},
     {{11, 15, 2}, {11, 14, 4}, {13, 15, 6}}},
    {5,
     {{2, 1}, {2, 3}, {4, 3}, {6, 3}, {6, 5}, {10, 1}, {12, 1}, {12, 3}, {14, 3}},
     {{8, 13, 6}, {4, 8, 1}}},
    {8,
     {{4, 1}, {4, 3}, {6, 3}, {8, 3}, {8, 1}, {12, 3}, {12, 1}, {14, 1}},
     {{2, 8, 6}, {1, 3, 2}}},
};

/// Pipes on the ground in front and behind: o ends in a boiler, x a valve, = and | and corners as
/// their neighbors ask.
const Plan kPipes({
    "..................",  //
    "..o====x===o......",  //
    "......=....=......",  //
    "......=....=......",  //
    "..................",  //
    "..................",  //
    "..................",  //
    "..................",  //
    "..................",  //
    "..................",  //
    "..................",  //
    "..o===x===o==x=o..",  //
    "..................",  //
});

class Gears {
 public:
  ProcessSample make() {
    kit_.ground(
        0.6, [&](int, int) { return plate_; }, iron_);
    for (const Row& row : kRows) {
      for (const auto& wheel : row.wheels) addWheel(row, wheel[0], wheel[1]);
      for (const auto& belt : row.belts) addBelt(row.y, belt[0], belt[1], belt[2]);
      posts(row);
    }
    for (std::size_t n = 0; n + 1 < kRows.size(); ++n) {
      for (const auto& wheel : kRows[n].wheels) {
        if (has(kRows[n + 1], wheel[0], wheel[1])) shaft(kRows[n], kRows[n + 1], wheel);
      }
    }
    kPipes.each([&](int x, int y, char c) {
      if (c != '.') pipe(x, y, c);
    });
    return kit_.take();
  }

 private:
  static bool has(const Row& row, int x, int z) {
    return std::find(row.wheels.begin(), row.wheels.end(), std::array<int, 2>{x, z}) !=
           row.wheels.end();
  }

  /// A ring of a wheel between two radii, in the plane of its row; a disc where `inner` is 0.
  void ring(double x, double z, double inner, double outer, double front, double back, int parts,
            std::uint32_t material) {
    for (int n = 0; n < parts; ++n) {
      const double a = 2 * std::numbers::pi * n / parts, b = 2 * std::numbers::pi * (n + 1) / parts;
      const auto at = [&](double r, double angle, double y) {
        return Vec3d{x + r * std::cos(angle), y, z + r * std::sin(angle)};
      };
      kit_.face(std::array{at(inner, a, front), at(outer, a, front), at(outer, b, front),
                           at(inner, b, front)},
                material);
      kit_.face(std::array{at(inner, b, back), at(outer, b, back), at(outer, a, back),
                           at(inner, a, back)},
                material);
      kit_.face(std::array{at(outer, a, front), at(outer, a, back), at(outer, b, back),
                           at(outer, b, front)},
                material);
      if (inner == 0) continue;
      kit_.face(std::array{at(inner, b, front), at(inner, b, back), at(inner, a, back),
                           at(inner, a, front)},
                material);
    }
  }

  void addWheel(const Row& row, int x, int z) {
    kit_.at({x, row.y, z});
    const bool odd = (x + z) / 2 % 2;
    const std::uint32_t metal = odd ? brass_ : steel_;
    ring(1, 1, 0.7, 0.88, kFront, kBack, 32, metal);
    ring(1, 1, 0.12, 0.24, kFront - 0.06, kBack + 0.06, 12, iron_);
    // Six spokes; or, every other wheel, a disc.
    if (odd) {
      ring(1, 1, 0.24, 0.7, kFront + 0.08, kBack - 0.08, 32, metal);
    } else {
      for (int n = 0; n < 4; ++n) {
        kit_.at({x, row.y, z});
        spoke(n * std::numbers::pi / 2 + std::numbers::pi / 4, metal);
      }
    }
    kit_.at({x, row.y, z});
    for (int n = 0; n < kTeeth; ++n) {
      // Wheels side by side are half a tooth apart; no tooth leaves the wheel's own cells.
      tooth(2 * std::numbers::pi * (n + (odd ? 0.5 : 0.0)) / kTeeth, 0.985, metal);
    }
    // The axle that the wheel turns on, in a bearing on its post, as long as the row is deep: it
    // looks the same whether or not a shaft goes on.
    ring(1, 1, 0, 0.12, 0, 1, 8, iron_);
  }

  void spoke(double angle, std::uint32_t metal) {
    const double c = std::cos(angle), s = std::sin(angle), half = 0.07;
    const auto at = [&](double r, double side) {
      return std::array<double, 2>{1 + r * s + side * c, 1 + r * c - side * s};
    };
    kit_.prism(1,
               std::array<std::array<double, 2>, 4>{at(0.22, half), at(0.72, half), at(0.72, -half),
                                                    at(0.22, -half)},
               kFront + 0.05, kBack - 0.05, metal);
  }

  void tooth(double angle, double tip, std::uint32_t metal) {
    const double c = std::cos(angle), s = std::sin(angle);
    const auto at = [&](double r, double side) {
      return std::array<double, 2>{1 + r * s + side * c, 1 + r * c - side * s};
    };
    kit_.prism(1,
               std::array<std::array<double, 2>, 4>{at(0.86, 0.1), at(tip, 0.06), at(tip, -0.06),
                                                    at(0.86, -0.1)},
               kFront, kBack, metal);
  }

  /// Wheels stand on posts behind them, which reach to the ground.
  void posts(const Row& row) {
    std::map<int, int> top;
    for (const auto& wheel : row.wheels) {
      int& z = top[wheel[0]];
      z = std::max(z, wheel[1] + 1);
    }
    for (const auto& [x, z] : top) {
      kit_.at({x, row.y, 0});
      kit_.box({0.92, 0.66, 1}, {1.08, 0.84, z + 0.2}, wood_);
      kit_.box({0.7, 0.6, 1}, {1.3, 0.9, 1.12}, iron_);
    }
  }

  void shaft(const Row& from, const Row& to, const std::array<int, 2>& wheel) {
    kit_.at({wheel[0], from.y, wheel[1]});
    ring(1, 1, 0, 0.12, 1, to.y - from.y, 8, iron_);
  }

  void addBelt(int y, int x0, int x1, int z) {
    for (const int x : {x0, x1}) {
      kit_.at({x, y, z});
      ring(0.5, 0.5, 0.1, 0.4, kFront, kBack, 16, brass_);
      ring(0.5, 0.5, 0, 0.1, 0.15, 0.9, 8, iron_);
      kit_.at({x, y, 0});
      kit_.box({0.44, 0.66, 1}, {0.56, 0.84, z + 0.6}, wood_);
    }
    kit_.at({x0, y, z});
    for (const double side : {0.06, 0.9}) {
      kit_.box({0.5, kFront + 0.04, side}, {x1 - x0 + 0.5, kBack - 0.04, side + 0.04}, leather_);
    }
  }

  void pipe(int x, int y, char c) {
    const unsigned sides = kPipes.sides(x, y, "=ox");
    kit_.at({x, y, 0});
    kit_.beams(sides, 0.1, 1.3, 1.5, copper_);
    if (c == '=') {
      kit_.box({0.44, 0.44, 1}, {0.56, 0.56, 1.3}, iron_);
    }
    if (c == 'x') {
      kit_.box({0.36, 0.36, 1.24}, {0.64, 0.64, 1.56}, iron_);
      kit_.column(0.5, 0.5, 0.03, 1.56, 1.75, 6, iron_);
      kit_.column(0.5, 0.5, 0.2, 1.75, 1.8, 10, red_);
    }
    if (c == 'o') {
      kit_.column(0.5, 0.5, 0.36, 1, 2.5, 12, copper_);
      kit_.spire(0.5, 0.5, 0.36, 2.5, 2.75, 12, copper_);
      for (const double z : {1.2, 2.2}) kit_.column(0.5, 0.5, 0.38, z, z + 0.08, 12, iron_);
      kit_.column(0.5, 0.5, 0.1, 2.7, 3.6, 8, iron_);
    }
  }

  PieceKit kit_{{18, 13, 9}};
  std::uint32_t plate_ = kit_.material("plate", {0.34f, 0.35f, 0.37f}, 0.6f),
                iron_ = kit_.material("iron", {0.13f, 0.13f, 0.15f}, 0.5f),
                steel_ = kit_.material("steel", {0.5f, 0.52f, 0.55f}, 0.4f, 0.6f),
                brass_ = kit_.material("brass", {0.62f, 0.42f, 0.14f}, 0.4f, 0.6f),
                copper_ = kit_.material("copper", {0.6f, 0.28f, 0.16f}, 0.4f, 0.6f),
                wood_ = kit_.material("wood", {0.3f, 0.17f, 0.08f}),
                leather_ = kit_.material("leather", {0.18f, 0.1f, 0.05f}),
                red_ = kit_.material("red", {0.5f, 0.03f, 0.02f});
};

}  // namespace

ProcessSample makeGears() { return Gears().make(); }

}  // namespace exemplar
