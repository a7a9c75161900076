// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/array3d.h"
#include "core/axes.h"
#include "core/progress.h"
#include "synth/geometry/synthesize.h"
#include "synth/geometry/voting/example_regions.h"

namespace exemplar {

struct VotingOptions {
  Vec3i size{0, 0, 0};  ///< of the result, samples; each component >= 1
  std::uint64_t seed = 0;
  int patch = 7;  ///< samples a side, 3..15; along a thinner axis its whole thickness
  /// 1..8; by default the coarsest has about 16 samples along the longest side of the example.
  std::optional<int> levels;
  int rounds = 6;  ///< of matches and votes a level, 1..100; the finest takes two thirds of them
  double truncation = 4;  ///< distances count up to here, in voxels of the level; > 0
  /// α of the completeness term (Granot et al., "Drop the GAN: in defense of patches nearest
  /// neighbors as single image generative models", CVPR 2022, section 4.1), in squared voxels: the
  /// smaller, the more each part of the example gets its turn; > 0, infinite for none. It works on
  /// all levels but the finest (which only adds detail), unless that is the only one.
  double completeness = 0.2;
  std::optional<Axes> stationary;  ///< found from the examples by default
  /// Along which axes the result continues at its opposite side, so that copies of it tile space.
  Axes periodic;
  /// What stays as it is: samples of the result, not 0, that are the (first) example's, to the bit;
  /// of the result's size. Where v, the sample is the example's at its place less
  /// `keptOffsets[v - 1]`, or at its place where there are no offsets. Samples outside the example
  /// are ignored. The rest is copied from what is kept alone, so that what is not kept of that
  /// example (a hole in a scan) is synthesized; but all of it is copied from where only solid or
  /// only air is kept, and where the result is longer along an axis along which the example ends in
  /// air: its farther end must come from somewhere.
  std::optional<Array3D<std::uint8_t>> kept;
  std::vector<Vec3i> keptOffsets;
  /// What the solid should be near to, coarsely: distances in voxels, below 0 where solid is
  /// wanted; of the result's size. Axes that are not stationary are then moved along like others.
  std::optional<Array3D<float>> guide;
  double guideWeight = 1;  ///< of the guide's squared differences among the example's own; > 0
  /// Of several examples, how they share the result, region by region.
  MixOptions mix;
  /// What the coarsest level starts from: for each of its samples one of the example at that level
  /// (of 2^(levels - 1) samples a side), of one example that is not turned. Patches may then be
  /// from anywhere, and come to be from where they look like what is there. Empty: random blocks.
  Array3D<Vec3i> start;
  /// Parts may be turned about z by quarter turns. Needs an example that is stationary along x and
  /// y.
  bool rotations = false;
};

/// Geometry synthesis from overlapping patches that are matched and vote, coarse to fine.
///
/// The coarsest level starts from small random blocks. Each level alternates a nearest-neighbor
/// field of all patches with a weighted vote (Kwatra et al., "Texture optimization for
/// example-based synthesis", SIGGRAPH 2005, doi:10.1145/1073204.1073263; Simakov et al.,
/// "Summarizing visual data using bidirectional similarity", CVPR 2008,
/// doi:10.1109/CVPR.2008.4587842), ends with copying, each sample the origin on which the patches
/// that cover it agree most, and with seams cut to where both sides agree best (`refineSeams`). At
/// the end what has broken off is cleared away (`dropBrokenPieces`), and steps across seams are
/// evened out (`evenSeams`).
///
/// It can do whatever is asked for: keep samples, follow a guide, mix examples, turn parts, make
/// any result periodic. What needs none of that is better quilted (`synthesizeByQuilting`).
///
/// Each sample has the sign of the example at its origin; its value is the example's to the bit
/// away from the borders of copied pieces, and nearly a distance beside them. Sides of the
/// example's box that lie wholly outside the solid (a free-standing object with air around it) stay
/// outside in the result; elsewhere the result is a window into something larger.
///
/// Cost: O(samples of the result x patch³ x rounds) for each level's PatchMatch at most; memory
/// about 120 bytes a sample of the result. The same bytes at any number of threads. Throws
/// `InputError` for options out of range, `Cancelled` when cancelled.
SynthesisResult synthesizeByVoting(const DistanceField& example, const VotingOptions& options,
                                   const Progress& progress = {});

/// The same from 1 to 255 examples, of one voxel size: each has regions of the result
/// (`ExampleRegions`), and where regions meet, seams are cut to where both agree best. Origins say
/// which example a sample is from.
SynthesisResult synthesizeByVoting(std::span<const DistanceField* const> examples,
                                   const VotingOptions& options, const Progress& progress = {});

}  // namespace exemplar
