// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/progress.h"
#include "synth/model/synthesize.h"
#include "world/phased_plane.h"

namespace exemplar {

/// The request of a world's rules: what of `options` says nothing about a single cell, or about
/// the whole. Throws `InputError` naming the setting where something is asked that no part of a
/// world can answer alone: counts, connectedness, symmetry, frames, tiling, Metropolis blocks,
/// pins, masks and maps, rules for sides along x and y.
void requireLocal(const ModelOptions& options);

/// A consistent labeling to begin a world with: 96 x 96 columns, as high as `options.size`, that
/// tile along x and y, annealed as results of model synthesis are. Of two ways to begin it, ground
/// and a labeling of its own, the one is taken that shows what the example shows more nearly as
/// often: half the sum over labels of the differences of shares. Impossible or Unfinished where the
/// example does not repeat over the plane, or that was not found out.
ModelResult labelWorldStart(std::span<const LabelGrid> examples, const Adjacency& adjacency,
                            const ModelOptions& options, const Progress& progress = {});

/// Half the sum over all labels of the differences of their shares in a grid and in examples, 0..1.
double shareDifference(const LabelGrid& grid, std::span<const LabelGrid> examples);

/// An unbounded plane of labels in which every two neighbors are a pair that the examples show,
/// and what they show occurs as often as there. Each part of it is a function of the rules alone.
///
/// The plane begins with `start`, over and over, and is modified in windows (`WindowLattice`), as
/// blocks are (Merrell 2007; thesis, Algorithm 3.4), so that it is consistent at all times: nothing
/// can contradict itself, and what cannot be modified stays. In the first two phases a window takes
/// another place of the start, of some random ones the one that goes on best from its rim
/// (`PatchMove`); in all phases its joints are annealed (`annealPatches`) with the rim fixed, each
/// window towards the example's statistics by itself.
class LabelWorld {
 public:
  /// All but `cache` are copied; `start` must tile. `options.seed` is the world's; `options.moves`
  /// of its moves are made a column for a sixteenth in each phase.
  LabelWorld(std::vector<LabelGrid> examples, Adjacency adjacency, const ModelOptions& options,
             LabelGrid start, const WindowLattice& lattice, WindowCache& cache);
  ~LabelWorld();
  LabelWorld(const LabelWorld&) = delete;
  LabelWorld& operator=(const LabelWorld&) = delete;

  /// The labels of a box of columns, with the examples' looks; its origin is that of the example,
  /// as if the box began there. Thread-safe. Throws `Cancelled`, and `InputError` where the box
  /// does not fit in memory.
  LabelGrid region(const PlaneBox& box, const Progress& progress = {}) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace exemplar
