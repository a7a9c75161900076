// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Terrain synthesis: from height maps to a height map.

#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "core/error.h"
#include "core/memory.h"
#include "engine/engines.h"
#include "engine/terrain_control.h"
#include "engine/words.h"
#include "synth/terrain/terrain.h"

namespace exemplar {
namespace {

/// What the synthesis takes, for each point of the result and of the examples, bytes.
constexpr double kBytesOfResult = 80, kBytesOfExample = 40;

struct TerrainSettings {
  TerrainSynthesisOptions synthesis;
  TerrainFiles files;
  bool fill = false, keepHoles = false;
};

SettingTable<TerrainSettings>::Row fileRow(std::string key, std::string TerrainFiles::*member,
                                           std::string meaning) {
  return {{.key = std::move(key), .type = SettingType::File, .meaning = std::move(meaning)},
          [member](const Setting&, const std::string& text, TerrainSettings& o) {
            o.files.*member = text;
          }};
}

const SettingTable<TerrainSettings>& terrainSettings() {
  using O = TerrainSettings;
  static const SettingTable<O> table{
      {{.key = "levels",
        .type = SettingType::Integer,
        .meaning = "resolutions on which it is made, each half the one before; more of them move "
                   "larger shapes",
        .least = 1,
        .most = 12,
        .byDefault = "found from the example's size"},
       [](const Setting& setting, const std::string& text, O& o) {
         o.synthesis.levels = static_cast<int>(readInteger(setting, text));
       }},
      settingRow<O>("rounds", [](O& o) -> int& { return o.synthesis.rounds; },
                    "rounds of matching and voting on each", {1, 50}),
      settingRow<O>(
          "piece-size", [](O& o) -> int& { return o.synthesis.piece; },
          "about how wide the pieces are that are taken from one place, on each resolution",
          {8, 24}, "points"),
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
             o.synthesis.turns = {0};
             break;
           case 2:
             o.synthesis.turns = {0, 2};
             break;
           case 4:
             o.synthesis.turns = {0, 1, 2, 3};
             break;
           case 8:
             o.synthesis.turns = {0, 1, 2, 3, 4, 5, 6, 7};
             break;
           default:
             throw InputError("`orientations` " + text + ": expected 1, 2, 4 or 8");
         }
       }},
      settingRow<O>(
          "keep-hollows", [](O& o) -> bool& { return o.synthesis.keepsHollows; },
          "cut no outlets, so that hollows hold water"),
      settingRow<O>(
          "fill", [](O& o) -> bool& { return o.fill; },
          "the result is the example itself, and its points without data become land like the "
          "rest; all others stay as they are"),
      settingRow<O>(
          "keep-holes", [](O& o) -> bool& { return o.keepHoles; },
          "the result has points without data where its pieces have them, as the example does"),
      settingRow<O>("follow", [](O& o) -> double& { return o.files.follow; },
                    "how strictly `guide` is followed", {0, 1}),
      fileRow("detail-of", &TerrainFiles::detailOf,
              "a coarse height map that gets the example's detail, at the example's resolution (4 "
              "times its own where the size of cells is not known)"),
      {{.key = "keep-at",
        .type = SettingType::Text,
        .meaning = "X,Y: where the example lies of which `keep` keeps a part, in points from the "
                   "result's top left",
        .byDefault = "in the middle"},
       [](const Setting&, const std::string& text, O& o) { o.files.at = text; }},
      fileRow("mask", &TerrainFiles::mask,
              "a gray picture, stretched over the result: white is made anew, black stays as it is "
              "in `base`"),
      fileRow("base", &TerrainFiles::base,
              "a height map of the result's size, of which `mask` leaves a part; the example "
              "itself where it is not given"),
      settingRow<O>(
          "blend", [](O& o) -> int& { return o.files.blend; },
          "width of the transition beside what stays", {0, 4096}, "points")};
  return table;
}

void warnOfHoles(std::span<const Example> examples, std::vector<std::string>& warnings) {
  for (const Example& example : examples) {
    const std::size_t holes = rangeOf(example.heights().heights)->holes;
    if (holes == 0) continue;
    warnings.push_back(example.name() + ": nothing is made of its " + counted(holes, "point") +
                       " without data; `fill` makes land of them, `keep-holes` more of them");
  }
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
    TerrainSettings settings;
    terrainSettings().apply(request.settings, settings);
    if (!settings.files.detailOf.empty()) {
      const CoarseTerrain coarse = readCoarseTerrain(settings.files.detailOf, examples.front());
      Vec3i size = scaledSize({coarse.map.width(), coarse.map.height(), 1},
                              {coarse.factor, coarse.factor, 1}, "points");
      size.z = 1;
      return size;
    }
    const bool itself = settings.fill || !settings.files.mask.empty();
    const Vec3d usual = itself ? Vec3d{1, 1, 1} : Vec3d{2, 2, 1};
    Vec3i size = resultSize(request, {map.width(), map.height(), 1}, usual, "points");
    size.z = 1;
    return size;
  }
  std::span<const Setting> settings() const override { return terrainSettings().settings(); }
  std::span<const std::string_view> honors() const override {
    static constexpr std::string_view keys[] = {"periodic", "keep", "guide"};
    return keys;
  }
  bool mixes() const override { return true; }

 protected:
  void checkFurther(const Request& request, std::size_t) const override {
    TerrainSettings settings;
    terrainSettings().apply(request.settings, settings);
    if (!settings.files.detailOf.empty() && (request.extent.size || request.extent.scale))
      throw InputError("`detail-of` says the size already; leave `size` and `scale` out");
    if (!settings.files.detailOf.empty() && request.guide)
      throw InputError("`detail-of` and `guide` both say heights; give one of the two");
    if (!settings.files.at.empty() && !request.decided.keep)
      throw InputError("`keep-at`: say with `keep` what of the example stays");
    if (!settings.files.base.empty() && settings.files.mask.empty())
      throw InputError("`base`: say with `mask` what of it is made anew");
    if (settings.fill && (request.extent.size || request.extent.scale))
      throw InputError(
          "`fill` makes the example whole, at its own size; leave `size` and `scale` out");
    if (settings.fill &&
        (request.decided.keep || !settings.files.mask.empty() || !settings.files.detailOf.empty() ||
         request.guide || settings.keepHoles)) {
      throw InputError(
          "`fill` leaves all that the example has as it is; `keep`, `mask`, `detail-of`, `guide` "
          "and "
          "`keep-holes` have no meaning beside it");
    }
    if (request.periodic.z) throw InputError("`periodic` z: height maps tile along x and y");
  }
  Result synthesize(std::span<const Example> examples, const Request& request,
                    const Progress& progress) const override {
    const Vec3i size = extentOf(examples, request);
    double points = 0;
    std::vector<Grid<float>> heights;
    for (const Example& example : examples) {
      heights.push_back(example.heights().heights);
      points += static_cast<double>(heights.back().count());
    }
    requireMemory(kBytesOfResult * size.x * size.y + kBytesOfExample * points, "terrain synthesis",
                  "ask for a smaller `size`");
    const HeightMap& first = examples.front().heights();
    TerrainSettings settings;
    terrainSettings().apply(request.settings, settings);
    TerrainSynthesisOptions& options = settings.synthesis;
    options.width = size.x;
    options.height = size.y;
    options.seed = request.seed;
    options.wrapsX = request.periodic.x;
    options.wrapsY = request.periodic.y;
    options.control.follow = settings.files.follow;
    std::optional<CoarseTerrain> coarse;
    if (request.guide) {
      TerrainGuide guide = readTerrainGuide(*request.guide, heights, first.cellSize, size.x, size.y,
                                            progress.part(0, 0.03));
      options.control.guide = std::move(guide.heights);
      options.control.guideWeight = std::move(guide.weight);
    } else if (!settings.files.detailOf.empty()) {
      coarse = readCoarseTerrain(settings.files.detailOf, examples.front());
      options.control.guide = coarse->map.heights;
      options.control.guideLevel = static_cast<int>(std::lround(std::log2(coarse->factor)));
      options.control.follow = 1;
    }
    readHeld(request.decided.keep, settings.files, examples.front(), size.x, size.y,
             options.control, progress.part(0.03, 0.05));
    if (settings.fill) holdData(examples.front(), options.control);
    std::vector<Grid<std::uint8_t>> holes;
    if (settings.keepHoles) {
      for (Grid<float>& map : heights) holes.push_back(takeHoles(map));
    }
    SynthesizedTerrain made = synthesizeTerrain(heights, options, progress.part(0.05, 1));

    if (settings.keepHoles) putHoles(holes, made);

    Result result;
    // In the example's units. It lies nowhere on earth, unless it is a terrain that does.
    result.data = HeightMap{std::move(made.heights), first.cellSize, first.cellSizeKnown,
                            settings.fill ? first.corner
                            : coarse      ? coarse->map.corner
                                          : std::nullopt,
                            first.steps};
    result.heightOrigins = std::move(made.origins);
    result.statistics = {{"levels", std::int64_t{made.levels}},
                         {"orientations", static_cast<std::int64_t>(made.turns.size())},
                         {"flooded_before_outlets", made.flooded},
                         {"outlets", made.outlets},
                         {"deepest_cut", made.deepestCut},
                         {"mean_cut", made.meanCut}};
    if (!settings.fill && !settings.keepHoles) warnOfHoles(examples, result.warnings);
    return result;
  }
};

}  // namespace

TerrainSynthesisOptions localTerrainOptions(const Request& request) {
  for (const char* key :
       {"fill", "keep-holes", "detail-of", "keep-at", "mask", "base", "blend", "follow"}) {
    if (request.settings.has(key))
      throw InputError("`" + std::string(key) +
                       "`: speaks of a whole map, and a world has no end; leave it out");
  }
  if (request.periodic.any() || request.decided.keep || request.guide)
    throw InputError(
        "`periodic`, `keep` and `guide` speak of a whole map, and a world has no end; "
        "leave them out");
  TerrainSettings settings;
  terrainSettings().apply(request.settings, settings);
  settings.synthesis.seed = request.seed;
  return settings.synthesis;
}

const Engine& terrainEngine() {
  static const TerrainEngine engine;
  return engine;
}

}  // namespace exemplar
