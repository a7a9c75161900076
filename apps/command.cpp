// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "apps/command.h"

#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "core/error.h"
#include "engine/words.h"

namespace exemplar {
namespace {

/// "side of a block (16 samples)".
std::string helpOf(const Setting& setting) {
  std::string text = setting.meaning;
  std::string usual = setting.byDefault;
  if (setting.type == SettingType::Flag) usual.clear();
  const bool number = !usual.empty() && usual.find_first_not_of("0123456789.,") == usual.npos;
  if (!setting.unit.empty() && number) {
    usual += " " + setting.unit;
  } else if (!setting.unit.empty()) {
    text += ", in " + setting.unit;
  }
  if (!usual.empty()) text += " (" + usual + ")";
  if (setting.repeats) text += " (one or more)";
  return spelledAsOptions(text);
}

/// "-s,--scale": the names of a setting's option.
std::string namesOf(const std::string& key) {
  if (key == "scale" || key == "resolution") return "-" + key.substr(0, 1) + "," + optionOf(key);
  return optionOf(key);
}

std::string valueOf(const Setting& setting) {
  if (setting.type != SettingType::Choice)
    return std::string(typeName(setting.type)) + (setting.repeats ? " ..." : "");
  std::string names;
  for (const std::string& choice : setting.choices) names += (names.empty() ? "" : "|") + choice;
  return names;
}

}  // namespace

std::shared_ptr<CommonOptions> addCommonOptions(CLI::App& command) {
  auto options = std::make_shared<CommonOptions>();
  command
      .add_option("--threads", options->threads, "cores to use; the result does not depend on it")
      ->check(CLI::Range(1, 1024))
      ->default_str("all");
  command.add_flag("-q,--quiet", options->quiet, "no progress, no summary");
  command
      .add_option("--progress", options->progress,
                  "how progress is shown on standard error: as one line that changes, as JSON "
                  "objects, one a line, for programs, or not at all (auto: a line on a terminal)")
      ->transform(CLI::CheckedTransformer(
          std::map<std::string, ProgressStyle>{{"auto", ProgressStyle::Auto},
                                               {"line", ProgressStyle::Line},
                                               {"json", ProgressStyle::Json},
                                               {"none", ProgressStyle::None}}))
      ->option_text("auto|line|json|none");
  return options;
}

void SettingOptions::add(const std::string& group, const std::string& whose,
                         std::span<const Setting> settings) {
  for (const Setting& setting : settings) {
    const auto same = std::ranges::find(options_, setting.key,
                                        [](const Option& option) { return option.setting.key; });
    if (same == options_.end()) {
      options_.push_back({group, whose, setting, helpOf(setting)});
      continue;
    }
    if (helpOf(setting) == helpOf(same->setting)) continue;
    if (same->help == helpOf(same->setting) && !same->whose.empty())
      same->help = same->whose + ": " + same->help;
    if (same->help.find(helpOf(setting)) == std::string::npos)
      same->help += "; " + whose + ": " + helpOf(setting);
    if (same->setting.type != setting.type) same->setting.type = SettingType::Text;
  }
}

void SettingOptions::install(CLI::App& command, Settings& into) const {
  for (const Option& option : options_) {
    const std::string key = option.setting.key;
    if (option.setting.type == SettingType::Flag) {
      command
          .add_flag_callback(
              namesOf(key), [&into, key] { into.set(key, true); }, option.help)
          ->group(option.group);
      continue;
    }
    command
        .add_option(
            namesOf(key),
            [&into, key](const CLI::results_t& texts) {
              for (const std::string& text : texts) into.add(key, text);
              return true;
            },
            option.help)
        ->type_size(1)
        ->expected(1, -1)
        ->allow_extra_args(false)
        ->option_text(valueOf(option.setting))
        ->group(option.group);
  }
}

void addReadingOptions(CLI::App& command, Form form, Settings& into) {
  SettingOptions options;
  options.add("Reading the example", "", readingSettings(form).settings());
  options.install(command, into);
}

ReadOptions readingOf(const Settings& settings, Form form) {
  ReadOptions options;
  options.form = form;
  readingSettings(form).apply(settings, options);
  checkReading(options);
  return options;
}

void addPictureOptions(CLI::App& command, PictureOptions& options, const std::string& size) {
  command
      .add_option("--view", options.view,
                  "iso, front, back, left, right, top, bottom, or AZIMUTH,ELEVATION in degrees")
      ->option_text("VIEW")
      ->capture_default_str()
      ->group("Picture");
  command.add_option(size, options.size, "the picture's size in pixels")
      ->option_text("WIDTHxHEIGHT")
      ->capture_default_str()
      ->group("Picture");
  command.add_option("--samples", options.samples, "rays a pixel")
      ->check(CLI::Range(1, 4096))
      ->capture_default_str()
      ->group("Picture");
}

RenderOptions renderOptions(const PictureOptions& options) {
  RenderOptions render;
  render.view = viewFromName(options.view);
  render.samples = options.samples;
  char end = 0;
  if (std::sscanf(options.size.c_str(), "%dx%d%c", &render.width, &render.height, &end) != 2 ||
      render.width < 1 || render.height < 1 || render.width > 16384 || render.height > 16384) {
    throw InputError("the picture's --size " + options.size +
                     ": expected WIDTHxHEIGHT, each 1 to 16384");
  }
  return render;
}

std::string optionOf(std::string_view key) { return "--" + std::string(key); }

std::string spelledAsOptions(const std::string& message) { return spelled(message, optionOf); }

struct ThreadLimit::Control {
  explicit Control(int threads)
      : limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)) {}
  tbb::global_control limit;
};

ThreadLimit::ThreadLimit(int threads)
    : control_(threads > 0 ? std::make_unique<Control>(threads) : nullptr) {}
ThreadLimit::~ThreadLimit() = default;

}  // namespace exemplar
