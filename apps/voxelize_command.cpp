// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// exemplar voxelize: an example as a grid of labels.

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/command.h"
#include "apps/label_example.h"
#include "apps/terminal.h"
#include "core/error.h"
#include "core/file.h"
#include "mesh/mesh_file.h"
#include "voxelize/label_mesh.h"

namespace exemplar {
namespace {

struct Options {
  std::string example, output;
  bool pieces = false;
  LabelReading reading;
  CommonOptions common;
};

/// A volume or height map: what is solid in it.
LabelGrid solidOf(const std::string& path, const LabelReading& reading, const Progress& progress) {
  ExampleOptions options;
  options.resolution = reading.resolution;
  const DistanceField field = loadExample(path, options, progress).field;
  LabelGrid grid;
  grid.cells = Array3D<Label>(field.size());
  grid.labels = {emptyLook(), LabelLook{.name = "solid"}};
  grid.cellSize = {field.voxelSize, field.voxelSize, field.voxelSize};
  grid.origin = field.box().min;
  for (std::size_t n = 0; n < grid.cells.count(); ++n) {
    grid.cells.values()[n] = field.values.values()[n] < 0;
  }
  return grid;
}

bool holdsField(const std::string& path) {
  const std::string ending = lowerExtension(path);
  return ending == ".pgm" || ending == ".asc";
}

void voxelize(const Options& options) {
  const ThreadLimit limit(options.common.threads);
  Terminal terminal(options.common.quiet);
  requireOutput(options.output, kLabelOutputEndings);
  LabelReading reading = options.reading;
  reading.voxels = !options.pieces;
  LabelExample example;
  if (holdsField(options.example)) {
    example.grid = solidOf(options.example, reading, terminal.progress());
  } else {
    try {
      example = loadLabelExample(options.example, reading, terminal.progress());
    } catch (const InputError&) {
      // A .vdb without labels may hold distances.
      if (lowerExtension(options.example) != ".vdb") throw;
      example.grid = solidOf(options.example, reading, terminal.progress());
    }
  }
  terminal.stopIfInterrupted();
  terminal.step("writing " + options.output);
  const std::string written =
      writeLabelResult(options.output, example.grid, example, false, reading.mesh);
  std::int64_t filled = 0;
  for (const Label label : example.grid.cells.values()) {
    filled += !isEmpty(example.grid.labels[label]);
  }
  terminal.say("labels", withThousands(example.grid.labelCount()) + ", " + withThousands(filled) +
                             " of " +
                             withThousands(static_cast<long long>(example.grid.cells.count())) +
                             " cells not empty");
  terminal.say("written", written);
}

}  // namespace

CommandRun addVoxelizeCommand(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("voxelize", "Write an example as a grid of labels (cells of materials)");
  command
      ->add_option("EXAMPLE", options->example,
                   "a mesh, a scene, a volume, a height map (.pgm .asc), a picture or a label grid")
      ->required();
  command
      ->add_option(
          "-o,--output", options->output,
          std::string("what to write; its ending chooses the format: ") + kLabelOutputEndings)
      ->required();
  command->add_flag("--pieces", options->pieces,
                    "label a mesh's cells by what they hold (equal pieces, equal labels), not by "
                    "material");
  command
      ->add_option("--fill", options->reading.fill,
                   "which cells of a mesh are not empty: whose centres are inside (solid), that "
                   "hold surface (surface), or both (the default)")
      ->transform(CLI::CheckedTransformer(std::map<std::string, VoxelFill>{
          {"solid", VoxelFill::Solid}, {"surface", VoxelFill::Surface}, {"both", VoxelFill::Both}}))
      ->option_text("solid|surface|both");
  addLabelReadingOptions(*command, options->reading);
  addCommonOptions(*command, options->common);
  return [options] { voxelize(*options); };
}

}  // namespace exemplar
