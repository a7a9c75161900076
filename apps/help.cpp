// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "apps/help.h"

#include <algorithm>
#include <sstream>
#include <utility>

namespace exemplar {
namespace {

constexpr std::size_t kColumns = 80;
constexpr int kNameIndent = 2, kMeaningIndent = 6;
/// Groups that begin so are only counted, unless all is asked for.
constexpr std::string_view kEngine = "Engine ";

bool isCollapsed(const std::string& group, CLI::AppFormatMode mode) {
  return mode != CLI::AppFormatMode::All && group.starts_with(kEngine);
}

std::vector<const CLI::Option*> optionsOf(const CLI::App* app, const std::string& group) {
  return app->get_options([&](const CLI::Option* option) {
    return option->get_group() == group && option->nonpositional();
  });
}

}  // namespace

HelpFormatter::HelpFormatter() {
  label("TEXT", "FILE");  // what is no file says itself what it is
  label("REQUIRED", "(required)");
}

std::string wrapped(std::string_view text, int indent) {
  std::string lines, line;
  const std::string margin(static_cast<std::size_t>(indent), ' ');
  std::istringstream words{std::string(text)};
  for (std::string word; words >> word;) {
    if (!line.empty() && line.size() + 1 + word.size() > kColumns) {
      lines += line + "\n";
      line.clear();
    }
    line += line.empty() ? margin : " ";
    // Choices of an option are one word: a long one goes on after a bar.
    while (line.size() + word.size() > kColumns) {
      const std::size_t bar = word.rfind('|', kColumns - line.size() - 1);
      if (bar == word.npos) break;
      lines += line + word.substr(0, bar + 1) + "\n";
      word.erase(0, bar + 1);
      line = margin;
    }
    line += word;
  }
  return line.empty() ? lines : lines + line + "\n";
}

std::string examplesFooter(const std::vector<std::string>& lines) {
  std::string text = "Examples:";
  for (const std::string& line : lines) text += "\n  exemplar " + line;
  return text;
}

std::string HelpFormatter::make_group(std::string group, bool isPositional,
                                      std::vector<const CLI::Option*> options) const {
  std::string text = "\n" + wrapped(group + ":", 0);
  for (const CLI::Option* option : options) text += make_option(option, isPositional);
  return text;
}

std::string HelpFormatter::make_help(const CLI::App* app, std::string name,
                                     CLI::AppFormatMode mode) const {
  const std::string description = app->get_description();  // several lines are as they should be
  const bool oneLine = description.find('\n') == description.npos;
  std::string text = (oneLine ? wrapped(description, 0) : description + "\n") +
                     make_usage(app, std::move(name)) + make_positionals(app);
  const auto commands = app->get_subcommands([](const CLI::App*) { return true; });
  if (!commands.empty()) text += "\nCommands:\n";
  for (const CLI::App* command : commands) text += make_subcommand(command);
  std::string collapsed;
  for (const std::string& group : app->get_groups()) {
    const std::vector<const CLI::Option*> options = optionsOf(app, group);
    if (group.empty() || options.empty()) continue;
    if (isCollapsed(group, mode)) {
      const std::string engine = group.substr(kEngine.size(), group.find(':') - kEngine.size());
      collapsed +=
          (collapsed.empty() ? "" : ", ") + engine + " (" + std::to_string(options.size()) + ")";
    } else {
      text += make_group(group, false, options);
    }
  }
  if (!collapsed.empty()) {
    text += "\n" + wrapped("Options of the engines " + collapsed + ": exemplar " + app->get_name() +
                               " --help-all lists them.",
                           0);
  }
  return text + "\n" + make_footer(app);
}

std::string HelpFormatter::make_usage(const CLI::App* app, std::string name) const {
  std::string text = "\nUsage: exemplar";
  if (app->get_parent() == nullptr) return text + " COMMAND ...\n";
  text += " " + std::move(name).substr(name.rfind(' ') + 1);
  for (const CLI::Option* option :
       app->get_options([](const CLI::Option* o) { return o->get_positional(); }))
    text += " " + make_option_usage(option);
  for (const CLI::Option* option : app->get_options(
           [](const CLI::Option* o) { return o->nonpositional() && o->get_required(); }))
    text += " " + option->get_name() + " FILE";
  return text + " [options]\n";
}

std::string HelpFormatter::make_subcommand(const CLI::App* sub) const {
  constexpr int kIndent = 12;
  const std::string name = "  " + sub->get_name() + " ";
  // Names are shorter than the margin, whose place they take.
  return name + wrapped(sub->get_description(), kIndent)
                    .substr(std::min<std::size_t>(name.size(), kIndent));
}

std::string HelpFormatter::make_option_opts(const CLI::Option* option) const {
  const std::string& type = option->get_type_name();
  const bool number =
      option->get_option_text().empty() && option->get_type_size() != 0 &&
      (type.starts_with("INT") || type.starts_with("UINT") || type.starts_with("FLOAT"));
  if (!number) return CLI::Formatter::make_option_opts(option);
  // The parser's own words ("INT:INT in [1 - 64]=8") are for programmers; a number out of range is
  // refused with the range.
  return option->get_expected_max() > 1 ? " N ..." : " N";
}

std::string HelpFormatter::make_option(const CLI::Option* option, bool isPositional) const {
  std::string name = make_option_name(option, isPositional);
  if (const std::size_t comma = name.find(','); comma != name.npos) name.insert(comma + 1, " ");
  if (!isPositional) name += make_option_opts(option);
  std::string meaning = make_option_desc(option);
  if (const std::string usual = option->get_default_str();
      !usual.empty() && name.find('=' + usual) == name.npos && !meaning.ends_with(")"))
    meaning += " (" + usual + ")";
  return wrapped(name, kNameIndent) + wrapped(meaning, kMeaningIndent);
}

}  // namespace exemplar
