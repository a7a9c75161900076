// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// exemplar render: a picture of a mesh, or of several side by side at one scale.

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/command.h"
#include "apps/help.h"
#include "engine/output.h"
#include "engine/realize.h"
#include "mesh/image.h"

namespace exemplar {

Command addRenderCommand(CLI::App& app) {
  struct Options {
    std::vector<std::string> examples;
    std::string output;
    Settings settings;
    PictureOptions picture;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("render", "Write a picture of a mesh or of any example");
  command
      ->add_option("EXAMPLE", options->examples,
                   "what to show; several are shown side by side at one scale")
      ->required();
  command->add_option("-o,--output", options->output, "the .png file to write")->required();
  addPictureOptions(*command, options->picture);
  addReadingOptions(*command, Form::Field, options->settings);

  command->footer(examplesFooter({"render statue.obj more.glb -o side_by_side.png"}));
  return {command, addCommonOptions(*command), [options](Terminal& terminal) {
            requireOutput(options->output, ".png");
            RenderOptions picture = renderOptions(options->picture);
            Warnings ofPictures;
            picture.warnings = &ofPictures;
            ReadOptions reading = readingOf(options->settings, Form::Field);
            std::vector<TriangleMesh> meshes;
            const auto count = static_cast<double>(options->examples.size());
            for (const std::string& path : options->examples) {
              const double from = 0.5 * static_cast<double>(meshes.size()) / count;
              meshes.push_back(
                  pictured(path, reading, terminal.progress().part(from, from + 0.5 / count)));
            }
            writePng(options->output,
                     renderSideBySide(meshes, picture, terminal.progress().part(0.5, 1)));
            terminal.wrote("picture", options->output, options->output);
            for (const std::string& warning : ofPictures) terminal.warn(warning);
          }};
}

}  // namespace exemplar
