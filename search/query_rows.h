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

/// A query made ready for summing equation 1 against many blocks: its rows along x that have a
/// known sample, each cut to the span of its known samples, in an order that spreads over the block
/// so that a bad block is left early.
template <class Sample>
class QueryRows {
 public:
  using Sum = SquaredSum<Sample>;

  /// For sources of `sourceSize`. Throws as `blockPositions` and `knownSamples` do.
  QueryRows(const BlockQuery<Sample>& query, const Vec3i& sourceSize);

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

  struct Row {
    std::uint32_t source;  ///< from the block's first sample to the row's first known one
    std::uint32_t query;   ///< into `values` and `masks`
    std::uint32_t length;
    bool masked;  ///< holds unknown samples
  };
  struct Data {
    std::vector<Row> rows;
    std::vector<std::conditional_t<std::is_same_v<Sample, std::uint8_t>, std::int16_t, float>>
        values;
    std::vector<Sample> masks;  ///< known: all bits set, or 1.0f; else 0
  };

 private:
  Data data_;
  std::int64_t known_ = 0;
};

}  // namespace exemplar
