// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// exemplar scene: a bundled scene's example as a mesh.

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/command.h"
#include "apps/help.h"
#include "core/error.h"
#include "engine/output.h"
#include "engine/source.h"
#include "engine/words.h"
#include "mesh/mesh_file.h"
#include "mesh/scene.h"
#include "voxelize/label_file.h"

namespace exemplar {
namespace {

struct SceneRequest {
  SceneOptions scene;
  MeshFileOptions file;
};

const SettingTable<SceneRequest>& sceneSettings() {
  using O = SceneRequest;
  static const SettingTable<O> table{
      settingRow<O>(
          "scene-seed", [](O & o) -> auto& { return o.scene.seed; },
          "another sample of the scene's process", {}, "", "the scene's"),
      settingRow<O>("extent", [](O & o) -> auto& { return o.scene.extent; },
                    "make a window this many times as large", {1, 1e6}),
      choiceRow<O, UpAxis>(
          "up", [](O & o) -> auto& { return o.file.up; },
          "which axis is up in mesh files: y for .obj and .glb, else z, where it is auto",
          {{"auto", UpAxis::Default}, {"y", UpAxis::Y}, {"z", UpAxis::Z}})};
  return table;
}

}  // namespace

Command addSceneCommand(CLI::App& app) {
  struct Options {
    std::string name, output;
    Settings settings;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "scene", "Write a bundled scene's example as a mesh, or a volume's labels");
  command
      ->add_option("NAME", options->name,
                   joined(bundledScenes(), "and") + "; or a scene .toml of your own")
      ->required();
  command
      ->add_option("-o,--output", options->output,
                   "what to write: " + std::string(kMeshEndings) + "; of a volume " + kLabelEndings)
      ->required();
  SettingOptions rows;
  rows.add("Scene", "", sceneSettings().settings());
  rows.install(*command, options->settings);

  command->footer(
      examplesFooter({"scene chainmail -o chainmail.glb", "scene minerals -o minerals.vox",
                      "scene balls -o balls.obj --scene-seed 2 --extent 2,2,1"}));
  return {command, addCommonOptions(*command), [options](Terminal& terminal) {
            const Source source(findScene(options->name));
            const SourceKind kind = sourceKind(source);
            const bool volume = kind == SourceKind::Labels;
            requireOutput(options->output, volume ? kLabelEndings : kMeshEndings);
            SceneRequest request;
            sceneSettings().apply(options->settings, request);
            if ((volume || kind == SourceKind::Solids) &&
                (request.scene.seed || request.scene.extent != Vec3d{1, 1, 1}))
              throw InputError(
                  "`scene-seed`, `extent`: a scene of solids or of a volume is what "
                  "it is");
            if (volume) {
              const LabelGrid grid = readLabelGrid(source);
              writeLabels(options->output, grid);
              terminal.wrote("scene", options->output,
                             source.name() + " written to " + options->output + ": " +
                                 readableSize(grid.size(), "cells"));
              return;
            }
            if (kind == SourceKind::Solids) {
              writeMesh(options->output, readTriangles(source, {}), request.file);
              terminal.wrote("scene", options->output,
                             source.name() + " written to " + options->output);
              return;
            }
            const Scene scene = readScene(findScene(options->name), request.scene);
            writeMesh(options->output, scene.mesh, request.file);
            terminal.wrote("scene", options->output,
                           scene.name + " written to " + options->output + ": " +
                               withThousands(static_cast<long long>(scene.mesh.triangles.size())) +
                               " triangles");
          }};
}

}  // namespace exemplar
