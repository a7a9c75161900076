// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

#include "core/array3d.h"
#include "core/vec.h"

/// The question that every search in this folder answers: given a block of samples of which only
/// some are known, which block of a source is nearest? A source is any array of numbers; `Sample`
/// is `std::uint8_t` (256 quantized levels: distances are exact integers over the count) or
/// `float`.
namespace exemplar {

/// A block to be matched.
///
/// Only the known samples count. The others may hold anything, and the block may have any size that
/// fits into the source (the paper's tree wants a cube whose side is a power of two).
template <class Sample>
struct BlockQuery {
  Array3D<Sample> samples;
  /// Empty: every sample is known. Otherwise of the size of `samples`: known where it is not 0.
  Array3D<std::uint8_t> known;
};

/// The answer. Of blocks at the same distance it is the one whose position has the lowest index in
/// the source (`Array3D::index`), in the lowest-numbered source.
struct BlockMatch {
  Vec3i position{};  ///< the block's first sample in the source
  /// Mean of the squared differences over the known samples (Lagae 2004, equation 1), in squared
  /// units of the samples; 0 where none is known.
  double distance = 0;
  int source = 0;  ///< which source, where several are searched at once

  bool operator==(const BlockMatch&) const = default;
};

/// The positions that a block of `block` can take in a source of `source`, along each axis: 0 up
/// to, not including, this. Throws `InputError` unless the block has a sample and fits.
Vec3i blockPositions(const Vec3i& source, const Vec3i& block);

/// The number of known samples. Throws `InputError` when `known` has not the size of `samples`.
template <class Sample>
std::int64_t knownSamples(const BlockQuery<Sample>& query);

}  // namespace exemplar
