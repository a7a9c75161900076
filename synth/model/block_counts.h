// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/progress.h"
#include "synth/model/patch_sources.h"
#include "synth/model/problem.h"

namespace exemplar {

/// How often the example's blocks of 1, 2 and 3 cells a side should occur in a result, and how
/// often they do: the energy
///
///     E = sum over all blocks of weight x |count in the result - count in the example x ratio|
///
/// (weights: 3 for single cells, else 1), whose minimum has the example's statistics (Zhu, Liu, Wu:
/// "Exploring texture ensembles by efficient Markov chain Monte Carlo", PAMI 22(6), 2000, with
/// counts of blocks as the features). Blocks that the example does not show should not occur at
/// all.
///
/// `ratio` is that of the columns in the result and in the example, but for what the example shows
/// only along its sides, as the ends of a ground: that is expected once for each place along that
/// side of the result, and the rest in between. What stands on the ground does not become more
/// where there is more air above, and single cells are counted at each height by itself, for where
/// things float larger blocks do not say how high; where neither bottom nor top has a rule, or the
/// result tiles along z, there is more, at any height. Weights of labels multiply the counts of the
/// blocks that hold them. Along an axis that is shorter than a block, blocks are that much shorter.
///
/// Blocks are known by hashes of 64 bits. Memory: 8 bytes a cell.
class BlockCounts {
 public:
  static constexpr int kSides = 3;
  static constexpr std::int32_t kUnknown = -1;  ///< a block that the example does not show

  BlockCounts(const ModelProblem& problem, std::span<const PatchSource> sources,
              const Progress& progress = {});

  /// Counts all blocks of a result: a label for each position.
  void count(std::span<const Label> grid, const Progress& progress = {});

  /// One block that a change touches: `place` is the position of its lowest cell.
  struct Touched {
    std::int32_t place;
    std::int32_t before, now;  ///< numbers of blocks, or `kUnknown`
  };
  /// The blocks touched by changes of labels, for each length of their sides. Scratch, too: keep
  /// one for each thread.
  struct Change {
    std::array<std::vector<Touched>, kSides> touched;
    std::vector<std::uint64_t> seen;  // a bit for each place around, by columns
    std::vector<std::uint64_t> sums;  // of the layers of a column's blocks
  };
  /// A position that has a new label in `grid`, and the one before.
  struct Changed {
    Vec3i cell;
    int frame;
    Label before;
  };
  /// Finds what `changed` touches. O(changed cells x 27). Threads may look at the same
  /// time, each into its own `change`, where what they touch is apart.
  /// With `largestOnly` blocks of 2 cells a side are left out, for an estimate.
  void look(std::span<const Label> grid, std::span<const Changed> changed, Change& change,
            bool largestOnly = false) const;

  /// About what `add` would return, without counting: blocks that a change touches several times
  /// are taken one by one.
  double estimate(const Change& change) const;
  /// Counts the change in; returns what it adds to the energy.
  double add(const Change& change);
  /// Takes it out again.
  void takeOut(const Change& change);
  /// Remembers the blocks that are in place now. Threads may, where what they touch is apart.
  void keep(const Change& change);

  double energy() const;
  /// The block of 3 cells a side whose lowest cell is at a position, or `kUnknown`; also where the
  /// grid ends before it does.
  std::int32_t blockAt(std::int64_t position) const { return ids_[2][position]; }
  /// How many more of a block there are than should be.
  double surplus(std::int32_t block) const { return count_[block] - target_[block]; }
  Vec3i blockSize() const { return shape_[2]; }

  /// Where the examples show a block of 3 cells a side.
  struct Place {
    std::int32_t source, position;  // of the source
  };
  std::span<const Place> places(std::int32_t block) const {
    const std::int32_t b = block - firstOf_[2];
    return {places_.data() + placeBegin_[b],
            static_cast<std::size_t>(placeBegin_[b + 1] - placeBegin_[b])};
  }

 private:
  struct Slot {
    std::uint64_t hash = 0;
    std::int32_t id = kUnknown;
  };

  void sumLayers(int side, std::span<const Label> grid, const Vec3i& p, int frame, int layers,
                 std::vector<std::uint64_t>& sums) const;
  std::uint64_t hashOf(int side, const std::uint64_t* sums) const;
  std::uint64_t hashAt(int side, const PatchSource& source, const Vec3i& p, int frame) const;
  std::int32_t find(int side, std::uint64_t hash) const;
  std::int32_t findOrAdd(int side, std::uint64_t hash);
  void grow();
  void countSources(std::span<const PatchSource> sources, const Progress& progress);
  void fillUp(const PatchSource& source);
  /// The number of a single cell of a label at a height.
  std::int32_t single(Label label, int z) const { return stands_ ? z * labels_ + label : label; }
  double shift(std::int32_t id, int by);

  const ModelProblem* problem_;
  Vec3i size_;
  int frames_, labels_;
  Axes periodic_;
  bool stands_;                                // whether heights differ
  std::array<Vec3i, kSides> shape_, places1_;  // of a block; how many places it has in the result
  std::vector<std::uint64_t> code_;            // of each label
  // Of each cell of a layer of a block, and of each layer: blocks' hashes are sums of products.
  std::array<std::vector<std::uint64_t>, kSides> across_, up_;
  std::array<std::int32_t, kSides> firstOf_{};  // blocks of a length come together
  std::vector<Slot> slots_;
  std::size_t used_ = 0;
  std::vector<double> target_;
  std::vector<double> count_;
  double unknown_ = 0;
  std::array<std::vector<std::int32_t>, kSides> ids_;  // of each position; of single cells: none
  std::vector<std::int64_t> placeBegin_;
  std::vector<Place> places_;
};

}  // namespace exemplar
