// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace CLI {
class App;
class FormatterBase;
}  // namespace CLI

namespace exemplar {

/// What `--help` looks like: 80 columns; of commands with `--help-all`, without what only some
/// engines have.
std::shared_ptr<CLI::FormatterBase> helpFormatter();

/// The name of `names` that a misspelled word most likely stands for: within a third of its letters
/// inserted, left out, exchanged or swapped with the next; an empty text where there is none.
std::string nearestName(const std::string& word, std::span<const std::string> names);

/// What is wrong with a command line that could not be parsed, and what to type instead: `words`
/// are those after the program's name, `why` is the parser's own message.
std::string explained(const CLI::App& app, std::span<const std::string> words,
                      const std::string& why);

}  // namespace exemplar
