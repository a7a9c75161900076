// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "search/block_index.h"
#include "search/block_sum.h"
#include "search/cell_features.h"
#include "search/kernels.h"

/// What a `BlockIndex` holds: for its own sources and tests.
namespace exemplar {

constexpr std::uint32_t kNoPosition = std::numeric_limits<std::uint32_t>::max();

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

struct alignas(64) IndexNode {
  kernels::MeanBoxes boxes;
  std::uint32_t lowest[kernels::kWide];  // position below each child
};

// What a search looks at in every leaf that it comes to; the details only where means leave
// something.
struct alignas(64) IndexLeaf {
  kernels::MeanPoints means;
  std::uint32_t entry[kernels::kWide];  // first position of each box
};

template <class Sample>
struct IndexedSource {
  Array3D<Sample> samples;
  Vec3i positions{};
  std::uint32_t offset = 0;        // of its first sample among the samples of all sources
  Array3D<kernels::Brick> bricks;  // with boxes of side 2: the features of all cells
};

template <class Sample>
struct BlockIndexData {
  using Sum = SquaredSum<Sample>;

  Vec3i block;
  int side = 1;  // of boxes of positions
  std::vector<IndexedSource<Sample>> sources;
  std::optional<CellLayout> layout;
  std::optional<CellFeatures> features;
  Vec3d slopes;         // largest differences of neighbours along each axis
  int brickShift = 0;   // of IndexedSource::bricks
  bool aligned = true;  // all cells of a box of positions lie in one brick each
  Bits live;            // positions that are in the tree
  Bits allowedBits;     // positions that may be found, where not all
  bool allAllowed = true;
  std::int64_t positionCount = 0;
  std::size_t entryCount = 0;
  std::vector<IndexLeaf> leaves;
  std::vector<kernels::DetailPoints> details;  // of each leaf
  std::vector<std::vector<IndexNode>>
      levels;  // levels[0]: parents of leaves; the last has one node

  int sourceOf(std::uint32_t position) const {
    int s = static_cast<int>(sources.size()) - 1;
    while (sources[s].offset > position) --s;
    return s;
  }
  /// The bits of the children that node or leaf `n` has, of `count` in all: only the last may have
  /// fewer.
  static std::uint32_t there(std::size_t n, std::size_t count) {
    const std::size_t left = count - n * kernels::kWide;
    return left >= kernels::kWide ? 0xffff : (std::uint32_t{1} << left) - 1;
  }
  std::size_t childrenAt(int level) const {
    return level == 0 ? leaves.size() : levels[level - 1].size();
  }
  const Sample* samplesAt(std::uint32_t position) const {
    const IndexedSource<Sample>& source = sources[sourceOf(position)];
    return source.samples.data() + (position - source.offset);
  }
  bool allowed(std::uint32_t position) const { return allAllowed || allowedBits[position]; }

  void build(const BlockIndexOptions& options);
  void findPositions(const BlockIndexOptions& options);
  void measureSlopes();
  void dropRepeats(IndexedSource<Sample>& source);
  using CellArrays = std::vector<std::array<Array3D<CellFeatures::Numbers>, 8>>;
  CellArrays cellNumbers() const;
  void packBricks(IndexedSource<Sample>& source, const Array3D<CellFeatures::Numbers>& numbers);
  /// The features' ranges over the live positions of a box, by cell and feature.
  void ranges(const CellArrays& cells, std::uint32_t entry, std::int16_t* low,
              std::int16_t* high) const;
  int cellArray(int cell) const;
};

}  // namespace exemplar
