// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <vector>

#include "core/progress.h"
#include "maps/map.h"

/// A texture that follows a control map: texture by numbers (Hertzmann et al. 2001; Rosenberger,
/// Cohen-Or, Lischinski 2009, section 4), by patch optimization (Kwatra et al. 2005) over
/// PatchMatch (Barnes et al. 2009).
namespace exemplar {

struct TextureOptions {
  int patch = 5;        ///< pixels a side, odd, 3..9
  int levels = 5;       ///< resolutions, each half the one before, 1..8
  int rounds = 5;       ///< of search and vote on each level, 1..20
  double guide = 1;     ///< how much a layer's difference weighs against the texture's spread, > 0
  double evenness = 1;  ///< how much it costs to use a place of the example more than others, >= 0
  bool exampleWraps = false;
  bool wraps = true;  ///< the result tiles
  std::uint64_t seed = 0;
};

/// Where each pixel of a texture comes from: the example's pixel.
using PixelOrigins = Grid<Pixel>;

struct GuidedTexture {
  Map map;               ///< all pictures of the example, aligned as there
  PixelOrigins origins;  ///< the place of the patch around each pixel
};

/// Makes a texture whose patches are the example's where the guides agree: `exampleGuide` belongs
/// to `example`, `guide` to the result. Patches are compared by the first picture of the example;
/// all its pictures are composed alike. Working memory about 60 bytes a pixel. The same at any
/// number of threads. Throws `InputError` where the example is smaller than a patch, and
/// `Cancelled`.
GuidedTexture synthesizeTexture(const Map& example, const Grid<float>& exampleGuide,
                                const Grid<float>& guide, const TextureOptions& options,
                                const Progress& progress = {});

}  // namespace exemplar
