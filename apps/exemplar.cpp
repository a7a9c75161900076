// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// The `exemplar` command: parse, call, print. No algorithm lives here.
//
// Exit status: 0 done; 2 the command or the input is wrong; 3 synthesis could not be completed;
// 4 interrupted. Every failure is one line on stderr.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <new>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/command.h"
#include "apps/help.h"
#include "apps/terminal.h"
#include "core/error.h"
#include "engine/engine.h"
#include "engine/request.h"

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

/// Whether a word is a number and nothing else: "2", "0.5"; no file is named like it.
bool isNumber(const std::string& word) {
  std::error_code error;
  return !word.empty() && word.find_first_not_of("0123456789.") == word.npos &&
         !std::filesystem::exists(word, error);
}

/// The command's words, with an option that may be repeated once before each of its values:
/// "--pin A B" is "--pin A --pin B"; and with three numbers as one value where there is one number
/// an axis: "--scale 2 2 1" is "--scale 2,2,1".
std::vector<std::string> spelledOut(std::span<char*> words) {
  using exemplar::SettingType;
  std::set<std::string> repeated, perAxis{"-s"};
  const auto note = [&](std::span<const exemplar::Setting> settings) {
    for (const exemplar::Setting& setting : settings) {
      if (setting.repeats) repeated.insert("--" + setting.key);
      if (setting.type == SettingType::Size || setting.type == SettingType::Lengths)
        perAxis.insert("--" + setting.key);
    }
  };
  note(exemplar::requestSettings());
  for (const exemplar::Engine* engine : exemplar::engines()) note(engine->settings());
  std::vector<std::string> all;
  for (std::size_t w = 1; w < words.size(); ++w) {
    all.emplace_back(words[w]);
    if (perAxis.contains(all.back()) && w + 3 < words.size() && isNumber(words[w + 1]) &&
        isNumber(words[w + 2]) && isNumber(words[w + 3])) {
      all.push_back(std::string(words[w + 1]) + "," + words[w + 2] + "," + words[w + 3]);
      w += 3;
      continue;
    }
    if (!repeated.contains(all.back()) || w + 1 == words.size()) continue;
    const std::string option = all.back();
    all.emplace_back(words[++w]);
    for (; w + 1 < words.size() && goesOn(words[w + 1]); ++w) {
      all.push_back(option);
      all.emplace_back(words[w + 1]);
    }
  }
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "exemplar: give it one example; get as much more of it as you want.\n"
      "An example is a mesh (.obj .ply .stl .off .glb .gltf), a volume (.vdb), a height\n"
      "map (.png .pgm .asc), a grid of labels (.txt .vox), a picture (.jpg) or a scene\n"
      "(.toml, or its name). 'exemplar COMMAND --help' lists a command's options.\n\n"
      "  exemplar synth wall.obj -o longer.glb --scale 3,1,1\n"
      "  exemplar synth chainmail -o more.glb --seed 7 --preview more.png --open\n"
      "  exemplar compare rock.glb -o report\n"};
  app.name("exemplar");
  app.set_version_flag("--version", EXEMPLAR_VERSION);
  app.require_subcommand(1);
  app.formatter(exemplar::helpFormatter());

  using namespace exemplar;
  const std::vector<Command> commands{
      addSynthCommand(app),   addSdfCommand(app),    addMeshCommand(app),     addRenderCommand(app),
      addMeasureCommand(app), addSceneCommand(app),  addVoxelizeCommand(app), addInfoCommand(app),
      addCompareCommand(app), addEnginesCommand(app)};
  if (argc == 1) {
    std::cout << app.help();
    return kDone;
  }
  try {
    std::vector<std::string> words =
        spelledOut(std::span<char*>(argv, static_cast<std::size_t>(argc)));
    std::reverse(words.begin(), words.end());  // as CLI11 wants them
    app.parse(std::move(words));
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
    const std::vector<std::string> given(words.begin() + 1, words.end());
    Terminal(json ? ProgressStyle::Json : ProgressStyle::None, false)
        .fail(explained(app, given, e.what()), kWrongInput);
    return kWrongInput;
  }
  for (const Command& command : commands) {
    if (command.app->parsed()) return run(command);
  }
  return kWrongInput;
}
