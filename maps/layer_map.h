// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "maps/grid.h"
#include "maps/shape.h"

namespace exemplar {

/// Which of several nested layers shows at each pixel, 1 (bottom) to the count of layers: layer i
/// is where the value is at least i (Rosenberger, Cohen-Or, Lischinski 2009, section 3).
using LayerMap = Grid<std::uint8_t>;
/// The same in space; one cell thick where it is flat (`boxOf`).
using LayerVolume = Array3D<std::uint8_t>;
inline constexpr int kMostLayers = 8;

/// The highest layer that shows.
int layerCount(const LayerVolume& layers);
int layerCount(const LayerMap& map);
/// Where the value is at least `layer`.
Shape layerShape(const LayerVolume& layers, int layer);
/// The share of steps between different layers that skip one. Layered synthesis models maps in
/// which they do not; in a picture it is the wrong model above .15.
double skippingShare(const LayerVolume& layers);
/// How oriented the boundaries between layers are in the plane: the larger of the counts of steps
/// along x and along y, over the smaller. 1 for shapes without a direction; above 1.5 shapes should
/// not be turned by a quarter.
double orientation(const LayerVolume& layers);

/// The order of labels, numbered from 1 to `count`, in which the smallest share of steps skips one:
/// their numbers, bottom up. The larger end lies at the bottom; or `bottom` does, if it is not 0.
/// O(count!).
std::vector<int> orderOfLayers(const LayerVolume& labels, int count, int bottom = 0);
/// Gives label `order[n]` the number n + 1.
void renumber(LayerVolume& labels, const std::vector<int>& order);
/// The share of each layer, from 1 to `count`.
std::vector<double> layerShares(const LayerVolume& layers, int count);

/// Reads a layer map from a gray picture: its different grays are the layers, the darkest lowest;
/// with `layers` above 0 exactly the grays that `writeLayerMap` gives so many layers. Throws
/// `InputError` where there are more than `kMostLayers` or grays that no layer has.
LayerMap readLayerMap(const std::filesystem::path& path, int layers = 0);
/// Writes a layer map as a gray `.png`, from black (the lowest layer) to white (the highest).
void writeLayerMap(const std::filesystem::path& path, const LayerMap& map, int layers);

}  // namespace exemplar
