// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Included by one source for each instruction set, with EXEMPLAR_KERNELS naming its namespace.
// Nothing but intrinsics may be included here: inline functions compiled for a newer machine must
// not replace those that the rest of the program shares.

#include "search/kernels.h"

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace exemplar::kernels {
namespace EXEMPLAR_KERNELS {
namespace {

// Lanes of 16 bits: loads, saturating differences, and products added in pairs to lanes of 32 bits.
#if defined(__AVX512BW__)
constexpr int kLanes = 32;
using V = __m512i;
inline V load(const void* p) { return _mm512_loadu_si512(p); }
inline V widen(const std::uint8_t* p) {
  return _mm512_cvtepu8_epi16(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(p)));
}
inline long long eight(const std::uint8_t* p) {
  long long v;
  __builtin_memcpy(&v, p, 8);
  return v;
}
inline int four(const std::uint8_t* p) {
  int v;
  __builtin_memcpy(&v, p, 4);
  return v;
}
// Pieces of rows, widened, straight into a register: through memory they would wait for their
// stores.
#define EXEMPLAR_REGISTER_PIECES 1
template <int piece>
inline V widenPieces(const std::uint8_t* b, const std::uint32_t* s) {
  if (piece == 16)
    return _mm512_cvtepu8_epi16(
        _mm256_set_m128i(_mm_loadu_si128(reinterpret_cast<const __m128i*>(b + s[1])),
                         _mm_loadu_si128(reinterpret_cast<const __m128i*>(b + s[0]))));
  if (piece == 8)
    return _mm512_cvtepu8_epi16(
        _mm256_set_epi64x(eight(b + s[3]), eight(b + s[2]), eight(b + s[1]), eight(b + s[0])));
  return _mm512_cvtepu8_epi16(_mm256_set_epi32(four(b + s[7]), four(b + s[6]), four(b + s[5]),
                                               four(b + s[4]), four(b + s[3]), four(b + s[2]),
                                               four(b + s[1]), four(b + s[0])));
}
inline V pair(const void* p) {
  int v;
  __builtin_memcpy(&v, p, 4);
  return _mm512_set1_epi32(v);
}
inline V quad(const void* p) {
  long long v;
  __builtin_memcpy(&v, p, 8);
  return _mm512_set1_epi64(v);
}
inline V same(std::int16_t v) { return _mm512_set1_epi16(v); }
inline V zero() { return _mm512_setzero_si512(); }
inline V subtract(V a, V b) { return _mm512_subs_epi16(a, b); }
inline V add(V a, V b) { return _mm512_adds_epi16(a, b); }
inline V both(V a, V b) { return _mm512_and_si512(a, b); }
inline V larger(V a, V b) { return _mm512_max_epi16(a, b); }
inline V smaller(V a, V b) { return _mm512_min_epi16(a, b); }
inline V scaled(V a, V w) { return _mm512_mulhi_epu16(a, w); }
inline V shifted(V a, int s) { return _mm512_sll_epi16(a, _mm_cvtsi32_si128(s)); }
inline V times(V a, V b) { return _mm512_mullo_epi16(a, b); }
inline V squares(V a) { return _mm512_madd_epi16(a, a); }
inline V add32(V a, V b) { return _mm512_add_epi32(a, b); }
inline void store(void* p, V a) { _mm512_storeu_si512(p, a); }
// Bits of the 32-bit lanes, below 2^31, that are at most `bound`.
inline std::uint32_t atMost(V a, std::uint32_t bound) {
  return _mm512_cmple_epu32_mask(a, _mm512_set1_epi32(static_cast<int>(bound)));
}
#elif defined(__AVX2__)
constexpr int kLanes = 16;
using V = __m256i;
inline V load(const void* p) { return _mm256_loadu_si256(static_cast<const V*>(p)); }
inline V widen(const std::uint8_t* p) {
  return _mm256_cvtepu8_epi16(_mm_loadu_si128(reinterpret_cast<const __m128i*>(p)));
}
inline long long eight(const std::uint8_t* p) {
  long long v;
  __builtin_memcpy(&v, p, 8);
  return v;
}
inline int four(const std::uint8_t* p) {
  int v;
  __builtin_memcpy(&v, p, 4);
  return v;
}
#define EXEMPLAR_REGISTER_PIECES 1
template <int piece>
inline V widenPieces(const std::uint8_t* b, const std::uint32_t* s) {
  if (piece == 16) return widen(b + s[0]);
  if (piece == 8) return _mm256_cvtepu8_epi16(_mm_set_epi64x(eight(b + s[1]), eight(b + s[0])));
  return _mm256_cvtepu8_epi16(
      _mm_set_epi32(four(b + s[3]), four(b + s[2]), four(b + s[1]), four(b + s[0])));
}
inline V pair(const void* p) {
  int v;
  __builtin_memcpy(&v, p, 4);
  return _mm256_set1_epi32(v);
}
inline V quad(const void* p) {
  long long v;
  __builtin_memcpy(&v, p, 8);
  return _mm256_set1_epi64x(v);
}
inline V same(std::int16_t v) { return _mm256_set1_epi16(v); }
inline V zero() { return _mm256_setzero_si256(); }
inline V subtract(V a, V b) { return _mm256_subs_epi16(a, b); }
inline V add(V a, V b) { return _mm256_adds_epi16(a, b); }
inline V both(V a, V b) { return _mm256_and_si256(a, b); }
inline V larger(V a, V b) { return _mm256_max_epi16(a, b); }
inline V smaller(V a, V b) { return _mm256_min_epi16(a, b); }
inline V scaled(V a, V w) { return _mm256_mulhi_epu16(a, w); }
inline V shifted(V a, int s) { return _mm256_sll_epi16(a, _mm_cvtsi32_si128(s)); }
inline V times(V a, V b) { return _mm256_mullo_epi16(a, b); }
inline V squares(V a) { return _mm256_madd_epi16(a, a); }
inline V add32(V a, V b) { return _mm256_add_epi32(a, b); }
inline void store(void* p, V a) { _mm256_storeu_si256(static_cast<V*>(p), a); }
inline std::uint32_t atMost(V a, std::uint32_t bound) {
  const V more = _mm256_cmpgt_epi32(a, _mm256_set1_epi32(static_cast<int>(bound)));
  return static_cast<std::uint32_t>(~_mm256_movemask_ps(_mm256_castsi256_ps(more))) & 0xff;
}
#elif defined(__SSE2__)
constexpr int kLanes = 8;
using V = __m128i;
inline V load(const void* p) { return _mm_loadu_si128(static_cast<const V*>(p)); }
inline V widen(const std::uint8_t* p) {
  return _mm_unpacklo_epi8(_mm_loadl_epi64(reinterpret_cast<const V*>(p)), _mm_setzero_si128());
}
inline V pair(const void* p) {
  int v;
  __builtin_memcpy(&v, p, 4);
  return _mm_set1_epi32(v);
}
inline V quad(const void* p) {
  long long v;
  __builtin_memcpy(&v, p, 8);
  return _mm_set1_epi64x(v);
}
inline V same(std::int16_t v) { return _mm_set1_epi16(v); }
inline V zero() { return _mm_setzero_si128(); }
inline V subtract(V a, V b) { return _mm_subs_epi16(a, b); }
inline V add(V a, V b) { return _mm_adds_epi16(a, b); }
inline V both(V a, V b) { return _mm_and_si128(a, b); }
inline V larger(V a, V b) { return _mm_max_epi16(a, b); }
inline V smaller(V a, V b) { return _mm_min_epi16(a, b); }
inline V scaled(V a, V w) { return _mm_mulhi_epu16(a, w); }
inline V shifted(V a, int s) { return _mm_sll_epi16(a, _mm_cvtsi32_si128(s)); }
inline V times(V a, V b) { return _mm_mullo_epi16(a, b); }
inline V squares(V a) { return _mm_madd_epi16(a, a); }
inline V add32(V a, V b) { return _mm_add_epi32(a, b); }
inline void store(void* p, V a) { _mm_storeu_si128(static_cast<V*>(p), a); }
inline std::uint32_t atMost(V a, std::uint32_t bound) {
  const V more = _mm_cmpgt_epi32(a, _mm_set1_epi32(static_cast<int>(bound)));
  return static_cast<std::uint32_t>(~_mm_movemask_ps(_mm_castsi128_ps(more))) & 0xf;
}
#else
// Any other machine: eight lanes, spelt out, for its compiler to vectorise.
constexpr int kLanes = 8;
struct V {
  std::int16_t lane[kLanes];
};
template <class Op>
inline V each(const Op& op) {
  V r;
  for (int l = 0; l < kLanes; ++l) r.lane[l] = static_cast<std::int16_t>(op(l));
  return r;
}
inline int saturated(int v) { return v > 32767 ? 32767 : v < -32768 ? -32768 : v; }
inline V load(const void* p) {
  V r;
  __builtin_memcpy(&r, p, sizeof r);
  return r;
}
inline V widen(const std::uint8_t* p) {
  return each([&](int l) { return p[l]; });
}
inline V pair(const void* p) {
  std::int16_t v[2];
  __builtin_memcpy(v, p, 4);
  return each([&](int l) { return v[l % 2]; });
}
inline V quad(const void* p) {
  std::int16_t v[4];
  __builtin_memcpy(v, p, 8);
  return each([&](int l) { return v[l % 4]; });
}
inline V same(std::int16_t v) {
  return each([&](int) { return v; });
}
inline V zero() { return same(0); }
inline V subtract(const V& a, const V& b) {
  return each([&](int l) { return saturated(a.lane[l] - b.lane[l]); });
}
inline V add(const V& a, const V& b) {
  return each([&](int l) { return saturated(a.lane[l] + b.lane[l]); });
}
inline V both(const V& a, const V& b) {
  return each([&](int l) { return a.lane[l] & b.lane[l]; });
}
inline V larger(const V& a, const V& b) {
  return each([&](int l) { return a.lane[l] > b.lane[l] ? a.lane[l] : b.lane[l]; });
}
inline V smaller(const V& a, const V& b) {
  return each([&](int l) { return a.lane[l] < b.lane[l] ? a.lane[l] : b.lane[l]; });
}
inline V scaled(const V& a, const V& w) {
  return each([&](int l) {
    return static_cast<std::uint32_t>(static_cast<std::uint16_t>(a.lane[l])) *
               static_cast<std::uint16_t>(w.lane[l]) >>
           16;
  });
}
inline V shifted(const V& a, int s) {
  return each([&](int l) { return static_cast<std::uint16_t>(a.lane[l]) << s; });
}
inline V times(const V& a, const V& b) {
  return each([&](int l) { return a.lane[l] * b.lane[l]; });
}
inline V squares(const V& a) {
  std::int32_t r[kLanes / 2];
  for (int l = 0; l < kLanes / 2; ++l)
    r[l] = a.lane[2 * l] * a.lane[2 * l] + a.lane[2 * l + 1] * a.lane[2 * l + 1];
  return load(r);
}
inline V add32(const V& a, const V& b) {
  std::uint32_t x[kLanes / 2], y[kLanes / 2];
  __builtin_memcpy(x, &a, sizeof a);
  __builtin_memcpy(y, &b, sizeof b);
  for (int l = 0; l < kLanes / 2; ++l) x[l] += y[l];
  return load(x);
}
inline void store(void* p, const V& a) { __builtin_memcpy(p, &a, sizeof a); }
inline std::uint32_t atMost(const V& a, std::uint32_t bound) {
  std::uint32_t x[kLanes / 2], bits = 0;
  __builtin_memcpy(x, &a, sizeof a);
  for (int l = 0; l < kLanes / 2; ++l) bits |= static_cast<std::uint32_t>(x[l] <= bound) << l;
  return bits;
}
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
  return smaller(larger(g, zero()), same(kLargestGap));
}

inline std::uint32_t finish(const V* sum, std::uint32_t bound, std::uint32_t* sums) {
  std::uint32_t within = 0;
  for (int v = 0; v < kVectors; ++v) {
    store(sums + v * kLanes / 2, sum[v]);
    within |= atMost(sum[v], bound) << (v * kLanes / 2);
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
  V sum[kVectors];
  for (int v = 0; v < kVectors; ++v) sum[v] = zero();
  for (int p = 0; p < kMeans / 2; ++p) {
    const V queryLow = pair(low + 2 * p), queryHigh = pair(high + 2 * p);
    for (int v = 0; v < kVectors; ++v) {
      V g =
          gap(shifted(widen(&boxes.low[p][0][0] + v * kLanes), boxes.shift),
              shifted(widen(&boxes.high[p][0][0] + v * kLanes), boxes.shift), queryLow, queryHigh);
      if (weighted) g = scaled(g, pair(q.meanWeight + 2 * p));
      sum[v] = add32(sum[v], squares(g));
    }
  }
  return finish(sum, bound, sums);
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
  V sum[kVectors];
  for (int v = 0; v < kVectors; ++v) sum[v] = zero();
  for (int p = 0; p < kMeans / 2; ++p) {
    const V queryLow = pair(low + 2 * p), queryHigh = pair(high + 2 * p);
    for (int v = 0; v < kVectors; ++v) {
      const V value = shifted(widen(&points.value[p][0][0] + v * kLanes), points.shift);
      V g = gap(value, value, queryLow, queryHigh);
      if (weighted) g = scaled(g, pair(q.meanWeight + 2 * p));
      sum[v] = add32(sum[v], squares(g));
    }
  }
  return finish(sum, bound, sums);
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
  V sum[kVectors];
  for (int v = 0; v < kVectors; ++v) sum[v] = load(sums + v * kLanes / 2);
  for (int i = 0; i < q.detailPairs; ++i) {
    const int p = q.detailPair[i];
    const V queryLow = pair(low + 2 * p), queryHigh = pair(high + 2 * p);
    for (int v = 0; v < kVectors; ++v) {
      const V value = shifted(widen(&points.value[p][0][0] + v * kLanes), points.shift);
      sum[v] = add32(sum[v], squares(gap(value, value, queryLow, queryHigh)));
    }
  }
  return finish(sum, bound, sums);
}

// Adds the gaps of one cell, whose numbers are `value(v)` in vector v, to the sums.
template <class Value>
inline void addCell(const QueryFeatures& q, int c, V width, V* sum, const Value& value) {
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
    sum[v] = add32(sum[v], squares(g));
  }
}

inline void finishBricks(const V* sum, std::uint32_t* sums) {
  std::uint32_t halves[kWide];
  for (int v = 0; v < kVectors; ++v) store(halves + v * kLanes / 2, sum[v]);
  for (int p = 0; p < 8; ++p) sums[p] = halves[2 * p] + halves[2 * p + 1];
}

void brickGaps(const Brick* const* bricks, int shift, std::int16_t width, const QueryFeatures& q,
               const std::uint8_t* cells, int count, std::uint32_t* sums) {
  V sum[kVectors];
  for (int v = 0; v < kVectors; ++v) sum[v] = zero();
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
  V sum[kVectors];
  for (int v = 0; v < kVectors; ++v) sum[v] = zero();
  const V base = quad(scale.base), step = quad(scale.step), width = quad(scale.width);
  for (int i = 0; i < count; ++i)
    addCell(q, cells[i], width, sum, [&](int v) {
      return add(base, times(widen(&bricks[i]->value[0][0] + v * kLanes), step));
    });
  finishBricks(sum, sums);
}

void numberGaps(const BrickNumbers* bricks, std::int16_t width, const QueryFeatures& q,
                const std::uint8_t* cells, int count, std::uint32_t* sums) {
  V sum[kVectors];
  for (int v = 0; v < kVectors; ++v) sum[v] = zero();
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

// Smaller pieces than this are gathered in memory.
#if defined(EXEMPLAR_REGISTER_PIECES)
constexpr int kInRegister = 4;
#else
constexpr int kInRegister = kSumLanes;
#endif

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
      V sum[2] = {zero(), zero()};
      for (; c < end; ++c) {
        const std::uint32_t* source = chunks.source + c * kPieces;
        const std::uint8_t* at = block + b + *source;
        alignas(64) std::uint8_t samples[kSumLanes];
        if (piece < kInRegister) {
          gather<piece>(block + b, source, samples);
          at = samples;
        }
        for (int v = 0; v < kSumLanes / kLanes; ++v) {
#if defined(EXEMPLAR_REGISTER_PIECES)
          V a = piece < kInRegister || piece == kSumLanes
                    ? widen(at + v * kLanes)
                    : widenPieces<piece>(block + b, source + v * kLanes / piece);
#else
          V a = widen(at + v * kLanes);
#endif
          if (c >= chunks.whole) a = both(a, load(chunks.mask + c * kSumLanes + v * kLanes));
          sum[v % 2] = add32(sum[v % 2],
                             squares(subtract(a, load(chunks.value + c * kSumLanes + v * kLanes))));
        }
      }
      alignas(64) std::uint32_t lanes[kLanes / 2];
      store(lanes, add32(sum[0], sum[1]));
      // At most kLook · 4 · 2 · 255² a lane.
      std::uint32_t all = 0;
      for (int l = 0; l < kLanes / 2; ++l) all += lanes[l];
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

extern const Kernels kKernels;
const Kernels kKernels{
    EXEMPLAR_KERNELS_NAME, boxGaps, meanGaps, detailGaps, brickGaps, byteGaps, numberGaps, scan};

}  // namespace EXEMPLAR_KERNELS
}  // namespace exemplar::kernels
