// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <memory>

#include "search/block_match.h"

namespace exemplar {

/// The nearest block by correlation in the frequency domain: all positions at once, whatever the
/// data. An oracle for tests and a baseline for benchmarks; FFTW is GPL, so the library itself must
/// not link it.
///
/// Sum of m (S - q)² = (S² correlated with m) - 2 (S correlated with m q) + sum of m q², with the
/// transforms of S and S² computed beforehand, in single precision. Blocks whose sum is within the
/// transforms' error of the smallest are then summed exactly, so the answer is that of the linear
/// scan.
class FftCorrelation {
 public:
  explicit FftCorrelation(Array3D<std::uint8_t> source);
  ~FftCorrelation();
  BlockMatch findBest(const BlockQuery<std::uint8_t>& query);
  /// Blocks that were summed exactly in the last search.
  std::int64_t verified() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace exemplar
