// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// exemplar measure: how alike, how new and how seamless a result is.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <optional>

#include "apps/command.h"
#include "apps/help.h"
#include "core/error.h"
#include "core/file.h"
#include "core/json_text.h"
#include "engine/json.h"
#include "engine/measured.h"
#include "engine/output.h"
#include "engine/page.h"
#include "engine/realize.h"
#include "engine/request.h"
#include "sdf/vdb_file.h"

namespace exemplar {
namespace {

struct Options {
  std::string example, result, origins, json, report;
  bool layers = false;
  Settings settings;
  PictureOptions picture;
};

/// A page of the example, the result and their figures.
void writeReport(const Options& options, const Example& example, const Measured& measured,
                 const std::vector<Figure>& all, const RenderOptions& picture,
                 const Progress& progress) {
  const TriangleMesh whole = pictured(example.source, example.reading, progress.part(0, 0.2));
  const TriangleMesh mesh = surfaceOf(measured, example, progress.part(0.2, 0.4));
  ResultPage page{options.report, options.example, example.description, whole, mesh};
  page.exampleField = &example.field();
  page.field = &measured.field;
  page.turn = example.turn;
  if (measured.origins.count() > 0) page.origins = &measured.origins;
  writePage(page, {{"figures", toJson(all)}}, picture, progress.part(0.4, 1));
}

void writeFigures(const Options& options, const std::vector<Figure>& all, Terminal& terminal,
                  const std::string& table = {}) {
  terminal.wipe();
  if (options.json == "-") {
    std::printf("%s\n", jsonText(toJson(all), 2).c_str());
    return;
  }
  if (!terminal.quiet()) terminal.print(table.empty() ? figuresTable(all) : table);
  if (options.json.empty()) return;
  writeFile(options.json, jsonText(toJson(all), 2) + "\n");
  terminal.noteFile(options.json, "figures");
}

/// Whether the result is a grid of labels, or a picture of an example that is one.
bool isOfLabels(const Options& options) {
  const SourceKind result = sourceKind(options.result);
  if (result == SourceKind::Labels || result == SourceKind::Picture) return true;
  return result == SourceKind::HeightMap && sourceKind(options.example) == SourceKind::Labels;
}

/// Refuses what only results with a surface have.
void requireNoSurface(const Options& options, const std::string& what) {
  for (const auto& [name, given] : {std::pair{"--report", !options.report.empty()},
                                    {"--origins", !options.origins.empty()},
                                    {"--scale", options.settings.has("scale")}}) {
    if (given)
      throw InputError(std::string(name) + ": has no meaning for " + what + "; leave it out");
  }
}

void measureLayerMaps(const Options& options, Terminal& terminal) {
  requireNoSurface(options, "layer maps");
  const Progress& progress = terminal.progress();
  if (sourceKind(options.example) == SourceKind::Labels) {
    const LayersLikeness likeness =
        measureLayers(Source(options.example), Source(options.result), progress);
    return writeFigures(options, figures(likeness), terminal);
  }
  const LayerMap example = readLayerMap(options.example);
  const LayerMap result = readLayerMap(options.result, layerCount(example));
  writeFigures(options, figures(measureLayers(boxOf(example), false, boxOf(result), progress)),
               terminal);
}

void measureLabels(const Options& options, Terminal& terminal) {
  requireNoSurface(options, "a result of labels");
  const Progress& progress = terminal.progress();
  const Example example = readExample(options.example, readingOf(options.settings, Form::Labels),
                                      progress.part(0, 0.4));
  for (const std::string& warning : example.warnings) terminal.warn(warning);
  writeFigures(options, figures(measureContent(options.result, example, progress.part(0.4, 1))),
               terminal);
}

/// Whether an option was given that only distances have.
bool asksForDistances(const Options& options) {
  return !options.report.empty() || !options.origins.empty() || options.settings.has("scale") ||
         options.settings.has("resolution");
}

void measureHeights(const Options& options, Terminal& terminal) {
  for (const std::string& path : {options.example, options.result}) requireThere(path);
  Warnings warnings;
  const TerrainLikeness terrain =
      measureTerrain(Source(options.example), Source(options.result),
                     readingOf(options.settings, Form::Field), warnings, terminal.progress());
  terminal.wipe();
  for (const std::string& warning : warnings) terminal.warn(warning);
  writeFigures(options, figures(terrain), terminal, figuresTable(terrain));
}

void measureFiles(const Options& options, Terminal& terminal) {
  if (!options.json.empty() && options.json != "-") requireOutput(options.json, ".json");
  if (!options.report.empty()) requireOutput(options.report, ".html");
  if (options.layers) return measureLayerMaps(options, terminal);
  if (isOfLabels(options)) return measureLabels(options, terminal);
  if (areHeights(options.example, options.result) && !asksForDistances(options))
    return measureHeights(options, terminal);
  RenderOptions picture = renderOptions(options.picture);
  const Request request = requestOf(options.settings);
  if (request.extent.scale && !options.origins.empty())
    throw InputError("`scale`: the origins say the size already; give one of the two");
  for (const std::string* path : {&options.example, &options.result, &options.origins})
    if (!path->empty()) requireThere(*path);
  const Progress& progress = terminal.progress();
  ReadOptions reading = readingOf(options.settings, Form::Field);
  // Read as it was for the synthesis.
  std::optional<Vec3d> scale = request.extent.scale;
  if (!scale && !options.origins.empty()) scale = readOriginsScale(options.origins);
  if (scale) reading.wanted = Extent{.scale = scale, .size = {}};
  const Example example = readExample(options.example, reading, progress.part(0, 0.2));
  for (const std::string& warning : example.warnings) terminal.warn(warning);
  std::optional<Source> origins;
  if (!options.origins.empty()) origins = Source(options.origins);
  const Measured measured =
      readMeasured(options.result, origins, request.extent.scale, example, progress.part(0.2, 0.4));
  const std::vector<Figure> all = figures(measure(measured, example, progress.part(0.4, 0.7)));
  writeFigures(options, all, terminal);
  if (!options.report.empty()) {
    Warnings ofPictures;
    picture.warnings = &ofPictures;
    writeReport(options, example, measured, all, picture, progress.part(0.7, 1));
    for (const std::string& warning : ofPictures) terminal.warn(warning);
    if (options.json != "-") terminal.wrote("report", options.report, options.report);
  }
}

}  // namespace

Command addMeasureCommand(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("measure", "Report how alike, how new and how seamless a result is");
  command->add_option("EXAMPLE", options->example, "what the result was made from")->required();
  command
      ->add_option(
          "RESULT", options->result,
          "a .vdb (its own samples), a mesh (sampled where synth's samples were), labels "
          "(.txt .vox .vdb, a picture), or a height map, which is measured as terrain where "
          "EXAMPLE is one (as distances with --resolution)")
      ->required();
  command->add_option("--origins", options->origins,
                      "the result's origins (.vdb, by synth --origins): more figures");
  SettingOptions rows;
  for (Setting setting : requestSettings()) {
    if (setting.key != "scale") continue;
    setting.meaning = "the size that a mesh was made with, as synth was given it";
    setting.byDefault = "guessed; origins say it too";
    rows.add("Result", "", {&setting, 1});
  }
  rows.install(*command, options->settings);
  command->add_flag("--layers", options->layers,
                    "both are gray pictures of layers, as synth --write-layers writes them, or "
                    "volumes of labels, each label a layer");
  command->add_option("--json", options->json, "write the figures to this .json; - prints them");
  command->add_option("--report", options->report,
                      "write a page with surfaces that turn, figures and marks (.html)");
  rows = {};
  rows.add("Reading a mesh, volume or height map as distances", "distances",
           readingSettings(Form::Field).settings());
  rows.add("Reading labels, or a mesh or picture cut into labels", "labels",
           readingSettings(Form::Labels).settings());
  rows.install(*command, options->settings);
  addPictureOptions(*command, options->picture);
  command->footer(
      examplesFooter({"measure wall.obj wall_more.obj -s 3,1,1",
                      "measure castle town.vox --json town.json", "measure terrain.tif more.tif"}));
  return {command, addCommonOptions(*command),
          [options](Terminal& terminal) { measureFiles(*options, terminal); }};
}

}  // namespace exemplar
