// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/seams/broken_pieces.h"

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

constexpr double kContact = 0.5;  // voxels: thinner contacts do not join bodies

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

/// Which samples count as one of the two sides: those whose value, with `sign`, is below -`depth`
/// world units. Solid has sign 1, air -1.
Array3D<std::uint8_t> side(const Array3D<float>& values, float sign, double depth) {
  const auto limit = static_cast<float>(-depth);
  Array3D<std::uint8_t> mask(values.size());
  for (std::size_t s = 0; s < mask.count(); ++s) {
    const float v = values.values()[s];
    // A sample on the surface is air.
    mask.values()[s] = sign > 0 ? v < limit : v >= -limit;
  }
  return mask;
}

/// What origins copy.
Array3D<float> copied(const DistanceField& example, const Origins& origins) {
  Array3D<float> values(origins.size());
  for (std::size_t s = 0; s < values.count(); ++s) {
    values.values()[s] = example.values[origins.values()[s].cell()];
  }
  return values;
}

/// What the example falls into.
struct ExamplePieces {
  std::size_t largest = 0, smallest = std::numeric_limits<std::size_t>::max();  // whole ones
  std::size_t inWhole = 0, all = 0;                                             // samples

  bool mostlyWhole() const { return 4 * inWhole >= all; }
  /// Half of the samples of the smallest whole piece; of the largest piece if none is whole.
  double kept() const { return static_cast<double>(inWhole > 0 ? smallest : largest) / 2; }
};

ExamplePieces piecesOf(Array3D<std::uint8_t> mask) {
  ExamplePieces pieces;
  forEachPiece(std::move(mask), [&](const Piece& piece) {
    const std::size_t size = piece.samples.size();
    pieces.all += size;
    pieces.largest = std::max(pieces.largest, size);
    if (!piece.whole) return;
    pieces.inWhole += size;
    pieces.smallest = std::min(pieces.smallest, size);
  });
  return pieces;
}

/// The sample of the example that is least far on the other side, the first of several.
std::optional<Vec3i> nearestOther(const DistanceField& example, float sign,
                                  const Array3D<std::uint8_t>* usable) {
  std::optional<Vec3i> cell;
  float least = std::numeric_limits<float>::infinity();
  for (std::size_t s = 0; s < example.values.count(); ++s) {
    const float v = example.values.values()[s];
    if ((v < 0) == (sign > 0) || std::abs(v) >= least || (usable && !usable->values()[s])) continue;
    least = std::abs(v);
    cell = example.values.ijk(s);
  }
  return cell;
}

constexpr std::uint8_t kBroken = 1, kWhole = 2;  // marks; 0 for what is on the other side

/// Marks the samples of `mask`.
Array3D<std::uint8_t> judge(Array3D<std::uint8_t> mask, double kept,
                            const Array3D<std::uint8_t>* fixed) {
  Array3D<std::uint8_t> marks(mask.size());
  forEachPiece(std::move(mask), [&](const Piece& piece) {
    const bool broken =
        piece.whole && static_cast<double>(piece.samples.size()) < kept &&
        (!fixed || std::none_of(piece.samples.begin(), piece.samples.end(),
                                [&](std::size_t s) { return fixed->values()[s] != 0; }));
    for (const std::size_t s : piece.samples) marks.values()[s] = broken ? kBroken : kWhole;
  });
  return marks;
}

/// Gives what lies above the depth to the piece that is fewest steps away, whole ones first.
void addSkin(const Array3D<std::uint8_t>& all, const Array3D<std::uint8_t>* fixed,
             Array3D<std::uint8_t>& marks) {
  constexpr int kThick = 2;  // steps: half a voxel deep, but for edges and corners
  for (int step = 0; step < kThick; ++step) {
    std::vector<std::pair<std::size_t, std::uint8_t>> taken;
    for (std::size_t s = 0; s < all.count(); ++s) {
      if (!all.values()[s] || marks.values()[s] || (fixed && fixed->values()[s])) continue;
      std::uint8_t mark = 0;
      for (const Vec3i& d : kSteps) {
        const Vec3i q = all.ijk(s) + d;
        if (all.contains(q)) mark = std::max(mark, marks[q]);
      }
      if (mark) taken.emplace_back(s, mark);
    }
    for (const auto& [s, mark] : taken) marks.values()[s] = mark;
  }
}

/// Whether the example shows the other side at `cell`, and may be copied there.
class OtherSide {
 public:
  OtherSide(const DistanceField& example, float sign, const Array3D<std::uint8_t>* usable)
      : example_(example), usable_(usable), solid_(sign < 0) {}

  bool at(const Vec3i& cell) const {
    return example_.values.contains(cell) && (example_.values[cell] < 0) == solid_ &&
           (!usable_ || (*usable_)[cell]);
  }

 private:
  const DistanceField& example_;
  const Array3D<std::uint8_t>* usable_;
  bool solid_;
};

/// Gives each broken sample the offset of a neighbour that shows the other side there: from outside
/// in, a ring of samples at a time takes the offsets of the one around it.
void takeFromAround(const DistanceField& example, const Vec3i& other, const OtherSide& otherSide,
                    Array3D<std::uint8_t>& broken, std::vector<std::size_t> left,
                    Origins& origins) {
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
        if (otherSide.at(cell)) cells.push_back(cell);
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
      for (const std::size_t s : later) ring.emplace_back(s, Origin(other));
      later.clear();
    }
    for (const auto& [s, origin] : ring) {
      origins.values()[s] = origin;
      broken.values()[s] = 0;
    }
    left.swap(later);
  }
}

/// Moves the broken pieces of one side of `values`, as seen at a depth, to the other.
std::int64_t dropSide(const DistanceField& example, const Array3D<float>& values, float sign,
                      double depth, double kept, Origins& origins,
                      const BrokenPiecesOptions& options) {
  const std::optional<Vec3i> other = nearestOther(example, sign, options.usable);
  if (!other) return 0;
  Array3D<std::uint8_t> marks = judge(side(values, sign, depth), kept, options.fixed);
  if (depth > 0) addSkin(side(values, sign, 0), options.fixed, marks);
  std::vector<std::size_t> left;
  for (std::size_t s = 0; s < marks.count(); ++s) {
    marks.values()[s] = marks.values()[s] == kBroken;
    if (marks.values()[s]) left.push_back(s);
  }
  const auto changed = static_cast<std::int64_t>(left.size());
  const OtherSide otherSide(example, sign, options.usable);
  takeFromAround(example, *other, otherSide, marks, std::move(left), origins);
  return changed;
}

}  // namespace

std::int64_t dropBrokenPieces(const DistanceField& example, Origins& origins,
                              const BrokenPiecesOptions& options) {
  const Array3D<float> values = options.values ? *options.values : copied(example, origins);
  ExamplePieces solid = piecesOf(side(example.values, 1, 0));
  double depth = 0;
  if (!solid.mostlyWhole()) {
    const double contact = kContact * example.voxelSize;
    const ExamplePieces deeper = piecesOf(side(example.values, 1, contact));
    if (deeper.inWhole > 0 && deeper.mostlyWhole()) {
      solid = deeper;
      depth = contact;
    }
  }
  std::int64_t changed = dropSide(example, values, 1, 0, solid.kept(), origins, options);
  if (depth > 0 && options.values) {
    changed += dropSide(example, values, 1, depth, solid.kept(), origins, options);
  }
  const double bubble = piecesOf(side(example.values, -1, 0)).kept();
  return changed + dropSide(example, values, -1, 0, bubble, origins, options);
}

}  // namespace exemplar
