// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// The `exemplar` command: parse, call, print. No algorithm lives here.
//
// Exit status: 0 done; 2 the command or the input is wrong; 3 synthesis could not be completed;
// 4 interrupted. Every failure is one line on stderr.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <new>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/advice.h"
#include "apps/command.h"
#include "apps/help.h"
#include "apps/terminal.h"
#include "apps/version.h"
#include "core/error.h"
#include "core/text.h"
#include "engine/engine.h"
#include "engine/request.h"
#include "engine/source.h"

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
    terminal.fail(e.what(), kUnfinished, e.conflict() ? &*e.conflict() : nullptr);
    return kUnfinished;
  } catch (const std::bad_alloc&) {
    return failed("out of memory; use a lower `resolution` or a smaller `scale`", kWrongInput);
  } catch (const std::exception& e) {
    return failed(e.what(), kWrongInput);
  }
}

/// Whether a word after an option's value is one more value of it: numbers with commas, or
/// KEY=VALUE, that no file is named like.
bool goesOn(const std::string& word) {
  const bool numbers =
      word.find(',') != word.npos && word.find_first_not_of("0123456789.,-") == word.npos;
  const bool pair = word.front() != '-' && word.find('=') != word.npos;
  std::error_code error;
  return (numbers || pair) && !std::filesystem::exists(word, error);
}

bool isPlainNumber(const std::string& word) {
  std::error_code error;
  return word.find_first_not_of("0123456789.") == word.npos && exemplar::parseNumber(word) &&
         !std::filesystem::exists(word, error);
}

/// The command's words, with an option that may be repeated once before each of its values, and
/// three numbers in one word: "--pin A B" is "--pin A --pin B", "--scale 2 2 1" "--scale 2,2,1".
std::vector<std::string> spelledOut(std::span<const std::string> words) {
  using exemplar::Form;
  std::set<std::string> repeated, triples;
  const auto note = [&](std::span<const exemplar::Setting> settings) {
    for (const exemplar::Setting& setting : settings) {
      const bool triple = setting.type == exemplar::SettingType::Size ||
                          setting.type == exemplar::SettingType::Lengths;
      if (setting.repeats) repeated.insert("--" + setting.key);
      if (triple) triples.insert("--" + setting.key);
    }
  };
  note(exemplar::requestSettings());
  for (const Form form : {Form::Field, Form::Labels, Form::Polygons, Form::Map})
    note(exemplar::readingSettings(form).settings());
  for (const exemplar::Engine* engine : exemplar::engines()) note(engine->settings());
  triples.insert("-s");

  std::vector<std::string> all;
  for (std::size_t w = 0; w < words.size(); ++w) {
    all.push_back(words[w]);
    if (triples.contains(words[w]) && w + 3 < words.size() &&
        std::ranges::all_of(words.subspan(w + 1, 3), isPlainNumber)) {
      all.push_back(words[w + 1] + "," + words[w + 2] + "," + words[w + 3]);
      w += 3;
    } else if (repeated.contains(words[w]) && w + 1 < words.size()) {
      const std::string& option = words[w];
      all.push_back(words[++w]);
      for (; w + 1 < words.size() && goesOn(words[w + 1]); ++w) {
        all.push_back(option);
        all.push_back(words[w + 1]);
      }
    }
  }
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace exemplar;
  CLI::App app{
      "exemplar: give it one example; get as much more of it as you want.\n\n" +
      wrapped(
          std::string("An example is a mesh, a volume, a height map, a picture, a grid of labels "
                      "(") +
              kExampleEndings + ") or a bundled scene, by its name.",
          0)};
  app.name("exemplar");
  app.set_version_flag(
      "--version", EXEMPLAR_VERSION,
      "print version, libraries and machine and exit; --version --json for programs");
  app.formatter(std::make_shared<HelpFormatter>());
  app.footer(examplesFooter({"synth chainmail -o more.glb --preview more.png",
                             "synth wall.obj -o wall_more.obj --scale 3,1,1", "synth --help"}));
  std::vector<Command> commands{
      addSynthCommand(app),    addSdfCommand(app),       addMeshCommand(app),
      addRenderCommand(app),   addMeasureCommand(app),   addSceneCommand(app),
      addVoxelizeCommand(app), addInfoCommand(app),      addCompareCommand(app),
      addEnginesCommand(app),  addCompletionCommand(app)};
  for (Command& command : addWorldCommands(app)) commands.push_back(std::move(command));
  for (const Command& command : commands)
    command.app->set_help_all_flag("--help-all", "list every option and exit");
  const std::vector<std::string> given(argv + 1, argv + argc);
  if (given.empty()) {
    std::fputs(app.help().c_str(), stdout);
    return kDone;
  }
  if (given.front() == "--version" && given.size() <= 2) {
    const bool json = given.size() == 2 && given.back() == "--json";
    if (json || given.size() == 1) {
      std::fputs((json ? versionJson() : versionText()).c_str(), stdout);
      return kDone;
    }
  }
  try {
    std::vector<std::string> words = spelledOut(given);
    std::reverse(words.begin(), words.end());  // as CLI11 wants them
    app.parse(std::move(words));
    if (app.get_subcommands().empty()) throw CLI::RequiredError("A command");
  } catch (const CLI::Success& e) {
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    // Programs that asked for JSON read nothing else.
    bool json = false;
    for (std::size_t w = 0; w < given.size(); ++w) {
      json = json || given[w] == "--progress=json" ||
             (w > 0 && given[w] == "json" && given[w - 1] == "--progress");
    }
    Terminal(json ? ProgressStyle::Json : ProgressStyle::None, false)
        .fail(adviceOn(app, given, e), kWrongInput);
    return kWrongInput;
  }
  for (const Command& command : commands) {
    if (command.app->parsed()) return run(command);
  }
  return kWrongInput;
}
