// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "search/block_index.h"
#include "search/block_sum.h"
#include "search/cell_features.h"
#include "search/feature_tree.h"
#include "search/kernels.h"

/// What a `BlockIndex` holds: for its own sources and tests.
namespace exemplar {

constexpr std::uint32_t kNoPosition = FeatureTree::kNone;

// One bit for each position of all sources.
class Bits {
 public:
  explicit Bits(std::size_t count = 0) : words_((count + 63) / 64, 0) {}
  bool operator[](std::size_t i) const { return (words_[i / 64] >> (i % 64) & 1) != 0; }
  void set(std::size_t i) { words_[i / 64] |= std::uint64_t{1} << (i % 64); }
  std::size_t bytes() const { return words_.size() * 8; }

 private:
  std::vector<std::uint64_t> words_;
};

template <class Sample>
struct IndexedSource {
  Array3D<Sample> samples;
  Vec3i positions{};
  std::uint32_t offset = 0;                // of its first sample among the samples of all sources
  Array3D<kernels::Brick> bricks;          // with boxes of side 2: the features of all cells
  Array3D<kernels::ByteBrick> fineBricks;  // and of their eighths, where blocks are large
};

template <class Sample>
struct BlockIndexData {
  using Sum = SquaredSum<Sample>;

  Vec3i block;
  int side = 1;  // of boxes of positions
  std::vector<IndexedSource<Sample>> sources;
  std::optional<CellLayout> layout;
  std::optional<CellFeatures> features;
  Vec3d slopes;        // largest differences of neighbors along each axis
  int brickShift = 0;  // of IndexedSource::bricks
  // Large blocks: each cell is cut into eight again, and these have features too.
  std::optional<CellLayout> fineLayout;
  std::optional<CellFeatures> fineFeatures;
  kernels::ByteScale fineScale;
  bool aligned = true;  // all cells of a box of positions lie in one brick each
  Bits live;            // positions that are in the tree
  Bits allowedBits;     // positions that may be found, where not all
  bool allAllowed = true;
  std::int64_t positionCount = 0;
  FeatureTree tree;  // of boxes, each known by the first of its positions

  int sourceOf(std::uint32_t position) const {
    int s = static_cast<int>(sources.size()) - 1;
    while (sources[s].offset > position) --s;
    return s;
  }
  bool allowed(std::uint32_t position) const { return allAllowed || allowedBits[position]; }

  void build(const BlockIndexOptions& options, const Progress& progress);
  void findPositions(const BlockIndexOptions& options);
  void measureSlopes();
  void dropRepeats(IndexedSource<Sample>& source);
  using CellArrays = std::vector<std::array<Array3D<CellFeatures::Numbers>, 8>>;
  CellArrays cellNumbers(const Progress& progress) const;
  /// The features of all cells, and of all their eighths, of each source, in bricks.
  void packBricks(const std::vector<Array3D<CellFeatures::Numbers>>& numbers);
  void packFineBricks(const std::vector<Array3D<CellFeatures::Numbers>>& numbers);
  /// The features' ranges over the live positions of a box.
  void ranges(const CellArrays& cells, std::uint32_t entry, std::int16_t* low,
              std::int16_t* high) const;
  int cellArray(int cell) const;
};

}  // namespace exemplar
