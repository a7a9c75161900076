// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <string>
#include <vector>

#include "maps/layer_map.h"
#include "voxelize/label_grid.h"

namespace exemplar {

/// A grid of labels as layers, one or several labels each.
struct LabelLayers {
  LayerVolume layers;
  /// For each label its layer, from 1; 0 where no cell has it.
  std::vector<std::uint8_t> layerOf;
  std::string order;   ///< for people, bottom up: "air, stone, lichen"
  bool mixed = false;  ///< whether a layer has several labels
};

/// The layers of a grid's labels. `order` names them from the bottom up, by number or name, those
/// of one layer joined by +: "0,stone+ore,lichen"; where it is empty each label is a layer, an
/// empty one at the bottom, so that as few steps as possible skip one. `name` is what errors call
/// the grid. Throws `InputError` where there are fewer than two layers or more than `kMostLayers`,
/// or `order` leaves out a label that is there.
LabelLayers layersOfLabels(const LabelGrid& grid, const std::string& order,
                           const std::string& name);
/// The layers of another grid with the same labels; throws `InputError` for a label that has none.
LayerVolume layersLike(const LabelGrid& grid, const LabelLayers& example, const std::string& name);

}  // namespace exemplar
