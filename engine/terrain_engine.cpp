// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Terrain synthesis: from height maps to a height map.

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "core/memory.h"
#include "engine/engines.h"
#include "engine/words.h"
#include "synth/terrain/terrain.h"

namespace exemplar {
namespace {

/// What the synthesis takes, for each point of the result and of the examples, bytes.
constexpr double kBytesOfResult = 80, kBytesOfExample = 40;

const SettingTable<TerrainSynthesisOptions>& terrainSettings() {
  using O = TerrainSynthesisOptions;
  static const SettingTable<O> table{
      {{.key = "levels",
        .type = SettingType::Integer,
        .meaning = "resolutions on which it is made, each half the one before; more of them move "
                   "larger shapes",
        .least = 1,
        .most = 12,
        .byDefault = "found from the example's size"},
       [](const Setting& setting, const std::string& text, O& o) {
         o.levels = static_cast<int>(readInteger(setting, text));
       }},
      settingRow<O>("rounds", &O::rounds, "rounds of matching and voting on each", {1, 50}),
      settingRow<O>("evenness", &O::evenness,
                    "how much it costs to use a part of the example more often than others",
                    kFromZero),
      {{.key = "orientations",
        .type = SettingType::Integer,
        .meaning = "in how many orientations the example is used: 1, 2 (turned by half), 4 (by "
                   "quarters) or 8 (and mirrored)",
        .least = 1,
        .most = 8,
        .byDefault = "8, or those that keep the direction of ridges and valleys"},
       [](const Setting& setting, const std::string& text, O& o) {
         switch (readInteger(setting, text)) {
           case 1:
             o.turns = {0};
             break;
           case 2:
             o.turns = {0, 2};
             break;
           case 4:
             o.turns = {0, 1, 2, 3};
             break;
           case 8:
             o.turns = {0, 1, 2, 3, 4, 5, 6, 7};
             break;
           default:
             throw InputError("`orientations` " + text + ": expected 1, 2, 4 or 8");
         }
       }},
      settingRow<O>("drain", &O::drains,
                    "give every hollow an outlet, so that water runs to the border")};
  return table;
}

/// The heights as a grid.
Grid<float> gridOf(const HeightMap& map) {
  Grid<float> grid(map.width, map.height);
  std::ranges::copy(map.heights, grid.values().begin());
  return grid;
}

class TerrainEngine final : public Engine {
 public:
  std::string_view name() const override { return "terrain"; }
  std::string_view meaning() const override {
    return "terrain synthesis: a height map's ridges and valleys, coarse to fine, whose rivers run "
           "to the border (after Zhou, Sun, Turk, Rehg 2007 and Gain, Merry, Marais 2015)";
  }
  Form form() const override { return Form::Heights; }
  Vec3i extentOf(std::span<const Example> examples, const Request& request) const override {
    const HeightMap& map = examples.front().heights();
    Vec3i size = resultSize(request, {map.width, map.height, 1}, {2, 2, 1}, "points");
    size.z = 1;
    return size;
  }
  std::span<const Setting> settings() const override { return terrainSettings().settings(); }
  std::span<const std::string_view> honors() const override {
    static constexpr std::string_view keys[] = {"periodic"};
    return keys;
  }
  bool mixes() const override { return true; }

 protected:
  void checkFurther(const Request& request, std::size_t) const override {
    if (request.periodic.z) throw InputError("`periodic` z: height maps tile along x and y");
  }
  Result synthesize(std::span<const Example> examples, const Request& request,
                    const Progress& progress) const override {
    const Vec3i size = extentOf(examples, request);
    double points = 0;
    std::vector<Grid<float>> heights;
    for (const Example& example : examples) {
      heights.push_back(gridOf(example.heights()));
      points += static_cast<double>(heights.back().count());
    }
    requireMemory(kBytesOfResult * size.x * size.y + kBytesOfExample * points, "terrain synthesis",
                  "ask for a smaller `size`");
    TerrainSynthesisOptions options;
    terrainSettings().apply(request.settings, options);
    options.width = size.x;
    options.height = size.y;
    options.seed = request.seed;
    options.wrapsX = request.periodic.x;
    options.wrapsY = request.periodic.y;
    SynthesizedTerrain made = synthesizeTerrain(heights, options, progress);

    Result result;
    HeightMap map = examples.front().heights();
    map.width = size.x;
    map.height = size.y;
    map.heights.assign(made.heights.values().begin(), made.heights.values().end());
    result.data = std::move(map);
    result.heightOrigins = std::move(made.origins);
    result.statistics = {{"levels", std::int64_t{made.levels}},
                         {"orientations", static_cast<std::int64_t>(made.turns.size())},
                         {"outlets", made.outlets},
                         {"deepest_cut", made.deepestCut},
                         {"mean_cut", made.meanCut}};
    return result;
  }
};

}  // namespace

const Engine& terrainEngine() {
  static const TerrainEngine engine;
  return engine;
}

}  // namespace exemplar
