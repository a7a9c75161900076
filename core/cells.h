// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/parallel.h"
#include "core/vec.h"

/// Loops over the cells of a grid: serial and parallel, over all of it or over a box.
namespace exemplar {

/// The cells from `begin` up to, and not including, `end`; empty where `end` is not above `begin`.
struct CellBox {
  Vec3i begin, end;

  static constexpr CellBox of(const Vec3i& size) { return {{0, 0, 0}, size}; }

  constexpr Vec3i size() const { return max(end - begin, Vec3i{0, 0, 0}); }
  constexpr bool empty() const { return volume(size()) == 0; }
  constexpr bool contains(const Vec3i& p) const {
    return p.x >= begin.x && p.y >= begin.y && p.z >= begin.z && p.x < end.x && p.y < end.y &&
           p.z < end.z;
  }
  /// With `cells` more on every side.
  constexpr CellBox grown(int cells) const {
    const Vec3i by{cells, cells, cells};
    return {begin - by, end + by};
  }
  constexpr bool operator==(const CellBox&) const = default;

  /// What is in both.
  friend constexpr CellBox operator&(const CellBox& a, const CellBox& b) {
    return {max(a.begin, b.begin), min(a.end, b.end)};
  }
};

/// Steps to the six neighbors of a cell that share a face with it: -x, +x, -y, +y, -z, +z.
inline constexpr std::array<Vec3i, 6> kFaceSteps{
    {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};

/// Calls `body(ijk)` for each cell of `box`, x fastest.
template <class Body>
void forEachCell(const CellBox& box, Body&& body) {
  Vec3i p;
  for (p.z = box.begin.z; p.z < box.end.z; ++p.z) {
    for (p.y = box.begin.y; p.y < box.end.y; ++p.y) {
      for (p.x = box.begin.x; p.x < box.end.x; ++p.x) body(static_cast<const Vec3i&>(p));
    }
  }
}
/// The same for a whole grid, in the order in which `Array3D` stores it.
template <class Body>
void forEachCell(const Vec3i& size, Body&& body) {
  forEachCell(CellBox::of(size), body);
}

/// Calls `body(ijk)` for each cell of `box` in parallel, rows along x by one thread each. The body
/// writes only to its own cell's slots, so that the result cannot depend on the threads.
template <class Body>
void parallelForEachCell(const CellBox& box, const Body& body) {
  if (box.empty()) return;
  const Vec3i n = box.size();
  constexpr int kCells = 4096;  // at least, in one task
  const std::size_t rows = static_cast<std::size_t>(n.y) * static_cast<std::size_t>(n.z);
  const std::size_t grain = static_cast<std::size_t>(std::max(1, kCells / n.x));
  parallelFor(0, rows, grain, [&](std::size_t first, std::size_t last) {
    for (std::size_t row = first; row < last; ++row) {
      const auto ny = static_cast<std::size_t>(n.y);
      Vec3i p{0, box.begin.y + static_cast<int>(row % ny),
              box.begin.z + static_cast<int>(row / ny)};
      for (p.x = box.begin.x; p.x < box.end.x; ++p.x) body(static_cast<const Vec3i&>(p));
    }
  });
}
template <class Body>
void parallelForEachCell(const Vec3i& size, const Body& body) {
  parallelForEachCell(CellBox::of(size), body);
}

}  // namespace exemplar
