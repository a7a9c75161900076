// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// exemplar measure: how alike, how new and how seamless a result is.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <optional>
#include <vector>

#include "apps/command.h"
#include "apps/json.h"
#include "apps/report.h"
#include "apps/terminal.h"
#include "core/error.h"
#include "core/file.h"
#include "measure/figures.h"
#include "measure/mesh_result.h"
#include "reconstruct/field_to_mesh.h"
#include "reconstruct/reconstruct.h"
#include "sdf/vdb_file.h"

namespace exemplar {
namespace {

struct Options {
  std::string example, result, origins, scale, json, report;
  ExampleOptions reading;
  PictureOptions picture;
  CommonOptions common;
};

/// How many samples a result given as a mesh has, where the command line tells.
std::optional<Vec3i> resultSize(const Options& options, const Example& example,
                                const Origins& origins) {
  if (origins.count() > 0) {
    if (!options.scale.empty())
      throw InputError("--scale: the origins tell the size already; give one of the two");
    return origins.size();
  }
  if (options.scale.empty()) return std::nullopt;
  return scaledSize(example.field.size(), parseTriple(options.scale, "--scale"), "samples");
}

/// The result at the example's voxel size, and its triangles where it has any.
Example loadResult(const Options& options, const Example& example, const Origins& origins,
                   const Progress& progress) {
  if (!isMeshFile(options.result)) {
    if (!options.scale.empty())
      throw InputError("--scale: " + options.result +
                       " has a size of its own; only a mesh has not");
    ExampleOptions reading = options.reading;
    reading.padding = 0;
    return loadExample(options.result, reading, progress);
  }
  Example result;
  result.path = options.result;
  result.mesh = readMesh(options.result, options.reading.mesh);
  const std::optional<Vec3i> size = resultSize(options, example, origins);
  try {
    result.field = sampleMeshResult(*result.mesh, example.field, {.size = size}, progress);
  } catch (const InputError& error) {
    throw InputError(options.result + ": " + error.what());
  }
  return result;
}

/// A page of the example, the result and their figures.
void writeReport(const Options& options, const Example& example, const Example& result,
                 const Origins* origins, const std::vector<Figure>& all,
                 const RenderOptions& picture, Terminal& terminal) {
  terminal.step("making the report");
  const TriangleMesh whole = loadForPicture(options.example, options.reading, terminal.progress());
  TriangleMesh mesh;
  if (result.mesh) {
    mesh = *result.mesh;
  } else if (origins) {
    mesh = reconstructSurface(result.field, *origins,
                              {example.field, example.mesh ? &*example.mesh : nullptr},
                              {.blend = 0}, terminal.progress())
               .mesh;
  } else {
    mesh = fieldToMesh(result.field);
  }
  ResultReport report{options.report, options.example, example.description, whole, mesh};
  report.exampleField = &example.field;
  report.field = &result.field;
  report.origins = origins;
  writeResultReport(report, {{"figures", toJson(all)}}, picture, terminal.progress());
  terminal.stopIfInterrupted();
  if (!options.common.quiet && options.json != "-") terminal.say("report", options.report);
}

void measureFiles(const Options& options) {
  const ThreadLimit limit(options.common.threads);
  Terminal terminal(options.common.quiet);
  if (!options.json.empty() && options.json != "-") requireOutput(options.json, ".json");
  if (!options.report.empty()) requireOutput(options.report, ".html");
  const RenderOptions picture = renderOptions(options.picture);
  const Example example = loadExample(options.example, options.reading, terminal.progress());
  Origins origins;
  if (!options.origins.empty()) origins = readOriginsVdb(options.origins);
  const Example result = loadResult(options, example, origins, terminal.progress());
  terminal.stopIfInterrupted();
  MeasureInput input;
  if (!options.origins.empty()) input.origins = &origins;
  if (result.mesh) input.mesh = &*result.mesh;
  terminal.step("measuring");
  const Measures measures =
      measure(example.field, result.field, input,
              {.likeness = {.contoured = result.mesh.has_value()}}, terminal.progress());
  terminal.stopIfInterrupted();
  const std::vector<Figure> all = figures(measures);
  terminal.wipe();
  if (options.json == "-") {
    std::printf("%s\n", toJson(all).dump(2).c_str());
  } else {
    if (!options.common.quiet) std::printf("%s", figuresTable(all).c_str());
    if (!options.json.empty()) writeFile(options.json, toJson(all).dump(2) + "\n");
  }
  if (!options.report.empty()) {
    writeReport(options, example, result, input.origins, all, picture, terminal);
  }
}

}  // namespace

CommandRun addMeasureCommand(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("measure", "Tell how alike, how new and how seamless a result is");
  command->add_option("EXAMPLE", options->example, "what the result was made from")->required();
  command
      ->add_option("RESULT", options->result,
                   "a .vdb (its own samples), or a mesh (sampled where synth's samples stood)")
      ->required();
  command->add_option("--origins", options->origins,
                      "the result's origins (.vdb, by synth --origins): more figures");
  command->add_option("--scale", options->scale,
                      "the size that a mesh was made with, as synth was told (guessed; origins "
                      "tell it too)");
  command->add_option("--json", options->json, "write the figures to this .json; - prints them");
  command->add_option("--report", options->report,
                      "write a page with surfaces that turn, figures and what shows (.html)");
  addExampleOptions(*command, options->reading);
  addPictureOptions(*command, options->picture);
  addCommonOptions(*command, options->common);
  return [options] { measureFiles(*options); };
}

}  // namespace exemplar
