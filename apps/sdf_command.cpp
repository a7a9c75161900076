// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// exemplar sdf: an example as a signed distance grid.

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/command.h"
#include "apps/terminal.h"
#include "sdf/vdb_file.h"

namespace exemplar {

CommandRun addSdfCommand(CLI::App& app) {
  struct Options {
    std::string example, output;
    ExampleOptions reading;
    CommonOptions common;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("sdf", "Write an example's signed distance field (.vdb)");
  command->add_option("EXAMPLE", options->example, "mesh, volume, height map or scene")->required();
  command->add_option("-o,--output", options->output, "the .vdb file to write")->required();
  addExampleOptions(*command, options->reading);
  addCommonOptions(*command, options->common);

  return [options] {
    const ThreadLimit limit(options->common.threads);
    Terminal terminal(options->common.quiet);
    requireOutput(options->output, ".vdb");
    const Example example = loadExample(options->example, options->reading, terminal.progress());
    terminal.step("writing " + options->output);
    writeVdb(options->output, example.field, example.wraps);
    terminal.say("example", example.description);
    terminal.say("field", options->output + ": " + readableSize(example.field.size()));
  };
}

}  // namespace exemplar
