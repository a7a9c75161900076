// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>

#include "core/random_streams.h"

namespace exemplar {

/// Random numbers that are a function of what they are for, and of nothing else: Philox4x32-10, a
/// counter-based generator (Salmon, Moraes, Dror, Shaw: "Parallel random numbers: as easy as 1, 2,
/// 3", SC 2011, doi:10.1145/2063384.2063405). Neither the order of the calls nor the number of
/// threads can change a number.
///
/// `seed` is the user's; `stream` distinguishes the places in the program that draw
/// (`core/random_streams.h` names them all); `cell` is what the number is for (a sample's index,
/// say); `draw` counts the numbers drawn for that cell. What is tried several times draws from a
/// `fork` for each attempt.
class Random {
 public:
  explicit Random(std::uint64_t seed, std::uint32_t stream = 0) : seed_(seed), stream_(stream) {}

  /// Numbers for attempt number `attempt` at the same thing, independent of these and of those of
  /// other attempts.
  Random fork(std::uint64_t attempt) const { return Random(bits(attempt), stream_); }

  /// 64 uniform bits.
  std::uint64_t bits(std::uint64_t cell, std::uint32_t draw = 0) const;

  /// Uniform in [0, 1), a multiple of 2^-53.
  double uniform(std::uint64_t cell, std::uint32_t draw = 0) const {
    return static_cast<double>(bits(cell, draw) >> 11) * 0x1p-53;
  }
  /// Uniform in [low, high).
  double uniform(double low, double high, std::uint64_t cell, std::uint32_t draw = 0) const {
    return low + (high - low) * uniform(cell, draw);
  }
  /// Uniform in 0..n-1, for n >= 1; the bias is below n / 2^32.
  std::uint32_t below(std::uint32_t n, std::uint64_t cell, std::uint32_t draw = 0) const {
    return static_cast<std::uint32_t>(((bits(cell, draw) >> 32) * n) >> 32);
  }
  /// Normal with mean 0 and deviation 1, by Box and Muller's method; spends `draw` and `draw` + 1.
  double normal(std::uint64_t cell, std::uint32_t draw = 0) const;

 private:
  std::uint64_t seed_;
  std::uint32_t stream_;
};

/// Ten rounds of Philox4x32: the published function, open for testing against its known answers.
std::array<std::uint32_t, 4> philox4x32(std::array<std::uint32_t, 4> counter,
                                        std::array<std::uint32_t, 2> key);

}  // namespace exemplar
