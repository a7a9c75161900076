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
  LayerVolume map;
  std::vector<double> shares;  ///< of each layer, bottom up
  double skipping = 0;         ///< `skippingShare`
};
/// A texture's layers: k-means clusters of its pixels' neighborhoods (their first 24 principal
/// components), smoothed, ordered. O(pixels x neighborhood² x planes). Throws `InputError` where
/// the texture has fewer colors, or clusters that remain, than layers, and `Cancelled`.
Decomposition decomposeTexture(const MapLayer& texture, const DecompositionOptions& options,
                               std::uint64_t seed, const Progress& progress = {});
/// A height map's layers: equal areas between contour lines of the heights, smoothed by a Gaussian
/// of one pixel. Throws `InputError` where it is flat.
Decomposition decomposeHeights(const Grid<float>& heights, const DecompositionOptions& options,
                               const Progress& progress = {});

struct LayerOptions {
  ShapeOptions shape;
  std::uint64_t seed = 0;
  /// Where not 0, the example is not known and is filled anew; elsewhere the result, which then has
  /// the example's size, is the example. Null: all of the result is made.
  const Shape* hole = nullptr;
  /// Layers painted by hand, of the result's size, from which it begins, in place of chance; their
  /// areas are kept. Null: none.
  const LayerVolume* paint = nullptr;
  /// On how many resolutions painted layers are made to look like the example's, from the finest;
  /// fewer keep more of what was painted. 1..7.
  int paintLevels = 2;
};
struct SynthesizedLayers {
  LayerVolume map;  ///< of a torus: copies tile, unless it has a hole
  /// Of each layer from the second on: its share less what it should be. Not 0 only where the layer
  /// below left too little room.
  std::vector<double> areaErrors;
  bool dealtExactly = true;  ///< not where greedy was asked, or patches were too many
};
/// Layers of this size that look like the example's, bottom to top, each inside the one below it
/// and placed by that one's boundary (section 3.3); flat or in space, as the example is. The same
/// at any number of threads. Throws `Cancelled`.
SynthesizedLayers synthesizeLayers(const LayerVolume& example, const Vec3i& size,
                                   const LayerOptions& options, const Progress& progress = {});

/// Painted layers with strips of those that were left out: where a layer touches one that is more
/// than one below it, the layers between them are added around it, each as wide as it usually is in
/// the example, at least one cell (section 4, user control).
LayerVolume withStrips(const LayerVolume& painted, const LayerVolume& example);

/// Two maps' layers as numbers that change smoothly (equation 5): within layer i, i to i + 1, by
/// the distances to what shows a lower layer and to what shows a higher one. The bottom and top
/// layers, which have one neighbor, go as far as the example's do; so do the others where the
/// result goes farther from a neighbor than the example ever does.
struct ControlMaps {
  Array3D<float> example, result;
  float top = 0;  ///< the highest layer

  /// Leaves `share` of the changes within layers, 0..1, so that a step from one layer to the next
  /// counts more than the way through one.
  void soften(float share);
};
ControlMaps controlMaps(const LayerVolume& example, bool exampleWraps, const LayerVolume& result,
                        bool resultWraps, const Progress& progress = {});

}  // namespace exemplar
