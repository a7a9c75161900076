// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "maps/shape.h"

/// The patches around the cells of shapes' boundaries: what layered shape synthesis compares
/// (Rosenberger, Cohen-Or, Lischinski 2009, section 3.1).
namespace exemplar {

/// The `turn`th of the eight symmetries of the square, 0..7, applied to a step: quarter turns about
/// z, then (from 4 on) the same of the mirror image. Up stays up.
Vec3i turnedAboutZ(Vec3i step, int turn);
/// The same in the plane.
inline Pixel turnedStep(Pixel step, int turn) {
  const Vec3i turned = turnedAboutZ({step.x, step.y, 0}, turn);
  return {turned.x, turned.y};
}

/// Several shapes on one grid that are compared together: of the first `whole` of them a cell that
/// differs counts 1, of the others one half.
struct ShapePlanes {
  std::vector<const Shape*> shapes;
  std::size_t whole = 1;

  ShapePlanes(const Shape& shape) : shapes{&shape} {}
  ShapePlanes(std::vector<const Shape*> all, std::size_t whole_)
      : shapes(std::move(all)), whole(whole_) {}
  const Vec3i& size() const { return shapes.front()->size(); }
};

/// Patches of `side` cells along each axis around boundary cells, packed into bits, in several
/// orientations; flat where the shape is.
class BoundaryPatches {
 public:
  /// Longest side of a patch.
  static constexpr int kMostSide = 31;

  BoundaryPatches() = default;
  /// The patches of `planes` around `centers`, in the first `turns` orientations (1, 2, 4 or 8; 2
  /// are 0 and 180 degrees). Cells beyond a shape that does not wrap are unknown: they count in no
  /// distance. O(centers x turns x cells of a patch).
  BoundaryPatches(const ShapePlanes& planes, std::span<const Vec3i> centers, int side, int turns,
                  bool wraps);

  std::size_t count() const { return centers_.size(); }
  int side() const { return side_; }
  /// Of one plane of a patch.
  int cells() const { return cells_; }
  int turns() const { return static_cast<int>(symmetries_.size()); }
  int words() const { return words_; }
  /// How many of the words, the first ones, count whole.
  int wholeWords() const { return wholeWords_; }
  const Vec3i& center(std::size_t patch) const { return centers_[patch]; }
  /// Which symmetry an orientation is.
  int symmetry(int turn) const { return symmetries_[static_cast<std::size_t>(turn)]; }
  const std::uint64_t* bits(std::size_t patch, int turn) const {
    return &bits_[(patch * symmetries_.size() + static_cast<std::size_t>(turn)) * words()];
  }
  /// Which cells are known; null where all are.
  const std::uint64_t* known(std::size_t patch, int turn) const {
    return whole_[patch]
               ? nullptr
               : &known_[(patch * symmetries_.size() + static_cast<std::size_t>(turn)) * words()];
  }
  bool whole(std::size_t patch) const { return whole_[patch] != 0; }
  /// How many cells of the patch are inside the first shape; the same in every orientation.
  int inside(std::size_t patch) const { return inside_[patch]; }
  /// The same of each block of an oriented patch: `kBlocks` numbers, 0 past the last block. All are
  /// 0 where blocks would have more than 255 cells. Two patches differ in at least as many cells as
  /// their blocks' numbers together.
  static constexpr int kBlocks = 32;
  const std::uint8_t* insideOfBlocks(std::size_t patch, int turn) const {
    return &blocks_[(patch * symmetries_.size() + static_cast<std::size_t>(turn)) * kBlocks];
  }

 private:
  /// Packs one row of an oriented patch, given its cells' indices (negative where not known), from
  /// this bit of each plane on.
  void packRow(const ShapePlanes& planes, std::span<const std::int64_t> row, std::size_t patch,
               std::size_t turn, std::size_t bit, std::span<const std::uint8_t> blockOf);

  int side_ = 0, cells_ = 0, words_ = 0, wholeWords_ = 0;
  std::vector<int> symmetries_;
  std::vector<Vec3i> centers_;
  std::vector<std::uint64_t> bits_, known_;
  std::vector<std::uint8_t> whole_, blocks_;
  std::vector<int> inside_;
};

/// A patch of an example as the likeness of another patch.
struct BoundaryMatch {
  std::uint32_t patch = 0;
  std::uint16_t turn = 0;
  /// Cells that differ (equation 1), each as its plane counts; of those that are known, as a share
  /// of all.
  std::uint16_t distance = 0;
};

/// The distance of patch `a` of one set, as it is, to patch `b` of another in an orientation.
int patchDistance(const BoundaryPatches& set, std::size_t a, const BoundaryPatches& examples,
                  std::size_t b, int turn);

/// Finds the nearest patches of an example, exactly: no patch whose count of inside cells differs
/// by more than the distance can be nearer, so that patches are visited by that count, and compared
/// only where the counts of their blocks leave it open.
class NearestPatches {
 public:
  explicit NearestPatches(const BoundaryPatches& examples);

  /// The `wanted` nearest different patches, nearest first, each in its best orientation; only of
  /// those whose `left` is above 0, where it is not empty. Equal distances: lower numbers first.
  void find(const BoundaryPatches& set, std::size_t patch, std::size_t wanted,
            std::span<const std::uint32_t> left, std::vector<BoundaryMatch>& found) const;

 private:
  /// The patch's best orientation among those that may be at most `limit` away; false if none may.
  bool compare(const BoundaryPatches& set, std::size_t patch, std::size_t rank, int limit,
               BoundaryMatch& match) const;

  const BoundaryPatches* examples_;
  std::vector<std::uint32_t> byInside_;  // whole patches, by their count of inside cells
  std::vector<std::uint8_t> blocks_;     // of each of these, in each orientation
  std::vector<std::uint32_t> partial_;   // the others
};

}  // namespace exemplar
