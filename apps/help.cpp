// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "apps/help.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <sstream>
#include <string_view>

#include "core/file.h"
#include "engine/source.h"

namespace exemplar {
namespace {

constexpr std::size_t kColumns = 80, kNames = 26;

/// Groups of options that only `--help-all` shows, by how their names begin.
constexpr std::array<std::string_view, 4> kFurther{"Engine ", "Reading labels", "Reading a mesh as",
                                                   "Reading a picture"};

bool isFurther(std::string_view group) {
  return std::ranges::any_of(
      kFurther, [&](std::string_view begin) { return group.substr(0, begin.size()) == begin; });
}

/// Words in lines of `columns`, all but the first behind `indent` spaces. A word that is longer is
/// broken behind a comma.
std::string wrapped(const std::string& text, std::size_t indent, std::size_t columns) {
  std::string result, line;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    while (indent + word.size() > columns) {
      const auto comma = word.rfind(',', columns - indent - 1);
      if (comma == word.npos) break;
      if (!line.empty()) result += line + "\n" + std::string(indent, ' ');
      line = word.substr(0, comma + 1);
      word.erase(0, comma + 1);
    }
    if (!line.empty() && indent + line.size() + 1 + word.size() > columns) {
      result += line + "\n" + std::string(indent, ' ');
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return result + line;
}

std::string row(const std::string& name, const std::string& text) {
  std::string result = "  " + name;
  if (result.size() + 2 > kNames) {
    result += "\n" + std::string(kNames, ' ');
  } else {
    result.resize(kNames, ' ');
  }
  return result + wrapped(text, kNames, kColumns) + "\n";
}

class Help : public CLI::Formatter {
 public:
  std::string make_option(const CLI::Option* option, bool positional) const override {
    std::string name = make_option_name(option, positional);
    if (const auto comma = name.find(','); comma != name.npos) name.insert(comma + 1, " ");
    // A value's kind where it was said; the parser's own names of types are no help.
    const std::string& kind = option->get_option_text();
    if (!kind.empty()) {
      if (2 + name.size() + 1 + kind.size() > kColumns) {
        name += "\n" + std::string(6, ' ') + wrappedChoices(kind);
      } else {
        name += " " + kind;
      }
    } else if (option->get_items_expected_max() > 0 && !positional) {
      name += option->get_type_name() == "TEXT" ? " FILE" : " N";
    }
    const bool required = option->get_required() && !positional;
    return row(name, make_option_desc(option) + (required ? " (required)" : ""));
  }
  std::string make_subcommand(const CLI::App* command) const override {
    return row(command->get_display_name(true), command->get_description());
  }
  std::string make_group(std::string group, bool positional,
                         std::vector<const CLI::Option*> options) const override {
    if (short_ && isFurther(group)) return "";
    return "\n" + wrapped(group, 2, kColumns) + ":\n" + rows(options, positional);
  }
  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override {
    const bool hasAll = app->get_help_all_ptr() != nullptr;
    short_ = hasAll && mode != CLI::AppFormatMode::All;
    std::string text = CLI::Formatter::make_help(app, std::move(name), mode);
    if (short_)
      text += "\nexemplar " + app->get_name() +
              " --help-all lists the options of single engines, too.\n";
    short_ = false;
    // One blank line between groups.
    for (std::size_t at; (at = text.find("\n\n\n")) != text.npos;) text.erase(at, 1);
    return text;
  }

 private:
  std::string rows(const std::vector<const CLI::Option*>& options, bool positional) const {
    std::string text;
    for (const CLI::Option* option : options) text += make_option(option, positional);
    return text;
  }
  /// "a|b|c" on lines.
  static std::string wrappedChoices(const std::string& choices) {
    std::string result, line;
    std::istringstream names(choices);
    for (std::string name; std::getline(names, name, '|');) {
      if (6 + line.size() + name.size() + 1 > kColumns) {
        result += line + "\n" + std::string(6, ' ');
        line.clear();
      }
      line += name + "|";
    }
    result += line;
    result.pop_back();
    return result;
  }

  mutable bool short_ = false;
};

/// The words of letters that differ, at best: Damerau's distance of neighboring swaps.
std::size_t editDistance(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        d[i][j] = i + j;
        continue;
      }
      d[i][j] = std::min(
          {d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0u : 1u)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

/// The long names of a command's options: "--scale".
std::vector<std::string> longNames(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

/// Whether a word looks like an example: a file that is there, or the ending of one.
bool looksLikeExample(const std::string& word) {
  const std::filesystem::path path(word);
  std::error_code error;
  if (std::filesystem::is_regular_file(path, error)) return true;
  const std::string ending = lowerExtension(path);
  return !ending.empty() &&
         (" " + std::string(kExampleEndings) + " ").find(" " + ending + " ") != std::string::npos;
}

}  // namespace

std::shared_ptr<CLI::FormatterBase> helpFormatter() { return std::make_shared<Help>(); }

std::string nearestName(const std::string& word, std::span<const std::string> names) {
  std::string nearest;
  std::size_t least = std::max<std::size_t>(1, word.size() / 3) + 1;
  for (const std::string& name : names) {
    const std::size_t distance = editDistance(word, name);
    if (distance < least) {
      least = distance;
      nearest = name;
    }
  }
  return nearest;
}

std::string explained(const CLI::App& app, std::span<const std::string> words,
                      const std::string& why) {
  const std::string help = " (see exemplar --help)";
  const CLI::App* command = nullptr;
  std::vector<std::string> commands;
  for (const CLI::App* one : app.get_subcommands({})) {
    commands.push_back(one->get_name());
    if (!words.empty() && one->get_name() == words.front()) command = one;
  }
  if (command == nullptr) {
    if (words.empty() || words.front().starts_with("-")) return why + help;
    const std::string& word = words.front();
    if (looksLikeExample(word)) {
      const std::string stem = std::filesystem::path(word).stem().string();
      return word + " is no command; to make more of it: exemplar synth " + word + " -o " + stem +
             "_more.glb";
    }
    const std::string nearest = nearestName(word, commands);
    return word + " is no command" +
           (nearest.empty() ? help : "; did you mean exemplar " + nearest + "?");
  }
  const std::vector<std::string> names = longNames(*command);
  for (const std::string& word : words.subspan(1)) {
    const std::string name = word.substr(0, word.find('='));
    if (!name.starts_with("--") || name == "--" || std::ranges::count(names, name)) continue;
    const std::string nearest = nearestName(name, names);
    return name + ": exemplar " + command->get_name() + " has no such option" +
           (nearest.empty() ? " (see exemplar " + command->get_name() + " --help)"
                            : "; did you mean " + nearest + "?");
  }
  return why + " (see exemplar " + command->get_name() + " --help)";
}

}  // namespace exemplar
