// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/progress.h"
#include "search/block_match.h"

namespace exemplar {

template <class Sample>
struct BlockIndexData;

struct BlockIndexOptions {
  /// For each source, in order, which positions may be found (a block's first sample): of the
  /// source's size, allowed where not 0; or null: all. No entries: all positions of all sources.
  std::vector<const Array3D<std::uint8_t>*> allowed;
  /// Sides of the boxes of positions that the index keeps as one, 1 or 2; 0: 1 for up to two
  /// million positions, which is faster and takes more memory for each, and 2 beyond.
  int boxSide = 0;
};

/// What a search did.
struct BlockIndexStatistics {
  std::int64_t nodes = 0;   ///< inner nodes whose children's bounds were evaluated
  std::int64_t leaves = 0;  ///< leaves whose entries' bounds were evaluated
  std::int64_t boxes = 0;   ///< boxes of positions whose positions' bounds were evaluated
  std::int64_t blocks = 0;  ///< blocks whose samples were summed
  bool scanned = false;     ///< the bounds did not pay: the rest was a linear scan
};

/// An exact index of all blocks of one size in one or more sources: the nearest block to a query,
/// also when only some of its samples are known. The answer is that of a linear scan, to the last
/// bit.
///
/// A block is cut into eight cells. Four features of each, its mean and three more inner products
/// with orthonormal polynomials, are a point in 32 dimensions; distances there never exceed
/// distances of blocks (Bessel's inequality; Lagae 2004, equation 2, is the case of averages), nor
/// do those over only the dimensions of cells that are known. A 16-ary tree of boxes over these
/// points is searched depth-first, nearest children first; what its bounds cannot exclude is summed
/// in full. docs/matching.md has the proof and measurements.
template <class Sample>
class BlockIndex {
 public:
  /// Takes the sources; `block` is any box that fits into all of them. About 9 to 12 bytes a sample
  /// beyond the sources with boxes of side 2, about 50 bytes a position with side 1. Parallel,
  /// deterministic; seconds for 256³ samples. Throws `InputError` when a block does not fit, no
  /// position is allowed, or memory does not suffice, and `Cancelled`.
  BlockIndex(std::vector<Array3D<Sample>> sources, const Vec3i& block,
             const BlockIndexOptions& options = {}, const Progress& progress = {});
  BlockIndex(Array3D<Sample> source, const Vec3i& block, const BlockIndexOptions& options = {},
             const Progress& progress = {});
  BlockIndex(BlockIndex&&) noexcept;
  BlockIndex& operator=(BlockIndex&&) noexcept;
  ~BlockIndex();

  /// The nearest block; ties by lowest source, then lowest index.
  ///
  /// `hints` are positions that are likely to be near (the neighbor's match, moved along); they
  /// make the search faster and never change its answer. Those that are outside or not allowed are
  /// ignored.
  BlockMatch findBest(const BlockQuery<Sample>& query, std::span<const BlockMatch> hints = {},
                      BlockIndexStatistics* statistics = nullptr) const;

  const Vec3i& block() const;
  int sources() const;
  const Array3D<Sample>& source(int number) const;
  std::int64_t positions() const;  ///< that may be found
  std::int64_t bytes() const;      ///< beyond the sources

 private:
  std::unique_ptr<const BlockIndexData<Sample>> data_;
};

}  // namespace exemplar
