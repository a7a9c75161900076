// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

/// What can be set, as it is declared: docs/settings.md for people, JSON for programs.
namespace exemplar {

/// Every engine and setting as a page of Markdown.
std::string settingsPage();

/// The same as JSON: for each engine its name, meaning, form and settings (key, type, meaning,
/// unit, least, most, choices, default, repeats).
nlohmann::ordered_json settingsJson();

}  // namespace exemplar
