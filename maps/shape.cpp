// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "maps/shape.h"

#include "core/cells.h"
#include "core/disjoint_sets.h"

namespace exemplar {
namespace {

/// The component of each cell: the index of its first cell.
DisjointSets componentsOf(const Shape& shape, bool wraps) {
  const Vec3i& size = shape.size();
  const std::uint8_t* inside = shape.data();
  DisjointSets sets(shape.count());
  std::size_t at = 0;
  forEachCell(size, [&](const Vec3i& p) {
    forEachBeside(size, wraps, p, at, [&](std::size_t other) {
      // Each pair once.
      if (other > at && inside[other] == inside[at])
        sets.join(static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(other));
    });
    ++at;
  });
  return sets;
}

std::vector<std::uint32_t> cellsOfSets(DisjointSets& sets) {
  std::vector<std::uint32_t> cells(sets.count());
  for (std::uint32_t p = 0; p < cells.size(); ++p) ++cells[sets.find(p)];
  return cells;
}

bool isOnBoundary(const Shape& shape, bool wraps, const Vec3i& p, std::size_t at) {
  const std::uint8_t* inside = shape.data();
  if (!inside[at]) return false;
  bool edge = false;
  forEachBeside(shape.size(), wraps, p, at, [&](std::size_t other) { edge |= !inside[other]; });
  return edge;
}

}  // namespace

std::vector<std::uint32_t> componentSizes(const Shape& shape, bool inside, bool wraps) {
  DisjointSets sets = componentsOf(shape, wraps);
  std::vector<std::uint32_t> sizes;
  const std::vector<std::uint32_t> cells = cellsOfSets(sets);
  for (std::uint32_t p = 0; p < cells.size(); ++p)
    if (cells[p] > 0 && (shape.data()[p] != 0) == inside) sizes.push_back(cells[p]);
  return sizes;
}

void removeSmall(Shape& shape, std::uint32_t inside, std::uint32_t outside, bool wraps) {
  if (inside <= 1 && outside <= 1) return;
  DisjointSets sets = componentsOf(shape, wraps);
  const std::vector<std::uint32_t> cells = cellsOfSets(sets);
  std::uint8_t* values = shape.data();
  for (std::uint32_t p = 0; p < cells.size(); ++p)
    if (cells[sets.find(p)] < (values[p] ? inside : outside)) values[p] = !values[p];
}

std::vector<Vec3i> boundaryOf(const Shape& shape, bool wraps) {
  std::vector<Vec3i> boundary;
  std::size_t at = 0;
  forEachCell(shape.size(), [&](const Vec3i& p) {
    if (isOnBoundary(shape, wraps, p, at)) boundary.push_back(p);
    ++at;
  });
  return boundary;
}

std::int64_t insideOf(const Shape& shape, const Shape* among) {
  std::int64_t inside = 0;
  for (std::size_t p = 0; p < shape.count(); ++p)
    inside += shape.data()[p] != 0 && (!among || among->data()[p]);
  return inside;
}

std::int64_t boundaryCount(const Shape& shape, bool wraps, const Shape* among) {
  std::int64_t count = 0;
  std::size_t at = 0;
  forEachCell(shape.size(), [&](const Vec3i& p) {
    count += (!among || among->data()[at]) && isOnBoundary(shape, wraps, p, at);
    ++at;
  });
  return count;
}

double areaOf(const Shape& shape) {
  return static_cast<double>(insideOf(shape)) / static_cast<double>(shape.count());
}

}  // namespace exemplar
