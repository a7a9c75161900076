// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

/// Eight lanes of 16 bits for machines of which Highway knows no more than that they run C++: of
/// every x86-64 SSE2, elsewhere loops for the compiler. Operations as in `kernels.cpp`, which uses
/// Highway's lanes wherever there are better ones.
namespace exemplar::kernels::baseline_lanes {

constexpr int kLanes = 8;

#if defined(__SSE2__)
using V = __m128i;
using V32 = __m128i;
inline V load(const std::int16_t* p) { return _mm_loadu_si128(reinterpret_cast<const V*>(p)); }
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
inline V subtract(V a, V b) { return _mm_subs_epi16(a, b); }
inline V add(V a, V b) { return _mm_adds_epi16(a, b); }
inline V both(V a, V b) { return _mm_and_si128(a, b); }
inline V larger(V a, V b) { return _mm_max_epi16(a, b); }
inline V smaller(V a, V b) { return _mm_min_epi16(a, b); }
inline V times(V a, V b) { return _mm_mullo_epi16(a, b); }
inline V shifted(V a, int bits) { return _mm_sll_epi16(a, _mm_cvtsi32_si128(bits)); }
inline V scaled(V a, V w) { return _mm_mulhi_epu16(a, w); }

inline V32 add32(V32 a, V32 b) { return _mm_add_epi32(a, b); }
inline V32 load32(const std::int32_t* p) { return _mm_loadu_si128(reinterpret_cast<const V*>(p)); }
inline void store32(V32 a, std::int32_t* p) { _mm_storeu_si128(reinterpret_cast<V*>(p), a); }
struct Sums {
  V32 sum = _mm_setzero_si128();

  void addSquares(V a) { sum = add32(sum, _mm_madd_epi16(a, a)); }
  V32 inOrder() const { return sum; }
};
inline std::uint32_t atMost(V32 a, std::uint32_t bound) {
  const V more = _mm_cmpgt_epi32(a, _mm_set1_epi32(static_cast<int>(bound)));
  return static_cast<std::uint32_t>(~_mm_movemask_ps(_mm_castsi128_ps(more))) & 0xf;
}
#else
struct V {
  std::int16_t lane[kLanes];
};
struct V32 {
  std::int32_t lane[kLanes / 2];
};
template <class Op>
inline V each(const Op& op) {
  V r;
  for (int l = 0; l < kLanes; ++l) r.lane[l] = static_cast<std::int16_t>(op(l));
  return r;
}
inline int saturated(int v) { return v > 32767 ? 32767 : v < -32768 ? -32768 : v; }
inline V load(const std::int16_t* p) {
  return each([&](int l) { return p[l]; });
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
inline V times(const V& a, const V& b) {
  return each([&](int l) { return a.lane[l] * b.lane[l]; });
}
inline V shifted(const V& a, int bits) {
  return each([&](int l) { return static_cast<std::uint16_t>(a.lane[l]) << bits; });
}
inline V scaled(const V& a, const V& w) {
  return each([&](int l) {
    return static_cast<std::uint32_t>(static_cast<std::uint16_t>(a.lane[l])) *
               static_cast<std::uint16_t>(w.lane[l]) >>
           16;
  });
}

inline V32 add32(const V32& a, const V32& b) {
  V32 r;
  for (int l = 0; l < kLanes / 2; ++l) r.lane[l] = a.lane[l] + b.lane[l];
  return r;
}
/// Sums of the squares of pairs of lanes.
struct Sums {
  V32 sum{};

  void addSquares(const V& a) {
    for (int l = 0; l < kLanes / 2; ++l)
      sum.lane[l] += a.lane[2 * l] * a.lane[2 * l] + a.lane[2 * l + 1] * a.lane[2 * l + 1];
  }
  V32 inOrder() const { return sum; }
};
inline V32 load32(const std::int32_t* p) {
  V32 r;
  for (int l = 0; l < kLanes / 2; ++l) r.lane[l] = p[l];
  return r;
}
inline void store32(const V32& a, std::int32_t* p) {
  for (int l = 0; l < kLanes / 2; ++l) p[l] = a.lane[l];
}
/// Bits of the lanes that are at most `bound`; both are below 2^31.
inline std::uint32_t atMost(const V32& a, std::uint32_t bound) {
  std::uint32_t bits = 0;
  for (int l = 0; l < kLanes / 2; ++l)
    bits |= static_cast<std::uint32_t>(a.lane[l] <= static_cast<std::int32_t>(bound)) << l;
  return bits;
}
#endif

template <int piece>
inline V widenPieces(const std::uint8_t* block, const std::uint32_t* source) {
  return widen(block + *source);
}
constexpr int kLeastJoined = kLanes;

}  // namespace exemplar::kernels::baseline_lanes
