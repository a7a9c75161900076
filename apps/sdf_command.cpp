// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// exemplar sdf: an example as a signed distance grid.

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/command.h"
#include "apps/help.h"
#include "engine/output.h"
#include "engine/words.h"
#include "sdf/vdb_file.h"

namespace exemplar {

Command addSdfCommand(CLI::App& app) {
  struct Options {
    std::string example, output;
    Settings settings;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("sdf", "Write an example's signed distance field (.vdb)");
  command->add_option("EXAMPLE", options->example, "mesh, volume, height map or scene")->required();
  command->add_option("-o,--output", options->output, "the .vdb file to write")->required();
  addReadingOptions(*command, Form::Field, options->settings);

  command->footer(examplesFooter({"sdf statue.stl -o statue.vdb -r 128",
                                  "sdf wall.obj -o wall.vdb --padding 0,4,4",
                                  "sdf rock.vdb -o rock_y_up.vdb --up y"}));
  return {command, addCommonOptions(*command), [options](Terminal& terminal) {
            requireOutput(options->output, ".vdb");
            const Example example =
                readExample(options->example, readingOf(options->settings, Form::Field),
                            terminal.progress().part(0, 0.9));
            for (const std::string& warning : example.warnings) terminal.warn(warning);
            terminal.progress().report("writing " + options->output, 0.9);
            writeVdb(options->output, example.field(),
                     {.wraps = example.continues,
                      .turn = example.turn,
                      .yUp = example.reading.mesh.up == UpAxis::Y});
            terminal.say("example", example.description);
            terminal.wrote(
                "field", options->output,
                options->output + ": " + readableSize(example.field().size(), "samples"));
          }};
}

}  // namespace exemplar
