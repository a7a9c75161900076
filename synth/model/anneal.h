// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/progress.h"
#include "synth/model/block_counts.h"
#include "synth/model/choose.h"
#include "synth/model/copied_windows.h"
#include "synth/model/patch_sources.h"
#include "synth/model/problem.h"

namespace exemplar {

struct AnnealSchedule {
  double moves = 8;  ///< for each column, >= 0
  double hot = 20;   ///< the temperature at first, in blocks, >= 0; at last it is 0
  int looks = 4;     ///< columns looked at to find one where the example is not met, >= 1
  int shift = 3;     ///< how far apart these are at most, in columns, >= 0
};

/// What a labeling of a problem is annealed towards: the same for all labelings of it.
struct PatchGoal {
  PatchGoal(const ModelProblem& problem, std::span<const LabelGrid> examples,
            const Progress& progress = {})
      : sources(patchSources(problem, examples, progress)),
        counts(problem, sources, progress),
        copies(problem, sources) {}

  std::vector<PatchSource> sources;
  BlockCounts counts;
  CopiedWindows copies;
};

/// Makes a labeling hold what the example holds: Metropolis sampling with patches of the example as
/// moves (Metropolis et al., J. Chem. Phys. 21, 1953), cooled down (Kirkpatrick, Gelatt, Vecchi:
/// "Optimization by simulated annealing", Science 220, 1983).
///
/// Rules of pairs leave open how often an object occurs, how large it is, and whether a street
/// leads anywhere. The energy counts that: over all blocks of 1, 2 and 3 cells a side, how many
/// more or fewer there are than in the example times the ratio of areas (`BlockCounts`), and a
/// price for each window of 8 x 8 columns that is verbatim in the example (`CopiedWindows`).
///
/// A move takes a core of 1 to 14 by 1 to 8 columns, at times of part of the height, near a block
/// that is unknown or too frequent; of some places in the example the one that agrees best with
/// what is around (`PatchAlignments`); and puts that in so that every pair stays one of the
/// example's, by implication and by a search in a narrow rim (`PatchMove`), within the labels that
/// the request leaves each cell: pins, holes, sides, periodic axes, symmetry, frames and further
/// offsets need nothing of their own. It is kept with the chance min(1, exp(-change /
/// temperature)). Cores are long at first, for short ones alone would not begin anything large, and
/// shorter at the end; the temperature falls evenly from 20 blocks to 0. Under weights of labels
/// other counts are wanted; where a map makes a label more probable, that counts like blocks.
///
/// `labels` must be consistent, and is after every move; `base` holds the labels that the request
/// leaves each cell, arc consistent. `ModelOptions::moves` moves are made for each column, those
/// that are far apart at the same time; each is weighed with exact counts, in a fixed order, so the
/// bytes are the same at any number of threads. O(moves); 12 bytes a cell, and a region for each
/// thread. Throws `Cancelled`.
void annealPatches(const ModelProblem& problem, const LabelSets& base, const LabelChooser& chooser,
                   std::span<const LabelGrid> examples, std::vector<Label>& labels,
                   const AnnealSchedule& schedule, ModelStatistics& statistics,
                   const Progress& progress = {});
/// The same for one of several labelings of a problem, with the random numbers of `seed` in place
/// of the request's. Returns the energy at last, copies included.
double annealPatches(const ModelProblem& problem, const LabelSets& base,
                     const LabelChooser& chooser, const PatchGoal& goal, std::uint64_t seed,
                     std::vector<Label>& labels, const AnnealSchedule& schedule,
                     ModelStatistics& statistics, const Progress& progress = {});

}  // namespace exemplar
