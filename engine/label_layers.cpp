// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/label_layers.h"

#include <algorithm>
#include <charconv>
#include <set>

#include "core/error.h"
#include "core/text.h"
#include "engine/words.h"

namespace exemplar {
namespace {

std::string nameOf(const LabelGrid& grid, Label label) {
  const LabelLook& look = grid.labels[label];
  if (!look.name.empty()) return look.name;
  return isEmpty(look) && label == 0 ? "air" : std::to_string(label);
}

Label labelNamed(const LabelGrid& grid, const std::string& word) {
  unsigned number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error == std::errc{} && end == word.data() + word.size() && number < grid.labels.size())
    return static_cast<Label>(number);
  for (std::size_t l = 0; l < grid.labels.size(); ++l)
    if (nameOf(grid, static_cast<Label>(l)) == word) return static_cast<Label>(l);
  std::vector<std::string> names;
  for (std::size_t l = 0; l < grid.labels.size() && l < 12; ++l)
    names.push_back(nameOf(grid, static_cast<Label>(l)));
  throw InputError("`order`: there is no label " + word + "; there are " + joined(names, "and") +
                   (grid.labels.size() > names.size() ? ", and more" : ""));
}

/// The labels of each layer, bottom up, as they are named.
std::vector<std::vector<Label>> namedLayers(const LabelGrid& grid, const std::string& order) {
  std::vector<std::vector<Label>> layers;
  std::set<Label> named;
  for (const std::string& layer : split(order, ',')) {
    layers.emplace_back();
    for (const std::string& word : split(layer, '+')) {
      const Label label = labelNamed(grid, word);
      if (!named.insert(label).second)
        throw InputError("`order` " + order + ": names " + nameOf(grid, label) + " twice");
      layers.back().push_back(label);
    }
  }
  return layers;
}

/// Each label a layer, so that as few steps as possible skip one.
std::vector<std::vector<Label>> foundLayers(const LabelGrid& grid, const std::set<Label>& present) {
  LayerVolume numbered(grid.size());
  const std::vector<Label> labels(present.begin(), present.end());
  int bottom = 0;
  for (std::size_t n = 0; n < labels.size() && bottom == 0; ++n)
    if (isEmpty(grid.labels[labels[n]])) bottom = static_cast<int>(n) + 1;
  for (std::size_t p = 0; p < numbered.count(); ++p) {
    const auto at = std::ranges::lower_bound(labels, grid.cells.data()[p]);
    numbered.data()[p] = static_cast<std::uint8_t>(at - labels.begin() + 1);
  }
  std::vector<std::vector<Label>> layers;
  for (const int number : orderOfLayers(numbered, static_cast<int>(labels.size()), bottom))
    layers.push_back({labels[static_cast<std::size_t>(number - 1)]});
  return layers;
}

}  // namespace

LabelLayers layersOfLabels(const LabelGrid& grid, const std::string& order,
                           const std::string& name) {
  const std::set<Label> present(grid.cells.values().begin(), grid.cells.values().end());
  if (order.empty() && present.size() > static_cast<std::size_t>(kMostLayers)) {
    throw InputError(name + ": " + std::to_string(present.size()) + " labels, and at most " +
                     std::to_string(kMostLayers) +
                     " layers are made; say with `order` which labels form a layer together "
                     "(0,1+2+3,4)");
  }
  const std::vector<std::vector<Label>> layers =
      order.empty() ? foundLayers(grid, present) : namedLayers(grid, order);
  if (layers.size() < 2 || layers.size() > static_cast<std::size_t>(kMostLayers)) {
    throw InputError(name + ": " + counted(layers.size(), "layer") + "; 2 to " +
                     std::to_string(kMostLayers) + " are made");
  }
  LabelLayers found;
  found.layerOf.resize(grid.labels.size());
  for (std::size_t n = 0; n < layers.size(); ++n) {
    if (n > 0) found.order += ", ";
    bool any = false;
    for (const Label label : layers[n]) {
      found.layerOf[label] = static_cast<std::uint8_t>(n + 1);
      found.order += (label == layers[n].front() ? "" : " + ") + nameOf(grid, label);
      any |= present.contains(label);
    }
    if (!any)
      throw InputError("`order` " + order + ": no cell has the label " +
                       nameOf(grid, layers[n].front()));
    found.mixed |= layers[n].size() > 1;
  }
  found.layers = layersLike(grid, found, name);
  return found;
}

LayerVolume layersLike(const LabelGrid& grid, const LabelLayers& example, const std::string& name) {
  LayerVolume layers(grid.size());
  for (std::size_t p = 0; p < layers.count(); ++p) {
    const Label label = grid.cells.data()[p];
    layers.data()[p] = label < example.layerOf.size() ? example.layerOf[label] : std::uint8_t{0};
    if (layers.data()[p] == 0)
      throw InputError(name + ": the label " + nameOf(grid, label) + " is in none of the layers");
  }
  return layers;
}

}  // namespace exemplar
