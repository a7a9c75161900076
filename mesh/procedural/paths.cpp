// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <map>

#include "mesh/procedural/piece_kit.h"
#include "mesh/procedural/piece_scenes.h"

namespace exemplar {
namespace {

/// The garden below: h hedges, t tree, c cypress, o pond (3 x 3), = gravel, u urn.
const Plan kGarden({
    "................",  //
    ".t.c..........t.",  //
    ".hhhhh.==.hhhhh.",  //
    ".h...h.==.h...h.",  //
    ".h.c.h.==.h.t.h.",  //
    ".h...h.==.h...h.",  //
    ".hh.hh.==.hh.hh.",  //
    "...=======......",  //
    "...==ooo==...u..",  //
    "...==ooo==......",  //
    "...==ooo==...u..",  //
    "...=======......",  //
    ".hhhh..=..hhhhh.",  //
    ".h..u..=..u...h.",  //
    ".t..c..=....c.t.",  //
    "................",  //
});
constexpr Vec3i kSize{16, 16, 10};
constexpr Vec3i kSteps[4] = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};

/// What a cell of a path is: a slab with its top at the cell's top that goes on to some sides, or
/// stairs in the cell above the slab that they start from.
struct PathCell {
  unsigned sides = 0;  ///< of a slab
  int rises = -1;      ///< of stairs: toward kSteps[rises]
  char on = ' ';       ///< what stands on it, as in the moves
  int along = 0;       ///< which way it was walked when that was put there: 0 x, 1 y
};

class Paths {
 public:
  ProcessSample make() {
    // F a step forward, U stairs up, D stairs down, L and R turns; A an arch, K a kiosk, l a lamp,
    // b a bench, f a flag, p a plant, G a gatehouse on the slab reached.
    walk({1, 1, 1}, 0, "FFAFFlFUFAFFpFFUFLGFFbFAFLUFFKFFlFFLFDFFAFDFFbFFDFF");
    walk({1, 1, 1}, 1, "FlFFAFUFFGFpFUFRFAFFlFFbFFUFRFAFFpFFDFLFGFFFDFF");
    walk({3, 1, 1}, 1, "FFbFAFFLFRFUFpFRFFAFFDFF");
    walk({5, 7, 2}, 0, "FAFFLFbFFRFGFFLFFpFFRFFAF");
    walk({14, 13, 2}, 3, "FbFAFFRFFUFlFLFpFFDFFRFAFFF");
    walk({1, 13, 1}, 0, "FpFAFFRFFbFLFUFGFFLFFlF");
    walk({13, 2, 1}, 1, "FlFAFLFFpFRFFbFUFFAF");
    walk({9, 1, 2}, 1, "FpFFAFRFFlFLFGFFDFFbF");
    // Short ones that end on either side, so that any path may.
    walk({9, 14, 1}, 0, "FFF");
    walk({14, 5, 1}, 1, "FFF");
    for (const auto& [at, cell] : cells_) place({at[0], at[1], at[2]}, cell);
    for (const auto& [at, cell] : cells_) support({at[0], at[1], at[2]}, cell);
    kGarden.each([&](int x, int y, char c) { garden(x, y, c); });
    kit_.ground(
        0.6, [&](int x, int y) { return kGarden(x, y) == 'o' ? water_ : grass_; }, earth_);
    return kit_.take();
  }

 private:
  using Key = std::array<int, 3>;
  static Key key(const Vec3i& c) { return {c.x, c.y, c.z}; }

  bool isFree(const Vec3i& c) const { return !cells_.contains(key(c)); }
  static bool isInside(const Vec3i& c) {
    return c.x >= 1 && c.y >= 1 && c.x + 1 < kSize.x && c.y + 1 < kSize.y && c.z >= 1 &&
           c.z + 3 < kSize.z;
  }

  /// Follows the moves as far as the scene and what is there already let it.
  void walk(Vec3i here, int heading, const std::string& moves) {
    cells_[key(here)];
    for (const char move : moves) {
      const Vec3i step = kSteps[heading];
      if (move == 'L') heading = (heading + 1) & 3;
      if (move == 'R') heading = (heading + 3) & 3;
      if (std::string("AKlbfpG").find(move) != std::string::npos) {
        PathCell& cell = cells_[key(here)];
        if (isFree(here + Vec3i{0, 0, 1}) && isFree(here + Vec3i{0, 0, 2}) && cell.on == ' ') {
          cell.on = move;
          cell.along = heading & 1;
        }
      }
      if (move == 'F') {
        const Vec3i next = here + step;
        if (!isInside(next)) return;
        const auto found = cells_.find(key(next));
        if (found != cells_.end() && found->second.rises >= 0) return;
        if (!hasHeadroom(next)) return;
        cells_[key(here)].sides |= 1u << heading;
        cells_[key(next)].sides |= 1u << ((heading + 2) & 3);
        here = next;
      }
      if (move == 'U' || move == 'D') {
        // The stairs' cell lies in the layer of the upper slab.
        const bool up = move == 'U';
        const Vec3i stairs = here + step + Vec3i{0, 0, up ? 1 : 0};
        const Vec3i next = stairs + step + Vec3i{0, 0, up ? 0 : -1};
        if (!isInside(stairs) || !isInside(next) || !isFree(stairs) || !isFree(next)) return;
        if (!isFree(stairs - Vec3i{0, 0, 1}) || !hasHeadroom(stairs) || !hasHeadroom(next)) return;
        cells_[key(here)].sides |= 1u << heading;
        cells_[key(stairs)].rises = up ? heading : (heading + 2) & 3;
        cells_[key(next)].sides |= 1u << ((heading + 2) & 3);
        here = next;
      }
    }
  }

  /// Whoever walks on a slab needs the layer above it, and nobody may be walking just below.
  bool hasHeadroom(const Vec3i& c) const {
    return isFree(c + Vec3i{0, 0, 1}) && isFree(c - Vec3i{0, 0, 1});
  }

  void place(const Vec3i& c, const PathCell& cell) {
    if (cell.rises >= 0) return stairs(c, cell.rises);
    // Towards stairs a slab ends; toward a slab it goes on.
    unsigned ends = 0;
    for (int n = 0; n < 4; ++n) {
      const auto next = cells_.find(key(c + kSteps[n]));
      const bool goesOn = next != cells_.end() && next->second.rises < 0 &&
                          (next->second.sides >> ((n + 2) & 3) & 1);
      if (!goesOn) ends |= 1u << n;
    }
    kit_.at(c);
    kit_.beams(cell.sides, 0.3, 0.82, 1, stone_, ends);
    for (int turn = 0; turn < 4; ++turn) {
      kit_.at(c, turn);
      const unsigned turned = turnedSides(cell.sides, -turn);
      if (turned & kEast) {
        // Low walls along the path.
        for (const double y : {0.2, 0.74}) {
          kit_.box({0.8, y, 1}, {1, y + 0.06, 1.14}, pale_,
                   turnedSides(ends, -turn) & kEast ? 0u : kMaxX);
        }
      } else {
        kit_.box({0.74, 0.2, 1}, {0.8, 0.8, 1.14}, pale_);
      }
    }
    // What is meant for a straight path stands only on one.
    const bool straight = cell.sides == (cell.along ? kNorth | kSouth : kEast | kWest);
    kit_.at(c, cell.along);
    if (cell.on == 'A' && straight) arch();
    if (cell.on == 'G' && straight) gatehouse();
    if (cell.on == 'b' && straight) {
      kit_.box({0.2, 0.66, 1.1}, {0.8, 0.74, 1.16}, wood_);
      kit_.box({0.2, 0.72, 1.16}, {0.8, 0.74, 1.36}, wood_);
      for (const double x : {0.24, 0.7}) kit_.box({x, 0.66, 1}, {x + 0.06, 0.72, 1.1}, dark_);
    }
    if (cell.on == 'p') {
      kit_.taper(0.5, 0.7, 0.06, 0.1, 1, 1.2, 8, tiles_);
      kit_.ball({0.5, 0.7, 1.34}, {0.16, 0.16, 0.18}, leaves_, 1);
    }
    if (cell.on == 'K') kiosk();
    if (cell.on == 'l') {
      kit_.box({0.47, 0.76, 1.1}, {0.53, 0.82, 1.7}, dark_);
      kit_.ball({0.5, 0.79, 1.78}, {0.09, 0.09, 0.09}, lamp_, 1);
    }
  }

  void stairs(const Vec3i& c, int rises) {
    kit_.at(c, rises);
    for (int step = 0; step < 6; ++step) {
      const double a = step / 6.0, b = (step + 1) / 6.0;
      kit_.box({a, 0.2, std::max(0.0, b - 0.34)}, {b, 0.8, b}, stone_);
    }
    // A slope along each side, from the wall below to the wall above.
    for (const double y : {0.14, 0.8}) {
      kit_.prism(1,
                 std::array<std::array<double, 2>, 4>{{{-0.16, 0}, {0.14, 0}, {1, 0.86}, {1, 1}}},
                 y, y + 0.06, pale_);
    }
  }

  /// Two posts and a round head over the path, which runs along x.
  void arch() {
    for (const double y : {0.14, 0.74}) kit_.box({0.4, y, 1}, {0.6, y + 0.12, 1.6}, pale_);
    const double r0 = 0.24, r1 = 0.36;
    const double c[] = {1, 0.8660254037844386, 0.5, 0, -0.5, -0.8660254037844386, -1};
    const double s[] = {0, 0.5, 0.8660254037844386, 1, 0.8660254037844386, 0.5, 0};
    for (int n = 0; n < 6; ++n) {
      kit_.prism(0,
                 std::array<std::array<double, 2>, 4>{{{0.5 + r0 * c[n], 1.6 + r0 * s[n]},
                                                       {0.5 + r1 * c[n], 1.6 + r1 * s[n]},
                                                       {0.5 + r1 * c[n + 1], 1.6 + r1 * s[n + 1]},
                                                       {0.5 + r0 * c[n + 1], 1.6 + r0 * s[n + 1]}}},
                 0.4, 0.6, pale_);
    }
  }

  /// A turret over the path.
  void gatehouse() {
    for (const double y : {0.08, 0.76}) kit_.box({0.1, y, 1}, {0.9, y + 0.16, 1.75}, stone_);
    kit_.box({0.1, 0.08, 1.75}, {0.9, 0.92, 2.5}, stone_);
    kit_.box({0.06, 0.04, 2.5}, {0.94, 0.96, 2.62}, pale_);
    kit_.spire(0.5, 0.5, 0.56, 2.62, 3.5, 4, tiles_);
    for (const double x : {0.08, 0.9}) kit_.box({x, 0.42, 2}, {x + 0.02, 0.58, 2.3}, dark_);
  }

  void garden(int x, int y, char c) {
    kit_.at({x, y, 0});
    // Nothing grows where a pillar stands or somebody walks.
    for (int z = 1; z < 4; ++z) {
      if (!isFree({x, y, z}) && c != 'h' && c != 'o' && c != '=') return;
    }
    if (c == '=') kit_.beams(kGarden.sides(x, y, "="), 0.35, 1, 1.03, gravel_);
    if (c == 'h' && isFree({x, y, 1})) {
      unsigned sides = kGarden.sides(x, y, "h");
      for (int n = 0; n < 4; ++n) {
        if (!isFree(Vec3i{x, y, 1} + kSteps[n])) sides &= ~(1u << n);
      }
      kit_.beams(sides, 0.2, 1, 1.45, leaves_);
    }
    if (c == 't') {
      kit_.column(0.5, 0.5, 0.07, 1, 1.8, 6, wood_);
      kit_.ball({0.5, 0.5, 2.2}, {0.44, 0.44, 0.5}, leaves_, 2);
    }
    if (c == 'c') {
      kit_.column(0.5, 0.5, 0.05, 1, 1.2, 6, wood_);
      kit_.taper(0.5, 0.5, 0.1, 0.22, 1.15, 1.8, 8, cypress_);
      kit_.spire(0.5, 0.5, 0.22, 1.8, 3.7, 8, cypress_);
    }
    if (c == 'u') {
      kit_.column(0.5, 0.5, 0.16, 1, 1.12, 8, pale_);
      kit_.taper(0.5, 0.5, 0.06, 0.2, 1.12, 1.5, 8, pale_);
      kit_.ball({0.5, 0.5, 1.56}, {0.18, 0.18, 0.12}, flower_, 1);
    }
    if (c == 'o') {
      // A rim around the water.
      const unsigned sides = kGarden.sides(x, y, "o");
      for (int turn = 0; turn < 4; ++turn) {
        if (turnedSides(sides, -turn) & kEast) continue;
        kit_.at({x, y, 0}, turn);
        kit_.box({0.86, 0, 1}, {1, 1, 1.14}, pale_,
                 (turnedSides(sides, -turn) & kNorth ? kMaxY : 0u) |
                     (turnedSides(sides, -turn) & kSouth ? kMinY : 0u));
      }
    }
  }

  void kiosk() {
    for (const double x : {0.2, 0.72}) {
      for (const double y : {0.2, 0.72}) kit_.box({x, y, 1}, {x + 0.08, y + 0.08, 1.8}, pale_);
    }
    kit_.box({0.12, 0.12, 1.8}, {0.88, 0.88, 1.9}, stone_);
    kit_.spire(0.5, 0.5, 0.5, 1.9, 2.5, 4, tiles_);
  }

  /// Every other slab stands on a pillar where the ground below is free; half arches lead from
  /// pillar to pillar.
  void support(const Vec3i& c, const PathCell& cell) {
    bool free = true;
    for (int z = c.z - 1; z >= 1; --z) free = free && isFree({c.x, c.y, z});
    const bool pillar = cell.rises < 0 && free && (c.x + c.y) % 2 == 0;
    if (pillar) {
      kit_.at(c);
      kit_.box({0.36, 0.36, 0.6}, {0.64, 0.64, 0.82}, pale_);
      kit_.at({c.x, c.y, 0});
      kit_.box({0.4, 0.4, 1}, {0.6, 0.6, c.z + 0.6}, stone_);
      if (c.z > 1) kit_.box({0.34, 0.34, 1}, {0.66, 0.66, 1.15}, pale_);
    }
    if (cell.rises >= 0) return;
    for (int turn = 0; turn < 4; ++turn) {
      if (!(turnedSides(cell.sides, -turn) & kEast)) continue;
      kit_.at(c, turn);
      if (pillar) {
        // From the pillar's head out to the middle of the span.
        kit_.prism(1,
                   std::array<std::array<double, 2>, 4>{
                       {{0.62, 0.64}, {0.82, 0.64}, {0.82, 1}, {0.74, 0.86}}},
                   0.36, 0.64, pale_);
      }
    }
  }

  PieceKit kit_{kSize};
  std::map<Key, PathCell> cells_;
  std::uint32_t grass_ = kit_.material("grass", {0.2f, 0.3f, 0.12f}),
                earth_ = kit_.material("earth", {0.25f, 0.18f, 0.12f}),
                stone_ = kit_.material("stone", {0.55f, 0.5f, 0.42f}),
                pale_ = kit_.material("pale stone", {0.72f, 0.68f, 0.58f}),
                tiles_ = kit_.material("roof tiles", {0.45f, 0.14f, 0.08f}),
                gravel_ = kit_.material("gravel", {0.55f, 0.48f, 0.36f}),
                water_ = kit_.material("water", {0.08f, 0.2f, 0.3f}, 0.1f),
                leaves_ = kit_.material("leaves", {0.09f, 0.22f, 0.05f}),
                cypress_ = kit_.material("cypress", {0.03f, 0.11f, 0.04f}),
                flower_ = kit_.material("flowers", {0.6f, 0.12f, 0.2f}),
                wood_ = kit_.material("wood", {0.25f, 0.14f, 0.07f}),
                dark_ = kit_.material("iron", {0.05f, 0.05f, 0.06f}, 0.5f, 1),
                lamp_ = kit_.material("lamp", {1, 0.85f, 0.55f}, 0.8f, 0, 3);
};

}  // namespace

ProcessSample makePaths() { return Paths().make(); }

}  // namespace exemplar
