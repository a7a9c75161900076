// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/procedural/piece_kit.h"
#include "mesh/procedural/piece_scenes.h"

namespace exemplar {
namespace {

// w wall, T round tower, t square tower, G gate, S stairs to the wall beside them, K keep, o well,
// = paved way
const Plan kPlan({
    "..................",  //
    ".TwwwtwwwTwwwGwwT.",  //
    ".w...S...w...=..w.",  //
    ".w.......wS..=..w.",  //
    ".t.KKKK..w...=..t.",  //
    ".w.KKKK..G====..w.",  //
    ".w...==..w...=o.w.",  //
    ".wS..=...w...=..w.",  //
    ".TwwwGwwwTwwwGwwT.",  //
    ".w...=...w...=..w.",  //
    ".w.o.=...G====.Sw.",  //
    ".w...=...w......w.",  //
    ".TwwwtwwwTwwwtwwT.",  //
    "..................",  //
});
const std::string kWalls = "wTtG";
constexpr double kWallTop = 3, kWallHalf = 0.22;

class Castle {
 public:
  ProcessSample make() {
    kit_.ground(
        0.6, [&](int, int) { return grass_; }, earth_);
    kPlan.each([&](int x, int y, char c) {
      cell_ = {x, y, 0};
      const unsigned sides = kPlan.sides(x, y, kWalls);
      if (c == '=' || c == 'G') {
        kit_.at(cell_);
        kit_.beams(kPlan.sides(x, y, "=G") & (c == 'G' ? ~sides : 15u), 0.25, 1, 1.03, paving_);
      }
      if (c == 'w') wall(sides);
      if (c == 'G') gate(sides);
      if (c == 'T') roundTower(sides);
      if (c == 't') squareTower(sides);
      if (c == 'S') stairs(sides);
      if (c == 'o') well();
      if (c == 'K' && kPlan(x - 1, y) != 'K' && kPlan(x, y - 1) != 'K') keep(x, y);
    });
    return kit_.take();
  }

 private:
  /// Teeth on top of a wall that runs along x, in a cell's eastern half.
  void teeth(double top) {
    for (const double y : {0.5 - kWallHalf, 0.5 + kWallHalf - 0.1}) {
      kit_.box({0.62, y, top}, {0.88, y + 0.1, top + 0.3}, stone_);
    }
  }

  void wall(unsigned sides) {
    kit_.at(cell_);
    kit_.beams(sides, kWallHalf, 1, kWallTop, stone_);
    for (int turn = 0; turn < 4; ++turn) {
      if (!(turnedSides(sides, -turn) & kEast)) continue;
      kit_.at(cell_, turn);
      teeth(kWallTop);
    }
  }

  void gate(unsigned sides) {
    kit_.at(cell_, sides & kEast ? 0 : 1);
    const double low = 0.5 - kWallHalf, high = 0.5 + kWallHalf;
    kit_.box({0, low, 1}, {0.2, high, kWallTop}, stone_, kMinX);
    kit_.box({0.8, low, 1}, {1, high, kWallTop}, stone_, kMaxX);
    kit_.box({0.2, low, 2.3}, {0.8, high, kWallTop}, stone_);
    // An arch below the lintel, and a portcullis drawn up in it.
    for (const double x : {0.2, 0.68}) kit_.box({x, low, 2.1}, {x + 0.12, high, 2.3}, stone_);
    for (int bar = 0; bar < 4; ++bar) {
      const double x = 0.26 + 0.14 * bar;
      kit_.box({x, 0.47, 1.75}, {x + 0.05, 0.53, 2.3}, iron_);
    }
    teeth(kWallTop);
    kit_.at(cell_, sides & kEast ? 2 : 3);
    teeth(kWallTop);
  }

  /// The ends of walls that run into a tower, `reach` of the cell long.
  void wallEnds(unsigned sides, double reach) {
    for (int turn = 0; turn < 4; ++turn) {
      if (!(turnedSides(sides, -turn) & kEast)) continue;
      kit_.at(cell_, turn);
      kit_.box({1 - reach, 0.5 - kWallHalf, 1}, {1, 0.5 + kWallHalf, kWallTop}, stone_, kMaxX);
    }
  }

  void roundTower(unsigned sides) {
    wallEnds(sides, 0.2);
    kit_.at(cell_);
    kit_.column(0.5, 0.5, 0.46, 1, 4.3, 16, stone_);
    kit_.column(0.5, 0.5, 0.49, 4.3, 4.55, 16, trim_);
    kit_.spire(0.5, 0.5, 0.47, 4.55, 5.75, 16, tiles_);
    kit_.box({0.48, 0.48, 5.7}, {0.52, 0.52, 5.95}, iron_);
    for (int turn = 0; turn < 4; ++turn) {
      kit_.at(cell_, turn);
      kit_.box({0.93, 0.45, 3.5}, {0.97, 0.55, 3.9}, dark_);
    }
  }

  void squareTower(unsigned sides) {
    wallEnds(sides, 0.1);
    kit_.at(cell_);
    kit_.box({0.1, 0.1, 1}, {0.9, 0.9, 4.1}, stone_);
    kit_.box({0.04, 0.04, 4.1}, {0.96, 0.96, 4.35}, trim_);
    for (int turn = 0; turn < 4; ++turn) {
      kit_.at(cell_, turn);
      kit_.box({0.04, 0.04, 4.35}, {0.28, 0.16, 4.7}, stone_);
      kit_.box({0.4, 0.04, 4.35}, {0.6, 0.16, 4.7}, stone_);
      kit_.box({0.45, 0.07, 3.3}, {0.55, 0.11, 3.7}, dark_);
    }
  }

  /// Steps that rise toward the wall, from the side across it.
  void stairs(unsigned sides) {
    int turn = 0;
    while (!(turnedSides(sides, -turn) & kEast)) ++turn;
    kit_.at(cell_, turn);
    for (int step = 0; step < 6; ++step) {
      kit_.box({step / 6.0, 0.2, 1}, {(step + 1) / 6.0, 0.8, 1 + (step + 1) / 3.0}, trim_,
               step < 5 ? 0u : kMaxX);
    }
    // The step before the wall's face.
    kit_.at(cell_ + Vec3i{turn == 0   ? 1
                          : turn == 2 ? -1
                                      : 0,
                          turn == 1   ? 1
                          : turn == 3 ? -1
                                      : 0,
                          0},
            turn);
    kit_.box({0, 0.2, 1}, {0.5 - kWallHalf, 0.8, kWallTop}, trim_, kMinX);
  }

  void well() {
    kit_.at(cell_);
    kit_.column(0.5, 0.5, 0.3, 1, 1.4, 12, trim_);
    kit_.column(0.5, 0.5, 0.2, 1.4, 1.41, 12, water_);
    for (const double x : {0.2, 0.74}) kit_.box({x, 0.47, 1}, {x + 0.06, 0.53, 2}, wood_);
    kit_.prism(0, std::array<std::array<double, 2>, 3>{{{0.25, 1.95}, {0.75, 1.95}, {0.5, 2.3}}},
               0.12, 0.88, tiles_);
  }

  void keep(int x, int y) {
    int width = 1, depth = 1;
    while (kPlan(x + width, y) == 'K') ++width;
    while (kPlan(x, y + depth) == 'K') ++depth;
    kit_.at(cell_);
    kit_.box({0.1, 0.1, 1}, {width - 0.1, depth - 0.1, 3.3}, plaster_);
    kit_.prism(0,
               std::array<std::array<double, 2>, 3>{
                   {{0, 3.3}, {1.0 * depth, 3.3}, {0.5 * depth, 3.3 + 0.8 * depth}}},
               0, width, tiles_);
    for (int i = 0; i < width; ++i) {
      for (const double wall : {0.07, depth - 0.1}) {
        for (const double z : {1.5, 2.4}) {
          // One door: a keep of any length would need another.
          if (z < 2 && wall < 1 && 2 * i == width) continue;
          kit_.box({i + 0.35, wall, z}, {i + 0.65, wall + 0.03, z + 0.5}, dark_);
        }
      }
      if (2 * i == width) {
        kit_.box({i + 0.3, 0.06, 1}, {i + 0.7, 0.1, 2}, wood_);
        kit_.box({i + 0.25, 0.04, 2}, {i + 0.75, 0.1, 2.1}, trim_);
      }
      // Timber between the windows.
      for (const double wall : {0.08, depth - 0.1}) {
        if (i > 0) kit_.box({i - 0.05, wall, 1}, {i + 0.05, wall + 0.02, 3.3}, wood_);
      }
    }
    for (int j = 0; j < depth; ++j) {
      for (const double wall : {0.07, width - 0.1}) {
        kit_.box({wall, j + 0.35, 2.4}, {wall + 0.03, j + 0.65, 2.9}, dark_);
      }
    }
  }

  PieceKit kit_{{kPlan.width(), kPlan.depth(), 7}};
  Vec3i cell_;
  std::uint32_t grass_ = kit_.material("grass", {0.13f, 0.26f, 0.06f}),
                earth_ = kit_.material("earth", {0.2f, 0.12f, 0.07f}),
                paving_ = kit_.material("paving", {0.36f, 0.31f, 0.24f}),
                stone_ = kit_.material("stone", {0.46f, 0.43f, 0.38f}),
                trim_ = kit_.material("pale stone", {0.6f, 0.57f, 0.5f}),
                tiles_ = kit_.material("roof tiles", {0.42f, 0.1f, 0.06f}),
                plaster_ = kit_.material("plaster", {0.7f, 0.62f, 0.48f}),
                wood_ = kit_.material("wood", {0.16f, 0.08f, 0.04f}),
                dark_ = kit_.material("window", {0.02f, 0.02f, 0.03f}, 0.3f),
                iron_ = kit_.material("iron", {0.1f, 0.1f, 0.11f}, 0.5f, 1),
                water_ = kit_.material("water", {0.05f, 0.12f, 0.2f}, 0.1f);
};

}  // namespace

ProcessSample makeCastle() { return Castle().make(); }

}  // namespace exemplar
