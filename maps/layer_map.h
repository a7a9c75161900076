// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <filesystem>

#include "maps/boundary_patches.h"
#include "maps/grid.h"

namespace exemplar {

/// Which of several nested layers shows at each pixel, 1 (bottom) to the count of layers: layer i
/// is where the value is at least i (Rosenberger, Cohen-Or, Lischinski 2009, section 3).
using LayerMap = Grid<std::uint8_t>;
inline constexpr int kMostLayers = 8;

/// The highest layer that shows.
int layerCount(const LayerMap& map);
/// Where the value is at least `layer`.
Shape layerShape(const LayerMap& map, int layer);
/// The share of steps between different layers, left or up, that skip one. Layered synthesis
/// models maps in which they do not; above .15 it is the wrong model. 0..1.
double skippingShare(const LayerMap& map);
/// How oriented the boundaries between layers are: the larger of the counts of steps along x and
/// along y, over the smaller. 1 for shapes without a direction; above 1.5 shapes should not be
/// turned by a quarter.
double orientation(const LayerMap& map);

/// Reads a layer map from a gray picture: its different grays are the layers, the darkest lowest;
/// with `layers` above 0 exactly the grays that `writeLayerMap` gives so many layers. Throws
/// `InputError` where there are more than `kMostLayers` or grays that no layer has.
LayerMap readLayerMap(const std::filesystem::path& path, int layers = 0);
/// Writes a layer map as a gray `.png`, from black (the lowest layer) to white (the highest).
void writeLayerMap(const std::filesystem::path& path, const LayerMap& map, int layers);

}  // namespace exemplar
