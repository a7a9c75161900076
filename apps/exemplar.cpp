// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// The `exemplar` command: parse, call, print. No algorithm lives here.
//
// Exit status: 0 done; 2 the command or the input is wrong; 3 synthesis could not be completed;
// 4 interrupted. Every failure is one line on stderr.

#include <CLI/CLI.hpp>
#include <iostream>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "apps/command.h"
#include "apps/terminal.h"
#include "core/error.h"

namespace {

enum ExitStatus { kDone = 0, kWrongInput = 2, kUnfinished = 3, kInterrupted = 4 };

int run(const exemplar::Command& command) {
  const exemplar::ThreadLimit limit(command.common->threads);
  exemplar::Terminal terminal(command.common->progress, command.common->quiet);
  const auto failed = [&](const std::string& message, ExitStatus status) {
    terminal.fail(message, status);
    return status;
  };
  try {
    command.run(terminal);
    terminal.done();
    return kDone;
  } catch (const exemplar::Cancelled&) {
    return failed(terminal.interruption(), kInterrupted);
  } catch (const exemplar::Unfinished& e) {
    return failed(e.what(), kUnfinished);
  } catch (const std::bad_alloc&) {
    return failed("out of memory; use a lower `resolution` or a smaller `scale`", kWrongInput);
  } catch (const std::exception& e) {
    return failed(e.what(), kWrongInput);
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "exemplar: give it one example; get as much more of it as you want.\n"
      "An example is a mesh (.obj .ply .stl .off .glb), a volume (.vdb), a height map (.png .pgm\n"
      ".asc), a grid of labels (.txt .vox) or a scene (.toml). 'exemplar COMMAND --help' lists a\n"
      "command's options."};
  app.name("exemplar");
  app.set_version_flag("--version", EXEMPLAR_VERSION);
  app.require_subcommand(1);
  app.get_formatter()->column_width(34);

  using namespace exemplar;
  const std::vector<Command> commands{
      addSynthCommand(app),   addSdfCommand(app),    addMeshCommand(app),     addRenderCommand(app),
      addMeasureCommand(app), addSceneCommand(app),  addVoxelizeCommand(app), addInfoCommand(app),
      addCompareCommand(app), addEnginesCommand(app)};
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& e) {
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    // Programs that asked for JSON read nothing else.
    const std::span<char*> words(argv, static_cast<std::size_t>(argc));
    bool json = false;
    for (std::size_t w = 1; w < words.size(); ++w) {
      const std::string_view word = words[w];
      json = json || word == "--progress=json" ||
             (word == "json" && std::string_view(words[w - 1]) == "--progress");
    }
    Terminal(json ? ProgressStyle::Json : ProgressStyle::None, false)
        .fail(std::string(e.what()) + " (see exemplar --help)", kWrongInput);
    return kWrongInput;
  }
  for (const Command& command : commands) {
    if (command.app->parsed()) return run(command);
  }
  return kWrongInput;
}
