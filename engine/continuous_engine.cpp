// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Continuous model synthesis: from solids to solids.

#include <algorithm>
#include <cstdio>
#include <utility>

#include "core/cells.h"
#include "core/error.h"
#include "core/file.h"
#include "engine/engines.h"
#include "engine/words.h"
#include "mesh/image.h"
#include "synth/continuous/synthesize.h"

namespace exemplar {
namespace {

using namespace continuous;

enum class Method { Auto, Whole, Blocks };
enum class Floating { Auto, Keep, Remove };

struct ContinuousSettings {
  ContinuousOptions options;
  Method method = Method::Auto;
  Floating floating = Floating::Auto;
  std::vector<std::string> thin;
};

const SettingTable<ContinuousSettings>& continuousSettings() {
  using O = ContinuousSettings;
  static const SettingTable<O> table{
      settingRow<O>(
          "spacing", [](O & o) -> auto& { return o.options.spacing; },
          "distance of parallel planes, on which all faces lie; finer than found, it makes finer "
          "steps",
          {1, 1e6}, "units of the example's grid",
          "the greatest common divisor of the example's distances"),
      settingRow<O>("density", [](O & o) -> auto& { return o.options.density; },
                    "how full the result is, in shares of the example's", {1e-3, 1e3}),
      settingRow<O>(
          "learning", [](O & o) -> auto& { return o.options.learning; },
          "rounds in which the weights of figures are adapted until trial results are as full as "
          "the example",
          {0, 100}),
      choiceRow<O, Method>(
          "method", &O::method, "in one pass, in blocks, or in blocks where one pass fails",
          {{"auto", Method::Auto}, {"whole", Method::Whole}, {"blocks", Method::Blocks}}),
      settingRow<O>(
          "budget", [](O & o) -> auto& { return o.options.budget; },
          "choices that may fail before an attempt ends (0: 1,000 and a tenth of the vertices)",
          {0, 1e12}),
      settingRow<O>("attempts", [](O & o) -> auto& { return o.options.attempts; },
                    "attempts at one pass", {1, 1000}),
      settingRow<O>(
          "block", [](O & o) -> auto& { return o.options.block; }, "side of a block", {4, 1024},
          "spacings"),
      settingRow<O>("rounds", [](O & o) -> auto& { return o.options.rounds; },
                    "how often all blocks are made anew", {1, 1000}),
      choiceRow<O, Floating>(
          "floating", [](O & o) -> auto& { return o.floating; },
          "solids that hang in the air over the ground: keep them, remove them, or remove them "
          "where the example has none",
          {{"auto", Floating::Auto}, {"keep", Floating::Keep}, {"remove", Floating::Remove}}),
      settingRow<O>("object-size", [](O & o) -> auto& { return o.options.objectSize; },
                    "how large solids are, in sizes of the example's: more within them, or more "
                    "corners",
                    {0.1, 10}),
      settingRow<O>(
          "groups", [](O & o) -> auto& { return o.options.groups; },
          "at most how many connected groups the solids form, grown from as many seeds; 0: any",
          {0, 10000}),
      settingRow<O>(
          "mirror", [](O & o) -> auto& { return o.options.mirror; },
          "make the result its own mirror image across x, y or both (xy)"),
      settingRow<O>(
          "open-sides", [](O & o) -> auto& { return o.options.open; },
          "axes along which the result is cut out of something longer, without ends of its own"),
      settingRow<O>(
          "jitter", [](O & o) -> auto& { return o.options.jitter; },
          "how far faces are moved out of their rows, in half distances of planes; only for faces "
          "of three directions",
          {0, 1}),
      {{.key = "thin",
        .type = SettingType::Text,
        .meaning = "MATERIAL=AXIS: a material that is one spacing thick along x, y or z, or across "
                   "faces of a normal (1,1,0)",
        .repeats = true},
       [](const Setting&, const std::string& text, O& o) { o.thin.push_back(text); }}};
  return table;
}

/// A request's settings, and a scene's own where it says nothing of them.
ContinuousSettings settingsOf(const Example& example, const Request& request) {
  Settings all;
  for (const auto& [key, text] : example.solids->settings) {
    if (std::ranges::find(continuousSettings().settings(), key, &Setting::key) ==
        continuousSettings().settings().end())
      throw InputError(example.name() + ": [settings]: the engine continuous has no `" + key + "`");
    if (!request.settings.has(key)) all.add(key, text);
  }
  ContinuousSettings settings;
  continuousSettings().apply(all, settings);
  continuousSettings().apply(request.settings, settings);
  return settings;
}

/// A scene's own settings that count, for people.
std::string readableSettings(const Example& example, const Request& request) {
  std::string text;
  for (const auto& [key, value] : example.solids->settings) {
    if (!request.settings.has(key)) text += (text.empty() ? "" : ", ") + key + " " + value;
  }
  return text;
}

Substance substanceNamed(const Solids& solids, const std::string& name, const std::string& what) {
  const auto found = std::ranges::find(solids.substances, name);
  if (found != solids.substances.end())
    return static_cast<Substance>(found - solids.substances.begin());
  throw InputError(what + ": there is no material " + name + "; the example has " +
                   joined(solids.substances, "and"));
}

Vec3l normalNamed(const std::string& text, const std::string& what) {
  if (text == "x") return {1, 0, 0};
  if (text == "y") return {0, 1, 0};
  if (text == "z") return {0, 0, 1};
  const Vec3i v = parseCell(text, what);
  if (v == Vec3i{}) throw InputError(what + ": a normal is not 0,0,0");
  return canonical(cast<std::int64_t>(v));
}

std::string pinText(const Pin& pin) {
  return "`pin` " + numberText(pin.cell.x) + "," + numberText(pin.cell.y) + "," +
         numberText(pin.cell.z) + "=" + pin.labels;
}

/// How full a result is, seen from above (the brightness of a picture), or by cells (labels: 0 is
/// empty).
DensityMap readDensityMap(const Source& source) {
  DensityMap map;
  const std::string what = "`guide` " + source.name();
  const std::string ending = lowerExtension(source.path());
  if (ending == ".png" || ending == ".jpg" || ending == ".jpeg") {
    const Image8 image = decodeImage(readBytes(source), source.name());
    map.size = {image.width, image.height, 1};
    for (int y = image.height - 1; y >= 0; --y) {
      for (int x = 0; x < image.width; ++x) {
        const std::uint8_t* p = image.at(x, y);
        const float gray = image.channels < 3 ? static_cast<float>(p[0])
                                              : 0.2126f * static_cast<float>(p[0]) +
                                                    0.7152f * static_cast<float>(p[1]) +
                                                    0.0722f * static_cast<float>(p[2]);
        map.values.push_back(gray / 255);
      }
    }
    return map;
  }
  if (sourceKind(source) != SourceKind::Labels)
    throw InputError(what + ": use a .png or .jpg seen from above, or cells (.vox, .txt)");
  const LabelGrid grid = readLabelGrid(source);
  map.size = grid.size();
  forEachCell(CellBox::of(map.size),
              [&](const Vec3i& cell) { map.values.push_back(grid.cells[cell] == 0 ? 0.f : 0.8f); });
  return map;
}

ContinuousOptions optionsOf(const Request& request, ContinuousSettings settings,
                            const Solids& solids, const Vec3i& size) {
  ContinuousOptions options = settings.options;
  options.size = size;
  if (request.guide) options.map = readDensityMap(*request.guide);
  if (options.mirror.z) throw InputError("`mirror`: only x and y can be mirrored");
  if (options.open.z && (solids.ground || solids.flat))
    throw InputError("`open-sides` z: an example with a ground, or of the plane, ends there");
  options.seed = request.seed;
  options.blocksOnly = settings.method == Method::Blocks;
  options.blocks = settings.method != Method::Whole;
  if (settings.floating != Floating::Auto) options.floating = settings.floating == Floating::Keep;
  for (const std::string& text : settings.thin) {
    const std::string what = "`thin` " + text;
    const auto [name, axis] = keyAndValue(text, "`thin`", "MATERIAL=AXIS");
    options.thin.push_back({substanceNamed(solids, name, what), normalNamed(axis, what)});
  }
  for (const Pin& pin : request.decided.pins) {
    PlacedSubstance placed{pin.cell, {}};
    const std::string what = pinText(pin);
    for (int axis = 0; axis < 3; ++axis) {
      if (pin.cell[axis] < 0 || pin.cell[axis] >= size[axis])
        throw InputError(what + ": outside of the result's " + readableSize(size, "spacings"));
    }
    for (const std::string& name : split(pin.labels, ','))
      placed.substances.push_back(substanceNamed(solids, name, what));
    options.placed.push_back(std::move(placed));
  }
  return options;
}

Statistics statisticsOf(const ContinuousStatistics& s, const Vec3i& size) {
  const auto count = [](std::size_t n) { return static_cast<std::int64_t>(n); };
  Statistics all{{"method", std::string(s.whole ? "whole" : "blocks")},
                 {"result_spacings", size},
                 {"directions", count(s.directions)},
                 {"figures", count(s.figures)},
                 {"classes", count(s.classes)},
                 {"most_labels", count(s.labels)},
                 {"vertices", count(s.vertices)},
                 {"free_vertices", count(s.freeVertices)},
                 {"faces", count(s.polygons)},
                 {"attempts", s.attempts},
                 {"choices", s.choices},
                 {"failed_choices", s.failures},
                 {"blocks", s.blocks},
                 {"blocks_kept", s.blocksKept},
                 {"exact_solver_calls", s.exact},
                 {"floating_removed", s.floating},
                 {"groups", s.groups}};
  for (int c = 0; c < kFigureClasses; ++c) {
    const std::string name = figureClassName(static_cast<FigureClass>(c));
    all.emplace_back("example_share_" + name, s.exampleShares[c]);
    all.emplace_back("share_" + name, s.shares[c]);
  }
  return all;
}

class ContinuousEngine final : public Engine {
 public:
  std::string_view name() const override { return "continuous"; }
  std::string_view meaning() const override {
    return "continuous model synthesis: solids of flat faces at any angles, exact, in which every "
           "point looks like one of the example (Merrell and Manocha 2008); the default for scenes "
           "of solids";
  }
  Form form() const override { return Form::Polygons; }
  Vec3i extentOf(std::span<const Example> examples, const Request& request) const override {
    const Example& example = examples.front();
    const ContinuousSettings settings = settingsOf(example, request);
    const PlaneLattice lattice = latticeOf(example.solids->solids, spacingOf(example, settings));
    Vec3i size = resultSize(request, sizeInSpacings(lattice, example.solids->solids),
                            example.hints.scale, "spacings");
    if (example.solids->solids.flat) {
      if (request.extent.size && size.z != 1)
        throw InputError("`size`: shapes of the plane are one spacing high; use X,Y,1");
      size.z = 1;
    }
    return size;
  }
  std::span<const Setting> settings() const override { return continuousSettings().settings(); }
  std::span<const std::string_view> honors() const override {
    static constexpr std::string_view keys[] = {"pin", "guide"};
    return keys;
  }

 protected:
  Result synthesize(std::span<const Example> examples, const Request& request,
                    const Progress& progress) const override {
    const Example& example = examples.front();
    const SolidScene& scene = *example.solids;
    ContinuousSettings settings = settingsOf(example, request);
    settings.options.spacing = spacingOf(example, settings);
    const ContinuousOptions options =
        optionsOf(request, settings, scene.solids, extentOf(examples, request));
    ContinuousResult made = synthesizeSolids(scene.solids, scene.looks, options, progress);
    Result result;
    result.outcome = made.outcome;
    result.why = made.why;
    result.statistics = statisticsOf(made.statistics, options.size);
    if (made.outcome == Outcome::Impossible) {
      for (const int pin : made.conflict) {
        const Pin& p = request.decided.pins[static_cast<std::size_t>(pin)];
        result.why += (pin == made.conflict.front() ? ": " : " and ") + pinText(p);
      }
      result.conflict = Conflict{result.why, made.conflict, {}};
    }
    if (made.outcome != Outcome::Complete) return result;
    const ContinuousStatistics& s = made.statistics;
    if (const std::string own = readableSettings(example, request); !own.empty())
      result.notes.emplace_back("scene", own);
    result.notes.emplace_back("method", s.whole ? "in one pass" : "in blocks");
    result.notes.emplace_back(
        "figures", withThousands(static_cast<long long>(s.figures)) + " of " +
                       withThousands(static_cast<long long>(s.directions)) + " directions, " +
                       withThousands(static_cast<long long>(s.freeVertices)) + " free vertices");
    if (s.shares[static_cast<int>(FigureClass::Empty)] == 1) {
      result.warnings.push_back("the result is empty; try another `seed`, or a larger `density`");
    } else if (const double full = fullness(s, options.density); full < kNearlyEmpty) {
      char share[16];
      std::snprintf(share, sizeof share, "%.0f %%", 100 * full);
      result.warnings.push_back(
          "the result is nearly empty: " + std::string(share) + " as full as asked for" +
          (s.exact > 0 ? "; the `budget` was spent and the exact solver finished it, which leaves "
                         "out what it can; use `method` auto, or a larger `budget`"
                       : "; try another `seed`, or a larger `density`"));
    }
    if (s.groups > options.groups && options.groups > 0) {
      result.warnings.push_back("the solids form " + std::to_string(s.groups) +
                                " groups, more than `groups` " + std::to_string(options.groups) +
                                ": what is decided, or a relief around them, keeps some");
    }
    result.data = std::move(made.model);
    return result;
  }

 private:
  /// A result less full than this share of what was asked for is nearly empty.
  static constexpr double kNearlyEmpty = 0.25;
  /// How full a result is, in shares of what was asked for.
  static double fullness(const ContinuousStatistics& s, double density) {
    const int empty = static_cast<int>(FigureClass::Empty);
    const double wanted = std::min(1.0, (1 - s.exampleShares[empty]) * density);
    return wanted > 0 ? (1 - s.shares[empty]) / wanted : 1;
  }
  static std::optional<std::int64_t> spacingOf(const Example& example,
                                               const ContinuousSettings& settings) {
    return settings.options.spacing ? settings.options.spacing : example.solids->spacing;
  }
};

}  // namespace

const Engine& continuousEngine() {
  static const ContinuousEngine engine;
  return engine;
}

}  // namespace exemplar
