// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// exemplar measure: how alike, how new and how seamless a result is.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "apps/terminal.h"
#include "core/file.h"
#include "measure/figures.h"
#include "sdf/mesh_to_sdf.h"
#include "sdf/vdb_file.h"

namespace exemplar {
namespace {

struct Options {
  std::string example, result, origins, json;
  ExampleOptions reading;
  CommonOptions common;
};

/// The result at the example's voxel size, and its triangles where it has any.
Example loadResult(const Options& options, const Example& example, const Progress& progress) {
  if (!isMeshFile(options.result)) {
    ExampleOptions reading = options.reading;
    reading.padding = 0;
    return loadExample(options.result, reading, progress);
  }
  Example result;
  result.path = options.result;
  result.mesh = readMesh(options.result, options.reading.mesh);
  result.field =
      meshToSdf(*result.mesh,
                {.voxelSize = example.field.voxelSize, .halfWidth = kExampleHalfWidth}, progress);
  return result;
}

nlohmann::ordered_json toJson(const std::vector<Figure>& figures) {
  nlohmann::ordered_json json;
  for (const Figure& figure : figures) {
    nlohmann::ordered_json& value = json[figure.group][figure.key];
    std::visit(
        [&](const auto& v) {
          if constexpr (!std::is_same_v<std::decay_t<decltype(v)>, std::monostate>) value = v;
        },
        figure.value);
  }
  return json;
}

void measureFiles(const Options& options) {
  const ThreadLimit limit(options.common.threads);
  Terminal terminal(options.common.quiet);
  if (!options.json.empty() && options.json != "-") requireOutput(options.json, ".json");
  const Example example = loadExample(options.example, options.reading, terminal.progress());
  const Example result = loadResult(options, example, terminal.progress());
  Origins origins;
  MeasureInput input;
  if (!options.origins.empty()) {
    origins = readOriginsVdb(options.origins);
    input.origins = &origins;
  }
  if (result.mesh) input.mesh = &*result.mesh;
  terminal.step("measuring");
  const Measures measures = measure(example.field, result.field, input, {}, terminal.progress());
  terminal.stopIfInterrupted();
  const std::vector<Figure> all = figures(measures);
  terminal.wipe();
  if (options.json == "-") {
    std::printf("%s\n", toJson(all).dump(2).c_str());
  } else {
    if (!options.common.quiet) std::printf("%s", figuresTable(all).c_str());
    if (!options.json.empty()) writeFile(options.json, toJson(all).dump(2) + "\n");
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
                   "a .vdb (its own samples), or a mesh (sampled again, as finely as EXAMPLE)")
      ->required();
  command->add_option("--origins", options->origins,
                      "the result's origins (.vdb, by synth --origins): more figures");
  command->add_option("--json", options->json, "write the figures to this .json; - prints them");
  addExampleOptions(*command, options->reading);
  addCommonOptions(*command, options->common);
  return [options] { measureFiles(*options); };
}

}  // namespace exemplar
