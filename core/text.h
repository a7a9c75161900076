// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace exemplar {

/// The text in a file's bytes as UTF-8, without a byte-order mark. UTF-16 of either byte order,
/// with a mark or without one (every other byte of the first characters is zero), is decoded into
/// `decoded`, unpaired surrogates as U+FFFD; other bytes are returned as they are.
std::string_view asUtf8(std::string_view bytes, std::string& decoded);

/// The number that a whole word spells: with a sign, an exponent, a decimal point or a decimal
/// comma (as programs write it whose author forgot the locale), "nan" or "inf"; nothing where it is
/// none or is out of a double's range. The same in every locale.
std::optional<double> parseNumber(std::string_view word);

/// A name without the double quotes around it, where it has them.
std::string_view unquoted(std::string_view name);

/// A number of things: "1 face", "3 faces".
std::string counted(std::size_t count, std::string_view noun);

/// The text with control characters (line ends, tabs, a terminal's escapes) made spaces, as
/// messages quote names and values from files.
std::string oneLine(std::string text);

/// ASCII letters made lower-case; other bytes stay, whatever the locale.
std::string lowerCase(std::string_view text);

/// The name that was meant by a mistyped one: the nearest in letters to leave out, put in, replace
/// or swap with the next, the first of equally near ones; empty where none is nearer than a third
/// of the word's letters (or one letter). O(length^2) a name.
std::string nearestName(std::string_view word, std::span<const std::string> names);

}  // namespace exemplar
