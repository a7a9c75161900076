// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#define TOML_EXCEPTIONS 1
#include <toml++/toml.h>

#include <string>
#include <string_view>

namespace exemplar {

/// The table that a TOML file's text holds. Keys without quotes are of ASCII letters, as TOML 1.0
/// has them. Throws InputError, which begins with the file's name and the line, when the text is no
/// TOML. Costs O(text); safe for any bytes.
toml::table parseToml(std::string_view text, const std::string& name);

}  // namespace exemplar
