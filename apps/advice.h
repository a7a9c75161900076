// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <CLI/CLI.hpp>
#include <span>
#include <string>

namespace exemplar {

/// What is wrong with a command line that could not be parsed, in one line, with what was probably
/// meant: the nearest command or option, or the command for an example that was given alone.
std::string adviceOn(const CLI::App& app, std::span<const std::string> words,
                     const CLI::ParseError& error);

}  // namespace exemplar
