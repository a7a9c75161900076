// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace exemplar {

/// What the shell proposes after a word.
enum class Proposal { Nothing, Files, Values };

struct CompletedOption {
  std::vector<std::string> shortNames, longNames;  ///< without their dashes: "o", "output"
  std::string meaning;                             ///< one line
  bool takesValue = false;
  Proposal proposal = Proposal::Nothing;  ///< of its value
  std::vector<std::string> values;        ///< those that may follow, where they are few
};

struct CompletedCommand {
  std::string name, meaning;
  std::vector<CompletedOption> options;
  std::vector<std::string> words;  ///< proposed beside files where no option is meant
};

/// The command's subcommands and options as they are declared; what takes an example is proposed
/// the names of the bundled scenes, too.
std::vector<CompletedCommand> completedCommands(const CLI::App& app,
                                                const std::vector<std::string>& scenes);

/// A script that completes the command's words in a shell, to be kept where the shell looks:
/// `bash`, `zsh` or `fish`. Throws InputError for others. Costs O(options).
std::string completionScript(const std::string& shell,
                             const std::vector<CompletedCommand>& commands);

}  // namespace exemplar
