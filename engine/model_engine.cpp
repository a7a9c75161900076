// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Model synthesis: from labels to labels.

#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "engine/engines.h"
#include "engine/measured.h"
#include "engine/model_request.h"
#include "engine/words.h"

namespace exemplar {
namespace {

constexpr const char* kSideNames[] = {"left", "right", "front", "back", "bottom", "top"};

Conflict conflictOf(const ModelConflict& found) {
  Conflict conflict{found.text, found.pins, {}};
  for (const Side side : found.sides)
    conflict.sides.emplace_back(kSideNames[static_cast<int>(side)]);
  return conflict;
}

/// What a symmetry takes for granted of labels whose images nobody has said.
std::string imagesTaken(const Settings& given, const ModelSettings& settings,
                        const Example& example) {
  if (std::holds_alternative<ModelPieces>(example.content)) return {};
  if (const auto* tiles = std::get_if<TiledMap>(&example.content); tiles && tiles->hasFlips())
    return {};
  std::vector<std::string> keys;
  const ModelSymmetry& symmetry = settings.options.symmetry;
  const bool x = settings.mirror.x, y = settings.mirror.y, turns = symmetry.turns > 1;
  if (x && !given.has("mirrored-x")) keys.emplace_back("`mirrored-x`");
  if (y && !given.has("mirrored-y")) keys.emplace_back("`mirrored-y`");
  if (turns && !given.has("turned")) keys.emplace_back("`turned`");
  if (keys.empty()) return {};
  const std::string what = x || y ? (turns ? "mirrored and turned" : "mirrored") : "turned";
  return "labels of a grid do not say what they become when " + what +
         ", so each counts as its own image; where that is wrong, say what labels become with " +
         joined(keys, "and");
}

Statistics statisticsOf(const ModelResult& made, const Example& example, const Vec3i& size) {
  const ModelStatistics& s = made.statistics;
  return {{"method", std::string(s.whole ? "whole" : "blocks")},
          {"labels", std::int64_t{example.labels().labelCount()}},
          {"example_cells", example.labels().size()},
          {"result_cells", size},
          {"frames", static_cast<std::int64_t>(made.frames.size())},
          {"contradictions", s.contradictions},
          {"repairs", s.repairs},
          {"blocks", s.blocks},
          {"blocks_kept", s.blocksKept},
          {"exact_solver_calls", s.exact},
          {"moves", s.moves},
          {"moves_kept", s.movesKept}};
}

/// Results of at most so many cells are looked at for what they hold; more would take seconds.
constexpr std::size_t kMostMeasured = 4'000'000;

std::string times(double ratio) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", ratio);
  return text;
}

/// Whether labels are windows of a picture that overlap: what is one object they do not say.
bool overlaps(const Example& example) {
  const auto* image = std::get_if<ImageLabels>(&example.content);
  return image && image->options.overlap;
}

/// What people should know where a result keeps every adjacency and is not the example's kind.
void judgeContent(const Content& c, bool smaller, bool objects, const ModelOptions& options,
                  Result& result) {
  result.statistics.emplace_back("labels_used", c.labelsUsed);
  if (c.density) result.statistics.emplace_back("density", *c.density);
  result.statistics.emplace_back("objects_per_100_columns", c.objects);
  result.statistics.emplace_back("objects_per_100_columns_example", c.exampleObjects);
  const bool ends = std::any_of(options.sides.begin(), options.sides.begin() + 4,
                                [](const SideRule& s) { return s.excludes(); });
  const std::string help =
      options.moves == 0 ? "; with `moves` of 1 or more it comes nearer"
      : ends ? "; try more `moves`, `side` all=free where things cannot end, or a larger `size`"
             : "; try more `moves`, another `seed`, or a larger `size`";
  if (c.density && (*c.density < 0.6 || *c.density > 1.6)) {
    result.warnings.push_back("the result holds " + times(*c.density) +
                              " times as much in each column as the example" + help);
  }
  if (!smaller && c.labelsUsed < 0.9) {
    result.warnings.push_back("the result shows " + times(100 * c.labelsUsed) +
                              " % of the example's labels" + help);
  }
  if (c.density && c.exampleObjects > 0 && !smaller && objects) {
    const double ratio = c.objects / c.exampleObjects;
    if (ratio < 0.4 || ratio > 2.5) {
      result.warnings.push_back("the result has " + times(ratio) +
                                " times as many separate objects for its area as the example" +
                                help);
    }
  }
}

/// Refuses settings of a method that is not the one.
void checkMethod(const Settings& given, const ModelSettings& settings) {
  const ModelMethod method = settings.options.method;
  if (method == ModelMethod::Whole) {
    for (const char* key : {"block", "rounds", "metropolis", "patience"})
      if (given.has(key))
        throw InputError("`" + std::string(key) + "`: `method` whole has no blocks; leave it out");
  }
  const bool blocks = method == ModelMethod::Blocks || settings.options.metropolis;
  if (blocks && given.has("patience")) throw InputError("`patience`: only `method` auto has it");
  for (const char* key : {"block", "rounds"}) {
    if (!blocks && given.has(key))
      throw InputError("`" + std::string(key) +
                       "`: only `method` blocks has it; add `method` blocks, or leave it out");
  }
  if (settings.options.moves == 0 && given.has("copy-price"))
    throw InputError("`copy-price`: has no effect with `moves` 0; leave it out");
  if (given.has("mirrored-x") && !settings.mirror.x && settings.options.symmetry.turns == 1)
    throw InputError("`mirrored-x`: has no effect without `mirror` x");
  if (given.has("mirrored-y") && !settings.mirror.y && settings.options.symmetry.turns == 1)
    throw InputError("`mirrored-y`: has no effect without `mirror` y");
}

class ModelEngine final : public Engine {
 public:
  std::string_view name() const override { return "model"; }
  std::string_view meaning() const override {
    return "model synthesis: labels in which every two neighbors are a pair that the example shows "
           "(Merrell 2007, 2009); the default for labels and scenes of pieces";
  }
  Form form() const override { return Form::Labels; }
  Vec3i extentOf(std::span<const Example> examples, const Request& request) const override {
    const Example& example = examples.front();
    return resultSize(request, cellsOfExample(example), example.hints.scale, "cells");
  }
  bool mixes() const override { return true; }
  std::span<const Setting> settings() const override { return modelSettings().settings(); }
  std::span<const std::string_view> honors() const override {
    static constexpr std::string_view keys[] = {"periodic", "pin"};
    return keys;
  }

 protected:
  void checkFurther(const Request& request, std::size_t examples) const override {
    ModelSettings settings;
    modelSettings().apply(request.settings, settings);
    if (settings.frames && examples < 2)
      throw InputError("`frames`: give the frames of an example, several files");
    if (settings.options.loop && !settings.frames)
      throw InputError("`loop`: only what changes over time does; say how many `frames`");
    checkMethod(request.settings, settings);
    checkTexts(settings);
    if (request.extent.size) {
      for (const Pin& pin : request.decided.pins)
        for (int axis = 0; axis < 3; ++axis)
          if (pin.cell[axis] < 0 || pin.cell[axis] >= (*request.extent.size)[axis])
            throw InputError("`pin` " + std::to_string(pin.cell.x) + "," +
                             std::to_string(pin.cell.y) + "," + std::to_string(pin.cell.z) +
                             ": is outside of the result, which has " +
                             readableSize(*request.extent.size, "cells"));
    }
  }
  Result synthesize(std::span<const Example> examples, const Request& request,
                    const Progress& progress) const override {
    ModelSettings settings;
    modelSettings().apply(request.settings, settings);
    ModelOptions options = modelOptions(request, settings, examples.front());
    const Adjacency adjacency = adjacencyOf(examples, adjacencyOptions(settings));
    const std::vector<LabelGrid> grids = modelGrids(examples);
    const Axes directed = settings.side.empty() ? directedAxes(examples.front()) : Axes{};
    ModelResult made =
        synthesizeModel(grids, adjacency, options, progress.part(0, directed.any() ? 0.45 : 0.9));
    const bool held = directed.any() && made.outcome == Outcome::Complete;
    if (directed.any() && !held) {
      // Nobody has asked for these ends: stripes, say, may be of no such number.
      for (int side = 0; side < 4; ++side)
        if (directed[side / 2]) options.sides[side].kind = SideRule::Kind::Free;
      made = synthesizeModel(grids, adjacency, options, progress.part(0.45, 0.9));
    }
    Result result;
    result.outcome = made.outcome;
    result.statistics = statisticsOf(made, examples.front(), options.size);
    if (made.outcome == Outcome::Impossible) {
      result.conflict = conflictOf(made.conflict);
      result.why = "impossible: " + made.conflict.text;
    }
    if (made.outcome == Outcome::Unfinished) {
      result.why =
          "no result within the budget, and none is proved impossible; try another `seed`, a "
          "smaller `size`, or a larger `budget`";
    }
    if (made.outcome != Outcome::Complete) return result;
    if (std::string taken = imagesTaken(request.settings, settings, examples.front());
        !taken.empty())
      result.warnings.push_back(std::move(taken));
    if (cutAtSides(examples.front()).any() && settings.side.empty())
      result.notes.emplace_back("sides", "free along " +
                                             readableAxes(cutAtSides(examples.front())) +
                                             ", where the example cuts objects off");
    if (held)
      result.notes.emplace_back("sides", "as in the example along " + readableAxes(directed) +
                                             ", whose ends have nothing in common");
    result.notes.emplace_back("method", made.statistics.whole ? "in one pass" : "in blocks");
    result.data = std::move(made.frames.front());
    result.laterFrames.assign(std::make_move_iterator(made.frames.begin() + 1),
                              std::make_move_iterator(made.frames.end()));
    result.origins = std::move(made.origins.front());
    originsInExamples(examples, result.origins);
    const LabelGrid& first = result.labels();
    if (first.cells.count() <= kMostMeasured) {
      const Vec3i n = first.size(), example = grids.front().size();
      judgeContent(*measureContent(result, examples, progress.part(0.9, 1)),
                   n.x < example.x || n.y < example.y, !overlaps(examples.front()), options,
                   result);
    }
    return result;
  }
};

}  // namespace

const Engine& modelEngine() {
  static const ModelEngine engine;
  return engine;
}

}  // namespace exemplar
