// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "preview/sampling.h"

#include <cassert>

namespace exemplar {
namespace {

constexpr int kBlockBits = 7;  // the Morton order spans 128 x 128 pixels

std::uint32_t reverseBits(std::uint32_t v) {
  v = (v << 16) | (v >> 16);
  v = ((v & 0x00ff00ffu) << 8) | ((v & 0xff00ff00u) >> 8);
  v = ((v & 0x0f0f0f0fu) << 4) | ((v & 0xf0f0f0f0u) >> 4);
  v = ((v & 0x33333333u) << 2) | ((v & 0xccccccccu) >> 2);
  return ((v & 0x55555555u) << 1) | ((v & 0xaaaaaaaau) >> 1);
}

// A hash in which each bit depends on lower bits only: seen with reversed bits, a random nested
// permutation, which is Owen's scrambling (Burley 2020, section 3; Laine and Karras' form).
std::uint32_t nestedHash(std::uint32_t v, std::uint32_t key) {
  v += key;
  v ^= v * 0x6c50b47cu;
  v ^= v * 0xb82f1e52u;
  v ^= v * 0xc7afe638u;
  v ^= v * 0x8d22f6e6u;
  return v;
}

// The second Sobol' dimension's matrix is Pascal's triangle modulo 2, whose entry (i, j) is set
// where i's bits are a subset of j's (Lucas): bit i of the product is the parity over the supersets
// of i, five butterfly steps.
std::uint32_t pascal(std::uint32_t v) {
  v ^= (v >> 1) & 0x55555555u;
  v ^= (v >> 2) & 0x33333333u;
  v ^= (v >> 4) & 0x0f0f0f0fu;
  v ^= (v >> 8) & 0x00ff00ffu;
  return v ^ ((v >> 16) & 0x0000ffffu);
}

std::uint32_t spread(std::uint32_t v) {  // 7 bits, a zero between each and the next
  std::uint32_t result = 0;
  for (int b = 0; b < kBlockBits; ++b) result |= ((v >> b) & 1u) << (2 * b);
  return result;
}

float unit(std::uint32_t v) { return static_cast<float>(v >> 8) * 0x1p-24f; }

}  // namespace

PixelSampler::PixelSampler(std::uint64_t seed, int paths) : random_(seed, stream::kPixels) {
  assert(paths >= 1);
  while ((1 << pathBits_) < paths) ++pathBits_;
  assert(pathBits_ + 2 * kBlockBits <= 32);
}

void PixelSampler::startPixel(int x, int y) {
  const std::uint32_t low = (1u << kBlockBits) - 1;
  first_ = ((spread(y & low) << 1) | spread(x & low)) << pathBits_;
  const std::uint64_t block = (static_cast<std::uint64_t>(y >> kBlockBits) << 32) |
                              static_cast<std::uint64_t>(x >> kBlockBits);
  if (block == block_) return;
  block_ = block;
  for (int p = 0; p < kPairs; ++p) {
    const std::uint64_t a = random_.bits(block, 2 * p), b = random_.bits(block, 2 * p + 1);
    keys_[p] = {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b),
                static_cast<std::uint32_t>(b >> 32)};
  }
}

Sample2 PixelSampler::get(int path, int pair) const {
  const Keys& keys = keys_[pair];
  const std::uint32_t index =
      reverseBits(nestedHash(reverseBits(first_ + static_cast<std::uint32_t>(path)), keys.shuffle));
  return {unit(reverseBits(nestedHash(index, keys.x))),
          unit(reverseBits(nestedHash(pascal(index), keys.y)))};
}

}  // namespace exemplar
