// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/toml_text.h"

#include <stdexcept>

#include "core/error.h"

namespace exemplar {
void failTomlAssertion(const char* what) { throw std::logic_error(what); }

toml::table parseToml(std::string_view text, const std::string& name) {
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& e) {
    throw InputError(name + ":" + std::to_string(e.source().begin.line) + ": " +
                     std::string(e.description()));
  } catch (const std::logic_error&) {
    throw InputError(name + ": not valid TOML");
  }
}

}  // namespace exemplar
