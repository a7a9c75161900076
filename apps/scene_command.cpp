// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// exemplar scene: a bundled scene's example as a mesh.

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/command.h"
#include "apps/terminal.h"
#include "mesh/mesh_file.h"
#include "mesh/scene.h"

namespace exemplar {

CommandRun addSceneCommand(CLI::App& app) {
  struct Options {
    std::string name, output, extent = "1,1,1";
    SceneOptions scene;
    MeshFileOptions file;
    CommonOptions common;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("scene", "Write a bundled scene's example as a mesh");
  std::string names;
  for (const std::string& name : bundledScenes()) names += (names.empty() ? "" : ", ") + name;
  command->add_option("NAME", options->name, names + "; or a scene .toml of your own")->required();
  command
      ->add_option("-o,--output", options->output,
                   "the mesh to write: " + std::string(kMeshEndings))
      ->required();
  command->add_option("--scene-seed", options->scene.seed, "another sample of the scene's process");
  command->add_option("--extent", options->extent, "make a window this many times as large: X,Y,Z");
  addUpOption(*command, options->file);
  addCommonOptions(*command, options->common);

  return [options] {
    const ThreadLimit limit(options->common.threads);
    Terminal terminal(options->common.quiet);
    requireOutput(options->output, kMeshEndings);
    options->scene.extent = parseTriple(options->extent, "--extent");
    const Scene scene = readScene(findScene(options->name), options->scene);
    writeMesh(options->output, scene.mesh, options->file);
    terminal.say("scene", scene.name + " written to " + options->output + ": " +
                              withThousands(static_cast<long long>(scene.mesh.triangles.size())) +
                              " triangles");
  };
}

}  // namespace exemplar
