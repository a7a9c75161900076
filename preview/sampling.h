// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>

#include "core/random.h"

namespace exemplar {

/// Two numbers in [0, 1).
struct Sample2 {
  float x, y;
};

/// Well-spread samples for every pixel of a picture: a scrambled (0, 2)-sequence whose index runs
/// over the pixels in Morton order, so that the samples of one pixel, of 2 x 2, of 4 x 4 pixels...
/// are stratified too and the error that remains is fine-grained, which the eye and the filter
/// average away.
///
/// Sources: B. Burley, "Practical hash-based Owen scrambling", JCGT 9(4), 2020 (shuffled and
/// scrambled Sobol' pairs, padded to more dimensions); A. G. M. Ahmed and P. Wonka, "Screen-space
/// blue-noise diffusion of Monte Carlo sampling error via hierarchical ordering of pixels", ACM
/// TOG 39(6), 2020, doi:10.1145/3414685.3417881. Different from the latter: base 2 in place of
/// 4, and the order starts again, with other keys, every 128 x 128 pixels.
class PixelSampler {
 public:
  static constexpr int kPairs = 5;  ///< sample pairs that a path may draw

  /// `paths` >= 1 samples for each pixel.
  PixelSampler(std::uint64_t seed, int paths);

  /// Moves to a pixel; x, y >= 0.
  void startPixel(int x, int y);

  /// Pair `pair` (0..kPairs-1) of path `path` (0..paths-1) of the current pixel.
  Sample2 get(int path, int pair) const;

 private:
  struct Keys {
    std::uint32_t shuffle, x, y;
  };

  Random random_;
  int pathBits_ = 0;
  std::uint32_t first_ = 0;  ///< index of the pixel's first sample
  std::uint64_t block_ = ~std::uint64_t{0};
  std::array<Keys, kPairs> keys_{};
};

}  // namespace exemplar
