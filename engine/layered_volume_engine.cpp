// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Layered shape synthesis of volumes: from labels to the layers they form, to new layers, and to
// labels from where each cell came from.

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "core/memory.h"
#include "engine/engines.h"
#include "engine/label_layers.h"
#include "engine/layered_settings.h"
#include "engine/words.h"
#include "synth/layered/regions.h"

namespace exemplar {
namespace {

/// Warns where the example's layers at its bottom are others than at its top: the result tiles
/// upward, too.
void warnOfGround(const LayerVolume& layers, int count, Result& result) {
  const Vec3i& size = layers.size();
  if (size.z < 8) return;
  const int slab = std::max(1, size.z / 10);
  std::vector<double> bottom(static_cast<std::size_t>(count) + 1), top = bottom;
  const double each = 1.0 / (static_cast<double>(slab) * size.x * size.y);
  for (std::size_t p = 0; p < layers.count(); ++p) {
    const int z = layers.ijk(p).z;
    if (z < slab) bottom[layers.data()[p]] += each;
    if (z >= size.z - slab) top[layers.data()[p]] += each;
  }
  double differs = 0;
  for (std::size_t k = 0; k < top.size(); ++k) differs += std::abs(top[k] - bottom[k]) / 2;
  if (differs > 0.5)
    result.warnings.emplace_back(
        "the example's top and bottom are of different layers, as of ground below air; layers are "
        "made alike at every height, so that the result is ground and air all through");
}

/// What patches of labels are compared by: their colors, where a layer has several.
Planes lookPlanes(const LabelGrid& grid, const LabelLayers& layers) {
  if (!layers.mixed) return {};
  Planes planes(3, Array3D<float>(grid.size()));
  for (std::size_t p = 0; p < grid.cells.count(); ++p)
    for (std::size_t c = 0; c < 3; ++c)
      planes[c].data()[p] = grid.labels[grid.cells.data()[p]].color[c];
  return planes;
}

class LayeredVolumeEngine final : public Engine {
 public:
  std::string_view name() const override { return "layered-volume"; }
  std::string_view meaning() const override {
    return "layered shape synthesis in space: a volume's labels as layers (lichen on stone, a core "
           "in a crust), new ones with surfaces like theirs; what layered is for labels (after "
           "Rosenberger, Cohen-Or, Lischinski 2009)";
  }
  Form form() const override { return Form::Labels; }
  bool accepts(const Example& example) const override {
    return example.form() == form() && std::holds_alternative<std::monostate>(example.content);
  }
  Vec3i extentOf(std::span<const Example> examples, const Request& request) const override {
    const Vec3i& size = examples.front().labels().size();
    Vec3d usual{2, 2, 2};
    for (int axis = 0; axis < 3; ++axis)
      if (size[axis] == 1) usual[axis] = 1;
    const Vec3i wanted = resultSize(request, size, usual, "cells");
    if ((wanted.z == 1) != (size.z == 1))
      throw InputError(
          "`size`: the result of a volume is a volume, and that of a flat grid is "
          "flat, not " +
          readableSize(wanted, "cells"));
    return wanted;
  }
  std::span<const Setting> settings() const override { return layeredVolumeSettings().settings(); }
  std::span<const std::string_view> honors() const override { return {}; }

 protected:
  void checkFurther(const Request& request, std::size_t) const override {
    layeredVolumeSettingsOf(request);
  }
  Result synthesize(std::span<const Example> examples, const Request& request,
                    const Progress& progress) const override {
    const Example& example = examples.front();
    const LabelGrid& grid = example.labels();
    LayeredSettings settings = layeredVolumeSettingsOf(request);
    const Vec3i size = extentOf(examples, request);
    requireMemory(
        160.0 * static_cast<double>(volume(size)) + 200.0 * static_cast<double>(grid.cells.count()),
        "layered synthesis", "ask for a smaller `size`");
    requireTexturePatch(grid.size(), settings.texture);
    const LabelLayers found = layersOfLabels(grid, settings.order, example.name());
    const int count = layerCount(found.layers);
    Result result;
    result.notes.emplace_back("layers", "bottom up " + found.order);
    warnOfGround(found.layers, count, result);
    const bool directed = orientation(found.layers) > 1.5;
    settings.layers.shape.turns = settings.turns > 0 ? settings.turns : directed ? 2 : 4;
    const Progress part = progress.part(0, 0.6);
    const SynthesizedLayers made =
        settings.regions ? synthesizeRegions(found.layers, size, settings.layers, part)
                         : synthesizeLayers(found.layers, size, settings.layers, part);
    warnOfAreas(made, count, result);
    warnOfDealing(made, settings.layers.shape.assignment, result);
    const TextureOrigins from =
        originsOf(grid, found, made.map, settings.texture, progress.part(0.6, 1));
    LabelGrid labels{Array3D<Label>(size), grid.labels, grid.cellSize, grid.origin, grid.name};
    result.origins = Origins(size);
    for (std::size_t p = 0; p < from.count(); ++p) {
      labels.cells.data()[p] = grid.cells[from.data()[p]];
      result.origins.data()[p] = Origin(from.data()[p]);
    }
    result.statistics = {{"layer_count", std::int64_t{count}},
                         {"orientations", std::int64_t{settings.layers.shape.turns}},
                         {"skipping", skippingShare(made.map)},
                         {"skipping_example", skippingShare(found.layers)}};
    result.data = std::move(labels);
    result.exampleLayers = found.layers;
    result.layers = made.map;
    return result;
  }

 private:
  /// For each cell of the result a cell of the example in the same layer.
  static TextureOrigins originsOf(const LabelGrid& grid, const LabelLayers& example,
                                  const LayerVolume& made, const TextureOptions& options,
                                  const Progress& progress) {
    ControlMaps control = controlMaps(example.layers, false, made, true, progress.part(0, 0.1));
    TextureTask task;
    task.example = lookPlanes(grid, example);
    task.exampleGuide.push_back(std::move(control.example));
    task.guide.push_back(std::move(control.result));
    return layerOrigins(matchTexture(task, options, progress.part(0.1, 0.9)), task, example.layers,
                        made, options);
  }
};

}  // namespace

const Engine& layeredVolumeEngine() {
  static const LayeredVolumeEngine engine;
  return engine;
}

}  // namespace exemplar
