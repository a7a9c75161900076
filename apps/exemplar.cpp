// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// The `exemplar` command: parse, call, report. No algorithm lives here.
//
// Exit status: 0 done; 2 the command or the input is wrong; 3 synthesis could not be completed;
// 4 interrupted. Every failure is one line on stderr.

#include <CLI/CLI.hpp>
#include <iostream>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "apps/command.h"
#include "apps/terminal.h"
#include "core/error.h"

namespace {

enum ExitStatus { kDone = 0, kWrongInput = 2, kUnfinished = 3, kInterrupted = 4 };

/// The first line of a message, so that an error stays one line.
std::string firstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

int fail(const std::string& message, ExitStatus status) {
  std::cerr << "exemplar: " << firstLine(message) << std::endl;
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "exemplar: give it one example; get as much more of it as you want.\n"
      "An example is a mesh (.obj .ply .stl .off .glb), a volume (.vdb), a height map (.png .pgm\n"
      ".asc), a grid of labels (.txt .vox) or a scene (.toml). 'exemplar COMMAND --help' tells a\n"
      "command's options."};
  app.name("exemplar");
  app.set_version_flag("--version", EXEMPLAR_VERSION);
  app.require_subcommand(1);
  app.get_formatter()->column_width(34);

  using exemplar::CommandRun;
  std::vector<std::pair<const char*, CommandRun>> commands{
      {"synth", exemplar::wantsModelEngine(argc, argv) ? exemplar::addModelSynthCommand(app)
                                                       : exemplar::addSynthCommand(app)},
      {"sdf", exemplar::addSdfCommand(app)},
      {"mesh", exemplar::addMeshCommand(app)},
      {"render", exemplar::addRenderCommand(app)},
      {"measure", exemplar::addMeasureCommand(app)},
      {"scene", exemplar::addSceneCommand(app)},
      {"voxelize", exemplar::addVoxelizeCommand(app)},
      {"info", exemplar::addInfoCommand(app)},
      {"compare", exemplar::addCompareCommand(app)},
  };

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& e) {
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    return fail(std::string(e.what()) + " (see exemplar --help)", kWrongInput);
  }

  try {
    for (const auto& [name, run] : commands) {
      if (app.got_subcommand(name)) run();
    }
    return kDone;
  } catch (const exemplar::Interrupted& e) {
    return fail(e.what(), kInterrupted);
  } catch (const exemplar::Unfinished& e) {
    return fail(e.what(), kUnfinished);
  } catch (const exemplar::InputError& e) {
    return fail(e.what(), kWrongInput);
  } catch (const std::bad_alloc&) {
    return fail("out of memory; use a lower --resolution or a smaller --scale", kWrongInput);
  } catch (const std::exception& e) {
    return fail(e.what(), kWrongInput);
  }
}
