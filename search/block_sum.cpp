// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "search/block_sum.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <numeric>

#include "core/simd.h"
#include "search/kernels.h"

namespace exemplar {

namespace {

static_assert(BlockSum<std::uint8_t>::kLanes == kernels::kSumLanes);

using FloatChunks = BlockSum<float>::Chunks;
constexpr int kFloatLanes = BlockSum<float>::kLanes;

// GCC and Clang compile these types to the widest registers that a version of a function may use;
// sums over lanes stay in order whatever those are.
using Floats __attribute__((vector_size(sizeof(float) * kFloatLanes))) = float;
using Doubles __attribute__((vector_size(sizeof(double) * kFloatLanes))) = double;

template <int piece>
inline __attribute__((always_inline)) std::size_t scanPieces(const FloatChunks& chunks,
                                                             const float* block, std::size_t count,
                                                             double limit, double& found) {
  // Chunks between two looks at the limit: a look costs about as much as a chunk.
  constexpr std::size_t kLook = 4;
  constexpr int pieces = kFloatLanes / piece;
  for (std::size_t b = 0; b < count; ++b) {
    Doubles sum{};
    double total = 0;
    for (std::size_t c = 0; c < chunks.count && total <= limit;) {
      const std::size_t end = std::min(chunks.count, c + kLook);
      for (; c < end; ++c) {
        alignas(32) float samples[kFloatLanes];
        for (int p = 0; p < pieces; ++p)
          std::memcpy(samples + p * piece, block + b + chunks.source[c * pieces + p],
                      piece * sizeof(float));
        Floats a, value, mask;
        std::memcpy(&a, samples, sizeof a);
        std::memcpy(&value, chunks.value.data() + c * kFloatLanes, sizeof value);
        std::memcpy(&mask, chunks.mask.data() + c * kFloatLanes, sizeof mask);
        const Doubles difference = __builtin_convertvector(a * mask - value, Doubles);
        sum += difference * difference;
      }
      // The sum of all lanes from first to last grows with each of them, in floating point too.
      total = 0;
      for (int l = 0; l < kFloatLanes; ++l) total += sum[l];
    }
    if (total <= limit) {
      found = total;
      return b;
    }
  }
  return count;
}

EXEMPLAR_MULTIVERSION std::size_t scanFloats(const FloatChunks& chunks, const float* block,
                                             std::size_t count, double limit, double& found) {
  switch (chunks.piece) {
    case 8:
      return scanPieces<8>(chunks, block, count, limit, found);
    case 4:
      return scanPieces<4>(chunks, block, count, limit, found);
    case 2:
      return scanPieces<2>(chunks, block, count, limit, found);
    default:
      return scanPieces<1>(chunks, block, count, limit, found);
  }
}

std::size_t scan(const FloatChunks& chunks, const float* block, std::size_t count, double limit,
                 double& found) {
  return scanFloats(chunks, block, count, limit, found);
}

std::size_t scan(const BlockSum<std::uint8_t>::Chunks& chunks, const std::uint8_t* block,
                 std::size_t count, std::int64_t limit, std::int64_t& found) {
  return kernels::kernels().scan({chunks.source.data(), chunks.value.data(), chunks.mask.data(),
                                  chunks.count, chunks.whole, chunks.piece},
                                 block, count, limit, found);
}

}  // namespace

template <class Sample>
BlockSum<Sample>::BlockSum(const BlockQuery<Sample>& query, const Vec3i& sourceSize) {
  const Vec3i size = query.samples.size();
  blockPositions(sourceSize, size);
  known_ = knownSamples(query);
  const int piece =
      std::min(kLanes, static_cast<int>(std::bit_floor(static_cast<unsigned>(size.x))));
  const bool all = query.known.empty();

  struct Piece {
    std::uint32_t source, query;
    int repeated;  // first samples that the piece before holds already
  };
  const std::size_t perRow = static_cast<std::size_t>((size.x + piece - 1) / piece);
  std::vector<Piece> whole, partial;
  whole.reserve(static_cast<std::size_t>(size.y) * size.z * perRow);
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j) {
      const auto sourceRow = static_cast<std::uint32_t>(
          (static_cast<std::size_t>(k) * sourceSize.y + j) * sourceSize.x);
      const auto queryRow = static_cast<std::uint32_t>(query.samples.index(0, j, k));
      for (int i = 0; i < size.x; i += piece) {
        // The last piece of a row is moved back to end with the row.
        const int first = std::min(i, size.x - piece);
        const Piece p{sourceRow + static_cast<std::uint32_t>(first),
                      queryRow + static_cast<std::uint32_t>(first), i - first};
        int known = piece - p.repeated;
        if (!all) {
          known = 0;
          const std::uint8_t* mask = query.known.data() + p.query;
          for (int l = p.repeated; l < piece; ++l) known += mask[l] != 0;
        }
        if (known == piece)
          whole.push_back(p);
        else if (known > 0)
          partial.push_back(p);
      }
    }

  const std::size_t width = static_cast<std::size_t>(piece);
  const std::size_t perChunk = static_cast<std::size_t>(kLanes) / width;
  const std::size_t pieces = whole.size() + partial.size();
  chunks_.piece = piece;
  chunks_.count = (pieces + perChunk - 1) / perChunk;
  chunks_.whole = whole.size() / perChunk;
  chunks_.source.assign(chunks_.count * perChunk, 0);
  chunks_.value.assign(chunks_.count * kLanes, Value{0});
  chunks_.mask.assign(chunks_.count * kLanes, Value{0});
  constexpr Value kKnown = kLevels ? Value{-1} : Value{1};
  // Steps of about the golden ratio visit the block evenly from the start on.
  const auto evenly = [](const std::vector<Piece>& list, const auto& visit) {
    const std::size_t n = list.size();
    std::size_t step = static_cast<std::size_t>(0.618 * static_cast<double>(n)) | 1;
    while (n > 1 && std::gcd(step, n) != 1) ++step;
    for (std::size_t i = 0, at = 0; i < n; ++i) {
      visit(list[at]);
      at += step;
      if (at >= n) at -= n;
    }
  };
  std::size_t slot = 0;
  evenly(whole, [&](const Piece& p) {
    chunks_.source[slot] = p.source;
    Value* value = chunks_.value.data() + slot * width;
    Value* mask = chunks_.mask.data() + slot * width;
    const Sample* samples = query.samples.data() + p.query;
    for (std::size_t l = 0; l < width; ++l) value[l] = static_cast<Value>(samples[l]);
    // Levels look at no mask in whole chunks.
    if (!kLevels || slot / perChunk >= chunks_.whole) std::fill_n(mask, width, kKnown);
    ++slot;
  });
  evenly(partial, [&](const Piece& p) {
    chunks_.source[slot] = p.source;
    Value* value = chunks_.value.data() + slot * width;
    Value* mask = chunks_.mask.data() + slot * width;
    const Sample* samples = query.samples.data() + p.query;
    const std::uint8_t* known = all ? nullptr : query.known.data() + p.query;
    for (std::size_t l = static_cast<std::size_t>(p.repeated); l < width; ++l) {
      const bool there = !known || known[l] != 0;
      value[l] = there ? static_cast<Value>(samples[l]) : Value{0};
      mask[l] = there ? kKnown : Value{0};
    }
    ++slot;
  });
}

template <class Sample>
SquaredSum<Sample> BlockSum<Sample>::sum(const Sample* block, Sum limit) const {
  Sum found;
  return scan(chunks_, block, 1, limit, found) == 0 ? found : limit + 1;
}

template <class Sample>
std::size_t BlockSum<Sample>::firstWithin(const Sample* block, std::size_t count, Sum limit,
                                          Sum& found) const {
  return scan(chunks_, block, count, limit, found);
}

template class BlockSum<std::uint8_t>;
template class BlockSum<float>;

}  // namespace exemplar
