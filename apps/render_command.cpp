// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// exemplar render: a picture of a mesh, or of several side by side at one scale; height maps as
// shaded relief.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <numbers>

#include "apps/command.h"
#include "apps/help.h"
#include "core/error.h"
#include "engine/heights.h"
#include "engine/output.h"
#include "engine/realize.h"
#include "mesh/image.h"
#include "preview/relief.h"

namespace exemplar {
namespace {

struct Options {
  std::vector<std::string> examples;
  std::string output;
  Settings settings;
  PictureOptions picture;
  std::vector<double> lights{315};  // degrees
  double exaggeration = 0;
  int streams = 0;
  bool gray = false;
};

/// Whether all are height maps.
bool areHeightMaps(const std::vector<std::string>& examples) {
  return std::ranges::all_of(
      examples, [](const std::string& path) { return sourceKind(path) == SourceKind::HeightMap; });
}

void renderMeshes(const Options& options, Terminal& terminal) {
  RenderOptions picture = renderOptions(options.picture);
  Warnings ofPictures;
  picture.warnings = &ofPictures;
  const ReadOptions reading = readingOf(options.settings, Form::Field);
  std::vector<TriangleMesh> meshes;
  const auto count = static_cast<double>(options.examples.size());
  for (const std::string& path : options.examples) {
    const double from = 0.5 * static_cast<double>(meshes.size()) / count;
    meshes.push_back(pictured(path, reading, terminal.progress().part(from, from + 0.5 / count)));
  }
  writePng(options.output, renderSideBySide(meshes, picture, terminal.progress().part(0.5, 1)));
  terminal.wrote("picture", options.output, options.output);
  for (const std::string& warning : ofPictures) terminal.warn(warning);
}

void renderMaps(const Options& options, Terminal& terminal) {
  const RenderOptions picture = renderOptions(options.picture);
  ReliefOptions relief;
  relief.azimuths.clear();
  for (const double degrees : options.lights)
    relief.azimuths.push_back(degrees * (std::numbers::pi / 180));
  relief.exaggeration = options.exaggeration;
  relief.streamCells = static_cast<std::uint32_t>(options.streams);
  relief.tint = !options.gray;
  relief.longest = std::max(picture.width, picture.height);
  for (const std::string& path : options.examples) requireThere(path);
  const std::vector<Source> sources(options.examples.begin(), options.examples.end());
  Warnings warnings;
  const std::vector<HeightMap> maps =
      readHeightsAlike(sources, readingOf(options.settings, Form::Field), warnings,
                       terminal.progress().part(0, 0.3));
  std::vector<ReliefMap> shown;
  for (const HeightMap& map : maps) shown.push_back({&map.heights, map.cellSize});
  writePng(options.output, renderRelief(shown, relief, terminal.progress().part(0.3, 1)));
  terminal.wrote("picture", options.output, options.output);
  for (const std::string& warning : warnings) terminal.warn(warning);
}

}  // namespace

Command addRenderCommand(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("render", "Write a picture of a mesh, a height map or any example");
  command
      ->add_option("EXAMPLE", options->examples,
                   "what to show; several are shown side by side at one scale; height maps alone "
                   "as shaded relief, north up, unless --view is given")
      ->required();
  command->add_option("-o,--output", options->output, "the .png file to write")->required();
  command
      ->add_option("--light", options->lights,
                   "of relief: where light comes from, degrees clockwise from north; a row of "
                   "pictures for each of several (315,45)")
      ->delimiter(',')
      ->check(CLI::Range(-360.0, 360.0))
      ->default_str("315");
  command
      ->add_option("--streams", options->streams,
                   "of relief: draw the streams that so many cells or more drain through")
      ->check(CLI::Range(1, 1'000'000'000));
  command
      ->add_option("--exaggeration", options->exaggeration,
                   "of relief: what heights are multiplied with before they are lit (default: so "
                   "that the first map's mean slope is 0.6)")
      ->check(CLI::Range(1e-6, 1e6));
  command->add_flag("--gray", options->gray, "of relief: without colors by height");
  addPictureOptions(*command, options->picture);
  addReadingOptions(*command, Form::Field, options->settings);

  command->footer(examplesFooter({"render statue.obj more.glb -o side_by_side.png",
                                  "render castle -o plan.png --view top",
                                  "render land.tif more.tif -o relief.png --light 315,45"}));
  return {command, addCommonOptions(*command), [options, command](Terminal& terminal) {
            requireOutput(options->output, ".png");
            const bool relief = areHeightMaps(options->examples) && command->count("--view") == 0;
            if (relief) return renderMaps(*options, terminal);
            for (const char* option : {"--light", "--streams", "--exaggeration", "--gray"}) {
              if (command->count(option) > 0) {
                throw InputError(std::string(option) +
                                 ": only relief has it, which is drawn of height maps alone and "
                                 "without --view");
              }
            }
            renderMeshes(*options, terminal);
          }};
}

}  // namespace exemplar
