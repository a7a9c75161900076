// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "mesh/procedural/processes.h"

namespace exemplar {

/// The four sides of a cell seen from above, as bits: which neighbors something goes on to.
enum SideBit : unsigned { kEast = 1, kNorth = 2, kWest = 4, kSouth = 8 };

/// Faces of a box, as bits: those to leave out, where the next cell goes on.
enum FaceBit : unsigned { kMinX = 1, kMaxX = 2, kMinY = 4, kMaxY = 8, kMinZ = 16, kMaxZ = 32 };

/// Builds scenes of model pieces: simple solids, placed in a cell and turned by quarters.
class PieceKit {
 public:
  explicit PieceKit(const Vec3i& size) : size_(size) {}

  std::uint32_t material(const std::string& name, const std::array<float, 3>& color,
                         float roughness = 0.85f, float metallic = 0, float emission = 0);

  /// What follows is drawn from the lowest corner of a cell, turned `turns` quarters
  /// counterclockwise about its vertical axis.
  void at(const Vec3i& cell, int turns = 0);
  /// The same about the vertical axis at (x, y) from the cell's corner.
  void at(const Vec3i& cell, int turns, double x, double y);

  /// The cell that things are drawn in.
  const Vec3i& cell() const { return cell_; }

  /// A box; `skip`: `FaceBit`s of faces that are not made, as seen before turning.
  void box(const Vec3d& low, const Vec3d& high, std::uint32_t material, unsigned skip = 0);
  /// A convex polygon in the plane across `axis` (its points' coordinates are those of the two axes
  /// after it in turn, counterclockwise), drawn out from `from` to `to`. `caps`: bit 1: the end at
  /// `from`, bit 2: that at `to`.
  void prism(int axis, std::span<const std::array<double, 2>> polygon, double from, double to,
             std::uint32_t material, unsigned caps = 3);
  /// A regular prism that stands upright, radius to the corners.
  void column(double x, double y, double radius, double z0, double z1, int sides,
              std::uint32_t material);
  /// A pyramid on a regular polygon.
  void spire(double x, double y, double radius, double z0, double z1, int sides,
             std::uint32_t material);
  /// A frustum between two regular polygons; radii > 0.
  void taper(double x, double y, double r0, double r1, double z0, double z1, int sides,
             std::uint32_t material);
  /// A ball of triangles, squashed: `radii` along the axes.
  void ball(const Vec3d& center, const Vec3d& radii, std::uint32_t material, int frequency = 2);
  /// A polygon with its corners counterclockwise seen from where it faces; convex.
  void face(std::span<const Vec3d> corners, std::uint32_t material);

  /// A beam along the cell's middle lines to each side in `sides` (`SideBit`s), `half` wide to each
  /// side of them, from z0 to z1; open toward the neighbors it goes on to, but for those in
  /// `closed`.
  void beams(unsigned sides, double half, double z0, double z1, std::uint32_t material,
             unsigned closed = 0);

  /// The ground: the lowest layer's cells from z = `bottom` to 1, with the top of each cell of the
  /// material that `top` says, the rest of `side`. Cells whose top is `kNone` have none.
  void ground(double bottom, const std::function<std::uint32_t(int, int)>& top, std::uint32_t side);
  static constexpr std::uint32_t kNone = 0xffffffff;

  /// The scene, points at equal places joined.
  ProcessSample take();

 private:
  std::uint32_t point(const Vec3d& p);
  void triangle(const Vec3d& a, const Vec3d& b, const Vec3d& c, std::uint32_t material);
  Vec3d placed(const Vec3d& p) const;

  Vec3i size_, cell_;
  int turns_ = 0;
  double axisX_ = 0.5, axisY_ = 0.5;
  std::map<std::array<std::int64_t, 3>, std::uint32_t> points_;
  TriangleMesh mesh_;
};

/// A plan drawn as text: rows from the back (largest y) to the front, x to the right.
class Plan {
 public:
  explicit Plan(std::vector<std::string> rows) : rows_(std::move(rows)) {}
  int width() const { return static_cast<int>(rows_.front().size()); }
  int depth() const { return static_cast<int>(rows_.size()); }
  /// The character at (x, y); '.' outside.
  char operator()(int x, int y) const {
    if (x < 0 || y < 0 || x >= width() || y >= depth()) return '.';
    return rows_[rows_.size() - 1 - y][x];
  }
  /// The sides (`SideBit`s) on which (x, y) has a neighbor among `kinds`.
  unsigned sides(int x, int y, const std::string& kinds) const {
    const auto has = [&](int i, int j) { return kinds.find((*this)(i, j)) != std::string::npos; };
    return (has(x + 1, y) ? kEast : 0u) | (has(x, y + 1) ? kNorth : 0u) |
           (has(x - 1, y) ? kWest : 0u) | (has(x, y - 1) ? kSouth : 0u);
  }
  /// Calls `visit(x, y, character)` for each cell.
  template <class Visit>
  void each(const Visit& visit) const {
    for (int y = 0; y < depth(); ++y) {
      for (int x = 0; x < width(); ++x) visit(x, y, (*this)(x, y));
    }
  }

 private:
  std::vector<std::string> rows_;
};

/// Sides turned by quarters, counterclockwise.
constexpr unsigned turnedSides(unsigned sides, int turns) {
  const unsigned n = static_cast<unsigned>(turns & 3);
  return ((sides << n) | (sides >> (4 - n))) & 15u;
}
constexpr int countSides(unsigned sides) {
  return static_cast<int>((sides & 1) + (sides >> 1 & 1) + (sides >> 2 & 1) + (sides >> 3 & 1));
}

}  // namespace exemplar
