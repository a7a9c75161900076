// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/progress.h"
#include "search/block_match.h"
#include "search/block_pyramid.h"

namespace exemplar {

/// When a queue entry may be dropped because another one is sure to hold something better (Lagae
/// 2004, section 4.3, equation 3). The answer is the same; only the queue's size differs. Synthesis
/// does without (it saves memory, not time); the rest is here for comparison with the paper.
enum class QueuePruning {
  None,
  Lipschitz,  ///< ε from `TreeSearchOptions::lipschitz`: right only where source and query keep
              ///< that promise
  Measured,  ///< ε from the deviations that the source's and the query's cells really have: always
             ///< right
};

struct TreeSearchOptions {
  QueuePruning pruning = QueuePruning::None;
  /// With `QueuePruning::Lipschitz`: by how many levels source and query change at most over the
  /// distance of two samples, rounding included; > 0.
  double lipschitz = 1;
  /// Only positions whose three components are multiples of this; >= 1. With the tree of
  /// `dropLeaves(d)` and 2^d: blocks of the field subsampled in place, rather than of all its 8^d
  /// shifts.
  int positionStride = 1;
};

/// What a search did.
struct TreeSearchStatistics {
  std::int64_t visitedNodes = 0;   ///< entries taken from the queue
  std::int64_t comparedCells = 0;  ///< pyramid cells whose difference was evaluated
  std::int64_t largestQueue = 0;   ///< entries
  std::int64_t prunedEntries = 0;  ///< never queued, or dropped, because of an upper bound
};

/// The search tree of Lagae 2004 (section 4), as published.
///
/// Every block's pyramid is a path from the root: level 1's average, then level 2's eight, and so
/// on (each level in z-order, so that a cell's eight children are neighbors). Equal beginnings
/// share their path: nodes with identical levels are one node (4.1), and nodes that agree in a part
/// of a level hang below a common parent that holds this part (4.4), so distances are evaluated
/// incrementally. Nodes store no samples but refer into a `SlidingPyramid`. A search is best-first
/// (4.3, figure 4): the queue is ordered by equation 2's lower bound.
///
/// Differences from the paper: rounded averages count as the interval that they represent, which
/// keeps the search exact; queries may be masked (cells known in part count with what their average
/// and the source's range of values leave possible); chains of nodes with one block below are not
/// stored; ties go to the lowest index.
class SearchTree {
 public:
  /// Blocks of `blockSize`³ samples; a power of two. About 30 bytes a block and 1 byte a sample and
  /// level. Deterministic; by one thread. Throws `InputError` when the block
  /// size is no power of two, or larger than the source, and `Cancelled`.
  SearchTree(Array3D<std::uint8_t> source, int blockSize, const Progress& progress = {});

  /// The tree without its `levels` lowest levels (section 5.2): the tree of the source subsampled
  /// `levels` times by two, for blocks of blockSize / 2^levels samples a side. Positions stay those
  /// of the original samples: sample (i, j, k) of a block at p is `pyramid().averages(levels)[p +
  /// 2^levels (i, j, k)]`.
  SearchTree dropLeaves(int levels) const;

  /// The nearest block to `query`, a cube of `blockSize()` samples a side. Exact; ties by lowest
  /// index.
  BlockMatch findBest(const BlockQuery<std::uint8_t>& query, const TreeSearchOptions& options = {},
                      TreeSearchStatistics* statistics = nullptr) const;

  /// The lower bounds that a search gives to the nodes on the way from the root to the block at
  /// `position`, in order, in units of `BlockMatch::distance`; the last is that block's distance.
  /// What the search rests on, for its tests to inspect: they never decrease.
  std::vector<double> boundsAlongPath(const BlockQuery<std::uint8_t>& query,
                                      const Vec3i& position) const;

  int blockSize() const { return blockSize_; }  ///< in samples of the (subsampled) field
  int droppedLevels() const { return dropped_; }
  const SlidingPyramid& pyramid() const { return *pyramid_; }

  std::int64_t nodes() const { return static_cast<std::int64_t>(nodes_.size()); }
  std::int64_t bytes() const;  ///< of nodes and references, without the pyramid

 private:
  struct Node {
    std::uint32_t begin;  ///< its positions in `order_`: [begin, begin + count)
    std::uint32_t count;
    std::uint32_t lowest;      ///< the lowest of them
    std::uint32_t firstChild;  ///< children are consecutive
    std::uint32_t prefix;      ///< cells along the path in which all its blocks agree
    std::uint32_t children;
  };
  struct Path;        // where each cell of a path lies
  struct Deviations;  // measured on first use
  friend class TreeBuilder;
  friend class TreeSearch;
  SearchTree() = default;

  int blockSize_ = 0, dropped_ = 0;
  int low_ = 0, high_ = 255;  ///< of the source's samples
  std::shared_ptr<const SlidingPyramid> pyramid_;
  std::shared_ptr<const Path> path_;
  std::vector<Node> nodes_;           ///< nodes_[0] is the root
  std::vector<std::uint32_t> order_;  ///< source indices of positions, sorted by path
  std::shared_ptr<Deviations> deviations_;
};

}  // namespace exemplar
