// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "search/block_sum.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <numeric>

#include "core/simd.h"

namespace exemplar {

namespace {

// GCC and Clang compile these types to the widest registers that a version of a function may use;
// sums over lanes stay in order whatever those are.
template <class T, int lanes>
using Vector __attribute__((vector_size(sizeof(T) * lanes))) = T;

// Chunks between two looks at the limit: a look costs about as much as one chunk.
constexpr std::size_t kChunksPerLook = 4;

template <int piece, class Sample, int lanes>
inline __attribute__((always_inline)) void load(const Sample* block, const std::uint32_t* source,
                                                Sample (&to)[lanes]) {
  for (int p = 0; p < lanes / piece; ++p)
    std::memcpy(to + p * piece, block + source[p], piece * sizeof(Sample));
}

template <int piece, class Sample>
inline __attribute__((always_inline)) std::size_t scanChunks(
    const typename BlockSum<Sample>::Data& data, const Sample* block, std::size_t count,
    SquaredSum<Sample> limit, SquaredSum<Sample>& found) {
  using Sums = BlockSum<Sample>;
  constexpr int lanes = Sums::kLanes;
  using Values = Vector<typename Sums::Value, lanes>;
  using Lane = std::conditional_t<Sums::kLevels, std::uint32_t, double>;

  const auto* chunks = data.chunks.data();
  const std::size_t chunkCount = data.chunks.size();
  for (std::size_t b = 0; b < count; ++b) {
    Vector<Lane, lanes> running{};
    SquaredSum<Sample> sum = 0;
    for (std::size_t c = 0; c < chunkCount && sum <= limit;) {
      const std::size_t end = std::min(chunkCount, c + kChunksPerLook);
      for (; c < end; ++c) {
        alignas(32) Sample samples[lanes];
        load<piece>(block + b, chunks[c].source, samples);
        Vector<Sample, lanes> loaded;
        Values values, mask;
        std::memcpy(&loaded, samples, sizeof loaded);
        std::memcpy(&values, chunks[c].value, sizeof values);
        std::memcpy(&mask, chunks[c].mask, sizeof mask);
        if constexpr (Sums::kLevels) {
          const Values difference = (__builtin_convertvector(loaded, Values) - values) & mask;
          // At most 255², so sixteen bits without sign hold it.
          const Values square = difference * difference;
          using Squares = Vector<std::uint16_t, lanes>;
          running += __builtin_convertvector((Squares)square, Vector<Lane, lanes>);
        } else {
          const auto difference =
              __builtin_convertvector(loaded * mask - values, Vector<Lane, lanes>);
          running += difference * difference;
        }
      }
      if constexpr (Sums::kLevels) {
        for (int l = 0; l < lanes; ++l) sum += running[l];
        running = Vector<Lane, lanes>{};
      } else {
        // The sum of all lanes from first to last grows with each of them, in floating point too.
        sum = 0;
        for (int l = 0; l < lanes; ++l) sum += running[l];
      }
    }
    if (sum <= limit) {
      found = sum;
      return b;
    }
  }
  return count;
}

EXEMPLAR_MULTIVERSION std::size_t scan(const BlockSum<std::uint8_t>::Data& data,
                                       const std::uint8_t* block, std::size_t count,
                                       std::int64_t limit, std::int64_t& found) {
  switch (data.piece) {
    case 16:
      return scanChunks<16>(data, block, count, limit, found);
    case 8:
      return scanChunks<8>(data, block, count, limit, found);
    case 4:
      return scanChunks<4>(data, block, count, limit, found);
    default:
      return scanChunks<1>(data, block, count, limit, found);
  }
}

EXEMPLAR_MULTIVERSION std::size_t scan(const BlockSum<float>::Data& data, const float* block,
                                       std::size_t count, double limit, double& found) {
  switch (data.piece) {
    case 8:
      return scanChunks<8>(data, block, count, limit, found);
    case 4:
      return scanChunks<4>(data, block, count, limit, found);
    default:
      return scanChunks<1>(data, block, count, limit, found);
  }
}

}  // namespace

template <class Sample>
BlockSum<Sample>::BlockSum(const BlockQuery<Sample>& query, const Vec3i& sourceSize) {
  const Vec3i size = query.samples.size();
  blockPositions(sourceSize, size);
  known_ = knownSamples(query);
  const int widest = size.x >= kLanes ? kLanes : size.x >= 8 ? 8 : size.x >= 4 ? 4 : 1;
  data_.piece = widest;

  struct Piece {
    int i, j, k, from;  // samples before `from` belong to the piece before
  };
  std::vector<Piece> pieces;
  const auto known = [&](int i, int j, int k) {
    return query.known.empty() || query.known(i, j, k) != 0;
  };
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x;) {
        if (!known(i, j, k)) {
          ++i;
          continue;
        }
        // The last piece of a row is moved back to end with the row.
        const int first = std::min(i, size.x - widest);
        pieces.push_back({first, j, k, i});
        i = first + widest;
      }

  // Steps of about the golden ratio visit the block evenly from the start on.
  const std::size_t n = pieces.size();
  std::size_t step = static_cast<std::size_t>(0.618 * static_cast<double>(n)) | 1;
  while (n > 1 && std::gcd(step, n) != 1) ++step;
  const std::size_t perChunk = static_cast<std::size_t>(kLanes / widest);
  data_.chunks.resize((n + perChunk - 1) / perChunk, Chunk{});
  for (std::size_t p = 0, at = 0; p < n; ++p, at = (at + step) % n) {
    const Piece& piece = pieces[at];
    Chunk& chunk = data_.chunks[p / perChunk];
    const std::size_t slot = p % perChunk;
    chunk.source[slot] = static_cast<std::uint32_t>(
        (static_cast<std::size_t>(piece.k) * sourceSize.y + piece.j) * sourceSize.x + piece.i);
    for (int l = 0; l < widest; ++l) {
      const int i = piece.i + l;
      if (i < piece.from || !known(i, piece.j, piece.k)) continue;
      const std::size_t lane =
          slot * static_cast<std::size_t>(widest) + static_cast<std::size_t>(l);
      chunk.value[lane] = static_cast<Value>(query.samples(i, piece.j, piece.k));
      chunk.mask[lane] = kLevels ? static_cast<Value>(-1) : static_cast<Value>(1);
    }
  }
}

template <class Sample>
SquaredSum<Sample> BlockSum<Sample>::sum(const Sample* block, Sum limit) const {
  Sum found;
  return scan(data_, block, 1, limit, found) == 0 ? found : limit + 1;
}

template <class Sample>
std::size_t BlockSum<Sample>::firstWithin(const Sample* block, std::size_t count, Sum limit,
                                          Sum& found) const {
  return scan(data_, block, count, limit, found);
}

template class BlockSum<std::uint8_t>;
template class BlockSum<float>;

}  // namespace exemplar
