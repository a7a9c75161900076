// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// exemplar mesh: a signed distance grid, or a grid of labels, as triangles.

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "apps/command.h"
#include "apps/help.h"
#include "core/error.h"
#include "engine/output.h"
#include "engine/realize.h"
#include "engine/words.h"
#include "mesh/mesh_file.h"
#include "mesh/mesh_health.h"
#include "sdf/vdb_file.h"
#include "voxelize/label_mesh.h"

namespace exemplar {
namespace {

struct Options {
  std::string source, origins, example;
  std::vector<std::string> outputs, with;
  Settings settings;
};

/// Refuses what cannot be written, and what would overwrite another file of this run.
void checkOutputs(const Options& options, int lods) {
  for (const std::string& output : options.outputs) requireOutput(output, kMeshEndings);
  std::vector<std::filesystem::path> inputs(options.with.begin(), options.with.end());
  for (const std::string* input : {&options.source, &options.origins, &options.example})
    if (!input->empty()) inputs.emplace_back(*input);
  requireDistinct(filesOf(options.outputs, lods), inputs);
}

/// The surface of a synthesis' field with what its origins say of the examples.
Surface dressed(const Options& options, const ReadOptions& reading, const SurfaceOptions& surface,
                const Progress& progress) {
  std::vector<Source> sources{options.example};
  sources.insert(sources.end(), options.with.begin(), options.with.end());
  ReadOptions asMade = reading;
  if (const auto scale = readOriginsScale(options.origins))
    asMade.wanted = Extent{.scale = scale, .size = {}};
  std::vector<Example> examples = readExamples(sources, asMade, progress.part(0, 0.3));
  requireKept(options.outputs, surface.lods, examples);
  Result result = readResult(options.source, options.origins, examples);
  if (surface.detail > 1) {
    examples = refined(examples, surface.detail, progress.part(0.3, 0.5));
    result = withDetail(result, examples, surface.detail, progress.part(0.5, 0.6));
  }
  return realize(result, examples, surface, progress.part(0.6, 0.9));
}

/// The boxes of a grid of labels.
TriangleMesh boxes(const Options& options, Terminal& terminal) {
  const LabelGrid grid = readLabelGrid(options.source);
  terminal.progress().report("finding faces", 0.2);
  TriangleMesh mesh = labelMesh(grid);
  if (mesh.triangles.empty()) throw InputError(options.source + ": all of its cells are empty");
  terminal.say("labels",
               withThousands(grid.labelCount()) + " in " + readableSize(grid.size(), "cells"));
  return mesh;
}

Surface surfaceOf(const Options& options, const ReadOptions& reading, const SurfaceOptions& surface,
                  Terminal& terminal) {
  const Progress& progress = terminal.progress();
  if (sourceKind(options.source) == SourceKind::Labels) {
    if (surface.lods > 0 || surface.simplify > 0 || surface.triangles > 0) {
      throw InputError(options.source +
                       ": labels become boxes, which are not simplified; leave out `lods`, "
                       "`simplify` and `triangles`");
    }
    Surface made{boxes(options, terminal), {}, 0, {}};
    made.health = meshHealth(made.mesh);
    return made;
  }
  if (!options.origins.empty()) return dressed(options, reading, surface, progress);
  if (surface.detail > 1) throw InputError("`detail` needs --origins and --example");
  if (surface.source) throw InputError("`source` needs --origins and --example");
  const Example example = readExample(options.source, reading, progress.part(0, 0.4));
  requireKept(options.outputs, surface.lods, {&example, 1});
  for (const std::string& warning : example.warnings) terminal.warn(warning);
  terminal.say("example", example.description);
  return contourOf(example, surface, progress.part(0.4, 0.9));
}

/// Writes a surface and its coarser copies to all outputs.
void write(const Options& options, const ReadOptions& reading, const Surface& surface,
           Terminal& terminal) {
  OutputOptions output;
  output.mesh = reading.mesh;
  Warnings warnings;
  output.mesh.warnings = &warnings;
  for (const std::string& path : options.outputs) {
    terminal.progress().report("writing " + path, 0.9);
    writeMesh(path, surface.mesh, output.mesh);
    terminal.wrote("mesh", path, path + ": " + readableHealth(surface.health));
    for (const Written& lod : writeLods(path, surface, output)) {
      terminal.wrote(lod.label, lod.path, lod.text);
      warnings.insert(warnings.end(), lod.warnings.begin(), lod.warnings.end());
    }
  }
  for (const std::string& warning : warnings) terminal.warn(warning);
}

}  // namespace

Command addMeshCommand(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("mesh", "Write the surface of a volume, or of any example, as a mesh");
  command
      ->add_option("EXAMPLE", options->source,
                   ".vdb, or any other example; labels (.txt .vox) become boxes")
      ->required();
  command
      ->add_option("-o,--output", options->outputs,
                   "the mesh to write (may be repeated): " + std::string(kMeshEndings))
      ->required()
      ->allow_extra_args(false);
  command->add_option("--origins", options->origins,
                      "where each sample of the volume came from (.vdb, by synth --origins): takes "
                      "materials, colors and detail from --example");
  command->add_option("--example", options->example,
                      "the example that the origins speak of, or another version of it: recolored, "
                      "or finer; sampled as for the synthesis");
  command->add_option("--with", options->with, "the further examples of the synthesis")
      ->allow_extra_args(false);
  SettingOptions rows;
  for (const Setting& setting : surfaceSettings(Form::Field).settings())
    if (setting.key != "surface") rows.add("Surface", "", {&setting, 1});
  rows.install(*command, options->settings);
  addReadingOptions(*command, Form::Field, options->settings);

  command->footer(examplesFooter(
      {"mesh statue.vdb -o statue.obj --triangles 20000", "mesh town.vox -o town.glb",
       "mesh more.vdb --origins from.vdb --example wall.obj -o more.glb"}));
  return {command, addCommonOptions(*command), [options](Terminal& terminal) {
            if (options->origins.empty() != options->example.empty())
              throw InputError("--origins and --example go together");
            const ReadOptions reading = readingOf(options->settings, Form::Field);
            SurfaceOptions surface;
            surfaceSettings(Form::Field).apply(options->settings, surface);
            checkOutputs(*options, surface.lods);
            const Surface made = surfaceOf(*options, reading, surface, terminal);
            if (made.contoured > made.health.triangles) {
              terminal.say("simplified", withThousands(made.contoured) + " triangles to " +
                                             withThousands(made.health.triangles));
            }
            write(*options, reading, made, terminal);
          }};
}

}  // namespace exemplar
