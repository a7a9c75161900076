// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "synth/geometry/pyramid.h"
#include "synth/geometry/stationary.h"
#include "synth/geometry/synthesize.h"

namespace exemplar {

struct OptimizeOptions {
  Vec3i size{0, 0, 0};  ///< of the result, samples; each component >= 1
  std::uint64_t seed = 0;
  int patch = 7;  ///< samples a side, 3..15; along a thinner axis its whole thickness
  /// 1..8; by default the coarsest has at most 40 samples along the longest side of the example,
  /// and about 16 where it starts from small blocks.
  std::optional<int> levels;
  /// Searches and votes a level, 1..100, where it starts from small blocks; the finest takes two
  /// thirds of them, and one that only repairs seams a sixth.
  int rounds = 6;
  double truncation = 4;  ///< distances count up to here, in voxels of the level; > 0
  /// α of the completeness term (Granot et al., "Drop the GAN: in defense of patches nearest
  /// neighbors as single image generative models", CVPR 2022, section 4.1), in squared voxels: the
  /// smaller, the more each part of the example gets its turn; > 0, infinite for none. It works
  /// where the start is from small blocks, on all levels but the finest (which only adds detail),
  /// unless that is the only one.
  double completeness = 0.2;
  std::optional<StationaryAxes> stationary;  ///< found from the example by default
  /// Along which axes the result goes on at its opposite side, so that copies of it tile space.
  PeriodicAxes periodic;
  /// What stays as it is: samples of the result, not 0, that are the (first) example's of the same
  /// place, to the bit; of the result's size. Only what is kept is copied from that example, so
  /// what is not kept of it (a hole in a scan) is made new; but where only solid or only air is
  /// kept, all of it is copied from. Samples outside the example are passed over.
  std::optional<Array3D<std::uint8_t>> kept;
  /// What the solid shall be near to, coarsely: distances in voxels, below 0 where solid is wanted;
  /// of the result's size. Axes that are not stationary are then moved along like others.
  std::optional<Array3D<float>> guide;
  double guideWeight = 1;  ///< of the guide's squared differences among the example's own; > 0
  /// Parts may be turned about z by quarter turns. Needs an example that is stationary along x and
  /// y.
  bool rotations = false;
};

/// Geometry synthesis by patch optimisation, coarse to fine.
///
/// A result of the example's own size is the example cut in two and its halves exchanged, where an
/// axis allows it (`rearrange`); that needs no coarser levels. Else the coarsest level starts from
/// large blocks of the example, each where it agrees best with those before, so that all parts get
/// their turn, and a result of the example's own size is no copy of it (`quilt`). On each level the
/// borders of the copied pieces move to where both sides agree best
/// (`refineSeams`), and pieces to where they line up (`alignPieces`). On the finest, where a border
/// shows all the same (`badSeams`), a nearest-neighbour field of overlapping patches and a weighted
/// vote find what belongs there (Kwatra et al., "Texture optimization for example-based synthesis",
/// SIGGRAPH 2005, doi:10.1145/1073204.1073263); what is verbatim stays so.
///
/// Where something is kept or guided, where the result is periodic, and of several examples or
/// turned ones, the start is from small blocks, and each level alternates such a field of all
/// patches with a vote (Simakov et al., "Summarizing visual data using bidirectional similarity",
/// CVPR 2008, doi:10.1109/CVPR.2008.4587842), ends with copying, each sample the origin on which
/// the patches that cover it agree most, and with seams cut as above.
///
/// At the end what has broken off is cleared away (`dropBrokenPieces`), and steps across borders
/// are evened out (`evenSeams`).
///
/// So each sample has the sign of the example at its origin; its value is the example's to the bit
/// away from the borders of copied pieces, and nearly a distance beside them.
///
/// Sides of the example's box that lie wholly outside the solid (a free-standing object with air
/// around it) stay outside in the result; elsewhere the result is a window into something larger.
///
/// Cost: O(samples of the result x patch^3 x rounds) for each level's PatchMatch at most; memory
/// about 120 bytes a sample of the result. The same bytes at any number of threads. Throws
/// `InputError` for options out of range.
SynthesisResult synthesizeOptimized(const DistanceField& example, const OptimizeOptions& options,
                                    const Progress& progress = {});

/// The axes that a synthesis moves parts along: those that the options name, or those along which
/// all examples are stationary, by what is kept of the first.
StationaryAxes stationaryAxes(std::span<const DistanceField* const> examples,
                              const OptimizeOptions& options);

/// The same from several examples, of one voxel size: parts of all of them meet in the result, and
/// origins tell which.
SynthesisResult synthesizeOptimized(std::span<const DistanceField* const> examples,
                                    const OptimizeOptions& options, const Progress& progress = {});

}  // namespace exemplar
