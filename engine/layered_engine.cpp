// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Layered shape synthesis of pictures: from a picture to its layers, to new layers, to a new
// picture.

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "core/memory.h"
#include "engine/engines.h"
#include "engine/layered_settings.h"
#include "engine/words.h"
#include "maps/fill_smoothly.h"
#include "synth/layered/regions.h"

namespace exemplar {
namespace {

/// How much of a control map's changes within layers guides the texture. With all of it a texture
/// shows rings where a layer is wider than the example shows often.
constexpr float kWithinLayers = 1.0f / 3;

std::string pixelsText(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height) + " pixels";
}

/// What the texture is compared by; where there is a hole, it is filled from around it.
MapLayer pictureWithout(const Shape& hole, const MapLayer& picture) {
  if (hole.empty()) return picture;
  Planes planes = planesOf(picture);
  fillSmoothly(planes, hole);
  MapLayer filled{picture.name, {}, picture.bits};
  for (const Array3D<float>& plane : planes) filled.planes.push_back(gridOf(plane));
  return filled;
}

/// The example's layers: as an artist gave them, or found.
Decomposition layersOf(const Example& example, const LayeredSettings& settings, const Shape& hole,
                       const Progress& progress) {
  const MapLayer picture = pictureWithout(hole, example.map().layers.front());
  if (!settings.layersFrom.empty()) {
    const LayerMap map = readLayerMap(settings.layersFrom);
    if (!map.sameSize(picture.planes.front())) {
      throw InputError(settings.layersFrom + ": " + pixelsText(map.width(), map.height()) +
                       "; it must have the size of " + example.name());
    }
    if (layerCount(map) < 2)
      throw InputError(settings.layersFrom + ": one gray; a layer map has two or more");
    Decomposition given{boxOf(map), {}, 0};
    given.shares = layerShares(given.map, layerCount(map));
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

/// The part of the example that is to be filled; empty where there is none.
Shape holeOf(const std::string& path, const Example& example, Warnings& warnings) {
  if (path.empty()) return {};
  const Map& map = example.map();
  const MapLayer picture = readOpaqueMapLayer(path, "inpaint");
  const Grid<float>& white = picture.planes.front();
  if (!white.sameSize(map.layers.front().planes.front())) {
    throw InputError(path + ": " + pixelsText(white.width(), white.height()) + "; " +
                     example.name() + " has " + pixelsText(map.width(), map.height()) +
                     ", and the two must be of one size");
  }
  for (const Grid<float>& plane : picture.planes)
    if (plane != white)
      throw InputError(path + ": has colors; what is to be filled is said in black and white");
  Shape hole(Vec3i{white.width(), white.height(), 1});
  for (std::size_t p = 0; p < hole.count(); ++p) hole.data()[p] = white[p] > 0.5f;
  if (std::ranges::any_of(white.values(), [](float value) { return value > 0 && value < 1; }))
    warnings.push_back(path + ": has grays; what is more than half white is filled");
  const std::int64_t cells = insideOf(hole);
  if (cells == 0) throw InputError(path + ": nothing is white, so that nothing is to be filled");
  if (cells == static_cast<std::int64_t>(hole.count()))
    throw InputError(path + ": all is white; the example must be known somewhere");
  return hole;
}

LayerVolume paintedLayers(const std::string& path, int layers, const Vec3i& size) {
  const LayerMap painted = readLayerMap(path, layers);
  if (painted.width() != size.x || painted.height() != size.y) {
    throw InputError(path + ": " + pixelsText(painted.width(), painted.height()) +
                     "; the result has " + std::to_string(size.x) + " x " + std::to_string(size.y) +
                     ", as `size` says");
  }
  return boxOf(painted);
}

void noteLayers(const Decomposition& found, const SynthesizedLayers& made, Result& result) {
  std::string shares;
  for (const double share : found.shares)
    shares += (shares.empty() ? "" : ", ") + numberText(std::round(100 * share)) + " %";
  result.notes.emplace_back("layers", "bottom up " + shares);
  for (std::size_t n = 0; n < found.shares.size(); ++n)
    result.statistics.emplace_back("share_of_layer_" + std::to_string(n + 1), found.shares[n]);
  warnOfAreas(made, static_cast<int>(found.shares.size()), result);
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
    const bool fills = request.settings.has("inpaint");
    const Vec3d usual = fills ? Vec3d{1, 1, 1} : Vec3d{2, 2, 1};
    Vec3i size = resultSize(request, {map.width(), map.height(), 1}, usual, "pixels");
    size.z = 1;
    return size;
  }
  std::span<const Setting> settings() const override { return layeredPictureSettings().settings(); }
  std::span<const std::string_view> honors() const override { return {}; }

 protected:
  void checkFurther(const Request& request, std::size_t) const override {
    layeredPictureSettingsOf(request);
  }
  Result synthesize(std::span<const Example> examples, const Request& request,
                    const Progress& progress) const override {
    const Example& example = examples.front();
    const Map& map = example.map();
    LayeredSettings settings = layeredPictureSettingsOf(request);
    const Vec3i size = extentOf(examples, request);
    const double planes = static_cast<double>(map.planes().size());
    requireMemory(
        (140 + 16 * planes) * size.x * size.y + (240 + 16 * planes) * map.width() * map.height(),
        "layered synthesis", "ask for a smaller `size`");
    requireTexturePatch({map.width(), map.height(), 1}, settings.texture);
    Result result;
    const Shape hole = holeOf(settings.inpaint, example, result.warnings);
    const Decomposition found = layersOf(example, settings, hole, progress.part(0, 0.15));
    const int layers = layerCount(found.map);
    if (found.skipping > 0.15 && !settings.regions) {
      result.warnings.push_back(
          numberText(std::round(100 * found.skipping)) +
          " % of the steps between layers skip one, so that these are not layers on each other; "
          "try fewer `layers`, another `order`, or `regions`");
    }
    if (const double placed = placedShare(found.map); settings.regions && placed > 0.5) {
      result.warnings.push_back(
          "the halves of the example share " + numberText(std::round(100 * (1 - placed))) +
          " % of their regions: it is a scene, with a top and a bottom or sides, and `regions` "
          "knows no places; leave it out and give `paint`, or crop to what is alike everywhere");
    }
    const bool directed = orientation(found.map) > 1.5;
    settings.layers.shape.turns = settings.turns > 0 ? settings.turns : directed ? 2 : 4;
    SynthesizedLayers made;
    LayerVolume painted;
    if (!settings.paint.empty()) painted = paintedLayers(settings.paint, layers, size);
    if (!painted.empty() && settings.layers.paintLevels == 0) {
      made.map = painted;
    } else {
      if (!painted.empty()) {
        painted = withStrips(painted, found.map);
        settings.layers.paint = &painted;
      }
      if (!hole.empty()) settings.layers.hole = &hole;
      made = settings.regions
                 ? synthesizeRegions(found.map, size, settings.layers, progress.part(0.15, 0.5))
                 : synthesizeLayers(found.map, size, settings.layers, progress.part(0.15, 0.5));
    }
    Planes exampleGuide, guide;
    if (settings.regions) {
      exampleGuide = regionGuides(found.map, layers);
      guide = regionGuides(made.map, layers);
    } else {
      ControlMaps control =
          controlMaps(found.map, false, made.map, hole.empty(), progress.part(0.5, 0.55));
      control.soften(kWithinLayers);
      exampleGuide.push_back(std::move(control.example));
      guide.push_back(std::move(control.result));
    }
    GuidedTexture texture = synthesizeTexture(map, std::move(exampleGuide), std::move(guide), hole,
                                              settings.texture, progress.part(0.55, 1));
    result.statistics = {{"layer_count", std::int64_t{layers}},
                         {"orientations", std::int64_t{settings.layers.shape.turns}},
                         {"skipping", skippingShare(made.map)},
                         {"skipping_example", found.skipping}};
    noteLayers(found, made, result);
    warnOfDealing(made, settings.layers.shape.assignment, result);
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
