// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <span>

#include "core/origin.h"
#include "reconstruct/transfer.h"
#include "sdf/distance_field.h"

namespace exemplar {

struct BlendSeamsOptions {
  /// How far from a seam copied parts are blended into each other, voxels, 0.5..8.
  double width = 2;
  /// How far apart, voxels, two parts may be to count as the same surface, > 0: beyond twice this
  /// they are left as they are, so that a wall that ends at a seam is not drawn out into a fin.
  double agreement = 1.5;
};

/// Evens out the steps between copied parts: near a seam each sample becomes the weighted mean of
/// what the parts around it say about it, every part carried on past its border by the example's
/// own field. Where one part is alone, samples stay as they are, to the bit.
///
/// This is the overlap and blend that patch-based texture synthesis uses (Liang et al. 2001) and
/// Lagae 2004, section 5.3, names as the missing step for geometry: parts need not have been
/// synthesized with an overlap, for origins tell how each goes on. Means of nearly equal distances
/// are nearly distances, so small steps become slopes; where parts do not agree their step remains.
///
/// Only samples within `width` and two more voxels of the surface change. O(s width³) for s such
/// samples. The same bytes at any number of threads. Throws `InputError` for options out of range
/// and where origins and field do not match or name an example that is not there.
DistanceField blendSeams(const DistanceField& field, const Origins& origins,
                         std::span<const DistanceField* const> examples,
                         const BlendSeamsOptions& options = {});

/// The same for one example.
DistanceField blendSeams(const DistanceField& field, const Origins& origins,
                         const DistanceField& example, const BlendSeamsOptions& options = {});

}  // namespace exemplar
