// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/array3d.h"
#include "maps/grid.h"

/// Shapes in the plane and in space: what the layers of a picture and of a volume have in common. A
/// flat shape is one cell thick, so that every algorithm on shapes is written once.
namespace exemplar {

/// A shape: 1 inside, 0 outside. Flat where `size().z` is 1.
using Shape = Array3D<std::uint8_t>;

/// Between a rectangle and a box that is one cell thick.
template <class T>
Array3D<T> boxOf(const Grid<T>& grid) {
  Array3D<T> box(Vec3i{grid.width(), grid.height(), 1});
  for (std::size_t p = 0; p < box.count(); ++p) box.data()[p] = grid[p];
  return box;
}
template <class T>
Grid<T> gridOf(const Array3D<T>& box) {
  assert(box.size().z == 1);
  Grid<T> grid(box.size().x, box.size().y);
  for (std::size_t p = 0; p < box.count(); ++p) grid[p] = box.data()[p];
  return grid;
}

/// Steps from the center of a patch of `side` cells a side to its cells: one layer of them in flat
/// shapes.
constexpr int patchDepth(const Vec3i& size, int side) { return size.z == 1 ? 1 : side; }
constexpr int patchCells(const Vec3i& size, int side) {
  return side * side * patchDepth(size, side);
}

/// A coordinate on a circle of `n` cells.
constexpr int wrappedCoordinate(int x, int n) {
  if (x >= 0 && x < n) return x;
  x %= n;
  return x < 0 ? x + n : x;
}
/// A place on the torus; any coordinates.
constexpr Vec3i wrappedPlace(const Vec3i& p, const Vec3i& size) {
  return {wrappedCoordinate(p.x, size.x), wrappedCoordinate(p.y, size.y),
          wrappedCoordinate(p.z, size.z)};
}

/// Calls `body(index)` for each of the cells that share a side with the one at `p`, whose index is
/// `at`: up to six, four in flat shapes. With `wraps` the grid is a torus.
template <class Body>
void forEachBeside(const Vec3i& size, bool wraps, const Vec3i& p, std::size_t at, Body&& body) {
  const std::size_t strides[] = {1, static_cast<std::size_t>(size.x),
                                 static_cast<std::size_t>(size.x) * size.y};
  for (int axis = 0; axis < 3; ++axis) {
    const int n = size[axis];
    if (n == 1) continue;
    const std::size_t stride = strides[axis], around = stride * static_cast<std::size_t>(n - 1);
    if (p[axis] > 0) {
      body(at - stride);
    } else if (wraps) {
      body(at + around);
    }
    if (p[axis] + 1 < n) {
      body(at + stride);
    } else if (wraps) {
      body(at - around);
    }
  }
}

/// For each cell of a row along x 1 where it lies on one side of a shape, inside or outside, and a
/// cell beside it on the other, else 0. With `wraps` the grid is a torus; else what lies beyond it
/// counts as neither. `edges` has a row's length.
void edgesOfRow(const Shape& shape, bool inside, bool wraps, int y, int z,
                std::span<std::uint8_t> edges);
/// Calls `body(p, index)` for each such cell, row by row.
template <class Body>
void forEachEdgeCell(const Shape& shape, bool inside, bool wraps, Body&& body) {
  const Vec3i& size = shape.size();
  std::vector<std::uint8_t> edges(static_cast<std::size_t>(size.x));
  std::size_t at = 0;
  Vec3i p;
  for (p.z = 0; p.z < size.z; ++p.z) {
    for (p.y = 0; p.y < size.y; ++p.y) {
      edgesOfRow(shape, inside, wraps, p.y, p.z, edges);
      for (p.x = 0; p.x < size.x; ++p.x, ++at)
        if (edges[static_cast<std::size_t>(p.x)]) body(static_cast<const Vec3i&>(p), at);
    }
  }
}

/// The boundary: cells inside that have one of the cells beside them outside, row by row. With
/// `wraps` the grid is a torus; else what lies beyond it counts as neither.
std::vector<Vec3i> boundaryOf(const Shape& shape, bool wraps);
/// How many cells are inside, and on the boundary; of those where `among`, if given, is not 0.
std::int64_t insideOf(const Shape& shape, const Shape* among = nullptr);
std::int64_t boundaryCount(const Shape& shape, bool wraps, const Shape* among = nullptr);

/// The shape whose inside is the outside of this one.
Shape outsideOf(const Shape& shape);

/// The share of cells inside.
double areaOf(const Shape& shape);

/// The sizes of the components of cells of one value (1 inside, 0 outside) that are connected by
/// sides, in cells, in the order of their first cells.
std::vector<std::uint32_t> componentSizes(const Shape& shape, bool inside, bool wraps);
/// Which components stay: those of `least` cells or more, and of these the `most` largest (with all
/// that are as large as the last).
struct ComponentLimits {
  std::uint32_t least = 0;
  std::size_t most = std::numeric_limits<std::size_t>::max();
};
/// Turns over the components that do not stay, of what is inside and of what is not.
void removeSmall(Shape& shape, const ComponentLimits& inside, const ComponentLimits& outside,
                 bool wraps);

}  // namespace exemplar
