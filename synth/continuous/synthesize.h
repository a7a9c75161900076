// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/axes.h"
#include "core/outcome.h"
#include "core/progress.h"
#include "synth/continuous/density_map.h"
#include "synth/continuous/polygons.h"
#include "synth/continuous/search.h"
#include "synth/continuous/solids.h"
#include "synth/continuous/weights.h"

/// Continuous model synthesis: P. Merrell and D. Manocha, "Continuous Model Synthesis", ACM
/// Transactions on Graphics 27(5) (SIGGRAPH Asia), 2008, doi:10.1145/1409060.1409111; P. Merrell,
/// "Model Synthesis", PhD thesis, University of North Carolina at Chapel Hill, 2009, chapter 4.
///
/// Near every point the result looks like the example near some point. Differences: everything is
/// exact; planes are spaced so that vertices of any number of planes repeat; failed choices are
/// undone one by one; labels are weighed.
namespace exemplar::continuous {

/// A point that must be of some substances. It is in a cell of the box of the result that is one
/// spacing wide, at its center.
struct PlacedSubstance {
  Vec3i cell;
  std::vector<Substance> substances;
};

/// A substance that is at most one spacing of planes thick across a direction.
struct Thickness {
  Substance substance = 1;
  Vec3l normal;  ///< canonical
};

struct ContinuousOptions {
  Vec3i size{1, 1, 1};  ///< of the result, in spacings
  std::uint64_t seed = 0;
  std::optional<std::int64_t> spacing;  ///< of planes, units; found
  double density = 1;                   ///< how full the result is, in shares of the example's, > 0
  int learning = 8;         ///< rounds in which weights are adapted to the example's shares, >= 0
  std::int64_t budget = 0;  ///< failed choices of an attempt; 0: 1,000 and a tenth of the vertices
  int attempts = 3;         ///< in one pass, before blocks
  int block = 20;           ///< side of a block, spacings
  int rounds = 2;           ///< of all blocks
  bool blocksOnly = false;  ///< no attempt in one pass
  bool blocks = true;       ///< where no attempt succeeds
  std::vector<PlacedSubstance> placed;
  std::vector<Thickness> thin;
  std::optional<DensityMap> map;  ///< where the result is full and where it is empty
  /// Along which axes the result is cut out of something longer, without ends of its own; not z
  /// where the example has a ground.
  Axes open;
  Axes mirror;  ///< along which the result is its own mirror image
  /// At most how many connected groups what is built forms, grown from as many seeds; 0: any.
  int groups = 0;
  double objectSize = 1;  ///< how large solids are, in sizes of the example's, > 0
  double jitter = 0;      ///< how far planes are moved out of their rows, half steps, 0..1
  /// Whether solids may hang in the air over the ground; by default, where some of the example do.
  std::optional<bool> floating;
  std::size_t mostVertices = 8'000'000;  ///< about 200 bytes each
};

struct ContinuousStatistics {
  std::size_t directions = 0, figures = 0, labels = 0, classes = 0;
  std::size_t vertices = 0, freeVertices = 0;
  std::int64_t choices = 0, failures = 0, attempts = 0, blocks = 0, blocksKept = 0, exact = 0,
               floating = 0,  // pieces in the air that were removed
      groups = 0;             // connected ones, where their number was limited
  std::size_t polygons = 0;
  bool whole = false;                ///< in one pass, not in blocks
  Shares exampleShares{}, shares{};  ///< of classes of figures, at inner vertices
};

struct ContinuousResult {
  Outcome outcome = Outcome::Complete;
  PolygonModel model;         ///< where complete
  std::string why;            ///< where not: one sentence
  std::vector<int> conflict;  ///< where impossible: indices of `placed` that exclude each other
  ContinuousStatistics statistics;
};

/// The example's own faces, in a box one spacing larger than it.
PolygonModel polygonsOf(const Solids& solids, const std::vector<Material>& looks,
                        const Progress& progress = {});

/// Makes more of an example. The same at any number of threads. Throws `InputError` for requests
/// that cannot be honored, and `Cancelled`.
ContinuousResult synthesizeSolids(const Solids& example, const std::vector<Material>& looks,
                                  const ContinuousOptions& options, const Progress& progress = {});

}  // namespace exemplar::continuous
