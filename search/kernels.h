// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

/// The innermost loops of matching, in whole numbers. Written once over 16-bit lanes with Highway,
/// compiled for each of the instruction sets that it knows (on x86-64 the baseline, SSSE3, AVX2 and
/// AVX-512), and chosen when the program starts. Integers give the same results in every version.
namespace exemplar::kernels {

constexpr int kWide = 16;      ///< children of a node, entries of a leaf
constexpr int kFeatures = 4;   ///< of a cell: its mean, and three details
constexpr int kMeans = 8;      ///< of a block: one of each cell
constexpr int kDetails = 24;   ///< of a block: three of each cell
constexpr int kSumLanes = 32;  ///< samples that are summed at once

/// The index of a cell's detail 0, 1 or 2 among a block's. Multiply-and-add takes neighbors in
/// pairs: each cell's first two are one, then come the third ones.
constexpr int detail(int cell, int number) { return number < 2 ? 2 * cell + number : 16 + cell; }

/// Gaps beyond this count as this, so that the squares of all 32 stay below 2^31.
constexpr std::int16_t kLargestGap = 8190;
/// No sum of squared gaps is larger.
constexpr std::uint32_t kLargestBound = 0x7fffffff;

/// What is known of a query in each dimension: a range, 0..32767, and how much a gap to it weighs.
struct QueryFeatures {
  alignas(64) std::int16_t meanLow[kMeans];
  std::int16_t meanHigh[kMeans];
  std::uint16_t meanWeight[kMeans];  ///< of a gap, in 65536ths; where `weighted`
  alignas(64) std::int16_t detailLow[kDetails];
  std::int16_t detailHigh[kDetails];
  std::uint8_t detailPair[kDetails / 2];  ///< the pairs that are known
  int detailPairs;                        ///< how many
  bool weighted;
};

/// Sixteen boxes in the space of means: from `base + (low << shift)` to `base + (high << shift)`.
/// Dimension d is in pair d / 2, lane d % 2.
struct MeanBoxes {
  alignas(64) std::uint8_t low[kMeans / 2][kWide][2];
  std::uint8_t high[kMeans / 2][kWide][2];
  std::int16_t base[kMeans];
  std::uint8_t shift;
};

/// Sixteen boxes of one size: center `base + (value << shift)`, plus or minus `width`.
template <int dimensions>
struct Points {
  alignas(64) std::uint8_t value[dimensions / 2][kWide][2];
  std::int16_t base[dimensions];
  std::int16_t width[dimensions];
  std::uint8_t shift;
};
using MeanPoints = Points<kMeans>;
using DetailPoints = Points<kDetails>;

/// Features of the cells at the eight positions of a box of side 2, x first:
/// `(center << kCenterShift) + ((difference - 128) << shift)`, plus or minus half a step and the
/// features' own margin.
struct Brick {
  std::uint8_t center[kFeatures];
  std::uint8_t difference[8][kFeatures];
};
constexpr int kCenterShift = 7;

/// The same with fewer bits, and never in two cache lines: `base + value * step`, plus or minus
/// half a step and the features' own margin (`width`).
struct alignas(32) ByteBrick {
  std::uint8_t value[8][kFeatures];
};
struct ByteScale {
  std::int16_t base[kFeatures];
  std::int16_t step[kFeatures];  ///< 1..128
  std::int16_t width[kFeatures];
};

/// The same, spelled out.
struct BrickNumbers {
  alignas(64) std::int16_t number[8][kFeatures];
};

/// A vector of known samples, gathered from pieces of rows (see `BlockSum`).
struct SumChunks {
  const std::uint32_t* source;  ///< offsets of pieces, kSumLanes / piece of them a chunk
  const std::int16_t* value;    ///< kSumLanes a chunk; 0 where unknown
  const std::int16_t* mask;     ///< kSumLanes a chunk; all bits where known
  std::size_t count;            ///< chunks
  std::size_t whole;            ///< how many, from the first on, have no unknown sample
  int piece;                    ///< 1, 2, 4, 8, 16 or 32 samples
};

struct Kernels {
  const char* name;
  /// Sums of squared gaps, weighted, between the query's ranges and sixteen boxes. Bit c of the
  /// result is set where sum c is at most `bound`, which is at most kLargestBound.
  std::uint32_t (*boxGaps)(const MeanBoxes&, const QueryFeatures&, std::uint32_t bound,
                           std::uint32_t* sums);
  std::uint32_t (*meanGaps)(const MeanPoints&, const QueryFeatures&, std::uint32_t bound,
                            std::uint32_t* sums);
  /// Adds to the sums of `meanGaps`.
  std::uint32_t (*detailGaps)(const DetailPoints&, const QueryFeatures&, std::uint32_t bound,
                              std::uint32_t* sums);
  /// The same for the blocks at the eight positions of a box. For the i-th of `count` cells, which
  /// is number `cells[i]` of a block, `bricks[i]` holds the features, each off by at most `width`.
  void (*brickGaps)(const Brick* const* bricks, int shift, std::int16_t width, const QueryFeatures&,
                    const std::uint8_t* cells, int count, std::uint32_t* sums);
  void (*byteGaps)(const ByteBrick* const* bricks, const ByteScale&, const QueryFeatures&,
                   const std::uint8_t* cells, int count, std::uint32_t* sums);
  void (*numberGaps)(const BrickNumbers* bricks, std::int16_t width, const QueryFeatures&,
                     const std::uint8_t* cells, int count, std::uint32_t* sums);
  /// As `BlockSum::firstWithin`, for levels.
  std::size_t (*scan)(const SumChunks&, const std::uint8_t* block, std::size_t count,
                      std::int64_t limit, std::int64_t& found);
};

/// The fastest that this machine runs.
const Kernels& kernels();
/// All that this machine runs, the fastest last.
std::span<const Kernels* const> availableKernels();

}  // namespace exemplar::kernels
