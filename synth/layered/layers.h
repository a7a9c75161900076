// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/progress.h"
#include "maps/layer_map.h"
#include "maps/map.h"
#include "synth/layered/shape_optimization.h"

/// Layer maps, found and made (Rosenberger, Cohen-Or, Lischinski 2009, sections 3,
/// 3.3 and 4).
namespace exemplar {

struct DecompositionOptions {
  int layers = 4;         ///< 2..8
  int neighborhood = 15;  ///< pixels a side of what is clustered, odd, 5..31
  /// Clusters from the bottom up by their numbers (1 the largest, 2 the next, ...); empty: so that
  /// as few steps as possible skip a layer, the larger end at the bottom.
  std::vector<int> order;
};

struct Decomposition {
  LayerMap map;
  std::vector<double> shares;  ///< of each layer, bottom up
  double skipping = 0;         ///< `skippingShare`
};
/// A texture's layers: k-means clusters of its pixels' neighborhoods (their first 24 principal
/// components), smoothed, ordered. O(pixels x neighborhood² x planes). Throws `InputError` where
/// the texture has fewer different neighborhoods than layers, and `Cancelled`.
Decomposition decomposeTexture(const MapLayer& texture, const DecompositionOptions& options,
                               std::uint64_t seed, const Progress& progress = {});
/// A height map's layers: equal areas between contour lines of the heights, smoothed by a Gaussian
/// of one pixel. Throws `InputError` where it is flat.
Decomposition decomposeHeights(const Grid<float>& heights, const DecompositionOptions& options,
                               const Progress& progress = {});

struct LayerOptions {
  ShapeOptions shape;
  std::uint64_t seed = 0;
};
struct SynthesizedLayers {
  LayerMap map;  ///< of a torus: copies tile
  /// Of each layer from the second on: its share less the example's. Not 0 only where the layer
  /// below left too little room.
  std::vector<double> areaErrors;
};
/// A layer map of this size whose layers look like the example's, bottom to top, each inside the
/// one below it and placed by that one's boundary (section 3.3). The same at any number of threads.
/// Throws `Cancelled`.
SynthesizedLayers synthesizeLayers(const LayerMap& example, int width, int height,
                                   const LayerOptions& options, const Progress& progress = {});

/// Two maps' layers as numbers that change smoothly (equation 5): within layer i, i to i + 1, by
/// the distances to what shows a lower layer and to what shows a higher one. The bottom and top
/// layers, which have one neighbor, go as far as the example's do.
struct ControlMaps {
  Grid<float> example, result;
};
ControlMaps controlMaps(const LayerMap& example, bool exampleWraps, const LayerMap& result,
                        const Progress& progress = {});

}  // namespace exemplar
