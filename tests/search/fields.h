// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

#include "core/array3d.h"
#include "core/random.h"
#include "search/block_match.h"

/// Fields made from formulas, for the tests and benchmarks of search. Distances are in samples,
/// negative inside; the same seed gives the same field.
namespace exemplar::fields {

/// The signed distance to a random packing of equal balls (about 60 % of the volume, no ball deeper
/// than a few percent of its radius in another), periodic.
Array3D<float> ballPacking(int n, double radius, std::uint64_t seed);

/// The distance, to first order, to a landscape of ridges and valleys: noise of several octaves,
/// folded.
Array3D<float> terrain(int n, std::uint64_t seed);

/// The signed distance to rings woven 4-in-1 in a layer, each slightly moved and turned. `pitch` is
/// the distance of neighboring rings of a row.
Array3D<float> chainmail(int n, double pitch, std::uint64_t seed);

/// The exact distance to a ball, a torus or a box in general position.
enum class Shape { Ball, Torus, Box };
Array3D<float> shape(int n, Shape kind, std::uint64_t seed);

/// Independent uniform levels, 0..`levels` - 1.
Array3D<std::uint8_t> noise(const Vec3i& size, std::uint64_t seed, int levels = 256);

/// 256 levels between -range and range, clamped.
Array3D<std::uint8_t> quantized(const Array3D<float>& field, double range);

/// The block at a position.
template <class Sample>
Array3D<Sample> block(const Array3D<Sample>& field, const Vec3i& position, const Vec3i& size) {
  Array3D<Sample> result(size);
  for (std::size_t i = 0; i < result.count(); ++i)
    result.data()[i] = field[position + result.ijk(i)];
  return result;
}

/// A mask that is known everywhere but in one octant, 0..7.
Array3D<std::uint8_t> withoutOctant(const Vec3i& size, int octant);

/// Each sample known with this probability.
Array3D<std::uint8_t> randomMask(const Vec3i& size, double known, std::uint64_t seed);

/// The case that synthesis asks for: a block of `field` at random, with one octant, at random,
/// unknown.
template <class Sample>
BlockQuery<Sample> octantQuery(const Array3D<Sample>& field, const Vec3i& size,
                               std::uint64_t seed) {
  const Random random(seed, 0x6f63);
  const Vec3i positions = blockPositions(field.size(), size);
  const Vec3i position{static_cast<int>(random.below(positions.x, 0)),
                       static_cast<int>(random.below(positions.y, 1)),
                       static_cast<int>(random.below(positions.z, 2))};
  return {block(field, position, size), withoutOctant(size, static_cast<int>(random.below(8, 3)))};
}

}  // namespace exemplar::fields
