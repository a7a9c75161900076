// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// exemplar mesh: a signed distance grid, or a grid of labels, as triangles.

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/command.h"
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
  std::string source, output, origins, example;
  std::vector<std::string> with;
  Settings settings;
};

/// The surface of a synthesis' field with what its origins say of the examples.
TriangleMesh dressed(const Options& options, const ReadOptions& reading, int detail,
                     const Progress& progress) {
  std::vector<Source> sources{options.example};
  sources.insert(sources.end(), options.with.begin(), options.with.end());
  ReadOptions asMade = reading;
  if (const auto scale = readOriginsScale(options.origins))
    asMade.wanted = Extent{.scale = scale, .size = {}};
  std::vector<Example> examples = readExamples(sources, asMade, progress.part(0, 0.3));
  Result result = readResult(options.source, options.origins, examples);
  if (detail > 1) {
    examples = refined(examples, detail, progress.part(0.3, 0.5));
    result = withDetail(result, examples, detail, progress.part(0.5, 0.6));
  }
  return realize(result, examples, {}, progress.part(0.6, 0.9)).mesh;
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

TriangleMesh meshOf(const Options& options, const ReadOptions& reading, Terminal& terminal) {
  const Progress& progress = terminal.progress();
  if (sourceKind(options.source) == SourceKind::Labels) return boxes(options, terminal);
  SurfaceOptions surface;
  surfaceSettings(Form::Field).apply(options.settings, surface);
  if (!options.origins.empty()) return dressed(options, reading, surface.detail, progress);
  if (surface.detail > 1) throw InputError("`detail` needs --origins and --example");
  const Example example = readExample(options.source, reading, progress.part(0, 0.4));
  for (const std::string& warning : example.warnings) terminal.warn(warning);
  terminal.say("example", example.description);
  return contourOf(example, progress.part(0.4, 0.9));
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
      ->add_option("-o,--output", options->output,
                   "the mesh to write: " + std::string(kMeshEndings))
      ->required();
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
    if (setting.key == "detail") rows.add("Surface", "", {&setting, 1});
  rows.install(*command, options->settings);
  addReadingOptions(*command, Form::Field, options->settings);

  return {command, addCommonOptions(*command), [options](Terminal& terminal) {
            requireOutput(options->output, kMeshEndings);
            if (options->origins.empty() != options->example.empty())
              throw InputError("--origins and --example go together");
            const ReadOptions reading = readingOf(options->settings, Form::Field);
            const TriangleMesh mesh = meshOf(*options, reading, terminal);
            terminal.progress().report("writing " + options->output, 0.9);
            writeMesh(options->output, mesh, reading.mesh);
            terminal.wrote("mesh", options->output,
                           options->output + ": " + readableHealth(meshHealth(mesh)));
          }};
}

}  // namespace exemplar
