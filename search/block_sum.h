// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <type_traits>
#include <vector>

#include "search/block_match.h"

namespace exemplar {

/// Sums of squared differences: exact integers for levels, doubles for floats.
template <class Sample>
using SquaredSum = std::conditional_t<std::is_same_v<Sample, std::uint8_t>, std::int64_t, double>;

/// A query made ready for summing equation 1 against many blocks, a vector of samples at a time, in
/// an order that spreads over the block so that a bad block is left early.
template <class Sample>
class BlockSum {
 public:
  using Sum = SquaredSum<Sample>;

  /// For sources of `sourceSize`. Throws as `blockPositions` and `knownSamples` do.
  BlockSum(const BlockQuery<Sample>& query, const Vec3i& sourceSize);

  std::int64_t known() const { return known_; }
  /// A sum as `BlockMatch::distance`.
  double distance(Sum sum) const {
    return known_ == 0 ? 0 : static_cast<double>(sum) / static_cast<double>(known_);
  }

  /// The sum for the block whose first sample is `*block`, or, as soon as it exceeds `limit`, a
  /// part of the sum that exceeds `limit`. Partial sums never exceed the whole one, rounding
  /// included.
  Sum sum(const Sample* block, Sum limit) const;

  /// Of the blocks at `block`, `block` + 1, ..., `count` of them, the first whose sum is at most
  /// `limit`; its sum goes to `found`. `count` when there is none.
  std::size_t firstWithin(const Sample* block, std::size_t count, Sum limit, Sum& found) const;

  static constexpr bool kLevels = std::is_same_v<Sample, std::uint8_t>;
  static constexpr int kLanes = kLevels ? 32 : 8;
  using Value = std::conditional_t<kLevels, std::int16_t, float>;

  /// Known samples, as many at a time ("a chunk") as a vector has lanes, gathered from pieces of
  /// rows. A piece has a power of two of samples, so that it is one load, and lies within its row,
  /// so that no load leaves the source.
  struct Chunks {
    std::vector<std::uint32_t> source;  ///< of each piece, from the block's first sample
    std::vector<Value> value;           ///< kLanes a chunk; 0 where unknown
    std::vector<Value> mask;            ///< kLanes a chunk; all bits, or 1.0f, where known
    std::size_t count = 0;              ///< chunks
    std::size_t whole = 0;              ///< how many, from the first on, have no unknown sample
    int piece = kLanes;                 ///< samples
  };

 private:
  Chunks chunks_;
  std::int64_t known_ = 0;
};

}  // namespace exemplar
