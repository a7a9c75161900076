// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/broken_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace exemplar {
namespace {

constexpr std::array<Vec3i, 6> kSteps{
    {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};

struct Piece {
  std::vector<std::size_t> samples;
  bool whole = true;  ///< touches no side of the box
};

/// Calls `take(piece)` for each connected region of samples that are solid.
template <class Take>
void forEachPiece(Array3D<std::uint8_t> solid, const Take& take) {
  const Vec3i last = solid.size() - Vec3i{1, 1, 1};
  std::vector<std::size_t> stack;
  for (std::size_t first = 0; first < solid.count(); ++first) {
    if (!solid.values()[first]) continue;
    Piece piece;
    solid.values()[first] = 0;
    stack.assign(1, first);
    while (!stack.empty()) {
      const std::size_t s = stack.back();
      stack.pop_back();
      piece.samples.push_back(s);
      const Vec3i p = solid.ijk(s);
      for (int axis = 0; axis < 3; ++axis) {
        if (p[axis] == 0 || p[axis] == last[axis]) piece.whole = false;
      }
      for (const Vec3i& step : kSteps) {
        const Vec3i q = p + step;
        if (!solid.contains(q) || !solid[q]) continue;
        solid[q] = 0;
        stack.push_back(solid.index(q));
      }
    }
    take(piece);
  }
}

/// Half of the samples of the example's smallest whole piece; of its largest if none is whole.
double smallestKept(const DistanceField& example) {
  Array3D<std::uint8_t> solid(example.size());
  for (std::size_t s = 0; s < solid.count(); ++s) {
    solid.values()[s] = example.values.values()[s] < 0;
  }
  std::size_t largest = 0, smallest = std::numeric_limits<std::size_t>::max();
  forEachPiece(std::move(solid), [&](const Piece& piece) {
    largest = std::max(largest, piece.samples.size());
    if (piece.whole) smallest = std::min(smallest, piece.samples.size());
  });
  const bool anyWhole = smallest != std::numeric_limits<std::size_t>::max();
  return static_cast<double>(anyWhole ? smallest : largest) / 2;
}

/// The sample of the example that is least outside the solid, the first of several.
std::optional<Vec3i> nearestAir(const DistanceField& example, const Array3D<std::uint8_t>* usable) {
  std::optional<Vec3i> cell;
  float least = std::numeric_limits<float>::infinity();
  for (std::size_t s = 0; s < example.values.count(); ++s) {
    const float v = example.values.values()[s];
    if (v < 0 || v >= least || (usable && !usable->values()[s])) continue;
    least = v;
    cell = example.values.ijk(s);
  }
  return cell;
}

}  // namespace

std::int64_t dropBrokenPieces(const DistanceField& example, Origins& origins,
                              const BrokenPiecesOptions& options) {
  const auto usable = [&](const Vec3i& cell) { return !options.usable || (*options.usable)[cell]; };
  const std::optional<Vec3i> anyAir = nearestAir(example, options.usable);
  if (!anyAir) return 0;
  const double kept = smallestKept(example);
  Array3D<std::uint8_t> solid(origins.size()), broken(origins.size());
  for (std::size_t s = 0; s < solid.count(); ++s) {
    solid.values()[s] = example.values[origins.values()[s].cell()] < 0;
  }
  std::vector<std::size_t> left;
  forEachPiece(std::move(solid), [&](const Piece& piece) {
    if (!piece.whole || static_cast<double>(piece.samples.size()) >= kept) return;
    if (options.fixed &&
        std::any_of(piece.samples.begin(), piece.samples.end(),
                    [&](std::size_t s) { return options.fixed->values()[s] != 0; })) {
      return;
    }
    left.insert(left.end(), piece.samples.begin(), piece.samples.end());
  });
  std::sort(left.begin(), left.end());
  for (const std::size_t s : left) broken.values()[s] = 1;

  // From outside in: a ring of samples at a time takes the offsets of the one around it.
  const auto changed = static_cast<std::int64_t>(left.size());
  std::vector<std::size_t> later;
  std::vector<std::pair<std::size_t, Origin>> ring;
  while (!left.empty()) {
    ring.clear();
    later.clear();
    for (const std::size_t s : left) {
      const Vec3i p = origins.ijk(s);
      std::vector<Vec3i> cells;
      float sum = 0;
      int count = 0;
      for (const Vec3i& step : kSteps) {
        const Vec3i q = p + step;
        if (!origins.contains(q) || broken[q]) continue;
        const Vec3i there = origins[q].cell();
        sum += example.values[there];
        ++count;
        const Vec3i cell = there - step;
        if (example.values.contains(cell) && example.values[cell] >= 0 && usable(cell)) {
          cells.push_back(cell);
        }
      }
      if (cells.empty()) {
        later.push_back(s);
        continue;
      }
      const float around = sum / static_cast<float>(count);
      ring.emplace_back(s, *std::min_element(cells.begin(), cells.end(), [&](auto& a, auto& b) {
                          return std::abs(example.values[a] - around) <
                                 std::abs(example.values[b] - around);
                        }));
    }
    if (ring.empty()) {
      for (const std::size_t s : later) ring.emplace_back(s, Origin(*anyAir));
      later.clear();
    }
    for (const auto& [s, origin] : ring) {
      origins.values()[s] = origin;
      broken.values()[s] = 0;
    }
    left.swap(later);
  }
  return changed;
}

}  // namespace exemplar
