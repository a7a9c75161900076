// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/origin.h"
#include "core/progress.h"
#include "sdf/distance_field.h"
#include "voxelize/adjacency.h"
#include "voxelize/label_grid.h"

namespace exemplar {

/// How a distance field is cut into blocks that become labels.
struct FieldBlocksOptions {
  /// Samples a side of a block along x, y, z, 2..64; 0: found (`findBlockSize`).
  Vec3i block{0, 0, 0};
  /// The first whole block's first sample, 0..block - 1 each; none: the phase at which most blocks
  /// are repeated, ties by the lowest.
  std::optional<Vec3i> phase;
  /// Blocks share a label when no two samples differ by more than this from those of the label's
  /// first block, voxels, >= 0. Only the field near the surface counts: it is clamped to ±
  /// `truncation` voxels first, > 0. Surfaces of neighbors that met in the example then meet within
  /// twice the tolerance in a result.
  double tolerance = 0.5;
  double truncation = 2;
  /// Samples that neighboring blocks share along each axis that has several, less than their sides.
  /// 0: blocks tile the field, and are neighbors as they are in it. Else blocks are taken at
  /// every place of the example (every second, fourth, ... where that gave too many labels), and
  /// any two may be neighbors whose shared samples agree: for examples without a grid.
  int overlap = 0;
};

/// A distance field as a grid of labels, one a block: what model synthesis can learn from. The
/// bridge between the two families.
struct FieldBlocks {
  LabelGrid grid;  ///< of whole blocks; what is left over at the sides is not part of it
  /// Which blocks may be neighbors in a result: those of neighboring cells of `grid`; with
  /// overlap, those that agree within twice the tolerance in all samples they share, as all do that
  /// are neighbors in the example, counted as often as they are, at least once.
  Adjacency adjacency;
  Vec3i block{};
  Vec3i phase{};
  Vec3i step{};    ///< from the block of one cell of `grid` to the next, samples; without overlap
                   ///< the block's sides
  Vec3i stride{};  ///< the same in a result: the block's sides less the overlap
  /// For each label the blocks (cells of `grid`) that share it, by rising index; the first is what
  /// the others were compared with.
  std::vector<std::vector<Vec3i>> members;
  /// The member with the smallest sum of squared differences to the others (of truncated samples).
  std::vector<Vec3i> medoid;
  /// Of all blocks the share that is not the first of its label: 0: nothing repeats.
  double repetition = 0;
  double tolerance = 0, truncation = 0;  ///< of the options
};

/// For each axis the shortest step after which the field is most nearly itself, near its surface:
/// the period of a regular example. Where nothing repeats, 8; never more than half the axis, and an
/// axis of fewer than 28 samples is one block. O(samples × largest step).
Vec3i findBlockSize(const DistanceField& field, const FieldBlocksOptions& options = {},
                    const Progress& progress = {});

/// Cuts a field into labeled blocks. Labels are numbered by their first block's index. Blocks are
/// compared with the first block of each label so far, each comparison left early: O(blocks ×
/// labels) at worst, for each phase that is tried (at most the sum of the block's sides, twice).
/// With overlap the labels are at most 4,096, unless the field has more blocks without it, and
/// all pairs are compared along each axis. Deterministic at any number of threads. Throws
/// `InputError` for options out of range, a field smaller than a block, or more than 65,536 labels
/// (16,384 with overlap). Throws `Cancelled`.
FieldBlocks cutIntoBlocks(const DistanceField& field, const FieldBlocksOptions& options = {},
                          const Progress& progress = {});

/// At which sides of its box, in the order of `Side`, the example's solid is cut off: there it is a
/// window into something larger, and what is there need not be at a result's sides.
std::array<bool, 6> cutSides(const DistanceField& field);

/// What a grid of labels shows as a field again, and where each sample came from.
struct PlacedBlocks {
  DistanceField field;
  Origins origins;
};

/// A field as labels of an example's blocks.
struct RecognizedBlocks {
  LabelGrid grid;            ///< one label more than the example: for blocks that it has not
  Vec3i phase{};             ///< that at which most of 64 blocks, evenly spread, are the example's
  std::int64_t unknown = 0;  ///< cells that are none of its blocks
};

/// Reads a field of the example's voxel size as if model synthesis had made it of `blocks`, which
/// tile: each block gets the label that it would have in the example. What `findViolations` then
/// says of the grid is how far any result is from keeping the example's adjacencies. O((blocks +
/// 64 phases) × labels) at worst. Deterministic at any number of threads. Throws `InputError` for
/// blocks that overlap or a field without a whole block. Throws `Cancelled`.
RecognizedBlocks recognizeBlocks(const DistanceField& field, const DistanceField& example,
                                 const FieldBlocks& blocks, const Progress& progress = {});

/// Puts blocks in place of their labels, the first `stride` samples of each: each cell's is the
/// member that agrees best with the samples across the faces it shares with cells already placed
/// (lower x, y, z); where none is placed, the medoid. Ties go to the lowest member. O(cells ×
/// members × face). Throws `InputError` for a grid without cells or with labels that `blocks` does
/// not know, or when memory does not suffice.
PlacedBlocks placeBlocks(const DistanceField& example, const FieldBlocks& blocks,
                         const Array3D<Label>& labels, const Progress& progress = {});

}  // namespace exemplar
