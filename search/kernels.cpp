// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "search/kernels.h"

// Compiled once for each instruction set that Highway knows and the compiler can target. The
// kernels gain nothing from SSE4 over SSSE3, and hold vectors in arrays, which scalable ones cannot
// be in.
#if !defined(HWY_DISABLED_TARGETS)
#define HWY_DISABLED_TARGETS (HWY_SSE4 | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#endif
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "search/kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <vector>

#include "search/baseline_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace exemplar::kernels {
namespace HWY_NAMESPACE {
namespace {

// Lanes of 16 bits, 32 at most, and lanes of 32 bits for the sums of their squares. What GCC makes
// of Highway for any machine is one lane at a time, which takes ten times as long as ours.
#if HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128
namespace hn = hwy::HWY_NAMESPACE;
using Tag16 = hn::CappedTag<std::int16_t, 32>;
using Tag32 = hn::Repartition<std::int32_t, Tag16>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(Tag16()));
using V = hn::VFromD<Tag16>;
using V32 = hn::VFromD<Tag32>;

inline V load(const std::int16_t* p) { return hn::LoadU(Tag16(), p); }
inline V widen(const std::uint8_t* p) {
  return hn::PromoteTo(Tag16(), hn::LoadU(hn::Rebind<std::uint8_t, Tag16>(), p));
}
inline V pair(const void* p) {
  std::uint32_t v;
  __builtin_memcpy(&v, p, 4);
  return hn::BitCast(Tag16(), hn::Set(hn::Repartition<std::uint32_t, Tag16>(), v));
}
inline V quad(const void* p) {
  std::uint64_t v;
  __builtin_memcpy(&v, p, 8);
  return hn::BitCast(Tag16(), hn::Set(hn::Repartition<std::uint64_t, Tag16>(), v));
}
inline V same(std::int16_t v) { return hn::Set(Tag16(), v); }
inline V subtract(V a, V b) { return hn::SaturatedSub(a, b); }
inline V add(V a, V b) { return hn::SaturatedAdd(a, b); }
inline V both(V a, V b) { return hn::And(a, b); }
inline V larger(V a, V b) { return hn::Max(a, b); }
inline V smaller(V a, V b) { return hn::Min(a, b); }
inline V times(V a, V b) { return hn::Mul(a, b); }
inline V shifted(V a, int bits) { return hn::ShiftLeftSame(a, bits); }
inline V scaled(V a, V w) {
  const hn::Repartition<std::uint16_t, Tag16> tag;
  return hn::BitCast(Tag16(), hn::MulHigh(hn::BitCast(tag, a), hn::BitCast(tag, w)));
}

/// Sums of the squares of pairs of lanes. Which of the two vectors holds what depends on the
/// machine.
struct Sums {
  V32 first, second;

  // Spelled out: GCC would compile one of its own for the baseline.
  Sums() : first(hn::Zero(Tag32())), second(hn::Zero(Tag32())) {}
  void addSquares(V a) { first = hn::ReorderWidenMulAccumulate(Tag32(), a, a, first, second); }
  V32 inOrder() const { return hn::RearrangeToOddPlusEven(first, second); }
};
inline V32 add32(V32 a, V32 b) { return hn::Add(a, b); }
inline V32 load32(const std::int32_t* p) { return hn::LoadU(Tag32(), p); }
inline void store32(V32 a, std::int32_t* p) { hn::StoreU(a, Tag32(), p); }

/// Bits of the lanes that are at most `bound`; both are below 2^31.
inline std::uint32_t atMost(V32 a, std::uint32_t bound) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(Tag32(), hn::Gt(a, hn::Set(Tag32(), static_cast<std::int32_t>(bound))), bits);
  std::uint32_t more;
  __builtin_memcpy(&more, bits, 4);
  return ~more & ((1u << kLanes / 2) - 1);
}

/// Pieces of rows one after the other, straight into a register: through memory they would wait for
/// their stores.
template <int piece, class Tag>
inline hn::VFromD<Tag> joined(Tag tag, const std::uint8_t* block, const std::uint32_t* source) {
  constexpr int lanes = static_cast<int>(hn::MaxLanes(Tag()));
  if constexpr (lanes <= piece) {
    return hn::LoadU(tag, block + source[0]);
  } else {
    const hn::Half<Tag> half;
    return hn::Combine(tag, joined<piece>(half, block, source + lanes / 2 / piece),
                       joined<piece>(half, block, source));
  }
}
template <int piece>
inline V widenPieces(const std::uint8_t* block, const std::uint32_t* source) {
  return hn::PromoteTo(Tag16(), joined<piece>(hn::Rebind<std::uint8_t, Tag16>(), block, source));
}
/// Smaller pieces are gathered in memory.
constexpr int kLeastJoined = 4;
#else
using namespace baseline_lanes;
#endif

// One lane, by itself.
inline std::int16_t saturatedDifference(int a, int b) {
  const int d = a - b;
  return static_cast<std::int16_t>(d > 32767 ? 32767 : d < -32768 ? -32768 : d);
}

// Vectors that hold two dimensions of sixteen children.
constexpr int kVectors = 2 * kWide / kLanes;

inline V gap(V low, V high, V queryLow, V queryHigh) {
  const V g = larger(subtract(low, queryHigh), subtract(queryLow, high));
  return smaller(larger(g, same(0)), same(kLargestGap));
}

/// With `adding`, the sums are added to those that `sums` holds.
template <bool adding>
inline std::uint32_t finish(const Sums* sum, std::uint32_t bound, std::uint32_t* sums) {
  std::uint32_t within = 0;
  for (int v = 0; v < kVectors; ++v) {
    auto* at = reinterpret_cast<std::int32_t*>(sums) + v * kLanes / 2;
    const V32 all = adding ? add32(sum[v].inOrder(), load32(at)) : sum[v].inOrder();
    store32(all, at);
    within |= atMost(all, bound) << (v * kLanes / 2);
  }
  return within;
}

template <bool weighted>
inline std::uint32_t boxGapsOf(const MeanBoxes& boxes, const QueryFeatures& q, std::uint32_t bound,
                               std::uint32_t* sums) {
  // The query as seen from the node: 16-bit lanes hold every difference that matters.
  alignas(16) std::int16_t low[kMeans], high[kMeans];
  for (int d = 0; d < kMeans; ++d) {
    low[d] = saturatedDifference(q.meanLow[d], boxes.base[d]);
    high[d] = saturatedDifference(q.meanHigh[d], boxes.base[d]);
  }
  Sums sum[kVectors];
  for (int p = 0; p < kMeans / 2; ++p) {
    const V queryLow = pair(low + 2 * p), queryHigh = pair(high + 2 * p);
    for (int v = 0; v < kVectors; ++v) {
      V g =
          gap(shifted(widen(&boxes.low[p][0][0] + v * kLanes), boxes.shift),
              shifted(widen(&boxes.high[p][0][0] + v * kLanes), boxes.shift), queryLow, queryHigh);
      if (weighted) g = scaled(g, pair(q.meanWeight + 2 * p));
      sum[v].addSquares(g);
    }
  }
  return finish<false>(sum, bound, sums);
}

std::uint32_t boxGaps(const MeanBoxes& boxes, const QueryFeatures& q, std::uint32_t bound,
                      std::uint32_t* sums) {
  return q.weighted ? boxGapsOf<true>(boxes, q, bound, sums)
                    : boxGapsOf<false>(boxes, q, bound, sums);
}

template <bool weighted>
inline std::uint32_t meanGapsOf(const MeanPoints& points, const QueryFeatures& q,
                                std::uint32_t bound, std::uint32_t* sums) {
  alignas(16) std::int16_t low[kMeans], high[kMeans];
  for (int d = 0; d < kMeans; ++d) {
    low[d] = saturatedDifference(q.meanLow[d], points.base[d] + points.width[d]);
    high[d] = saturatedDifference(q.meanHigh[d], points.base[d] - points.width[d]);
  }
  Sums sum[kVectors];
  for (int p = 0; p < kMeans / 2; ++p) {
    const V queryLow = pair(low + 2 * p), queryHigh = pair(high + 2 * p);
    for (int v = 0; v < kVectors; ++v) {
      const V value = shifted(widen(&points.value[p][0][0] + v * kLanes), points.shift);
      V g = gap(value, value, queryLow, queryHigh);
      if (weighted) g = scaled(g, pair(q.meanWeight + 2 * p));
      sum[v].addSquares(g);
    }
  }
  return finish<false>(sum, bound, sums);
}

std::uint32_t meanGaps(const MeanPoints& points, const QueryFeatures& q, std::uint32_t bound,
                       std::uint32_t* sums) {
  return q.weighted ? meanGapsOf<true>(points, q, bound, sums)
                    : meanGapsOf<false>(points, q, bound, sums);
}

std::uint32_t detailGaps(const DetailPoints& points, const QueryFeatures& q, std::uint32_t bound,
                         std::uint32_t* sums) {
  alignas(64) std::int16_t low[kDetails], high[kDetails];
  for (int d = 0; d < kDetails; ++d) {
    low[d] = saturatedDifference(q.detailLow[d], points.base[d] + points.width[d]);
    high[d] = saturatedDifference(q.detailHigh[d], points.base[d] - points.width[d]);
  }
  Sums sum[kVectors];
  for (int i = 0; i < q.detailPairs; ++i) {
    const int p = q.detailPair[i];
    const V queryLow = pair(low + 2 * p), queryHigh = pair(high + 2 * p);
    for (int v = 0; v < kVectors; ++v) {
      const V value = shifted(widen(&points.value[p][0][0] + v * kLanes), points.shift);
      sum[v].addSquares(gap(value, value, queryLow, queryHigh));
    }
  }
  return finish<true>(sum, bound, sums);
}

// Adds the gaps of one cell, whose numbers are `value(v)` in vector v, to the sums.
template <class Value>
inline void addCell(const QueryFeatures& q, int c, V width, Sums* sum, const Value& value) {
  const std::int16_t lows[4] = {q.meanLow[c], q.detailLow[detail(c, 0)], q.detailLow[detail(c, 1)],
                                q.detailLow[detail(c, 2)]};
  const std::int16_t highs[4] = {q.meanHigh[c], q.detailHigh[detail(c, 0)],
                                 q.detailHigh[detail(c, 1)], q.detailHigh[detail(c, 2)]};
  const std::uint16_t weights[4] = {q.meanWeight[c], 65535, 65535, 65535};
  const V queryLow = subtract(quad(lows), width), queryHigh = add(quad(highs), width);
  for (int v = 0; v < kVectors; ++v) {
    const V number = value(v);
    V g = gap(number, number, queryLow, queryHigh);
    if (q.weighted) g = scaled(g, quad(weights));
    sum[v].addSquares(g);
  }
}

inline void finishBricks(const Sums* sum, std::uint32_t* sums) {
  std::int32_t halves[kWide];
  for (int v = 0; v < kVectors; ++v) store32(sum[v].inOrder(), halves + v * kLanes / 2);
  for (int p = 0; p < 8; ++p)
    sums[p] = static_cast<std::uint32_t>(halves[2 * p] + halves[2 * p + 1]);
}

void brickGaps(const Brick* const* bricks, int shift, std::int16_t width, const QueryFeatures& q,
               const std::uint8_t* cells, int count, std::uint32_t* sums) {
  Sums sum[kVectors];
  const V middle = same(128);
  for (int i = 0; i < count; ++i) {
    std::int16_t centers[kFeatures];
    for (int f = 0; f < kFeatures; ++f)
      centers[f] = static_cast<std::int16_t>(bricks[i]->center[f] << kCenterShift);
    const V center = quad(centers);
    addCell(q, cells[i], same(width), sum, [&](int v) {
      return add(center, shifted(subtract(widen(&bricks[i]->difference[0][0] + v * kLanes), middle),
                                 shift));
    });
  }
  finishBricks(sum, sums);
}

void byteGaps(const ByteBrick* const* bricks, const ByteScale& scale, const QueryFeatures& q,
              const std::uint8_t* cells, int count, std::uint32_t* sums) {
  Sums sum[kVectors];
  const V base = quad(scale.base), step = quad(scale.step), width = quad(scale.width);
  for (int i = 0; i < count; ++i)
    addCell(q, cells[i], width, sum, [&](int v) {
      return add(base, times(widen(&bricks[i]->value[0][0] + v * kLanes), step));
    });
  finishBricks(sum, sums);
}

void numberGaps(const BrickNumbers* bricks, std::int16_t width, const QueryFeatures& q,
                const std::uint8_t* cells, int count, std::uint32_t* sums) {
  Sums sum[kVectors];
  for (int i = 0; i < count; ++i)
    addCell(q, cells[i], same(width), sum,
            [&](int v) { return load(&bricks[i].number[0][0] + v * kLanes); });
  finishBricks(sum, sums);
}

template <int piece>
inline void gather(const std::uint8_t* block, const std::uint32_t* source, std::uint8_t* to) {
  for (int p = 0; p < kSumLanes / piece; ++p)
    __builtin_memcpy(to + p * piece, block + source[p], piece);
}

template <int piece>
inline std::size_t scanPieces(const SumChunks& chunks, const std::uint8_t* block, std::size_t count,
                              std::int64_t limit, std::int64_t& found) {
  // Chunks between two looks at the limit: a look costs about as much as a chunk.
  constexpr std::size_t kLook = 4;
  constexpr int kPieces = kSumLanes / piece;
  for (std::size_t b = 0; b < count; ++b) {
    std::int64_t total = 0;
    for (std::size_t c = 0; c < chunks.count && total <= limit;) {
      const std::size_t end = c + kLook < chunks.count ? c + kLook : chunks.count;
      Sums sum[2];
      for (; c < end; ++c) {
        const std::uint32_t* source = chunks.source + c * kPieces;
        alignas(64) std::uint8_t samples[kSumLanes];
        if constexpr (piece < kLeastJoined) gather<piece>(block + b, source, samples);
        for (int v = 0; v < kSumLanes / kLanes; ++v) {
          const int first = v * kLanes;  // sample
          V a;
          if constexpr (piece < kLeastJoined) {
            a = widen(samples + first);
          } else {
            a = widenPieces<piece>(block + b + first % piece, source + first / piece);
          }
          const std::size_t at = c * kSumLanes + static_cast<std::size_t>(first);
          if (c >= chunks.whole) a = both(a, load(chunks.mask + at));
          sum[v % 2].addSquares(subtract(a, load(chunks.value + at)));
        }
      }
      alignas(64) std::int32_t lanes[kLanes / 2];
      store32(add32(sum[0].inOrder(), sum[1].inOrder()), lanes);
      // At most kLook · 4 · 2 · 255² a lane.
      std::uint32_t all = 0;
      for (int l = 0; l < kLanes / 2; ++l) all += static_cast<std::uint32_t>(lanes[l]);
      total += all;
    }
    if (total <= limit) {
      found = total;
      return b;
    }
  }
  return count;
}

std::size_t scan(const SumChunks& chunks, const std::uint8_t* block, std::size_t count,
                 std::int64_t limit, std::int64_t& found) {
  switch (chunks.piece) {
    case 32:
      return scanPieces<32>(chunks, block, count, limit, found);
    case 16:
      return scanPieces<16>(chunks, block, count, limit, found);
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

}  // namespace

const Kernels& compiled() {
  static const Kernels kernels{hwy::TargetName(HWY_TARGET),
                               boxGaps,
                               meanGaps,
                               detailGaps,
                               brickGaps,
                               byteGaps,
                               numberGaps,
                               scan};
  return kernels;
}

}  // namespace HWY_NAMESPACE
}  // namespace exemplar::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace exemplar::kernels {
namespace {

HWY_EXPORT(compiled);

/// Those that this machine runs, the slowest first.
std::vector<const Kernels*> runnable() {
  std::vector<const Kernels*> all;
  const auto& table = HWY_DISPATCH_TABLE(compiled);
  constexpr int entries = sizeof table / sizeof *table;
  if constexpr (entries == 1) {
    all.push_back(&table[0]());
  } else {
    // The last entry is for every machine; entry i > 0 is for the target of the i-th bit (from 1)
    // of those that this kind of machine may have.
    all.push_back(&table[entries - 1]());
    constexpr int lowestBit = HWY_HIGHEST_TARGET_BIT + 1 - HWY_MAX_DYNAMIC_TARGETS;
    for (int i = entries - 2; i > 0; --i) {
      if (!table[i] || !(hwy::SupportedTargets() >> (lowestBit + i - 1) & 1)) continue;
      if (table[i] != table[entries - 1]) all.push_back(&table[i]());
    }
  }
  return all;
}

}  // namespace

std::span<const Kernels* const> availableKernels() {
  static const std::vector<const Kernels*> available = runnable();
  return available;
}

const Kernels& kernels() {
  static const Kernels& fastest = *availableKernels().back();
  return fastest;
}

}  // namespace exemplar::kernels
#endif  // HWY_ONCE
