// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/array3d.h"
#include "core/axes.h"
#include "core/origin.h"
#include "core/outcome.h"
#include "core/progress.h"
#include "synth/model/symmetry.h"
#include "voxelize/adjacency.h"
#include "voxelize/label_grid.h"

namespace exemplar {

/// Which cells are labeled together.
enum class ModelMethod {
  Auto,    ///< `Whole`, and `Blocks` where that does not finish
  Whole,   ///< the whole grid in one pass, repaired where it contradicts itself (Algorithm 3.1)
  Blocks,  ///< a consistent start, modified block by block (Algorithm 3.4)
};

/// How probable each of a cell's possible labels is, before the user's own weights.
enum class LabelChoice {
  Neighbors,    ///< as frequent as in the example beside the labels around the cell
  Frequency,    ///< as frequent as in the example, whatever is around
  Uniform,      ///< all alike, as published
  Resemblance,  ///< as frequent as where the example's surroundings look the same (Merrell 2007,
                ///< equations 2-6)
};

/// What may be in the outermost layer at a side of the result (thesis, section 3.3.6).
struct SideRule {
  enum class Kind {
    Example,  ///< what the example shows at its own outermost layer on that side
    Free,     ///< anything
    Open,     ///< anything, but what the example shows on that side only is wanted there
    Labels,   ///< any of `labels`
  };
  Kind kind = Kind::Example;
  /// Whether it excludes anything.
  bool excludes() const { return kind == Kind::Example || kind == Kind::Labels; }
  /// Whether the side is to be like the example's.
  bool likeExample() const { return kind == Kind::Example || kind == Kind::Open; }
  std::vector<Label> labels;
};

/// A cell that must have one of some labels.
struct PinnedCell {
  Vec3i cell;
  std::vector<Label> labels;  ///< at least one
  int frame = 0;
};

/// Where a label should be: its weight is multiplied by the map's value at a cell.
struct WeightMap {
  std::vector<Label> labels;  ///< those that it speaks of
  /// Of the result's size; >= 0; where it is 0 the labels do not occur. A map that is 1 cell high
  /// holds for every height.
  Array3D<float> weight;
};

/// How many cells of some labels a result has, all in all.
struct CountLimit {
  std::vector<Label> labels;
  std::int64_t least = 0;
  std::optional<std::int64_t> most;  ///< none: any number
};

struct ModelOptions {
  Vec3i size{0, 0, 0};  ///< of the result, cells; each component >= 1
  int frames = 1;       ///< of the result, >= 1; more than one only with an example of frames
  std::uint64_t seed = 0;
  ModelMethod method = ModelMethod::Auto;
  LabelChoice choice = LabelChoice::Neighbors;

  /// Auto: blocks take over where repairs have taken more than this many times the work of labeling
  /// a hundred thousand cells and a quarter of those done so far, >= 0.
  int patience = 3;
  Vec3i block{10, 10, 10};  ///< cells; each component >= 2; blocks overlap by half
  int rounds = 1;           ///< over all blocks, 1..100

  /// Patches of the example tried for each column of the result after it is labeled, so that blocks
  /// occur as often as in the example (`annealPatches`); 0: none. With some, and
  /// no vertical side free, `Auto` begins with the most frequent labels. Results of more than
  /// 12,000 columns are quilted from a smaller one (`quiltLabels`), with fewer moves a column.
  double moves = 8;
  /// What a window of 8 x 8 columns costs then that stands verbatim in the example, >= 0, in blocks
  /// that occur once too often.
  double copyPrice = 80;

  /// How many cells after its own a label shows something of along each axis, >= 0, as a window of
  /// a picture does that begins at every pixel; along axes where the example ends.
  Vec3i reach{0, 0, 0};

  std::array<SideRule, 6> sides;  ///< in the order of `Side`
  Axes periodic;      ///< the result tiles along these: its sides there meet and have no rule
  bool loop = false;  ///< the last frame is followed by the first

  std::vector<PinnedCell> pins;
  Array3D<std::uint8_t> mask;   ///< of the result's size, 0: a hole that stays empty of all rules
                                ///< and gets label 0; without cells: no holes
  std::vector<double> weights;  ///< one a label, >= 0; empty: all 1; 0: the label does not occur
  std::vector<WeightMap> weightMaps;
  /// Blocks only: weights and maps do not bias the choice of labels; a modified block is kept with
  /// the chance min(1, f(new) / f(old)), f being the product of the weights of all labels in place
  /// (Metropolis; 2007, section 4.2).
  bool metropolis = false;
  std::vector<CountLimit> counts;
  /// Sets of labels whose cells, all in all, form one piece joined through faces.
  std::vector<std::vector<Label>> connected;
  ModelSymmetry symmetry;

  /// Conflicts that the exact solver may meet over the whole grid before it gives up, >= 1; also
  /// how many regions are tried for limits on counts and for connectedness.
  std::int64_t budget = 200000;
};

/// Why nothing fits: a smallest set of demands that exclude each other, given which labels may be
/// neighbors. Without any one of them the others can be met (or at least are not known to conflict,
/// where `proved` is false).
struct ModelConflict {
  std::vector<int> pins;    ///< indices into `ModelOptions::pins`
  std::vector<Side> sides;  ///< sides with a rule
  std::string text;         ///< one sentence, for people
};

/// What it took.
struct ModelStatistics {
  std::int64_t cells = 0;           ///< of the result
  std::int64_t contradictions = 0;  ///< cells left without a label
  std::int64_t repairs = 0;         ///< regions taken back and relabeled
  std::int64_t blocks = 0;          ///< modified, Blocks only
  std::int64_t blocksKept = 0;      ///< of these, left as they were
  std::int64_t exact = 0;           ///< calls of the exact solver
  std::int64_t moves = 0;           ///< patches tried
  std::int64_t movesKept = 0;       ///< of these, kept
  bool whole = true;                ///< in one pass; false: in blocks
};

struct ModelResult {
  /// Complete: every cell has a label, and every pair of neighbors is one of the example's.
  /// Impossible: proved; `conflict` says why. Unfinished: the budget was spent. Never Cancelled.
  Outcome outcome = Outcome::Complete;
  std::vector<LabelGrid> frames;  ///< one grid per frame; empty unless Complete
  /// For each frame and cell a cell of the example with the same label, whose neighbors agree best
  /// with the result's; `Origin::example` is the number of the example, or of its frame.
  std::vector<Origins> origins;
  ModelConflict conflict;  ///< where Impossible
  ModelStatistics statistics;

  const LabelGrid& grid() const { return frames.front(); }
};

/// Discrete model synthesis (Merrell, "Example-based model synthesis", I3D 2007,
/// doi:10.1145/1230100.1230119; thesis "Model Synthesis", University of North Carolina 2009,
/// chapter 3): a grid of labels of any size in which every pair of neighbors is one that the
/// example shows.
///
/// Each cell keeps the set of labels that are still possible there, always arc consistent
/// (statements 3.5-3.7); cell after cell, in column order, takes one of them at random. Where a
/// cell is left without any, a region around it is taken back and relabeled, by search with
/// backjumping and then by an exact solver, which finds a labeling or proves that none exists.
/// So a request is met, or shown to be impossible, or the budget is spent; a result never breaks
/// the example's rules. Patches of the example are then put in, each by relabeling what is around
/// it, until blocks of up to 3 x 3 x 3 cells occur as often as in the example. Limits on counts and
/// connectedness are met by relabeling regions where they are broken; where that does not succeed
/// the outcome is Unfinished, not a proof.
///
/// `examples` are those that `adjacency` was found in (they share one numbering of labels); looks,
/// cell size and origins come from them. The same bytes at any number of threads; `Blocks` runs
/// blocks that do not touch in parallel. Cost: about O(cells x labels) with a small factor; memory
/// about 64 bytes a cell and 4 bits a cell and label. Throws `InputError` for options out of range
/// or that name cells or labels that do not exist.
ModelResult synthesizeModel(std::span<const LabelGrid> examples, const Adjacency& adjacency,
                            const ModelOptions& options, const Progress& progress = {});
ModelResult synthesizeModel(const LabelGrid& example, const ModelOptions& options,
                            const Progress& progress = {});

}  // namespace exemplar
