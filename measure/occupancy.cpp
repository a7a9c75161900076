// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/occupancy.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>

#include "core/origin.h"
#include "core/parallel.h"
#include "core/simd.h"

namespace exemplar {
namespace {

/// `count` low bits set; 0..64.
constexpr std::uint64_t lowBits(int count) {
  return count >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1;
}

/// Solid cells of the overlap in both, and in either, of rows z0..z1 of `a`.
EXEMPLAR_MULTIVERSION
Overlap countOverlap(const Occupancy& a, const Occupancy& b, const Vec3i& shift, const Vec3i& low,
                     const Vec3i& high, int z0, int z1) {
  Overlap counts;
  for (int z = z0; z < z1; ++z)
    for (int y = low.y; y < high.y; ++y)
      for (int x = low.x; x < high.x; x += 64) {
        const std::uint64_t mask = lowBits(high.x - x);
        const std::uint64_t p = a.bits(x, y, z) & mask;
        const std::uint64_t q = b.bits(x - shift.x, y - shift.y, z - shift.z) & mask;
        counts.both += std::popcount(p & q);
        counts.either += std::popcount(p | q);
      }
  return counts;
}

Overlap overlap(const Occupancy& a, const Occupancy& b, const Vec3i& shift) {
  const Vec3i low = max(Vec3i{0, 0, 0}, shift), high = min(a.size(), b.size() + shift);
  if (low.x >= high.x || low.y >= high.y || low.z >= high.z) return {};
  return parallelSum<Overlap>(low.z, high.z, 16, [&](std::size_t z0, std::size_t z1) {
    return countOverlap(a, b, shift, low, high, static_cast<int>(z0), static_cast<int>(z1));
  });
}

/// Pairs of neighbors along `d`, one solid and one empty, whose first cell has z in z0..z1.
EXEMPLAR_MULTIVERSION
std::int64_t countChanges(const Occupancy& o, const Vec3i& d, int z0, int z1) {
  const Vec3i n = o.size();
  const int xBegin = std::max(0, -d.x), xEnd = n.x - std::max(0, d.x);
  const int yBegin = std::max(0, -d.y), yEnd = n.y - std::max(0, d.y);
  std::int64_t changes = 0;
  for (int z = z0; z < z1; ++z)
    for (int y = yBegin; y < yEnd; ++y)
      for (int x = xBegin; x < xEnd; x += 64)
        changes += std::popcount((o.bits(x, y, z) ^ o.bits(x + d.x, y + d.y, z + d.z)) &
                                 lowBits(xEnd - x));
  return changes;
}

/// A direction of the 3³ neighborhood and the share of all directions that are nearest to it.
struct Direction {
  Vec3i step;
  double weight;
};

constexpr double kAxis = 0.0915557824, kFace = 0.0739612558, kCorner = 0.0703912794;
constexpr std::array<Direction, 13> kDirections{{{{1, 0, 0}, kAxis},
                                                 {{0, 1, 0}, kAxis},
                                                 {{0, 0, 1}, kAxis},
                                                 {{1, 1, 0}, kFace},
                                                 {{-1, 1, 0}, kFace},
                                                 {{1, 0, 1}, kFace},
                                                 {{-1, 0, 1}, kFace},
                                                 {{0, 1, 1}, kFace},
                                                 {{0, -1, 1}, kFace},
                                                 {{1, 1, 1}, kCorner},
                                                 {{-1, 1, 1}, kCorner},
                                                 {{1, -1, 1}, kCorner},
                                                 {{-1, -1, 1}, kCorner}}};

}  // namespace

template <class IsSolid>
void Occupancy::fill(const IsSolid& isSolid) {
  if (volume(size_) == 0) return;
  // A word before, one for bits() to reach into, and one that a window's 64 cells may start in.
  wordsPerRow_ = static_cast<std::size_t>((size_.x + 63) / 64) + 3;
  const std::size_t rows = static_cast<std::size_t>(size_.y + 2 * kMargin) *
                           static_cast<std::size_t>(size_.z + 2 * kMargin);
  words_.resize(rows * wordsPerRow_);
  solidCells_ = parallelSum<std::int64_t>(0, size_.z, 8, [&](std::size_t z0, std::size_t z1) {
    std::int64_t solid = 0;
    for (int z = static_cast<int>(z0); z < static_cast<int>(z1); ++z)
      for (int y = 0; y < size_.y; ++y) {
        std::uint64_t* words = words_.data() + (row(y, z) - words_.data()) + 1;
        for (int x = 0; x < size_.x; ++x) {
          const std::uint64_t bit = isSolid(x, y, z) ? 1 : 0;
          words[x >> 6] |= bit << (x & 63);
          solid += static_cast<std::int64_t>(bit);
        }
      }
    return solid;
  });
}

Occupancy::Occupancy(const DistanceField& field, double depth) : size_(field.size()) {
  const auto level = static_cast<float>(-depth * field.voxelSize);
  fill([&](int x, int y, int z) { return field.values(x, y, z) < level; });
}

Occupancy::Occupancy(const Array3D<std::uint8_t>& cells) : size_(cells.size()) {
  fill([&](int x, int y, int z) { return cells(x, y, z) != 0; });
}

double solidFraction(const Occupancy& occupancy) {
  return occupancy.cells() == 0 ? 0
                                : static_cast<double>(occupancy.solidCells()) / occupancy.cells();
}

double surfaceDensity(const Occupancy& occupancy) {
  double density = 0, weights = 0;
  for (const Direction& direction : kDirections) {
    const Vec3i step = direction.step;
    const Vec3i pairs = occupancy.size() - Vec3i{std::abs(step.x), std::abs(step.y), step.z};
    if (pairs.x <= 0 || pairs.y <= 0 || pairs.z <= 0) continue;  // a volume one cell thin
    const auto changes =
        parallelSum<std::int64_t>(0, pairs.z, 16, [&](std::size_t z0, std::size_t z1) {
          return countChanges(occupancy, step, static_cast<int>(z0), static_cast<int>(z1));
        });
    const double runs = static_cast<double>(volume(pairs)) * length(cast<double>(step));
    density += 2 * direction.weight * static_cast<double>(changes) / runs;
    weights += direction.weight;
  }
  return weights == 0 ? 0 : density / weights;
}

double intersectionOverUnion(const Occupancy& a, const Occupancy& b) {
  assert(a.size() == b.size());
  const Overlap counts = overlap(a, b, {0, 0, 0});
  return counts.iou();
}

double intersectionOverUnion(const Occupancy& a, const Occupancy& b, const Vec3i& shift) {
  const Overlap counts = overlap(a, b, shift);
  return counts.either == 0 ? 0 : static_cast<double>(counts.both) / counts.either;
}

Overlap rolledOverlap(const Occupancy& a, const CellBox& window, const Occupancy& b,
                      const Vec3i& shift) {
  // Up to two parts along each axis: what came in around the box, and what did not.
  Overlap sum;
  for (int part = 0; part < 8; ++part) {
    Vec3i low = window.begin, high = window.end, by;
    for (int axis = 0; axis < 3; ++axis) {
      const int cut = std::min(window.begin[axis] + shift[axis], window.end[axis]);
      const bool around = (part >> axis & 1) != 0;
      (around ? high : low)[axis] = cut;
      by[axis] = window.begin[axis] + shift[axis] - (around ? b.size()[axis] : 0);
    }
    if (low.x >= high.x || low.y >= high.y || low.z >= high.z) continue;
    sum += countOverlap(a, b, by, low, high, low.z, high.z);
  }
  return sum;
}

Occupancy turnedOccupancy(const Occupancy& occupancy, int turns, bool mirrored) {
  const Vec3i n = occupancy.size();
  Array3D<std::uint8_t> cells(turnedSize(n, turns));
  forEachCell(n, [&](const Vec3i& p) {
    if (!occupancy.solid(p.x, p.y, p.z)) return;
    cells[turnedCell({mirrored ? n.x - 1 - p.x : p.x, p.y, p.z}, n, turns)] = 1;
  });
  return Occupancy(cells);
}

}  // namespace exemplar
