// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/procedural/piece_kit.h"
#include "mesh/procedural/piece_scenes.h"

namespace exemplar {
namespace {

// H hall, h hall with a chimney, D hall with a door, T tower with a spire, C clock tower, = path,
// F fountain, t tree, - low wall, l lantern
const Plan kPlan({
    "......................",  //
    ".THHhHTHHHHCHHDHTHhHT.",  //
    ".H.t..H.t..H.=..H...H.",  //
    ".h.F..D.F..H.=..D.t.H.",  //
    ".H.t..HHHh.H.=..HHH.h.",  //
    ".THHHHH.t..H.=..H...H.",  //
    ".H....T....HHHDHT.F.H.",  //
    ".H.t..H.==.D....H.t.H.",  //
    ".D.==.H.==.H.t..HhHHT.",  //
    ".H.==.D.==.h....H...H.",  //
    ".CHDHHTHDHHTHH..THDHC.",  //
    "..l=l...=...==.l.l=...",  //
    "..HDHHT.=.t.==.THDH.t.",  //
    "..---.H.=...==.H.----.",  //
    "..THhHT.=.l.==.THhHT..",  //
    "......................",  //
});
const std::string kHouse = "HhDTC";
constexpr double kEaves = 3, kRidge = 3.8, kHalf = 0.32;

class Cluster {
 public:
  ProcessSample make() {
    kit_.ground(
        0.7, [&](int, int) { return lawn_; }, earth_);
    kPlan.each([&](int x, int y, char c) {
      cell_ = {x, y, 0};
      const unsigned sides = kPlan.sides(x, y, kHouse);
      if (c == 'H' || c == 'h' || c == 'D') hall(sides, c, kPlan.sides(x, y, "="));
      if (c == '=') {
        kit_.at(cell_);
        kit_.beams(kPlan.sides(x, y, "="), 0.3, 1, 1.03, path_);
      }
      if (c == 'F') fountain();
      if (c == 't') tree();
      if (c == 'l') lantern();
      if (c == '-') lowWall(kPlan.sides(x, y, "-"));
      if (c == 'T') tower(sides);
      if (c == 'C') clockTower(sides);
    });
    return kit_.take();
  }

 private:
  static constexpr std::array<std::array<double, 2>, 3> kGable{
      {{0.5 - kHalf - 0.08, kEaves}, {0.5 + kHalf + 0.08, kEaves}, {0.5, kRidge}}};

  /// A pointed window in the southern wall, its middle at x.
  void window(double x, double z) {
    const double wall = 0.5 - kHalf;
    kit_.prism(
        1,
        std::array<std::array<double, 2>, 5>{
            {{z, x - 0.09}, {z + 0.75, x - 0.09}, {z + 1, x}, {z + 0.75, x + 0.09}, {z, x + 0.09}}},
        wall - 0.02, wall, glass_);
  }

  void hall(unsigned sides, char kind, unsigned paths) {
    kit_.at(cell_);
    kit_.beams(sides, kHalf, 1, kEaves, stone_);
    if (sides == (kEast | kWest) || sides == (kNorth | kSouth)) {
      const int turn = sides & kEast ? 0 : 1;
      kit_.at(cell_, turn);
      kit_.prism(0, kGable, 0, 1, slate_, 0);
      for (const int side : {turn, turn + 2}) {
        kit_.at(cell_, side);
        // A door where a path comes, else on the sunny side.
        const unsigned door = paths != 0 ? turnedSides(paths, -side) & kSouth : side == turn;
        if (kind == 'D' && door) {
          porch();
        } else {
          window(0.25, 1.5);
          window(0.75, 1.5);
          buttress();
        }
      }
      if (kind == 'h') {
        kit_.at(cell_, turn);
        kit_.box({0.42, 0.32, kEaves + 0.2}, {0.58, 0.44, kRidge + 0.4}, brick_);
        kit_.box({0.45, 0.34, kRidge + 0.4}, {0.49, 0.42, kRidge + 0.55}, brick_);
        kit_.box({0.51, 0.34, kRidge + 0.4}, {0.55, 0.42, kRidge + 0.55}, brick_);
      }
      return;
    }
    for (int turn = 0; turn < 4; ++turn) {
      const unsigned turned = turnedSides(sides, -turn);
      kit_.at(cell_, turn);
      // The roofs of the arms run into each other; a hall that ends has a gable.
      if (turned & kEast) kit_.prism(0, kGable, 0.5 - kHalf - 0.08, 1, slate_, 1);
      if (turned & kSouth) continue;
      window(0.5, 1.5);
      if (countSides(sides) == 1 && turned == kNorth) rose();
    }
  }

  void buttress() {
    const double wall = 0.5 - kHalf;
    kit_.prism(0,
               std::array<std::array<double, 2>, 4>{
                   {{wall - 0.14, 1}, {wall, 1}, {wall, 2.8}, {wall - 0.14, 2.3}}},
               0.45, 0.55, pale_);
  }

  void porch() {
    const double wall = 0.5 - kHalf;
    kit_.box({0.34, wall - 0.02, 1}, {0.66, wall, 2}, wood_);
    for (const double x : {0.22, 0.7}) kit_.box({x, wall - 0.15, 1}, {x + 0.08, wall, 2.1}, pale_);
    kit_.prism(1, std::array<std::array<double, 2>, 3>{{{2.1, 0.18}, {2.5, 0.5}, {2.1, 0.82}}},
               wall - 0.16, wall, slate_);
    window(0.5, 2);
  }

  void fountain() {
    kit_.at(cell_);
    kit_.column(0.5, 0.5, 0.44, 1, 1.2, 12, pale_);
    kit_.column(0.5, 0.5, 0.38, 1.2, 1.21, 12, water_);
    kit_.column(0.5, 0.5, 0.07, 1.2, 1.6, 8, pale_);
    kit_.taper(0.5, 0.5, 0.08, 0.24, 1.6, 1.7, 10, pale_);
    kit_.spire(0.5, 0.5, 0.05, 1.7, 2.1, 6, water_);
  }

  void tree() {
    kit_.at(cell_);
    kit_.column(0.5, 0.5, 0.06, 1, 1.7, 6, wood_);
    kit_.ball({0.5, 0.5, 2.05}, {0.38, 0.38, 0.5}, leaves_, 2);
  }

  void lantern() {
    kit_.at(cell_);
    kit_.column(0.5, 0.5, 0.12, 1, 1.1, 8, iron_);
    kit_.column(0.5, 0.5, 0.04, 1.1, 2.1, 6, iron_);
    kit_.column(0.5, 0.5, 0.1, 2.1, 2.35, 6, lamp_);
    kit_.spire(0.5, 0.5, 0.13, 2.35, 2.5, 6, iron_);
  }

  void lowWall(unsigned sides) {
    kit_.at(cell_);
    kit_.beams(sides, 0.08, 1, 1.5, stone_);
    if (countSides(sides) < 2) kit_.box({0.36, 0.36, 1}, {0.64, 0.64, 1.75}, pale_);
  }

  /// A round window in a gable to the south.
  void rose() {
    const double wall = 0.5 - kHalf - 0.08;
    std::vector<std::array<double, 2>> circle;
    for (int n = 0; n < 8; ++n) {
      const double c[] = {0.12, 0.085, 0, -0.085, -0.12, -0.085, 0, 0.085};
      circle.push_back({3.26 - c[n], 0.5 + c[(n + 2) % 8]});
    }
    kit_.prism(1, circle, wall - 0.02, wall, glass_);
  }

  /// The ends of halls that run into a tower.
  void ends(unsigned sides) {
    for (int turn = 0; turn < 4; ++turn) {
      if (!(turnedSides(sides, -turn) & kEast)) continue;
      kit_.at(cell_, turn);
      kit_.box({0.85, 0.5 - kHalf, 1}, {1, 0.5 + kHalf, kEaves}, stone_, kMaxX);
      kit_.prism(0, kGable, 0.85, 1, slate_, 1);
    }
  }

  void pinnacles(double inset, double z) {
    for (int turn = 0; turn < 4; ++turn) {
      kit_.at(cell_, turn);
      kit_.column(inset, inset, 0.09, z, z + 0.5, 4, pale_);
      kit_.spire(inset, inset, 0.09, z + 0.5, z + 1, 4, slate_);
    }
  }

  void tower(unsigned sides) {
    ends(sides);
    kit_.at(cell_);
    kit_.box({0.1, 0.1, 1}, {0.9, 0.9, 5}, stone_);
    kit_.box({0.06, 0.06, 5}, {0.94, 0.94, 5.15}, pale_);
    kit_.spire(0.5, 0.5, 0.46, 5.15, 7.6, 8, slate_);
    pinnacles(0.18, 5.15);
    for (int turn = 0; turn < 4; ++turn) {
      kit_.at(cell_, turn);
      kit_.box({0.36, 0.08, 4.1}, {0.46, 0.1, 4.75}, glass_);
      kit_.box({0.54, 0.08, 4.1}, {0.64, 0.1, 4.75}, glass_);
    }
  }

  void clockTower(unsigned sides) {
    ends(sides);
    kit_.at(cell_);
    kit_.box({0.08, 0.08, 1}, {0.92, 0.92, 6.2}, stone_);
    kit_.box({0.03, 0.03, 6.2}, {0.97, 0.97, 7.4}, pale_);
    kit_.spire(0.5, 0.5, 0.62, 7.4, 9.7, 4, slate_);
    for (int turn = 0; turn < 4; ++turn) {
      kit_.at(cell_, turn);
      std::vector<std::array<double, 2>> face;
      for (int n = 0; n < 8; ++n) {
        const double c[] = {0.36, 0.25, 0, -0.25, -0.36, -0.25, 0, 0.25};
        face.push_back({6.8 - c[n], 0.5 + c[(n + 2) % 8]});
      }
      kit_.prism(1, face, 0.01, 0.03, dial_);
      kit_.box({0.48, 0, 6.8}, {0.52, 0.01, 7.08}, iron_);
      kit_.box({0.5, 0, 6.78}, {0.7, 0.01, 6.82}, iron_);
      for (int storey = 3; storey < 6; ++storey) {
        kit_.box({0.45, 0.06, storey + 0.3}, {0.55, 0.08, storey + 0.8}, glass_);
      }
    }
  }

  PieceKit kit_{{kPlan.width(), kPlan.depth(), 11}};
  Vec3i cell_;
  std::uint32_t lawn_ = kit_.material("lawn", {0.12f, 0.26f, 0.06f}),
                earth_ = kit_.material("earth", {0.2f, 0.12f, 0.07f}),
                path_ = kit_.material("path", {0.5f, 0.44f, 0.34f}),
                stone_ = kit_.material("sandstone", {0.56f, 0.44f, 0.27f}),
                pale_ = kit_.material("pale stone", {0.68f, 0.58f, 0.4f}),
                slate_ = kit_.material("slate", {0.12f, 0.14f, 0.18f}),
                glass_ = kit_.material("window", {0.04f, 0.06f, 0.1f}, 0.2f),
                dial_ = kit_.material("dial", {0.8f, 0.78f, 0.7f}),
                iron_ = kit_.material("iron", {0.03f, 0.03f, 0.03f}),
                brick_ = kit_.material("brick", {0.34f, 0.14f, 0.09f}),
                wood_ = kit_.material("wood", {0.16f, 0.08f, 0.04f}),
                leaves_ = kit_.material("leaves", {0.08f, 0.2f, 0.04f}),
                water_ = kit_.material("water", {0.1f, 0.25f, 0.35f}, 0.1f),
                lamp_ = kit_.material("lamp", {1, 0.85f, 0.55f}, 0.8f, 0, 1.5f);
};

}  // namespace

ProcessSample makeCluster() { return Cluster().make(); }

}  // namespace exemplar
