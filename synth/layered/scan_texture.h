// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include "core/progress.h"
#include "core/random.h"
#include "synth/layered/texture_level.h"

namespace exemplar {

/// One resolution of a texture made in scan order.
struct ScannedLevel {
  TextureFeatures example, result;
  TextureOrigins origins;
};

/// Makes a texture pixel by pixel in scan order, each the middle of the example's neighborhood that
/// is most like what is there: the guide around it, what is made of the texture already, and the
/// texture around it on the `coarser` resolution (null at the coarsest). Where a place that goes on
/// beside a neighbor's is hardly worse than the best, it is taken: by 1 + 2^-level `coherence`
/// (Hertzmann et al. 2001, section 3.1). The best is looked for among up to 60,000 of the example's
/// places, approximately, with a tree. `result` has its guide; its texture is made. `hole`: as in
/// `TextureTask`; may be null. Flat textures only. One thread, so that the result is the same at
/// any number. Throws `InputError` where a hole leaves no neighborhood, and `Cancelled`.
ScannedLevel scanTexture(TextureFeatures example, TextureFeatures result,
                         const ScannedLevel* coarser, const Shape* hole, int level,
                         const TextureOptions& options, const Random& random,
                         const Progress& progress);

}  // namespace exemplar
