// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// exemplar completion: what a shell needs to complete the command's words.

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/command.h"
#include "apps/completion.h"
#include "apps/help.h"
#include "mesh/scene.h"

namespace exemplar {

Command addCompletionCommand(CLI::App& app) {
  auto shell = std::make_shared<std::string>();
  CLI::App* command =
      app.add_subcommand("completion", "Print what a shell needs to complete the command's words");
  command->add_option("SHELL", *shell, "bash, zsh or fish")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish"}))
      ->option_text("bash|zsh|fish");
  command->footer(
      examplesFooter({"completion bash > ~/.local/share/bash-completion/completions/exemplar",
                      "completion zsh > ~/.zfunc/_exemplar",
                      "completion fish > ~/.config/fish/completions/exemplar.fish"}));
  return {command, addCommonOptions(*command), [shell, &app](Terminal& terminal) {
            terminal.print(completionScript(*shell, completedCommands(app, bundledScenes())));
          }};
}

}  // namespace exemplar
