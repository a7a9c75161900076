// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "search/block_match.h"

#include <algorithm>
#include <limits>
#include <string>

#include "core/error.h"

namespace exemplar {

namespace {

std::string text(const Vec3i& size) {
  return std::to_string(size.x) + " x " + std::to_string(size.y) + " x " + std::to_string(size.z);
}

}  // namespace

Vec3i blockPositions(const Vec3i& source, const Vec3i& block) {
  const Vec3i positions = source - block + Vec3i{1, 1, 1};
  if (std::min({block.x, block.y, block.z}) < 1 ||
      std::min({positions.x, positions.y, positions.z}) < 1)
    throw InputError("a block of " + text(block) + " samples does not fit into a source of " +
                     text(source) + "; it needs 1 to that many along each axis");
  if (volume(source) > std::numeric_limits<std::int32_t>::max())
    throw InputError("a source of " + text(source) + " samples cannot be searched; at most 2^31");
  return positions;
}

template <class Sample>
std::int64_t knownSamples(const BlockQuery<Sample>& query) {
  if (query.known.empty()) return static_cast<std::int64_t>(query.samples.count());
  if (query.known.size() != query.samples.size())
    throw InputError("a block of " + text(query.samples.size()) + " samples has a mask of " +
                     text(query.known.size()) + "; they must agree");
  return std::ranges::count_if(query.known.values(), [](std::uint8_t k) { return k != 0; });
}

template std::int64_t knownSamples(const BlockQuery<std::uint8_t>&);
template std::int64_t knownSamples(const BlockQuery<float>&);

}  // namespace exemplar
