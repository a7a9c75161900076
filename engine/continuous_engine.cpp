// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Continuous model synthesis: from solids to solids.

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "engine/engines.h"
#include "engine/words.h"
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
      {{.key = "thin",
        .type = SettingType::Text,
        .meaning = "MATERIAL=AXIS: a material that is one spacing thick along x, y or z, or across "
                   "faces of a normal (1,1,0)",
        .repeats = true},
       [](const Setting&, const std::string& text, O& o) { o.thin.push_back(text); }}};
  return table;
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

ContinuousOptions optionsOf(const Request& request, ContinuousSettings settings,
                            const Solids& solids, const Vec3i& size) {
  ContinuousOptions options = settings.options;
  options.size = size;
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
                 {"floating_removed", s.floating}};
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
    ContinuousSettings settings;
    continuousSettings().apply(request.settings, settings);
    const PlaneLattice lattice = latticeOf(example.solids->solids, spacingOf(example, settings));
    return resultSize(request, sizeInSpacings(lattice, example.solids->solids), example.hints.scale,
                      "spacings");
  }
  std::span<const Setting> settings() const override { return continuousSettings().settings(); }
  std::span<const std::string_view> honors() const override {
    static constexpr std::string_view keys[] = {"pin"};
    return keys;
  }

 protected:
  Result synthesize(std::span<const Example> examples, const Request& request,
                    const Progress& progress) const override {
    const Example& example = examples.front();
    const SolidScene& scene = *example.solids;
    ContinuousSettings settings;
    continuousSettings().apply(request.settings, settings);
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
    result.notes.emplace_back("method", s.whole ? "in one pass" : "in blocks");
    result.notes.emplace_back(
        "figures", withThousands(static_cast<long long>(s.figures)) + " of " +
                       withThousands(static_cast<long long>(s.directions)) + " directions, " +
                       withThousands(static_cast<long long>(s.freeVertices)) + " free vertices");
    if (s.shares[static_cast<int>(FigureClass::Empty)] == 1)
      result.warnings.push_back("the result is empty; try another `seed`, or a larger `density`");
    result.data = std::move(made.model);
    return result;
  }

 private:
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
