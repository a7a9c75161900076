// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/procedural/piece_kit.h"
#include "mesh/procedural/piece_scenes.h"

namespace exemplar {
namespace {

// P tall fir, p low fir, O oak (the middle of 3 x 3), B birch, b bush, f ferns, m mushrooms, s
// stone, l log lying along x, ~ brook, = planks over it
const Plan kPlan({
    "....................",  //
    "..f..P...b...B..p...",  //
    ".P.b...p...s...f..P.",  //
    "...........f.m......",  //
    ".b..O..P.B...~~~.b..",  //
    ".f........p..~.~....",  //
    ".s.....m.~~~~~.~.P..",  //
    "..p.b..f.~...s.~~=~.",  //
    ".P.....~~~.O....f.~.",  //
    "...ll..~........b.~.",  //
    ".B...P.=..f...p.~~~.",  //
    "..f....~.b..m...~.s.",  //
    ".b...~~~..P...B.~~~.",  //
    "...p.~..s..f..b...~.",  //
    ".s...~~~~~...ll.p.~.",  //
    ".P.b..f..~~~.....~~.",  //
    "...........~~~~~~~..",  //
    "....................",  //
});

class Forest {
 public:
  ProcessSample make() {
    kit_.ground(
        0.4, [&](int x, int y) { return isBrook(x, y) ? PieceKit::kNone : moss_; }, earth_);
    kPlan.each([&](int x, int y, char c) {
      kit_.at({x, y, 0});
      if (isBrook(x, y)) brook(kPlan.sides(x, y, "~="));
      kit_.at({x, y, 0});
      if (c == '=') planks();
      if (c == 'P') fir(4.6);
      if (c == 'p') fir(2.6);
      if (c == 'B') birch();
      if (c == 'O') oak(x, y);
      if (c == 'b') bush();
      if (c == 'f') ferns();
      if (c == 'm') mushrooms();
      if (c == 's') kit_.ball({0.5, 0.48, 1.05}, {0.3, 0.24, 0.2}, stone_, 1);
      if (c == 'l') log(kPlan.sides(x, y, "l"));
    });
    return kit_.take();
  }

 private:
  static bool isBrook(int x, int y) { return kPlan(x, y) == '~' || kPlan(x, y) == '='; }

  /// A ditch with water that goes on to some sides; what is not water is moss. Closed: each slope
  /// meets the next along the edges at the ditch's corners.
  void brook(unsigned sides) {
    kit_.at(cell());
    kit_.face(std::array{Vec3d{0.3, 0.3, 0.8}, Vec3d{0.7, 0.3, 0.8}, Vec3d{0.7, 0.7, 0.8},
                         Vec3d{0.3, 0.7, 0.8}},
              water_);
    for (int turn = 0; turn < 4; ++turn) {
      kit_.at(cell(), turn);
      // The corner between east and north.
      kit_.face(
          std::array{Vec3d{0.75, 0.75, 1}, Vec3d{1, 0.75, 1}, Vec3d{1, 1, 1}, Vec3d{0.75, 1, 1}},
          moss_);
      if (turnedSides(sides, -turn) & kEast) {
        kit_.face(std::array{Vec3d{0.7, 0.3, 0.8}, Vec3d{1, 0.3, 0.8}, Vec3d{1, 0.7, 0.8},
                             Vec3d{0.7, 0.7, 0.8}},
                  water_);
        kit_.face(std::array{Vec3d{0.7, 0.7, 0.8}, Vec3d{1, 0.7, 0.8}, Vec3d{1, 0.75, 1},
                             Vec3d{0.75, 0.75, 1}},
                  earth_);
        kit_.face(std::array{Vec3d{0.75, 0.25, 1}, Vec3d{1, 0.25, 1}, Vec3d{1, 0.3, 0.8},
                             Vec3d{0.7, 0.3, 0.8}},
                  earth_);
      } else {
        kit_.face(std::array{Vec3d{0.7, 0.3, 0.8}, Vec3d{0.75, 0.25, 1}, Vec3d{0.75, 0.75, 1},
                             Vec3d{0.7, 0.7, 0.8}},
                  earth_);
        kit_.face(std::array{Vec3d{0.75, 0.25, 1}, Vec3d{1, 0.25, 1}, Vec3d{1, 0.75, 1},
                             Vec3d{0.75, 0.75, 1}},
                  moss_);
      }
    }
  }

  Vec3i cell() const { return kit_.cell(); }

  void planks() {
    const Vec3i c = cell();
    kit_.at(c, kPlan.sides(c.x, c.y, "~=") & (kEast | kWest) ? 1 : 0);
    for (int n = 0; n < 5; ++n) {
      kit_.box({0.05 + 0.19 * n, 0.2, 1.02}, {0.2 + 0.19 * n, 0.8, 1.07}, wood_);
    }
    for (const double y : {0.22, 0.72}) kit_.box({0, y, 0.96}, {1, y + 0.06, 1.02}, wood_);
  }

  void fir(double height) {
    kit_.column(0.5, 0.5, 0.08, 1, 1.6, 7, bark_);
    const int tiers = height > 3 ? 4 : 2;
    for (int n = 0; n < tiers; ++n) {
      const double z = 1.4 + (height - 1.4) * n / tiers;
      kit_.spire(0.5, 0.5, 0.48 - 0.08 * n, z, z + height / tiers, 9, n % 2 ? fir2_ : fir_);
    }
  }

  void birch() {
    kit_.column(0.5, 0.5, 0.05, 1, 3.2, 7, birch_);
    for (const double z : {1.3, 1.8, 2.2}) kit_.box({0.44, 0.46, z}, {0.56, 0.54, z + 0.04}, bark_);
    kit_.ball({0.5, 0.5, 2.9}, {0.36, 0.36, 0.5}, light_, 2);
    kit_.ball({0.5, 0.5, 3.6}, {0.26, 0.26, 0.42}, light_, 2);
  }

  /// A trunk with boughs and a crown over nine cells.
  void oak(int x, int y) {
    kit_.taper(0.5, 0.5, 0.3, 0.16, 1, 2.4, 9, bark_);
    for (int turn = 0; turn < 4; ++turn) {
      kit_.at({x, y, 0}, turn);
      kit_.prism(
          1, std::array<std::array<double, 2>, 4>{{{2, 0.5}, {2.25, 0.5}, {3, 1.25}, {2.88, 1.3}}},
          0.44, 0.56, bark_);
      kit_.ball({1.2, 0.5, 3.05}, {0.62, 0.7, 0.55}, turn % 2 ? leaf_ : leaf2_, 3);
      kit_.ball({1.05, 1.05, 3.2}, {0.6, 0.6, 0.5}, turn % 2 ? leaf2_ : leaf_, 3);
    }
    kit_.at({x, y, 0});
    kit_.ball({0.5, 0.5, 3.75}, {0.85, 0.85, 0.7}, leaf_, 3);
  }

  void bush() {
    kit_.ball({0.42, 0.45, 1.16}, {0.28, 0.28, 0.24}, leaf2_, 2);
    kit_.ball({0.62, 0.6, 1.12}, {0.22, 0.22, 0.2}, leaf_, 2);
    for (const double x : {0.34, 0.5, 0.6}) {
      kit_.box({x, 0.24, 1.2}, {x + 0.04, 0.28, 1.24}, berry_);
    }
  }

  void ferns() {
    for (int turn = 0; turn < 4; ++turn) {
      kit_.at(cell(), turn);
      kit_.face(std::array{Vec3d{0.5, 0.46, 1}, Vec3d{0.72, 0.4, 1.26}, Vec3d{0.92, 0.5, 1.12},
                           Vec3d{0.72, 0.6, 1.26}},
                light_);
      kit_.face(std::array{Vec3d{0.72, 0.6, 1.26}, Vec3d{0.92, 0.5, 1.12}, Vec3d{0.72, 0.4, 1.26},
                           Vec3d{0.5, 0.46, 1}},
                light_);
    }
  }

  void mushrooms() {
    for (const auto& [x, y, h] :
         std::initializer_list<std::array<double, 3>>{{0.4, 0.4, 0.3}, {0.62, 0.5, 0.2}}) {
      kit_.column(x, y, 0.05, 1, 1 + h, 6, birch_);
      kit_.spire(x, y, 0.16, 1 + h, 1.16 + h, 9, cap_);
    }
  }

  void log(unsigned sides) {
    kit_.at(cell(), sides & kWest ? 2 : 0);
    std::vector<std::array<double, 2>> circle;
    const double c[] = {0.18, 0.13, 0, -0.13, -0.18, -0.13, 0, 0.13};
    for (int n = 0; n < 8; ++n) circle.push_back({0.5 + c[n], 1.18 + c[(n + 6) % 8]});
    kit_.prism(0, circle, 0.2, 1, bark_, 1);
    kit_.prism(0, circle, 0.18, 0.2, wood_, 1);
  }

  PieceKit kit_{{kPlan.width(), kPlan.depth(), 7}};
  std::uint32_t moss_ = kit_.material("moss", {0.09f, 0.17f, 0.04f}),
                earth_ = kit_.material("earth", {0.14f, 0.08f, 0.045f}),
                water_ = kit_.material("water", {0.06f, 0.15f, 0.2f}, 0.1f),
                bark_ = kit_.material("bark", {0.13f, 0.075f, 0.04f}),
                birch_ = kit_.material("birch bark", {0.72f, 0.7f, 0.64f}),
                wood_ = kit_.material("wood", {0.42f, 0.27f, 0.14f}),
                fir_ = kit_.material("fir", {0.03f, 0.12f, 0.05f}),
                fir2_ = kit_.material("fir, lighter", {0.05f, 0.16f, 0.06f}),
                leaf_ = kit_.material("oak leaves", {0.1f, 0.23f, 0.04f}),
                leaf2_ = kit_.material("oak leaves, darker", {0.07f, 0.18f, 0.03f}),
                light_ = kit_.material("light leaves", {0.26f, 0.38f, 0.07f}),
                stone_ = kit_.material("stone", {0.32f, 0.31f, 0.29f}),
                berry_ = kit_.material("berries", {0.5f, 0.03f, 0.04f}),
                cap_ = kit_.material("mushroom", {0.55f, 0.07f, 0.04f});
};

}  // namespace

ProcessSample makeForest() { return Forest().make(); }

}  // namespace exemplar
