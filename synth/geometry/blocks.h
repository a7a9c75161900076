// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

#include "synth/geometry/synthesize.h"

namespace exemplar {

/// What the samples of a block that are not synthesized yet count as, in the first iteration.
enum class BlockSeeding {
  Random,  ///< random samples of the example, "these will match approximately equally well with any
           ///< block" (Lagae 2004, section 5.1): as published, and a source of variety
  Masked,  ///< nothing: only samples that are known count
};

/// How best matches are found. All are exact and give the same result.
enum class BlockSearch {
  Index,  ///< `BlockIndex`: the fastest
  Tree,   ///< the paper's search tree (section 4)
  Scan,   ///< the vectorized linear scan: faster than the tree on targets that are no distance
          ///< fields
};

struct BlocksOptions {
  Vec3i size{0, 0, 0};  ///< of the result, samples; each component >= 1
  std::uint64_t seed = 0;
  int block = 16;      ///< samples a side in the last iteration; a power of two, 2..256
  int iterations = 3;  ///< levels of resolution, each half as fine as the next; 1..8
  BlockSeeding seeding = BlockSeeding::Random;
  BlockSearch search = BlockSearch::Index;
  double truncation = 4;  ///< distances are compared up to here, in voxels, in 256 levels; > 0
};

/// Geometry synthesis by copying best-matching blocks (Lagae, Dumont, Dutré: "Geometry Synthesis",
/// report CW 381, K.U.Leuven, 2004, section 5).
///
/// Single resolution (5.1): the target is seeded, then block after block of it, each overlapping
/// what is there by seven octants, is replaced by the example's best match, of which only the
/// samples that were not synthesized are copied. Multiresolution (5.2): this is done on the example
/// subsampled, then finer and finer, each iteration seeded by the one before, so that large
/// features come from the first ones and detail from the last. Blocks shrink from twice `block` (in
/// samples of the finest level, where the example allows it) to `block`; one search tree serves all
/// iterations of a size, less its leaves.
///
/// Differences from the paper: blocks that do not depend on each other are matched in parallel; an
/// example thinner than a block is extended with what its face shows.
///
/// The result's samples are the example's, each at its origin. About result / (block/2)³ searches
/// in the last iteration. The same bytes at any number of threads. Throws `InputError` for options
/// out of range, `Cancelled` when cancelled.
SynthesisResult synthesizeBlocks(const DistanceField& example, const BlocksOptions& options,
                                 const Progress& progress = {});

}  // namespace exemplar
