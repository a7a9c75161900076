// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Layered shape synthesis: from a picture to its layers, to new layers, to a new picture.

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "core/memory.h"
#include "engine/engines.h"
#include "engine/words.h"
#include "synth/layered/layers.h"
#include "synth/layered/texture_by_numbers.h"

namespace exemplar {
namespace {

enum class PictureKind { Auto, Texture, Heights };

struct LayeredSettings {
  DecompositionOptions decomposition;
  PictureKind kind = PictureKind::Auto;
  std::string order, layersFrom, paint;
  int turns = 0;  ///< 0: found
  LayerOptions layers;
  TextureOptions texture{.guide = 3};
};

const SettingTable<LayeredSettings>& layeredSettings() {
  using O = LayeredSettings;
  static const SettingTable<O> table{
      settingRow<O>("layers", [](O& o) -> int& { return o.decomposition.layers; },
                    "how many layers the picture is decomposed into", {2, kMostLayers}),
      choiceRow<O, PictureKind>("kind", &O::kind,
                                "what the picture is: a texture, whose layers are clusters of "
                                "neighborhoods, or heights, whose layers lie between contour lines "
                                "(auto: heights where it is gray and of 16 bits)",
                                {{"auto", PictureKind::Auto},
                                 {"texture", PictureKind::Texture},
                                 {"heights", PictureKind::Heights}}),
      settingRow<O>(
          "neighborhood", [](O& o) -> int& { return o.decomposition.neighborhood; },
          "side of the neighborhoods that are clustered, odd", {5, 31}, "pixels"),
      settingRow<O>("order", &O::order,
                    "the clusters from the bottom up, by size: 2,1,3 puts the second largest below "
                    "the largest",
                    {}, "", "so that as few steps as possible skip a layer"),
      {{.key = "layers-from",
        .type = SettingType::File,
        .meaning = "a gray picture of the example's size whose grays are its layers, dark to "
                   "light, in place of the decomposition"},
       [](const Setting&, const std::string& text, O& o) { o.layersFrom = text; }},
      {{.key = "paint",
        .type = SettingType::File,
        .meaning = "a gray picture of the layers that the result should have, in the grays that "
                   "--write-layers writes"},
       [](const Setting&, const std::string& text, O& o) { o.paint = text; }},
      settingRow<O>(
          "shape-patch", [](O& o) -> int& { return o.layers.shape.patch; },
          "side of the patches around the layers' boundaries, odd", {9, BoundaryPatches::kMostSide},
          "pixels"),
      settingRow<O>("shape-levels", [](O& o) -> int& { return o.layers.shape.levels; },
                    "resolutions on which layers are made, each half the one before", {1, 7}),
      settingRow<O>("shape-iterations", [](O& o) -> int& { return o.layers.shape.iterations; },
                    "rounds of matching and voting on each, at most", {1, 50}),
      {{.key = "orientations",
        .type = SettingType::Integer,
        .meaning = "in how many orientations patches are used: 1, 2 (turned by half), 4 (by "
                   "quarters) or 8 (and mirrored)",
        .least = 1,
        .most = 8,
        .byDefault = "4; 2 where the layers have a direction"},
       [](const Setting& setting, const std::string& text, O& o) {
         o.turns = static_cast<int>(readInteger(setting, text));
         if (o.turns != 1 && o.turns != 2 && o.turns != 4 && o.turns != 8)
           throw InputError("`orientations` " + text + ": expected 1, 2, 4 or 8");
       }},
      choiceRow<O, AssignmentKind>(
          "assignment", [](O& o) -> AssignmentKind& { return o.layers.shape.assignment; },
          "how the example's patches are dealt out: cheapest pairs first, or, on levels of up to "
          "2,000 patches, the optimum",
          {{"greedy", AssignmentKind::Greedy}, {"exact", AssignmentKind::Exact}}),
      settingRow<O>(
          "texture-patch", [](O& o) -> int& { return o.texture.patch; },
          "side of the patches of the texture, odd", {3, 9}, "pixels"),
      settingRow<O>("texture-levels", [](O& o) -> int& { return o.texture.levels; },
                    "resolutions on which the texture is made, each half the one before", {1, 8}),
      settingRow<O>("texture-rounds", [](O& o) -> int& { return o.texture.rounds; },
                    "rounds of search and vote on each", {1, 20}),
      settingRow<O>(
          "follow", [](O& o) -> double& { return o.texture.guide; },
          "how strictly the texture follows the layers", kAboveZero),
      settingRow<O>(
          "evenness", [](O& o) -> double& { return o.texture.evenness; },
          "how much it costs to use a part of the example more often than others", kFromZero)};
  return table;
}

void requireOdd(int value, const char* key) {
  if (value % 2 == 0)
    throw InputError("`" + std::string(key) + "` " + std::to_string(value) +
                     ": expected an odd number");
}

LayeredSettings settingsFrom(const Request& request) {
  LayeredSettings settings;
  layeredSettings().apply(request.settings, settings);
  requireOdd(settings.decomposition.neighborhood, "neighborhood");
  requireOdd(settings.layers.shape.patch, "shape-patch");
  requireOdd(settings.texture.patch, "texture-patch");
  if (!settings.order.empty()) {
    for (const std::string& word : split(settings.order, ','))
      settings.decomposition.order.push_back(wholeNumber(parseNumber(word, "`order`"), "`order`"));
    std::vector<int> sorted = settings.decomposition.order;
    std::ranges::sort(sorted);
    for (int n = 0; n < static_cast<int>(sorted.size()); ++n) {
      if (sorted[static_cast<std::size_t>(n)] != n + 1 ||
          static_cast<int>(sorted.size()) != settings.decomposition.layers)
        throw InputError("`order` " + settings.order + ": expected each of 1 to " +
                         std::to_string(settings.decomposition.layers) + " once");
    }
  }
  settings.layers.seed = settings.texture.seed = request.seed;
  return settings;
}

/// The example's layers: as an artist gave them, or found.
Decomposition layersOf(const Example& example, const LayeredSettings& settings,
                       const Progress& progress) {
  const MapLayer& picture = example.map().layers.front();
  if (!settings.layersFrom.empty()) {
    Decomposition given{readLayerMap(settings.layersFrom), {}, 0};
    if (!given.map.sameSize(picture.planes.front())) {
      throw InputError(settings.layersFrom + ": " + std::to_string(given.map.width()) + " x " +
                       std::to_string(given.map.height()) + " pixels; it must have the size of " +
                       example.name());
    }
    if (layerCount(given.map) < 2)
      throw InputError(settings.layersFrom + ": one gray; a layer map has two or more");
    given.shares.resize(static_cast<std::size_t>(layerCount(given.map)));
    for (const std::uint8_t k : given.map.values())
      given.shares[k - 1u] += 1 / static_cast<double>(given.map.count());
    given.skipping = skippingShare(given.map);
    return given;
  }
  const bool gray = picture.planes.size() == 1;
  if (settings.kind == PictureKind::Heights && !gray)
    throw InputError("`kind` heights: " + example.name() + " is colored; heights are gray");
  const bool heights = settings.kind == PictureKind::Heights ||
                       (settings.kind == PictureKind::Auto && gray && picture.bits == 16);
  // The same layers for every seed: the example is what it is.
  return heights ? decomposeHeights(picture.planes.front(), settings.decomposition, progress)
                 : decomposeTexture(picture, settings.decomposition, 0, progress);
}

class LayeredEngine final : public Engine {
 public:
  std::string_view name() const override { return "layered"; }
  std::string_view meaning() const override {
    return "layered shape synthesis: a picture's layers (rust on paint on metal), new layers with "
           "outlines like theirs, and a texture that follows them (Rosenberger, Cohen-Or, "
           "Lischinski 2009)";
  }
  Form form() const override { return Form::Map; }
  Vec3i extentOf(std::span<const Example> examples, const Request& request) const override {
    const Map& map = examples.front().map();
    Vec3i size = resultSize(request, {map.width(), map.height(), 1}, {2, 2, 1}, "pixels");
    size.z = 1;
    return size;
  }
  std::span<const Setting> settings() const override { return layeredSettings().settings(); }
  std::span<const std::string_view> honors() const override { return {}; }

 protected:
  void checkFurther(const Request& request, std::size_t) const override { settingsFrom(request); }
  Result synthesize(std::span<const Example> examples, const Request& request,
                    const Progress& progress) const override {
    const Example& example = examples.front();
    const Map& map = example.map();
    LayeredSettings settings = settingsFrom(request);
    const Vec3i size = extentOf(examples, request);
    const double planes = static_cast<double>(map.planes().size());
    requireMemory(
        (120 + 16 * planes) * size.x * size.y + (240 + 16 * planes) * map.width() * map.height(),
        "layered synthesis", "ask for a smaller `size`");
    Result result;
    const Decomposition found = layersOf(example, settings, progress.part(0, 0.15));
    const int layers = layerCount(found.map);
    if (found.skipping > 0.15) {
      result.warnings.push_back(
          numberText(std::round(100 * found.skipping)) +
          " % of the steps between layers skip one, so that these are not layers on each other; "
          "try fewer `layers`, or another `order`");
    }
    const bool directed = orientation(found.map) > 1.5;
    settings.layers.shape.turns = settings.turns > 0 ? settings.turns : directed ? 2 : 4;
    SynthesizedLayers made;
    if (settings.paint.empty()) {
      made = synthesizeLayers(found.map, size.x, size.y, settings.layers, progress.part(0.15, 0.5));
    } else {
      made.map = readLayerMap(settings.paint, layers);
      if (made.map.width() != size.x || made.map.height() != size.y) {
        throw InputError(settings.paint + ": " + std::to_string(made.map.width()) + " x " +
                         std::to_string(made.map.height()) + " pixels; the result has " +
                         std::to_string(size.x) + " x " + std::to_string(size.y) +
                         ", as `size` says");
      }
    }
    for (std::size_t n = 0; n < made.areaErrors.size(); ++n) {
      if (std::abs(made.areaErrors[n]) > 1e-3)
        result.warnings.push_back("layer " + std::to_string(n + 2) + " covers " +
                                  numberText(std::round(1e4 * made.areaErrors[n]) / 100) +
                                  " % of the result more than of the example: the layer below "
                                  "leaves it too little room");
    }
    const ControlMaps control = controlMaps(found.map, false, made.map, progress.part(0.5, 0.55));
    GuidedTexture texture = synthesizeTexture(map, control.example, control.result,
                                              settings.texture, progress.part(0.55, 1));
    std::string shares;
    for (const double share : found.shares)
      shares += (shares.empty() ? "" : ", ") + numberText(std::round(100 * share)) + " %";
    result.notes.emplace_back("layers", "bottom up " + shares);
    result.statistics = {{"layer_count", std::int64_t{layers}},
                         {"orientations", std::int64_t{settings.layers.shape.turns}},
                         {"skipping", skippingShare(made.map)},
                         {"skipping_example", found.skipping}};
    for (std::size_t n = 0; n < found.shares.size(); ++n)
      result.statistics.emplace_back("share_of_layer_" + std::to_string(n + 1), found.shares[n]);
    result.data = std::move(texture.map);
    result.exampleLayers = found.map;
    result.layers = std::move(made.map);
    return result;
  }
};

}  // namespace

const Engine& layeredEngine() {
  static const LayeredEngine engine;
  return engine;
}

}  // namespace exemplar
