// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// exemplar engines: what makes more of an example, and what can be set.

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/command.h"
#include "apps/help.h"
#include "core/json_text.h"
#include "engine/engine.h"
#include "engine/json.h"
#include "engine/settings_page.h"

namespace exemplar {

Command addEnginesCommand(CLI::App& app) {
  struct Options {
    bool json = false, markdown = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("engines", "List the engines and what can be set");
  CLI::Option* json =
      command->add_flag("--json", options->json, "every setting as JSON, for programs");
  command->add_flag("--markdown", options->markdown, "every setting as a page (docs/settings.md)")
      ->excludes(json);
  command->footer(
      examplesFooter({"engines", "engines --json", "engines --markdown > settings.md"}));
  return {command, addCommonOptions(*command), [options](Terminal& terminal) {
            if (options->json) {
              terminal.print(jsonText(settingsJson(), 2) + "\n");
            } else if (options->markdown) {
              terminal.print(settingsPage());
            } else {
              for (const Engine* engine : engines())
                terminal.say(engine->name(), std::string(engine->meaning()));
            }
          }};
}

}  // namespace exemplar
