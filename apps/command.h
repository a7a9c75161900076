// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "apps/terminal.h"
#include "engine/example.h"
#include "engine/result.h"
#include "engine/setting.h"
#include "preview/render.h"

namespace CLI {
class App;
}

namespace exemplar {

/// What every command has: `--threads`, `--quiet` and `--progress`.
struct CommonOptions {
  int threads = 0;  ///< 0: all cores
  bool quiet = false;
  ProgressStyle progress = ProgressStyle::Auto;
};

/// A subcommand: its parser, what is common to all, and what runs it once it was parsed. Errors
/// leave it as exceptions.
struct Command {
  CLI::App* app;
  std::shared_ptr<CommonOptions> common;
  std::function<void(Terminal&)> run;
};

/// Each adds one subcommand to the parser.
Command addSynthCommand(CLI::App& app);
Command addSdfCommand(CLI::App& app);
Command addMeshCommand(CLI::App& app);
Command addMeasureCommand(CLI::App& app);
Command addRenderCommand(CLI::App& app);
Command addSceneCommand(CLI::App& app);
Command addVoxelizeCommand(CLI::App& app);
Command addInfoCommand(CLI::App& app);
Command addCompareCommand(CLI::App& app);
Command addEnginesCommand(CLI::App& app);
Command addCompletionCommand(CLI::App& app);
/// One subcommand with subcommands of its own.
std::vector<Command> addWorldCommands(CLI::App& app);

/// Synthesis that could not be completed: exit status 3.
class Unfinished : public std::runtime_error {
 public:
  explicit Unfinished(const std::string& why, std::optional<Conflict> conflict = {})
      : std::runtime_error(why), conflict_(std::move(conflict)) {}
  /// What excludes each other, where the request is impossible.
  const std::optional<Conflict>& conflict() const { return conflict_; }

 private:
  std::optional<Conflict> conflict_;
};

/// Adds what is common to all commands.
std::shared_ptr<CommonOptions> addCommonOptions(CLI::App& command);

/// Options for settings, in groups of the help. A key that several groups have is one option, whose
/// text is read by whoever it is for.
class SettingOptions {
 public:
  /// `whose` ("model") is said before the meaning of a key that another group has, too.
  void add(const std::string& group, const std::string& whose, std::span<const Setting> settings);
  /// Adds the options; what is given of them goes to `into`, which must outlive the parser.
  void install(CLI::App& command, Settings& into) const;

 private:
  struct Option {
    std::string group, whose;
    Setting setting;
    std::string help;
  };
  std::vector<Option> options_;
};

/// The options of reading an example in a form, and what they say.
void addReadingOptions(CLI::App& command, Form form, Settings& into);
ReadOptions readingOf(const Settings& settings, Form form);

/// Picture options: `--view`, `--size` or another name, `--samples`.
struct PictureOptions {
  std::string view = "iso";
  std::string size = "960x720";
  int samples = 64;
};
void addPictureOptions(CLI::App& command, PictureOptions& options,
                       const std::string& size = "--size");
RenderOptions renderOptions(const PictureOptions& options);

/// The option of a setting: "--key".
std::string optionOf(std::string_view key);
/// A message of the library as the command says it: settings in backticks become options.
std::string spelledAsOptions(const std::string& message);

/// Limits the cores that work uses while it lives; 0 for all.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Control;
  std::unique_ptr<Control> control_;
};

}  // namespace exemplar
