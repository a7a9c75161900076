// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "maps/grid.h"

/// Shapes, and the patches around the pixels of their boundary: what layered shape synthesis
/// compares (Rosenberger, Cohen-Or, Lischinski 2009, section 3.1).
namespace exemplar {

/// A shape: 1 inside, 0 outside.
using Shape = Grid<std::uint8_t>;

/// The boundary: pixels inside that have one of their four neighbors outside, row by row. With
/// `wraps` the grid is a torus; else what lies beyond it counts as neither.
std::vector<Pixel> boundaryOf(const Shape& shape, bool wraps);

/// The share of pixels inside.
double areaOf(const Shape& shape);

/// The sizes of the components of pixels of one value (1 inside, 0 outside) that are connected by
/// sides, in pixels, in the order of their first pixels.
std::vector<std::uint32_t> componentSizes(const Shape& shape, bool inside, bool wraps);
/// Turns components of fewer pixels over: `inside` is the least size of what is inside, `outside`
/// of what is not.
void removeSmall(Shape& shape, std::uint32_t inside, std::uint32_t outside, bool wraps);

/// The `turn`th of the eight symmetries of the square, 0..7, applied to a step: quarter turns, then
/// (from 4 on) the same of the mirror image.
Pixel turnedStep(Pixel step, int turn);

/// Patches of `side` x `side` pixels around boundary pixels, packed into bits, in several
/// orientations.
class BoundaryPatches {
 public:
  /// Longest side of a patch.
  static constexpr int kMostSide = 31;

  BoundaryPatches() = default;
  /// The patches of `shape` around `centers`, in the first `turns` orientations (1, 2, 4 or 8; 2
  /// are 0 and 180 degrees). Pixels beyond a shape that does not wrap are unknown: they count in no
  /// distance. O(centers x turns x side²).
  BoundaryPatches(const Shape& shape, std::span<const Pixel> centers, int side, int turns,
                  bool wraps);

  std::size_t count() const { return centers_.size(); }
  int side() const { return side_; }
  int turns() const { return static_cast<int>(symmetries_.size()); }
  int words() const { return words_; }
  const Pixel& center(std::size_t patch) const { return centers_[patch]; }
  /// Which symmetry an orientation is.
  int symmetry(int turn) const { return symmetries_[static_cast<std::size_t>(turn)]; }
  const std::uint64_t* bits(std::size_t patch, int turn) const {
    return &bits_[(patch * symmetries_.size() + static_cast<std::size_t>(turn)) * words()];
  }
  /// Which pixels are known; null where all are.
  const std::uint64_t* known(std::size_t patch, int turn) const {
    return whole_[patch]
               ? nullptr
               : &known_[(patch * symmetries_.size() + static_cast<std::size_t>(turn)) * words()];
  }
  bool whole(std::size_t patch) const { return whole_[patch] != 0; }
  /// How many pixels of the patch are inside; the same in every orientation.
  int inside(std::size_t patch) const { return inside_[patch]; }

 private:
  int side_ = 0, words_ = 0;
  std::vector<int> symmetries_;
  std::vector<Pixel> centers_;
  std::vector<std::uint64_t> bits_, known_;
  std::vector<std::uint8_t> whole_;
  std::vector<int> inside_;
};

/// A patch of an example as the likeness of another patch.
struct PatchMatch2D {
  std::uint32_t patch = 0;
  std::uint16_t turn = 0;
  /// Pixels that differ (equation 1); of those that are known, as a share of all.
  std::uint16_t distance = 0;
};

/// The distance of patch `a` of one set, as it is, to patch `b` of another in an orientation.
int patchDistance(const BoundaryPatches& set, std::size_t a, const BoundaryPatches& examples,
                  std::size_t b, int turn);

/// Finds the nearest patches of an example, exactly: no patch whose count of inside pixels differs
/// by more than the distance can be nearer, so that patches are visited by that count.
class NearestPatches {
 public:
  explicit NearestPatches(const BoundaryPatches& examples);

  /// The `wanted` nearest different patches, nearest first, each in its best orientation; only of
  /// those whose `left` is above 0, where it is not empty. Equal distances: lower numbers first.
  void find(const BoundaryPatches& set, std::size_t patch, std::size_t wanted,
            std::span<const std::uint32_t> left, std::vector<PatchMatch2D>& found) const;

 private:
  const BoundaryPatches* examples_;
  std::vector<std::uint32_t> byInside_;  // whole patches, by their count of inside pixels
  std::vector<std::uint32_t> partial_;   // the others
};

}  // namespace exemplar
