// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include "synth/layered/layers.h"

namespace exemplar {

/// A map of this size whose regions lie beside each other as the example's do, without an order:
/// what the paper wishes for in its section 5. Where `synthesizeLayers` compares a layer with all
/// that is below it, here a boundary cell between two regions is given a patch of the example's
/// boundary between the same two, and patches vote for regions. The areas of regions are kept, and
/// of several thresholds of certainty that is taken which gives the example's length of boundary.
///
/// It keeps which regions touch which, and how often; it does not know that one lies on another, so
/// that nested shapes come out less like the example than by layers. Of `options` the shape's
/// `assignment`, `patch`, `levels`, `iterations`, `settled`, `turns` and the seed count. The same
/// at any number of threads. Throws `Cancelled`.
///
/// In the result, `map` has the example's numbers and `areaErrors` are those of every region from
/// the first on.
SynthesizedLayers synthesizeRegions(const LayerVolume& example, const Vec3i& size,
                                    const LayerOptions& options, const Progress& progress = {});

/// How much the regions' shares differ between the halves of a map, left and right or top and
/// bottom (in space also front and back), whichever differ more: 0 where they are the same, 1 where
/// no region is in both. Regions that have a place, as sky and ground have in a scene, are not made
/// like the example's by `synthesizeRegions`, which knows no places.
double placedShare(const LayerVolume& map);

/// For each region, 1 to `count`, where it is: what guides a texture of regions without an order.
/// Any two differ as much as neighboring layers do.
std::vector<Array3D<float>> regionGuides(const LayerVolume& map, int count);

}  // namespace exemplar
