// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/procedural/piece_kit.h"
#include "mesh/procedural/piece_scenes.h"

namespace exemplar {
namespace {

// # wall, W wall with a window, D door, g gallery over shelves along the wall, C column under the
// gallery's corner, r s stairs up to the gallery (r below s), B free-standing shelves, T table with
// lamps, G globe, p plant, _ floor, . lawn
const Plan kPlan({
    "......................",  //
    ".#WW#WW#WW#WW#WW#WW#..",  //
    ".WgggggggggWgggggggW..",  //
    ".Wg_____p_gWg_____gW..",  //
    ".#g_BB_BB_g#g_TTT_g#..",  //
    ".Wg_______gWg_____gW..",  //
    ".Wg_TTTT__gWg_BBB_gW..",  //
    ".#g_______g#g_____g#..",  //
    ".Wg_G_BBB_gWgrs___gW..",  //
    ".Wgrs_____gWgggggggW..",  //
    ".#ggggDgggg#WW#WW#D#..",  //
    ".WWW#D#WW#W#___p___W..",  //
    ".W____p____D_TTTT__W..",  //
    ".#_BBB__BB_#_______#..",  //
    ".W_________W_BB_BB_W..",  //
    ".W_TTT_G_p_W___G___W..",  //
    ".#WW#WDW#W##WW#D#WW#..",  //
    "......................",  //
});
const std::string kWalls = "#WD";
constexpr double kWallTop = 4, kGallery = 3;

class Library {
 public:
  ProcessSample make() {
    kit_.ground(
        0.6,
        [&](int x, int y) {
          // Walls stand on stone: indoors and outdoors meet nowhere else.
          const bool wall = kWalls.find(kPlan(x, y)) != std::string::npos;
          return kPlan(x, y) == '.' ? lawn_ : wall ? stone_ : parquet_;
        },
        earth_);
    kPlan.each([&](int x, int y, char c) {
      cell_ = {x, y, 0};
      kit_.at(cell_);
      const unsigned walls = kPlan.sides(x, y, kWalls);
      if (c == '#') wall(walls);
      if (c == 'W') window(walls);
      if (c == 'D') door(walls);
      if (c == 'g') gallery(x, y, walls);
      if (c == 'r') stairs(x, y, 1);
      if (c == 's') stairs(x, y, 2);
      if (c == 'B') shelves(kPlan.sides(x, y, "B"));
      if (c == 'T') table(kPlan.sides(x, y, "T"));
      if (c == 'G') globe();
      if (c == 'p') plant();
    });
    return kit_.take();
  }

 private:
  void wall(unsigned sides) {
    kit_.beams(sides, 0.15, 1, kWallTop, brick_);
    kit_.beams(sides, 0.19, kWallTop, kWallTop + 0.12, stone_);
  }

  /// Straight pieces alone have openings; what is none becomes a wall.
  bool alongX(unsigned sides, bool& straight) const {
    straight = sides == (kEast | kWest) || sides == (kNorth | kSouth);
    return (sides & kEast) != 0;
  }

  void window(unsigned sides) {
    bool straight;
    const bool along = alongX(sides, straight);
    if (!straight) return wall(sides);
    kit_.at(cell_, along ? 0 : 1);
    kit_.box({0, 0.35, 1}, {1, 0.65, 1.7}, brick_, kMinX | kMaxX);
    kit_.box({0, 0.35, 3.4}, {1, 0.65, kWallTop}, brick_, kMinX | kMaxX);
    kit_.box({0, 0.35, 1.7}, {0.18, 0.65, 3.4}, brick_, kMinX);
    kit_.box({0.82, 0.35, 1.7}, {1, 0.65, 3.4}, brick_, kMaxX);
    kit_.box({0.18, 0.47, 1.7}, {0.82, 0.53, 3.4}, glass_);
    kit_.box({0.47, 0.45, 1.7}, {0.53, 0.55, 3.4}, stone_);
    kit_.box({0.18, 0.45, 2.6}, {0.82, 0.55, 2.66}, stone_);
    kit_.box({0, 0.31, kWallTop}, {1, 0.69, kWallTop + 0.12}, stone_, kMinX | kMaxX);
  }

  void door(unsigned sides) {
    bool straight;
    const bool along = alongX(sides, straight);
    if (!straight) return wall(sides);
    kit_.at(cell_, along ? 0 : 1);
    kit_.box({0, 0.35, 1}, {0.15, 0.65, kWallTop}, brick_, kMinX);
    kit_.box({0.85, 0.35, 1}, {1, 0.65, kWallTop}, brick_, kMaxX);
    kit_.box({0.15, 0.35, 2.6}, {0.85, 0.65, kWallTop}, brick_);
    for (const double x : {0.15, 0.79}) kit_.box({x, 0.33, 1}, {x + 0.06, 0.67, 2.6}, wood_);
    // A leaf that stands open.
    kit_.box({0.16, 0.67, 1.02}, {0.21, 0.98, 2.5}, wood_);
    kit_.box({0, 0.31, kWallTop}, {1, 0.69, kWallTop + 0.12}, stone_, kMinX | kMaxX);
  }

  /// Books from x0 to x1 on a board, their backs to the south at y.
  void books(double x0, double x1, double y, double z, int pattern) {
    const std::uint32_t colors[] = {red_, green_, blue_, ochre_};
    const double heights[] = {0.3, 0.24, 0.33, 0.27};
    const double width = (x1 - x0) / 4;
    for (int n = 0; n < 4; ++n) {
      kit_.box({x0 + n * width + 0.01, y, z},
               {x0 + (n + 1) * width - 0.01, y + 0.12, z + heights[(n + pattern) % 4]},
               colors[(n + pattern) % 4]);
    }
  }

  /// A case of shelves against what lies to the north, `high` boards.
  void caseToNorth(double y, int boards) {
    kit_.box({0.04, y, 1}, {0.08, y + 0.3, 1 + 0.46 * boards}, wood_);
    kit_.box({0.92, y, 1}, {0.96, y + 0.3, 1 + 0.46 * boards}, wood_);
    kit_.box({0.08, y + 0.26, 1}, {0.92, y + 0.3, 1 + 0.46 * boards}, wood_);
    for (int n = 0; n < boards; ++n) {
      const double z = 1.04 + 0.46 * n;
      kit_.box({0.08, y, z}, {0.92, y + 0.26, z + 0.04}, wood_);
      books(0.1, 0.9, y + 0.06, z + 0.04, n);
    }
  }

  /// Shelves at each wall beside the cell, a floor on top of them, and a rail toward the room.
  void gallery(int x, int y, unsigned walls) {
    for (int turn = 0; turn < 4; ++turn) {
      const unsigned turned = turnedSides(walls, -turn);
      if (!(turned & kNorth) || kPlan(x, y) != 'g') continue;
      kit_.at(cell_, turn);
      caseToNorth(0.68, 4);
    }
    kit_.at(cell_);
    const unsigned on = kPlan.sides(x, y, "g");
    kit_.box({0, 0, kGallery - 0.1}, {1, 1, kGallery}, wood_,
             (on & kEast ? kMaxX : 0u) | (on & kWest ? kMinX : 0u) | (on & kNorth ? kMaxY : 0u) |
                 (on & kSouth ? kMinY : 0u));
    const unsigned rooms = kPlan.sides(x, y, "_BTGprsp");
    const unsigned stairs = kPlan.sides(x, y, "s");
    for (int turn = 0; turn < 4; ++turn) {
      const unsigned turned = turnedSides(rooms & ~stairs, -turn);
      if (!(turned & kEast)) continue;
      kit_.at(cell_, turn);
      kit_.box({0.93, 0, kGallery + 0.4}, {0.97, 1, kGallery + 0.45}, brass_);
      for (const double post : {0.23, 0.73}) {
        kit_.box({0.94, post, kGallery}, {0.96, post + 0.04, kGallery + 0.4}, brass_);
      }
    }
  }

  /// Steps to the east of the gallery they lead up to: the upper flight is `flight` 2.
  void stairs(int, int, int flight) {
    kit_.at(cell_);
    for (int step = 0; step < 6; ++step) {
      const double top = flight + (step + 1) / 6.0;
      kit_.box({step / 6.0, 0.15, std::max(1.0, top - 0.4)}, {(step + 1) / 6.0, 0.85, top}, wood_);
    }
  }

  void shelves(unsigned sides) {
    const int turn = sides & (kNorth | kSouth) ? 1 : 0;
    for (const int side : {turn, turn + 2}) {
      kit_.at(cell_, side);
      caseToNorth(0.2, 3);
    }
  }

  void table(unsigned sides) {
    const bool along = !(sides & (kNorth | kSouth));
    kit_.at(cell_, along ? 0 : 1);
    const unsigned turned = along ? sides : turnedSides(sides, -1);
    const double west = turned & kWest ? 0 : 0.15, east = turned & kEast ? 1 : 0.85;
    kit_.box({west, 0.25, 1.42}, {east, 0.75, 1.48}, wood_,
             (turned & kWest ? kMinX : 0u) | (turned & kEast ? kMaxX : 0u));
    if (!(turned & kWest)) {
      for (const double y : {0.28, 0.68}) kit_.box({0.18, y, 1}, {0.22, y + 0.04, 1.42}, wood_);
    }
    if (!(turned & kEast)) {
      for (const double y : {0.28, 0.68}) kit_.box({0.78, y, 1}, {0.82, y + 0.04, 1.42}, wood_);
    }
    kit_.box({0.48, 0.48, 1.48}, {0.52, 0.52, 1.68}, brass_);
    kit_.spire(0.5, 0.5, 0.14, 1.68, 1.8, 8, lamp_);
    kit_.box({0.2, 0.32, 1.48}, {0.36, 0.44, 1.52}, blue_);
    kit_.box({0.64, 0.56, 1.48}, {0.82, 0.68, 1.54}, red_);
    for (const int side : {0, 2}) {
      kit_.at(cell_, (along ? 0 : 1) + side);
      kit_.box({0.38, 0.06, 1.2}, {0.62, 0.26, 1.24}, leather_);
      kit_.box({0.38, 0.04, 1.24}, {0.62, 0.08, 1.6}, leather_);
      kit_.box({0.47, 0.14, 1}, {0.53, 0.2, 1.2}, wood_);
    }
  }

  void globe() {
    kit_.column(0.5, 0.5, 0.18, 1, 1.06, 8, wood_);
    kit_.box({0.48, 0.48, 1.06}, {0.52, 0.52, 1.3}, brass_);
    kit_.ball({0.5, 0.5, 1.52}, {0.26, 0.26, 0.26}, ocean_, 3);
  }

  void plant() {
    kit_.taper(0.5, 0.5, 0.16, 0.22, 1, 1.3, 8, brick_);
    for (int turn = 0; turn < 4; ++turn) {
      kit_.at(cell_, turn);
      kit_.spire(0.6, 0.56, 0.1, 1.3, 1.95, 5, leaves_);
    }
    kit_.at(cell_);
    kit_.spire(0.5, 0.5, 0.12, 1.3, 2.2, 6, leaves_);
  }

  PieceKit kit_{{kPlan.width(), kPlan.depth(), 6}};
  Vec3i cell_;
  std::uint32_t lawn_ = kit_.material("lawn", {0.13f, 0.26f, 0.07f}),
                earth_ = kit_.material("earth", {0.2f, 0.12f, 0.07f}),
                parquet_ = kit_.material("parquet", {0.4f, 0.25f, 0.12f}, 0.5f),
                brick_ = kit_.material("brick", {0.45f, 0.2f, 0.13f}),
                stone_ = kit_.material("stone", {0.66f, 0.62f, 0.54f}),
                glass_ = kit_.material("glass", {0.35f, 0.5f, 0.58f}, 0.1f),
                wood_ = kit_.material("dark wood", {0.17f, 0.085f, 0.04f}, 0.6f),
                brass_ = kit_.material("brass", {0.62f, 0.44f, 0.16f}, 0.4f, 0.6f),
                leather_ = kit_.material("leather", {0.25f, 0.07f, 0.04f}, 0.6f),
                red_ = kit_.material("red book", {0.4f, 0.05f, 0.04f}),
                green_ = kit_.material("green book", {0.05f, 0.2f, 0.08f}),
                blue_ = kit_.material("blue book", {0.06f, 0.1f, 0.3f}),
                ochre_ = kit_.material("ochre book", {0.5f, 0.33f, 0.1f}),
                ocean_ = kit_.material("globe", {0.1f, 0.25f, 0.42f}, 0.4f),
                leaves_ = kit_.material("leaves", {0.08f, 0.24f, 0.06f}),
                lamp_ = kit_.material("lamp", {0.1f, 0.55f, 0.25f}, 0.5f, 0, 1);
};

}  // namespace

ProcessSample makeLibrary() { return Library().make(); }

}  // namespace exemplar
