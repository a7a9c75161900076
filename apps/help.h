// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace exemplar {

/// Help that fits 80 columns: each option on a line of its own, what it means below, in groups.
/// `--help` counts the options of each engine; `--help-all` lists them.
class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter();

  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override;
  std::string make_group(std::string group, bool isPositional,
                         std::vector<const CLI::Option*> options) const override;
  std::string make_usage(const CLI::App* app, std::string name) const override;
  std::string make_subcommand(const CLI::App* sub) const override;
  std::string make_option(const CLI::Option* option, bool isPositional) const override;
  std::string make_option_opts(const CLI::Option* option) const override;
};

/// Text in lines of at most 80 columns, each after so many spaces. Words that are longer stay
/// whole.
std::string wrapped(std::string_view text, int indent);

/// A command's examples, for the end of its help.
std::string examplesFooter(const std::vector<std::string>& lines);

}  // namespace exemplar
