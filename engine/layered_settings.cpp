// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/layered_settings.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "engine/words.h"

namespace exemplar {
namespace {

using O = LayeredSettings;
using Row = SettingTable<O>::Row;

Row fileRow(std::string key, std::string O::*member, std::string meaning) {
  return {{.key = std::move(key), .type = SettingType::File, .meaning = std::move(meaning)},
          [member](const Setting&, const std::string& text, O& o) { o.*member = text; }};
}

// Rows that pictures and volumes share.

Row shapePatch(int usual) {
  Row row = settingRow<O>(
      "shape-patch", [](O& o) -> int& { return o.layers.shape.patch; },
      "side of the patches around the layers' boundaries, odd", {5, BoundaryPatches::kMostSide},
      "cells", std::to_string(usual));
  return row;
}
Row shapeLevels() {
  return settingRow<O>("shape-levels", [](O& o) -> int& { return o.layers.shape.levels; },
                       "resolutions on which layers are made, each half the one before", {1, 7});
}
Row shapeIterations() {
  return settingRow<O>("shape-iterations", [](O& o) -> int& { return o.layers.shape.iterations; },
                       "rounds of matching and voting on each, at most", {1, 50});
}
Row orientations() {
  return {{.key = "orientations",
           .type = SettingType::Integer,
           .meaning = "in how many orientations patches are used, seen from above: 1, 2 (turned by "
                      "half), 4 (by quarters) or 8 (and mirrored)",
           .least = 1,
           .most = 8,
           .byDefault = "4; 2 where the layers have a direction"},
          [](const Setting& setting, const std::string& text, O& o) {
            o.turns = static_cast<int>(readInteger(setting, text));
            if (o.turns != 1 && o.turns != 2 && o.turns != 4 && o.turns != 8)
              throw InputError("`orientations` " + text + ": expected 1, 2, 4 or 8");
          }};
}
Row assignment() {
  return choiceRow<O, AssignmentKind>(
      "assignment", [](O& o) -> AssignmentKind& { return o.layers.shape.assignment; },
      "how the example's patches are dealt out: cheapest pairs first, or the optimum, which takes "
      "longer",
      {{"greedy", AssignmentKind::Greedy}, {"exact", AssignmentKind::Exact}});
}
Row certainty() {
  return choiceRow<O, CertaintyKind>(
      "certainty", [](O& o) -> CertaintyKind& { return o.layers.shape.certainty; },
      "what decides how certain votes must be to change a shape: the length of its boundary, or, "
      "as "
      "in the paper, its area",
      {{"boundary", CertaintyKind::Boundary}, {"area", CertaintyKind::Area}});
}
Row joint() {
  return settingRow<O>(
      "joint", [](O& o) -> bool& { return o.layers.shape.joint; },
      "compare patches by the layer below, too, at half weight");
}
Row regions() {
  return settingRow<O>("regions", &O::regions,
                       "regions lie beside each other, without an order: each two have boundary "
                       "patches of their own");
}
Row textureLevels() {
  return settingRow<O>("texture-levels", [](O& o) -> int& { return o.texture.levels; },
                       "resolutions on which the texture is made, each half the one before",
                       {1, 8});
}
Row texturePatch(int usual) {
  return settingRow<O>(
      "texture-patch", [](O& o) -> int& { return o.texture.patch; },
      "side of the patches of the texture, odd", {3, 9}, "cells", std::to_string(usual));
}
Row textureRounds(int usual) {
  return settingRow<O>(
      "texture-rounds", [](O& o) -> int& { return o.texture.rounds; },
      "rounds of search and vote on each", {1, 20}, "", std::to_string(usual));
}
Row follow() {
  return settingRow<O>(
      "follow", [](O& o) -> double& { return o.texture.guide; },
      "how strictly the texture follows the layers", kAboveZero);
}
Row evenness() {
  return settingRow<O>(
      "evenness", [](O& o) -> double& { return o.texture.evenness; },
      "how much it costs to use a part of the example more often than others", kFromZero);
}

// What volumes take in place of a picture's values: patches have a third side.
constexpr int kVolumeShapePatch = 9, kVolumeTexturePatch = 3, kVolumeTextureRounds = 2;

void requireOdd(int value, const char* key) {
  if (value % 2 == 0)
    throw InputError("`" + std::string(key) + "` " + std::to_string(value) +
                     ": expected an odd number");
}

LayeredSettings settingsOf(const Request& request, const SettingTable<O>& table,
                           LayeredSettings settings) {
  table.apply(request.settings, settings);
  requireOdd(settings.decomposition.neighborhood, "neighborhood");
  requireOdd(settings.layers.shape.patch, "shape-patch");
  requireOdd(settings.texture.patch, "texture-patch");
  if (settings.regions) {
    for (const char* key : {"certainty", "joint", "paint", "inpaint"})
      if (request.settings.has(key))
        throw InputError("`" + std::string(key) +
                         "`: is of layers on each other; leave it out, or `regions`");
  }
  settings.layers.seed = settings.texture.seed = request.seed;
  return settings;
}

}  // namespace

const SettingTable<LayeredSettings>& layeredPictureSettings() {
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
      fileRow("layers-from", &O::layersFrom,
              "a gray picture of the example's size whose grays are its layers, dark to light, in "
              "place of the decomposition"),
      fileRow("paint", &O::paint,
              "a gray picture of the layers that the result should have, in the grays that "
              "--write-layers writes"),
      settingRow<O>(
          "paint-levels", [](O& o) -> int& { return o.layers.paintLevels; },
          "on how many resolutions painted layers are given outlines like the example's; 0 keeps "
          "them as they are painted",
          {0, 7}),
      fileRow("inpaint", &O::inpaint,
              "a gray picture of the example's size, white where the example is to be filled anew; "
              "the rest of it stays as it is"),
      shapePatch(ShapeOptions{}.patch),
      shapeLevels(),
      shapeIterations(),
      orientations(),
      assignment(),
      certainty(),
      joint(),
      regions(),
      choiceRow<O, TextureMethod>(
          "texture", [](O& o) -> TextureMethod& { return o.texture.method; },
          "how the texture is made: by patch optimization, or pixel by pixel in scan order "
          "(classic texture by numbers)",
          {{"patches", TextureMethod::Patches}, {"classic", TextureMethod::Classic}}),
      texturePatch(TextureOptions{}.patch),
      textureLevels(),
      textureRounds(TextureOptions{}.rounds),
      settingRow<O>(
          "coherence", [](O& o) -> double& { return o.texture.coherence; },
          "with the classic texture: how much worse a match may be that continues a neighbor's",
          {0, 50}),
      follow(),
      evenness()};
  return table;
}

const SettingTable<LayeredSettings>& layeredVolumeSettings() {
  static const SettingTable<O> table{
      settingRow<O>("order", &O::order,
                    "the labels from the bottom up, by number or name, those of one layer joined: "
                    "air,stone+ore,lichen",
                    {}, "",
                    "what is empty at the bottom, then so that as few steps as possible skip one"),
      shapePatch(kVolumeShapePatch),
      shapeLevels(),
      shapeIterations(),
      orientations(),
      assignment(),
      certainty(),
      joint(),
      regions(),
      texturePatch(kVolumeTexturePatch),
      textureLevels(),
      textureRounds(kVolumeTextureRounds),
      follow(),
      evenness()};
  return table;
}

void warnOfAreas(const SynthesizedLayers& made, int count, Result& result) {
  // Of regions the first is counted, too.
  const std::size_t first = static_cast<std::size_t>(count) - made.areaErrors.size() + 1;
  for (std::size_t n = 0; n < made.areaErrors.size(); ++n) {
    if (std::abs(made.areaErrors[n]) <= 1e-3) continue;
    const double more = std::round(1e4 * made.areaErrors[n]) / 100;
    result.warnings.push_back("layer " + std::to_string(n + first) + " covers " + numberText(more) +
                              " % of the result more than it should: what it lies on or beside "
                              "leaves it no other room");
  }
}

void warnOfDealing(const SynthesizedLayers& made, AssignmentKind asked, Result& result) {
  if (asked != AssignmentKind::Exact || made.dealtExactly) return;
  result.warnings.push_back(
      "`assignment` exact: there are more than " + std::to_string(kMostExactPairs) +
      " pairs of a patch and one of the example, so that those were dealt out greedily; ask for a "
      "smaller `size`, or crop the example");
}

LayeredSettings layeredPictureSettingsOf(const Request& request) {
  LayeredSettings settings = settingsOf(request, layeredPictureSettings(), {});
  if (!settings.inpaint.empty()) {
    if (!settings.paint.empty())
      throw InputError("`inpaint` and `paint` both say what the result is; give one of the two");
    if (request.extent.size || request.extent.scale)
      throw InputError(
          "`inpaint`: the result has the example's size; leave out `size` and `scale`");
    settings.texture.wraps = false;
  }
  if (request.settings.has("paint-levels") && settings.paint.empty())
    throw InputError("`paint-levels`: has no effect without `paint`");
  if (settings.texture.method == TextureMethod::Classic) {
    for (const char* key : {"texture-rounds", "evenness"})
      if (request.settings.has(key))
        throw InputError("`" + std::string(key) + "`: only `texture` patches has it; leave it out");
  } else if (request.settings.has("coherence")) {
    throw InputError("`coherence`: only `texture` classic has it; leave it out");
  }
  if (settings.order.empty()) return settings;
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
  return settings;
}

LayeredSettings layeredVolumeSettingsOf(const Request& request) {
  LayeredSettings usual;
  usual.layers.shape.patch = kVolumeShapePatch;
  usual.texture.patch = kVolumeTexturePatch;
  usual.texture.rounds = kVolumeTextureRounds;
  return settingsOf(request, layeredVolumeSettings(), usual);
}

}  // namespace exemplar
