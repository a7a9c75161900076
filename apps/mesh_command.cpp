// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// exemplar mesh: a signed distance grid, or a grid of labels, as triangles.

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/command.h"
#include "apps/terminal.h"
#include "core/error.h"
#include "mesh/mesh_file.h"
#include "mesh/mesh_health.h"
#include "reconstruct/field_to_mesh.h"
#include "voxelize/label_file.h"
#include "voxelize/label_mesh.h"

namespace exemplar {

CommandRun addMeshCommand(CLI::App& app) {
  struct Options {
    std::string example, output;
    ExampleOptions reading;
    CommonOptions common;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("mesh", "Write the surface of a volume, or of any example, as a mesh");
  command
      ->add_option("EXAMPLE", options->example,
                   ".vdb, or any other example; labels (.txt .vox) become boxes")
      ->required();
  command
      ->add_option("-o,--output", options->output,
                   "the mesh to write: " + std::string(kMeshEndings))
      ->required();
  addExampleOptions(*command, options->reading);
  addCommonOptions(*command, options->common);

  return [options] {
    const ThreadLimit limit(options->common.threads);
    Terminal terminal(options->common.quiet);
    requireOutput(options->output, kMeshEndings);
    if (isLabelFile(options->example)) {
      const LabelGrid grid = readLabels(options->example);
      terminal.step("finding faces");
      const TriangleMesh mesh = labelMesh(grid);
      if (mesh.triangles.empty()) {
        throw InputError(options->example + ": all of its cells are empty");
      }
      writeMesh(options->output, mesh, options->reading.mesh);
      terminal.say("labels", withThousands(grid.labelCount()) + " in " + readableSize(grid.size()));
      terminal.say("mesh", options->output + ": " + readableHealth(meshHealth(mesh)));
      return;
    }
    const Example example = loadExample(options->example, options->reading, terminal.progress());
    terminal.step("contouring");
    const TriangleMesh mesh = fieldToMesh(example.field);
    terminal.step("writing " + options->output);
    writeMesh(options->output, mesh, options->reading.mesh);
    terminal.say("example", example.description);
    terminal.say("mesh", options->output + ": " + readableHealth(meshHealth(mesh)));
  };
}

}  // namespace exemplar
