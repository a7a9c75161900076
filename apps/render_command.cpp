// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// exemplar render: a picture of a mesh, or of several side by side at one scale.

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/command.h"
#include "apps/terminal.h"
#include "mesh/mesh_file.h"
#include "reconstruct/field_to_mesh.h"

namespace exemplar {

CommandRun addRenderCommand(CLI::App& app) {
  struct Options {
    std::vector<std::string> examples;
    std::string output;
    ExampleOptions reading;
    PictureOptions picture;
    CommonOptions common;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("render", "Write a picture of a mesh or of any example");
  command
      ->add_option("EXAMPLE", options->examples,
                   "what to show; several are shown side by side at one scale")
      ->required();
  command->add_option("-o,--output", options->output, "the .png file to write")->required();
  addPictureOptions(*command, options->picture);
  addExampleOptions(*command, options->reading);
  addCommonOptions(*command, options->common);

  return [options] {
    const ThreadLimit limit(options->common.threads);
    Terminal terminal(options->common.quiet);
    requireOutput(options->output, ".png");
    const RenderOptions render = renderOptions(options->picture);
    std::vector<TriangleMesh> meshes;
    for (const std::string& path : options->examples) {
      meshes.push_back(loadForPicture(path, options->reading, terminal.progress()));
    }
    const Image8 image = renderSideBySide(meshes, render, terminal.progress());
    terminal.stopIfInterrupted();
    writePng(options->output, image);
    terminal.say("picture", options->output);
  };
}

}  // namespace exemplar
