// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <optional>

#include "core/origin.h"
#include "core/progress.h"
#include "sdf/distance_field.h"

namespace exemplar {

/// How visible it is that a result was put together. All in voxels, over values cut off at the
/// smaller of the two fields' truncations.
struct Seams {
  /// The mean of | |∇φ| - 1 | where |φ| is less than 3 voxels and the central differences do not
  /// reach truncated values (so |φ| < truncation - 1 voxel), in the result and in the example.
  /// Nothing where there is no such sample.
  std::optional<double> eikonalResidual, exampleEikonalResidual;

  // Measured on origins; absent without them.

  /// The share of cell faces where the source offset changes; 0..1.
  std::optional<double> seamShare;
  /// The mean of |(φa - φb) - (φ'a - φ'b)| over those faces, φ' being what the source of a says,
  /// and what the source of b says: the mean of both where both are inside the example. 0 without
  /// seams.
  std::optional<double> jump;
  /// `jump` over the mean |φ(x - 1) - 2 φ(x) + φ(x + 1)| of the example; nothing where that is 0.
  std::optional<double> jumpRatio;
  /// The same where the surface is near (|φ| < 3 voxels at one of the face's cells; in the example
  /// at x): seams in empty space, which cost nothing, cannot dilute it.
  std::optional<double> nearJump, nearJumpRatio;
};

/// Seams from the fields and, where there are any, the origins (same size as the result; `nullptr`
/// if none). Faces whose sources are not in example number `exampleIndex` are passed over.
/// O(samples), the same bytes at any number of threads. Throws `InputError` for voxel sizes or
/// numbers of origins that do not fit, and for origins outside the example, and `Cancelled`.
Seams measureSeams(const DistanceField& example, const DistanceField& result,
                   const Origins* origins = nullptr, int exampleIndex = 0,
                   const Progress& progress = {});

/// Where seams are and how much they jump, in voxels: for each sample of the result the largest of
/// the jumps that `Seams::jump` is the mean of, over the sample's own faces; 0 where its source
/// goes on to all sides. Arguments, errors and cost as there.
Array3D<float> seamJumps(const DistanceField& example, const DistanceField& result,
                         const Origins& origins, int exampleIndex = 0,
                         const Progress& progress = {});

}  // namespace exemplar
