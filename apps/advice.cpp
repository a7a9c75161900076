// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "apps/advice.h"

#include <algorithm>
#include <filesystem>
#include <vector>

#include "core/error.h"
#include "core/file.h"
#include "core/text.h"
#include "engine/source.h"

namespace exemplar {
namespace {

/// ": did you mean scale?", or nothing.
std::string meant(const std::string& word, std::span<const std::string> names) {
  const std::string nearest = nearestName(word, names);
  return nearest.empty() ? "" : "; did you mean " + nearest + "?";
}

std::vector<std::string> commandsOf(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* sub : app.get_subcommands({})) names.push_back(sub->get_name());
  return names;
}

std::vector<std::string> optionsOf(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

bool isExample(const std::string& word) {
  try {
    const Source source(word);
    sourceKind(source);
    requireThere(source);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

/// What an example's synthesis would be written to: of its own kind, mostly.
std::string outputFor(const std::string& example) {
  const std::filesystem::path path(example);
  const std::string ending = lowerExtension(path);
  const bool same = ending != ".toml" && ending != ".jpg" && ending != ".jpeg" && !ending.empty();
  return path.stem().string() + "_more" + (same ? ending : ".glb");
}

/// Of a first word that is no command.
std::string adviceOnCommand(const CLI::App& app, const std::string& word) {
  if (isExample(word))
    return word + ": say what to do with it: exemplar synth " + word + " -o " + outputFor(word);
  const std::vector<std::string> names = commandsOf(app);
  const std::string guess = meant(word, names);
  return word + ": no such command, and no example that is there" +
         (guess.empty() ? "; see exemplar --help" : guess);
}

/// The one of an application's commands that a word names; null where none does.
const CLI::App* commandNamed(const CLI::App& app, const std::string& word) {
  const auto named =
      app.get_subcommands([&](const CLI::App* sub) { return sub->get_name() == word; });
  return named.empty() ? nullptr : named.front();
}

/// Of the first option that a command, `name`, does not have; empty where it has all.
std::string adviceOnOption(const CLI::App& command, const std::string& name,
                           std::span<const std::string> words) {
  const std::vector<std::string> names = optionsOf(command);
  for (const std::string& word : words) {
    if (!word.starts_with("--") || word == "--") continue;
    const std::string option = word.substr(0, word.find('='));
    if (std::ranges::find(names, option) != names.end()) continue;
    const std::string guess = meant(option, names);
    return option + ": exemplar " + name + " has no such option" +
           (guess.empty() ? "; see exemplar " + name + " --help" : guess);
  }
  return {};
}

}  // namespace

std::string adviceOn(const CLI::App& app, std::span<const std::string> words,
                     const CLI::ParseError& error) {
  std::string name;
  if (!words.empty() && !words.front().starts_with('-')) {
    const CLI::App* command = commandNamed(app, words.front());
    if (!command) return adviceOnCommand(app, words.front());
    name = words.front();
    words = words.subspan(1);
    // Commands of commands.
    while (!words.empty()) {
      const CLI::App* inner = commandNamed(*command, words.front());
      if (!inner) break;
      command = inner;
      name += " " + words.front();
      words = words.subspan(1);
    }
    if (std::string advice = adviceOnOption(*command, name, words); !advice.empty()) return advice;
  }
  std::string what = error.what();
  std::replace(what.begin(), what.end(), '\n', ' ');
  return what + " (see exemplar " + (name.empty() ? "" : name + " ") + "--help)";
}

}  // namespace exemplar
