// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "apps/completion.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string_view>

#include "core/error.h"
#include "core/text.h"

namespace exemplar {
namespace {

std::string joined(const std::vector<std::string>& words, std::string_view between = " ") {
  std::string text;
  for (const std::string& word : words) {
    if (!text.empty()) text += between;
    text += word;
  }
  return text;
}

/// "auto|line|json" as its words; nothing where the text is no list of words.
std::vector<std::string> alternatives(const std::string& text) {
  std::vector<std::string> words;
  std::size_t start = 0;
  for (std::size_t end = text.find('|'); end != text.npos; end = text.find('|', start)) {
    words.push_back(text.substr(start, end - start));
    start = end + 1;
  }
  if (!words.empty()) words.push_back(text.substr(start));
  const bool plain = std::ranges::all_of(words, [](const std::string& word) {
    return !word.empty() && word.find_first_of(" ,()[]{}'\"\\") == word.npos;
  });
  return plain ? words : std::vector<std::string>{};
}

CompletedOption completed(const CLI::Option& option) {
  CompletedOption one;
  one.shortNames = option.get_snames();
  one.longNames = option.get_lnames();
  one.meaning = oneLine(option.get_description());
  one.takesValue = option.get_items_expected_max() > 0;
  if (!one.takesValue) return one;
  // What is shown in the help is what is meant; the parser's own names say the type.
  const std::string shown =
      option.get_option_text().empty() ? option.get_type_name() : option.get_option_text();
  one.values = alternatives(shown);
  if (!one.values.empty()) {
    one.proposal = Proposal::Values;
  } else if (shown.starts_with("FILE") || shown.starts_with("TEXT")) {
    one.proposal = Proposal::Files;
  }
  return one;
}

/// What a command's own options and words add to what is proposed after its name.
void addOptions(const CLI::App& app, const std::vector<std::string>& scenes,
                CompletedCommand& command) {
  for (const CLI::Option* option : app.get_options()) {
    if (option->nonpositional()) {
      CompletedOption one = completed(*option);
      const bool known = std::ranges::any_of(command.options, [&](const CompletedOption& other) {
        return other.shortNames == one.shortNames && other.longNames == one.longNames;
      });
      if (!known) command.options.push_back(std::move(one));
    } else if (option->get_name() == "EXAMPLE" || option->get_name() == "NAME") {
      command.words.insert(command.words.end(), scenes.begin(), scenes.end());
    }
  }
}

/// Text between single quotes of a shell.
std::string shellQuoted(std::string_view text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'') {
      result += "'\\''";
    } else {
      result += c;
    }
  }
  return result + "'";
}

std::vector<std::string> dashed(const CompletedOption& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.shortNames) names.push_back("-" + name);
  for (const std::string& name : option.longNames) names.push_back("--" + name);
  return names;
}

std::vector<std::string> namesOf(const std::vector<CompletedCommand>& commands) {
  std::vector<std::string> names;
  for (const CompletedCommand& command : commands) names.push_back(command.name);
  return names;
}

std::string bashScript(const std::vector<CompletedCommand>& commands) {
  const std::vector<std::string> names = namesOf(commands);
  std::string text =
      "# Completes the words of exemplar in bash.\n"
      "_exemplar() {\n"
      "  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]} command= word\n"
      "  for word in \"${COMP_WORDS[@]:1:COMP_CWORD-1}\"; do\n"
      "    case $word in\n"
      "      " +
      joined(names, "|") +
      ") command=$word; break ;;\n"
      "    esac\n"
      "  done\n"
      "  COMPREPLY=()\n"
      "  case \"$command $prev\" in\n";
  for (const CompletedCommand& command : commands) {
    for (const CompletedOption& option : command.options) {
      if (!option.takesValue) continue;
      std::vector<std::string> cases;
      for (const std::string& name : dashed(option))
        cases.push_back(shellQuoted(command.name + " " + name));
      text += "    " + joined(cases, "|") + ") ";
      if (option.proposal == Proposal::Values)
        text +=
            "COMPREPLY=($(compgen -W " + shellQuoted(joined(option.values)) + " -- \"$cur\")); ";
      if (option.proposal == Proposal::Files) text += "COMPREPLY=($(compgen -f -- \"$cur\")); ";
      text += "return ;;\n";
    }
  }
  text +=
      "  esac\n"
      "  case \"$command\" in\n"
      "    '') COMPREPLY=($(compgen -W " +
      shellQuoted(joined(names) + " --help --version") + " -- \"$cur\")) ;;\n";
  for (const CompletedCommand& command : commands) {
    std::vector<std::string> options;
    for (const CompletedOption& option : command.options) {
      const std::vector<std::string> all = dashed(option);
      options.insert(options.end(), all.begin(), all.end());
    }
    text += "    " + command.name + ")\n      if [[ $cur == -* ]]; then COMPREPLY=($(compgen -W " +
            shellQuoted(joined(options)) +
            " -- \"$cur\"))\n      else COMPREPLY=($(compgen -f -W " +
            shellQuoted(joined(command.words)) + " -- \"$cur\")); fi ;;\n";
  }
  return text +
         "  esac\n"
         "}\n"
         "complete -o filenames -F _exemplar exemplar\n";
}

/// Text where zsh's _arguments gives brackets and colons a meaning.
std::string escapedForZsh(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
    result += c;
  }
  return result;
}

std::string zshScript(const std::vector<CompletedCommand>& commands) {
  std::string text =
      "#compdef exemplar\n"
      "# Completes the words of exemplar in zsh.\n"
      "_exemplar() {\n"
      "  local state line\n"
      "  local -a commands\n"
      "  commands=(\n";
  for (const CompletedCommand& command : commands)
    text += "    " + shellQuoted(escapedForZsh(command.name) + ":" + command.meaning) + "\n";
  text +=
      "  )\n"
      "  _arguments -C '(- *)--help[print help and exit]' '(- *)--version[print the version]' "
      "'1: :->command' '*:: :->words'\n"
      "  case $state in\n"
      "    command) _describe 'command' commands ;;\n"
      "    words)\n"
      "      case $words[1] in\n";
  for (const CompletedCommand& command : commands) {
    text += "        " + command.name + ") _arguments -s \\\n";
    for (const CompletedOption& option : command.options) {
      for (const std::string& name : dashed(option)) {
        std::string spec = "*" + name + "[" + escapedForZsh(option.meaning) + "]";
        if (option.takesValue) spec += ":value:";
        if (option.proposal == Proposal::Values) spec += "(" + joined(option.values) + ")";
        if (option.proposal == Proposal::Files) spec += "_files";
        text += "          " + shellQuoted(spec) + " \\\n";
      }
    }
    const std::string words =
        command.words.empty() ? "_files" : "{_files; compadd " + joined(command.words) + "}";
    text += "          " + shellQuoted("*:file:" + words) + " ;;\n";
  }
  return text +
         "      esac ;;\n"
         "  esac\n"
         "}\n"
         "if [ \"$funcstack[1]\" = _exemplar ]; then _exemplar \"$@\"; else compdef _exemplar "
         "exemplar; fi\n";
}

std::string fishScript(const std::vector<CompletedCommand>& commands) {
  std::string text = "# Completes the words of exemplar in fish.\n";
  const std::string names = joined(namesOf(commands));
  const std::string none = shellQuoted("not __fish_seen_subcommand_from " + names);
  text += "complete -c exemplar -n " + none + " -f\n";
  for (const CompletedCommand& command : commands)
    text += "complete -c exemplar -n " + none + " -a " + command.name + " -d " +
            shellQuoted(command.meaning) + "\n";
  for (const CompletedCommand& command : commands) {
    const std::string here = shellQuoted("__fish_seen_subcommand_from " + command.name);
    if (!command.words.empty())
      text +=
          "complete -c exemplar -n " + here + " -a " + shellQuoted(joined(command.words)) + "\n";
    for (const CompletedOption& option : command.options) {
      text += "complete -c exemplar -n " + here;
      for (const std::string& name : option.shortNames) text += " -s " + name;
      for (const std::string& name : option.longNames) text += " -l " + name;
      if (option.takesValue) text += option.proposal == Proposal::Files ? " -r -F" : " -x";
      if (option.proposal == Proposal::Values) text += " -a " + shellQuoted(joined(option.values));
      text += " -d " + shellQuoted(option.meaning) + "\n";
    }
  }
  return text;
}

}  // namespace

std::vector<CompletedCommand> completedCommands(const CLI::App& app,
                                                const std::vector<std::string>& scenes) {
  std::vector<CompletedCommand> commands;
  const auto all = [](const CLI::App*) { return true; };
  for (const CLI::App* sub : app.get_subcommands(all)) {
    CompletedCommand command{sub->get_name(), oneLine(sub->get_description()), {}, {}};
    addOptions(*sub, scenes, command);
    // A command of its own commands: their names are words, their options are all proposed.
    for (const CLI::App* own : sub->get_subcommands(all)) {
      command.words.push_back(own->get_name());
      addOptions(*own, scenes, command);
    }
    commands.push_back(std::move(command));
  }
  return commands;
}

std::string completionScript(const std::string& shell,
                             const std::vector<CompletedCommand>& commands) {
  if (shell == "bash") return bashScript(commands);
  if (shell == "zsh") return zshScript(commands);
  if (shell == "fish") return fishScript(commands);
  throw InputError("no completion for the shell '" + shell + "'; there are bash, zsh and fish");
}

}  // namespace exemplar
