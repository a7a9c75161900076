// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/progress.h"
#include "synth/geometry/synthesize.h"

namespace exemplar {

/// Whether an example is an object that stands alone: solid, with air all over the sides of its box
/// but for the bottom, on which it may stand. O(samples).
bool isFreeStanding(const DistanceField& example);

/// What becomes of an object along an axis.
enum class Growth {
  Varied,  ///< it stays as long, its parts longer and shorter
  Fitted,  ///< it is extended or shortened in its own structure
  Grown,   ///< it does not dock onto itself: it grows as a whole (`growObject`)
};

struct ObjectOptions {
  Vec3i size{0, 0, 0};  ///< of the result, samples; each component >= 1
  std::uint64_t seed = 0;
  /// The least distance (1 - IoU) to the example of a result of its own size, where the object's
  /// parts can be moved so far without tearing; 0..1.
  double novelty = 0.22;
  double truncation = 4;  ///< distances count up to here, voxels; > 0
  /// Samples of the example, not 0, that stay as they are, to the bit; of its size, or none. Then
  /// nothing is varied: the result is the example made longer or shorter where nothing is kept.
  std::optional<Array3D<std::uint8_t>> kept;
};

struct ObjectResult {
  SynthesisResult made;
  std::array<Growth, 3> growth{};  ///< along each axis
  int parts = 0;                   ///< that were exchanged
  int strewn = 0;                  ///< loose parts that it is made of (`strewParts`), or none
  double partDistance = 0;
  /// The distance (1 - IoU) to the example in place, of a result of its own size, before joints are
  /// cut; else 0.
  double distance = 0;
  Vec3i keptOffset{0, 0, 0};  ///< by which what is kept, and first along each axis, was moved
};

/// More of an object that stands alone, as an object: its ends, its ground, and how its parts hang
/// together stay.
///
/// A result of its own size is a variation of it: along each axis, parts become longer and shorter
/// where the object docks onto itself (`variedPath`), as far as it takes to be new. Along an axis
/// along which the result is longer or shorter, the object is extended or shortened where it docks
/// onto itself (`fittedPath`), and joints are cut where both sides agree best, as everywhere
/// (`assemble`). Where it does not, or would stand on several feet instead of one, it grows into
/// one larger object (`growObject`).
///
/// What is made of loose parts is strewn anew, at any size (`strewParts`), unless something is
/// kept.
///
/// Where something is kept and the example does not dock onto itself beside it along an axis along
/// which the result is of another size, nothing is made, and `made.field` is empty.
///
/// Memory about 120 bytes a sample of the result, up to twice that where it grows. The same bytes
/// at any number of threads. Throws `InputError` for options out of range, `Cancelled`.
ObjectResult synthesizeObject(const DistanceField& example, const ObjectOptions& options,
                              const Progress& progress = {});

}  // namespace exemplar
