// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <vector>

#include "core/progress.h"
#include "maps/layer_map.h"
#include "maps/map.h"
#include "maps/shape.h"

/// A texture that follows a control map: texture by numbers (Hertzmann et al. 2001; Rosenberger,
/// Cohen-Or, Lischinski 2009, section 4), by patch optimization (Kwatra et al. 2005) over
/// PatchMatch (Barnes et al. 2009), or pixel by pixel. In the plane and in space.
namespace exemplar {

/// How a texture is made.
enum class TextureMethod {
  Patches,  ///< patch optimization
  Classic,  ///< pixel by pixel in scan order, as in image analogies; in the plane
};

struct TextureOptions {
  TextureMethod method = TextureMethod::Patches;
  int patch = 5;        ///< cells a side, odd, 3..9
  int levels = 5;       ///< resolutions, each half the one before, 1..8
  int rounds = 5;       ///< of search and vote on each level, 1..20; of patch optimization
  double guide = 1;     ///< how much a layer's difference weighs against the texture's spread, > 0
  double evenness = 1;  ///< how much it costs to use a place of the example more than others, >= 0
  /// Classic: how much worse than the best match one may be that goes on where a neighbor's comes
  /// from (kappa of image analogies, section 3.1), 0..50.
  double coherence = 1;
  bool exampleWraps = false;
  bool wraps = true;  ///< the result tiles
  std::uint64_t seed = 0;
};

/// Planes of values on one grid.
using Planes = std::vector<Array3D<float>>;
/// Where each cell of a texture comes from: the example's cell.
using TextureOrigins = Array3D<Vec3i>;

/// What a texture is made from, and where.
struct TextureTask {
  Planes example;       ///< what patches are compared by
  Planes exampleGuide;  ///< what says where in the example's layers a cell is
  Planes guide;         ///< the same of the result
  /// Where not 0, the example is not known and is made anew; the result has its size, and is the
  /// example elsewhere. Empty: all of the result is made.
  Shape hole;

  const Vec3i& exampleSize() const { return exampleGuide.front().size(); }
  const Vec3i& size() const { return guide.front().size(); }
};

/// Throws `InputError` where an example is too small for the texture's patches.
void requireTexturePatch(const Vec3i& exampleSize, const TextureOptions& options);

/// For each cell of a result the cell of the example in the middle of the patch that fits best
/// around it, and how well it fits.
struct MatchedTexture {
  TextureOrigins origins;
  Array3D<float> costs;
};

/// Finds patches of the example that agree with the guides and with each other. Working memory
/// about 80 bytes a cell. The same at any number of threads. Throws `InputError` where the example
/// is smaller than a patch or the hole leaves none of it, and `Cancelled`.
MatchedTexture matchTexture(const TextureTask& task, const TextureOptions& options,
                            const Progress& progress = {});

/// Where each cell comes from: of the patches over it the one that counts most there.
TextureOrigins sharpestOrigins(const MatchedTexture& matched, const TextureTask& task,
                               const TextureOptions& options);
/// The same where each cell must come from its own layer: of the patches over it that show that
/// layer there, or else from where the guides are most alike.
TextureOrigins layerOrigins(const MatchedTexture& matched, const TextureTask& task,
                            const LayerVolume& exampleLayers, const LayerVolume& layers,
                            const TextureOptions& options);

struct GuidedTexture {
  Map map;  ///< all pictures of the example, aligned as there
  TextureOrigins origins;
};

/// Makes a texture whose patches are the example's where the guides agree. Patches are compared by
/// the first picture of the example; all its pictures are composed alike. Outside a hole the
/// result is the example, to the bit. As `matchTexture`.
GuidedTexture synthesizeTexture(const Map& example, Planes exampleGuide, Planes guide,
                                const Shape& hole, const TextureOptions& options,
                                const Progress& progress = {});

/// The planes of a picture as boxes that are one cell thick.
Planes planesOf(const MapLayer& picture);

}  // namespace exemplar
