// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/procedural/piece_kit.h"
#include "mesh/procedural/piece_scenes.h"

namespace exemplar {
namespace {

// # road; on roads: > and < cars that drive east and west, ^ and v north and south, T a lorry
// (east), b a bus (north). Others: l lamp beside a road, p park with a tree, . pavement,
// A tower of glass, B office block with a roof garden, C old house with a pitched roof, D stepped
// tower, each as large as its letters reach
const Plan kPlan({
    ".......................",  //
    ".#####<####>###<##>###.",  //
    ".#l.l.#l.lp.#l.l..l.l#.",  //
    ".^.AA.#.BBB.#.CCCC..l#.",  //
    ".#lAA.v.BBB.#.CCCC.pp^.",  //
    ".#..l.#.BBBl^l.l..l.p#.",  //
    ".#####b##>###T##<####v.",  //
    ".#l.l.#l.l..#l.l..l.l#.",  //
    ".v.CC.#.DDD.#.AA.BBB.#.",  //
    ".#lCC.#.DDD.v.AA.BBBl#.",  //
    ".#.CC.^.DDD.#.AA.BBB.#.",  //
    ".#lCC.#l.l..#l.l.BBB.b.",  //
    ".#..l.##>##<##T##.l.l#.",  //
    ".#lpp.#l.l..#l.l#l.pl#.",  //
    ".^.pp.#.AA..#.p.#.DDD#.",  //
    ".#l.pl#.AA.l#..p^.DDD#.",  //
    ".#....#..l..#l..#.DDD^.",  //
    ".##<#>###T##<#>####b##.",  //
    ".......................",  //
});
const std::string kRoads = "#><^vTb";

class City {
 public:
  ProcessSample make() {
    kit_.ground(
        0.7,
        [&](int x, int y) {
          return isRoad(x, y) ? asphalt_ : kPlan(x, y) == 'p' ? lawn_ : foundation(kPlan(x, y));
        },
        concrete_);
    kPlan.each([&](int x, int y, char c) {
      cell_ = {x, y, 0};
      if (isRoad(x, y)) road(x, y, c);
      if (c == 'l') lamp(x, y);
      if (c == 'p') tree();
      const std::string buildings = "ABCD";
      if (buildings.find(c) == std::string::npos) return;
      if (kPlan(x - 1, y) == c || kPlan(x, y - 1) == c) return;
      int width = 1, depth = 1;
      while (kPlan(x + width, y) == c) ++width;
      while (kPlan(x, y + depth) == c) ++depth;
      kit_.at(cell_);
      if (c == 'A') glassTower(width, depth);
      if (c == 'B') offices(width, depth);
      if (c == 'C') houses(width, depth);
      if (c == 'D') steppedTower(width, depth);
    });
    return kit_.take();
  }

 private:
  static bool isRoad(int x, int y) { return kRoads.find(kPlan(x, y)) != std::string::npos; }

  /// Each kind of building stands on ground of its own.
  std::uint32_t foundation(char c) const {
    return c == 'A'   ? basalt_
           : c == 'B' ? brick_
           : c == 'C' ? plaster_
           : c == 'D' ? stone_
                      : pavement_;
  }

  void road(int x, int y, char c) {
    const unsigned sides = kPlan.sides(x, y, kRoads);
    const bool along = sides == (kEast | kWest), across = sides == (kNorth | kSouth);
    // A kerb on each side without a road, and at corners between roads.
    for (int turn = 0; turn < 4; ++turn) {
      const unsigned turned = turnedSides(sides, -turn);
      kit_.at(cell_, turn);
      if (!(turned & kEast)) kit_.box({0.95, 0, 1}, {1, 1, 1.05}, concrete_);
      if ((turned & kEast) && (turned & kNorth)) {
        kit_.box({0.95, 0.95, 1}, {1, 1, 1.05}, concrete_);
      }
    }
    if (along || across) {
      kit_.at(cell_, along ? 0 : 1);
      kit_.box({0.3, 0.48, 1}, {0.7, 0.52, 1.01}, paint_);
    } else if (countSides(sides) >= 3) {
      // Stripes to walk over, where the roads come in.
      for (int turn = 0; turn < 4; ++turn) {
        if (!(turnedSides(sides, -turn) & kEast)) continue;
        kit_.at(cell_, turn);
        for (int n = 0; n < 4; ++n) {
          kit_.box({0.8, 0.14 + 0.2 * n, 1}, {0.96, 0.24 + 0.2 * n, 1.01}, paint_);
        }
      }
      // A traffic light hangs over the middle.
      kit_.at(cell_);
      kit_.box({0.46, 0.46, 1.75}, {0.54, 0.54, 1.95}, dark_);
      kit_.box({0.45, 0.47, 1.77}, {0.46, 0.53, 1.82}, green_);
      kit_.box({0.54, 0.47, 1.77}, {0.55, 0.53, 1.82}, green_);
      kit_.box({0.47, 0.45, 1.88}, {0.53, 0.46, 1.93}, red_);
      kit_.box({0.47, 0.54, 1.88}, {0.53, 0.55, 1.93}, red_);
    }
    if (c == '>') car(0, blue_);
    if (c == '<') car(2, silver_);
    if (c == '^') car(1, orange_);
    if (c == 'v') car(3, silver_);
    if (c == 'T') lorry(0);
    if (c == 'b') lorry(1);
  }

  /// Drives to the east on the right-hand side, before turning.
  void car(int turn, std::uint32_t paint) {
    kit_.at(cell_, turn);
    kit_.box({0.25, 0.18, 1.04}, {0.75, 0.4, 1.16}, paint);
    kit_.box({0.35, 0.2, 1.16}, {0.62, 0.38, 1.26}, dark_);
    lights(0.25, 0.75);
  }
  void lorry(int turn) {
    kit_.at(cell_, turn);
    kit_.box({0.12, 0.14, 1.05}, {0.72, 0.43, 1.5}, white_);
    kit_.box({0.74, 0.16, 1.05}, {0.9, 0.41, 1.35}, orange_);
    lights(0.12, 0.9);
  }
  void lights(double back, double front) {
    for (const double y : {0.2, 0.33}) {
      kit_.box({front, y, 1.08}, {front + 0.02, y + 0.05, 1.13}, headlight_);
      kit_.box({back - 0.02, y, 1.08}, {back, y + 0.05, 1.13}, red_);
    }
  }

  /// Leans over the nearest road.
  void lamp(int x, int y) {
    const unsigned roads = kPlan.sides(x, y, kRoads);
    int turn = 0;
    while (turn < 3 && !(turnedSides(roads, -turn) & kEast)) ++turn;
    kit_.at(cell_, turn);
    kit_.box({0.72, 0.47, 1}, {0.78, 0.53, 2.2}, iron_);
    kit_.box({0.78, 0.48, 2.14}, {1, 0.52, 2.2}, iron_, 0);
    kit_.box({0.86, 0.45, 2.08}, {0.98, 0.55, 2.14}, lamp_);
  }

  void tree() {
    kit_.at(cell_);
    kit_.column(0.5, 0.5, 0.06, 1, 1.5, 6, bark_);
    kit_.ball({0.5, 0.5, 1.68}, {0.36, 0.36, 0.3}, leaves_, 2);
  }

  /// Windows along the wall from (0, 0) to (length, 0) of a building, on one storey.
  void windows(int width, int depth, double inset, double z, std::uint32_t even,
               std::uint32_t odd) {
    for (int turn = 0; turn < 4; ++turn) {
      const int length = turn % 2 ? depth : width;
      for (int n = 0; n < length; ++n) {
        for (int half = 0; half < 2; ++half) {
          const double a = n + 0.16 + 0.4 * half, b = a + 0.28;
          const std::uint32_t light = (half + turn) % 2 ? odd : even;
          const double out = inset - 0.02, in = inset + 0.0;
          if (turn == 0) kit_.box({a, out, z}, {b, in, z + 0.5}, light);
          if (turn == 2) kit_.box({a, depth - in, z}, {b, depth - out, z + 0.5}, light);
          if (turn == 1) kit_.box({width - in, a, z}, {width - out, b, z + 0.5}, light);
          if (turn == 3) kit_.box({out, a, z}, {in, b, z + 0.5}, light);
        }
      }
    }
  }

  void glassTower(int width, int depth) {
    kit_.box({0.1, 0.1, 1}, {width - 0.1, depth - 0.1, 7.2}, glass_);
    for (int storey = 1; storey < 7; ++storey) {
      windows(width, depth, 0.1, storey + 0.3, storey % 2 ? lit_ : cold_, storey % 2 ? off_ : lit_);
    }
    kit_.box({width / 2.0 - 0.05, depth / 2.0 - 0.05, 7.2},
             {width / 2.0 + 0.05, depth / 2.0 + 0.05, 7.9}, iron_);
    kit_.box({width / 2.0 - 0.07, depth / 2.0 - 0.07, 7.9},
             {width / 2.0 + 0.07, depth / 2.0 + 0.07, 7.97}, red_);
  }

  void offices(int width, int depth) {
    kit_.box({0.08, 0.08, 1}, {width - 0.08, depth - 0.08, 4.05}, brick_);
    for (int storey = 1; storey < 4; ++storey) {
      windows(width, depth, 0.08, storey + 0.3, lit_, storey % 2 ? lit_ : off_);
    }
    // A parapet around the roof, and trees on it.
    kit_.box({0.04, 0.04, 4.05}, {width - 0.04, depth - 0.04, 4.2}, concrete_);
    for (int j = 0; j < depth; ++j) {
      for (int i = 0; i < width; ++i) {
        if (i > 0 && j > 0 && i + 1 < width && j + 1 < depth) {
          kit_.ball({i + 0.5, j + 0.5, 4.4}, {0.3, 0.3, 0.25}, leaves_, 2);
        }
      }
    }
  }

  void houses(int width, int depth) {
    kit_.box({0.1, 0.1, 1}, {width - 0.1, depth - 0.1, 3.1}, plaster_);
    for (int storey = 1; storey < 3; ++storey) {
      windows(width, depth, 0.1, storey + 0.3, storey % 2 ? shop_ : warm_, off_);
    }
    const bool alongX = width >= depth;
    const double across = alongX ? depth : width;
    // The polygon's two axes are y and z across x, and z and x across y.
    const double ridge = 3.1 + 0.45 * across;
    if (alongX) {
      kit_.prism(0,
                 std::array<std::array<double, 2>, 3>{
                     {{0.04, 3.1}, {depth - 0.04, 3.1}, {depth / 2.0, ridge}}},
                 0.04, width - 0.04, tiles_);
    } else {
      kit_.prism(1,
                 std::array<std::array<double, 2>, 3>{
                     {{3.1, 0.04}, {ridge, width / 2.0}, {3.1, width - 0.04}}},
                 0.04, depth - 0.04, tiles_);
    }
  }

  void steppedTower(int width, int depth) {
    const double middleX = width / 2.0, middleY = depth / 2.0;
    kit_.box({0.08, 0.08, 1}, {width - 0.08, depth - 0.08, 3}, stone_);
    kit_.box({0.5, 0.5, 3}, {width - 0.5, depth - 0.5, 5}, stone_);
    kit_.box({1, 1, 5}, {width - 1.0, depth - 1.0, 6.4}, stone_);
    kit_.spire(middleX, middleY, 0.55, 6.4, 8.4, 4, copper_);
    for (int storey = 1; storey < 3; ++storey) {
      windows(width, depth, 0.08, storey + 0.3, lit_, lit_);
    }
    for (int storey = 3; storey < 5; ++storey) {
      for (int n = 0; n < width - 1; ++n) {
        for (const double wall : {0.48, depth - 0.5}) {
          kit_.box({n + 0.8, wall, storey + 0.2}, {n + 1.2, wall + 0.02, storey + 0.7}, cold_);
        }
        for (const double wall : {0.48, width - 0.5}) {
          kit_.box({wall, n + 0.8, storey + 0.2}, {wall + 0.02, n + 1.2, storey + 0.7}, cold_);
        }
      }
    }
    for (const double wall : {0.98, depth - 1.0}) {
      kit_.box({1.3, wall, 5.3}, {width - 1.3, wall + 0.02, 6.1}, lit_);
    }
    for (const double wall : {0.98, width - 1.0}) {
      kit_.box({wall, 1.3, 5.3}, {wall + 0.02, depth - 1.3, 6.1}, lit_);
    }
  }

  PieceKit kit_{{kPlan.width(), kPlan.depth(), 10}};
  Vec3i cell_;
  std::uint32_t asphalt_ = kit_.material("asphalt", {0.02f, 0.02f, 0.025f}),
                pavement_ = kit_.material("pavement", {0.1f, 0.1f, 0.11f}),
                concrete_ = kit_.material("concrete", {0.16f, 0.16f, 0.17f}),
                basalt_ = kit_.material("basalt", {0.05f, 0.05f, 0.06f}),
                lawn_ = kit_.material("lawn", {0.02f, 0.06f, 0.025f}),
                paint_ = kit_.material("road paint", {0.5f, 0.5f, 0.48f}),
                glass_ = kit_.material("glass", {0.02f, 0.035f, 0.06f}, 0.15f),
                brick_ = kit_.material("brick", {0.1f, 0.045f, 0.035f}),
                plaster_ = kit_.material("plaster", {0.16f, 0.14f, 0.12f}),
                stone_ = kit_.material("stone", {0.13f, 0.12f, 0.11f}),
                tiles_ = kit_.material("roof tiles", {0.08f, 0.03f, 0.025f}),
                copper_ = kit_.material("copper", {0.06f, 0.2f, 0.16f}, 0.5f),
                iron_ = kit_.material("iron", {0.05f, 0.05f, 0.055f}, 0.5f, 1),
                bark_ = kit_.material("bark", {0.05f, 0.03f, 0.02f}),
                leaves_ = kit_.material("leaves", {0.025f, 0.07f, 0.02f}),
                dark_ = kit_.material("dark", {0.01f, 0.01f, 0.012f}, 0.2f),
                blue_ = kit_.material("blue car", {0.02f, 0.05f, 0.2f}, 0.3f),
                silver_ = kit_.material("silver car", {0.35f, 0.35f, 0.37f}, 0.3f),
                orange_ = kit_.material("orange car", {0.45f, 0.12f, 0.02f}, 0.3f),
                white_ = kit_.material("white", {0.6f, 0.6f, 0.6f}),
                lit_ = kit_.material("lit window", {1, 0.72f, 0.32f}, 0.8f, 0, 1.6f),
                warm_ = kit_.material("warm window", {1, 0.5f, 0.16f}, 0.8f, 0, 1.4f),
                cold_ = kit_.material("cold window", {0.6f, 0.8f, 1}, 0.8f, 0, 1.3f),
                shop_ = kit_.material("shop window", {1, 0.85f, 0.6f}, 0.8f, 0, 2.2f),
                off_ = kit_.material("dark window", {0.015f, 0.02f, 0.03f}, 0.15f),
                lamp_ = kit_.material("street lamp", {1, 0.8f, 0.5f}, 0.8f, 0, 6),
                headlight_ = kit_.material("headlight", {1, 0.95f, 0.8f}, 0.8f, 0, 5),
                red_ = kit_.material("red light", {1, 0.05f, 0.03f}, 0.8f, 0, 4),
                green_ = kit_.material("green light", {0.1f, 1, 0.3f}, 0.8f, 0, 4);
};

}  // namespace

ProcessSample makeCity() { return City().make(); }

}  // namespace exemplar
