// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// exemplar mesh: a signed distance grid, or a grid of labels, as triangles.

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <memory>

#include "apps/command.h"
#include "apps/synth_control.h"
#include "apps/terminal.h"
#include "core/error.h"
#include "mesh/mesh_file.h"
#include "mesh/mesh_health.h"
#include "reconstruct/field_to_mesh.h"
#include "reconstruct/reconstruct.h"
#include "sdf/vdb_file.h"
#include "synth/geometry/detail.h"
#include "voxelize/label_file.h"
#include "voxelize/label_mesh.h"

namespace exemplar {
namespace {

/// The surface of a synthesis' field with what its origins say of the examples.
TriangleMesh dressed(const std::string& path, const std::string& originsPath,
                     const std::string& examplePath, const SynthControl& control,
                     const ExampleOptions& reading, Terminal& terminal) {
  SynthesisResult result;
  std::array<bool, 3> wraps{};
  result.field = readVdb(path, &wraps);
  result.origins = readOriginsVdb(originsPath);
  if (result.origins.size() != result.field.size()) {
    throw InputError(originsPath + ": origins of " + readableSize(result.origins.size()) +
                     " for a volume of " + readableSize(result.field.size()));
  }
  Examples examples(loadExample(examplePath, reading, terminal.progress()), control, reading,
                    terminal.progress());
  const double voxel = examples.first().field.voxelSize;
  if (std::abs(voxel / result.field.voxelSize - 1) > 1e-3) {
    throw InputError(examplePath + ": sampled with voxels of " + std::to_string(voxel) + ", " +
                     path + " has " + std::to_string(result.field.voxelSize) +
                     "; give the --resolution and --padding of the synthesis");
  }
  for (const Origin& origin : result.origins.values()) {
    if (origin.example >= examples.all.size() ||
        !examples.all[origin.example].field.values.contains(origin.cell())) {
      throw InputError(originsPath + ": names samples that " + examplePath +
                       " does not have; give the examples and options of the synthesis");
    }
  }
  if (control.detail > 1) {
    terminal.step("pulling finer detail");
    examples.refine(control.detail, reading, terminal.progress());
    result = addDetail(examples.fields(), result.origins, control.detail, terminal.progress());
    if (result.status == SynthesisStatus::Cancelled) throw Interrupted();
  }
  terminal.step("making the surface");
  ReconstructOptions surface;
  surface.blend = 0;
  surface.contour.wraps = wraps;
  return reconstructSurface(result.field, result.origins, examples.views(), surface,
                            terminal.progress())
      .mesh;
}

}  // namespace

CommandRun addMeshCommand(CLI::App& app) {
  struct Options {
    std::string field, output, origins, example;
    SynthControl control;  // of it only more examples, and detail
    ExampleOptions reading;
    CommonOptions common;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("mesh", "Write the surface of a volume, or of any example, as a mesh");
  command
      ->add_option("EXAMPLE", options->field,
                   ".vdb, or any other example; labels (.txt .vox) become boxes")
      ->required();
  command
      ->add_option("-o,--output", options->output,
                   "the mesh to write: " + std::string(kMeshEndings))
      ->required();
  command->add_option("--origins", options->origins,
                      "where each sample of the volume came from (.vdb, by synth --origins): takes "
                      "materials, colours and detail from --example");
  command->add_option(
      "--example", options->example,
      "the example that the origins speak of, or another version of it: recoloured, "
      "or finer; sampled as for the synthesis");
  command->add_option("--with", options->control.with, "the further examples of the synthesis");
  command
      ->add_option("--detail", options->control.detail,
                   "re-make the surface at this many times the resolution, from --example (1)")
      ->check(CLI::Range(1, 16));
  addExampleOptions(*command, options->reading);
  addCommonOptions(*command, options->common);

  return [options] {
    const ThreadLimit limit(options->common.threads);
    Terminal terminal(options->common.quiet);
    requireOutput(options->output, kMeshEndings);
    if (isLabelFile(options->field)) {
      const LabelGrid grid = readLabels(options->field);
      terminal.step("finding faces");
      const TriangleMesh mesh = labelMesh(grid);
      if (mesh.triangles.empty()) {
        throw InputError(options->field + ": all of its cells are empty");
      }
      writeMesh(options->output, mesh, options->reading.mesh);
      terminal.say("labels", withThousands(grid.labelCount()) + " in " + readableSize(grid.size()));
      terminal.say("mesh", options->output + ": " + readableHealth(meshHealth(mesh)));
      return;
    }
    if (options->origins.empty() != options->example.empty()) {
      throw InputError("--origins and --example go together");
    }
    if (!options->origins.empty()) {
      const TriangleMesh mesh = dressed(options->field, options->origins, options->example,
                                        options->control, options->reading, terminal);
      terminal.step("writing " + options->output);
      writeMesh(options->output, mesh, options->reading.mesh);
      terminal.say("mesh", options->output + ": " + readableHealth(meshHealth(mesh)));
      return;
    }
    if (options->control.detail > 1) throw InputError("--detail needs --origins and --example");
    const Example example = loadExample(options->field, options->reading, terminal.progress());
    terminal.step("contouring");
    const TriangleMesh mesh = fieldToMesh(example.field, {.wraps = example.wraps});
    terminal.step("writing " + options->output);
    writeMesh(options->output, mesh, options->reading.mesh);
    terminal.say("example", example.description);
    terminal.say("mesh", options->output + ": " + readableHealth(meshHealth(mesh)));
  };
}

}  // namespace exemplar
