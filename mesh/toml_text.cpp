// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/toml_text.h"

#include <algorithm>

#include "core/error.h"

namespace exemplar {
namespace {

/// Where a string or a comment that begins at `start` ends (just behind its last byte); `start`
/// where neither does. One that is never closed ends with the line or the text: the parser says so.
std::size_t endOfQuoted(std::string_view text, std::size_t start) {
  const char open = text[start];
  if (open == '#') return std::min(text.find('\n', start), text.size());
  if (open != '"' && open != '\'') return start;
  const bool lines = text.substr(start, 3) == std::string(3, open);
  const std::size_t quotes = lines ? 3 : 1;
  for (std::size_t i = start + quotes; i < text.size(); ++i) {
    if (text[i] == '\\' && open == '"') {
      ++i;
    } else if (text[i] == '\n' && !lines) {
      return i;
    } else if (text.substr(i, quotes) == std::string(quotes, open)) {
      return i + quotes;
    }
  }
  return text.size();
}

/// Refuses bytes beyond ASCII outside of strings and comments. TOML 1.0 has none there; toml++ 3
/// looks them up in tables of letters by code that the compiler may take to be unreachable.
void requireAsciiKeys(std::string_view text, const std::string& name) {
  std::size_t i = text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
  while (i < text.size()) {
    if (static_cast<unsigned char>(text[i]) > 0x7f) {
      const auto line = 1 + std::count(text.begin(), text.begin() + i, '\n');
      throw InputError(name + ":" + std::to_string(line) +
                       ": a letter beyond ASCII outside of quotes; put the name in quotes");
    }
    const std::size_t end = endOfQuoted(text, i);
    i = std::max(end, i + 1);
  }
}

}  // namespace

toml::table parseToml(std::string_view text, const std::string& name) {
  requireAsciiKeys(text, name);
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& e) {
    throw InputError(name + ":" + std::to_string(e.source().begin.line) + ": " +
                     std::string(e.description()));
  }
}

}  // namespace exemplar
