// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// exemplar voxelize: an example as a grid of labels.

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/command.h"
#include "apps/help.h"
#include "core/file.h"
#include "engine/output.h"
#include "engine/words.h"

namespace exemplar {
namespace {

struct Options {
  std::string example, output;
  bool pieces = false;
  Settings settings;
};

/// Cells of a mesh that are not empty.
const SettingTable<ReadOptions>& fillSettings() {
  static const SettingTable<ReadOptions> table{choiceRow<ReadOptions, VoxelFill>(
      "fill", &ReadOptions::fill,
      "which cells of a mesh are not empty: those whose centers are inside (solid), that hold "
      "surface (surface), or both",
      {{"solid", VoxelFill::Solid}, {"surface", VoxelFill::Surface}, {"both", VoxelFill::Both}})};
  return table;
}

void voxelize(const Options& options, Terminal& terminal) {
  requireOutput(options.output, kLabelOutputEndings);
  ReadOptions reading = readingOf(options.settings, Form::Labels);
  fillSettings().apply(options.settings, reading);
  reading.voxels = !options.pieces;
  const Example example = readSolid(options.example, reading, terminal.progress().part(0, 0.8));
  for (const std::string& warning : example.warnings) terminal.warn(warning);
  const Written written = writeLabels(options.output, example.labels(), example,
                                      {.mesh = reading.mesh}, terminal.progress().part(0.8, 1));
  std::int64_t filled = 0;
  const LabelGrid& grid = example.labels();
  for (const Label label : grid.cells.values()) filled += !isEmpty(grid.labels[label]);
  terminal.say("labels", withThousands(grid.labelCount()) + ", " + withThousands(filled) + " of " +
                             withThousands(static_cast<long long>(grid.cells.count())) +
                             " cells not empty");
  terminal.wrote(written.label, options.output, written.text);
  for (const std::string& warning : written.warnings) terminal.warn(warning);
}

}  // namespace

Command addVoxelizeCommand(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("voxelize", "Write an example as a grid of labels (cells of materials)");
  command
      ->add_option(
          "EXAMPLE", options->example,
          "a mesh, a scene, a volume, a height map (.asc .tif .exr .pgm .r16 .raw), a picture "
          "or a label grid")
      ->required();
  command
      ->add_option(
          "-o,--output", options->output,
          std::string("what to write; its ending chooses the format: ") + kLabelOutputEndings)
      ->required();
  command->add_flag("--pieces", options->pieces,
                    "label a mesh's cells by what they hold (equal pieces, equal labels), not by "
                    "material");
  SettingOptions rows;
  rows.add("Reading the example", "", fillSettings().settings());
  rows.add("Reading the example", "", readingSettings(Form::Labels).settings());
  rows.install(*command, options->settings);
  command->footer(examplesFooter({"voxelize house.glb -o house.vox --cell 0.5",
                                  "voxelize town.obj -o town.txt --cell 2 --pieces",
                                  "voxelize flowers.png -o flowers.txt --piece 3 --overlap"}));
  return {command, addCommonOptions(*command),
          [options](Terminal& terminal) { voxelize(*options, terminal); }};
}

}  // namespace exemplar
