// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "core/text.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <utility>
#include <vector>

namespace exemplar {
namespace {

enum class Encoding { Bytes, Utf16Little, Utf16Big };

/// How the text is stored; `mark` receives the length of its byte-order mark.
Encoding encodingOf(std::string_view bytes, std::size_t& mark) {
  mark = 2;
  if (bytes.starts_with("\xff\xfe")) return Encoding::Utf16Little;
  if (bytes.starts_with("\xfe\xff")) return Encoding::Utf16Big;
  mark = bytes.starts_with("\xef\xbb\xbf") ? 3 : 0;
  if (mark != 0 || bytes.size() < 8) return Encoding::Bytes;
  bool little = true, big = true;
  for (std::size_t i = 0; i < 8; ++i) {
    const bool zero = bytes[i] == 0;
    little = little && zero == (i % 2 == 1);
    big = big && zero == (i % 2 == 0);
  }
  return little ? Encoding::Utf16Little : big ? Encoding::Utf16Big : Encoding::Bytes;
}

void appendUtf8(std::string& text, std::uint32_t c) {
  const auto byte = [&](std::uint32_t bits) { text += static_cast<char>(bits); };
  if (c < 0x80) {
    byte(c);
  } else if (c < 0x800) {
    byte(0xc0 | c >> 6);
    byte(0x80 | (c & 0x3f));
  } else if (c < 0x10000) {
    byte(0xe0 | c >> 12);
    byte(0x80 | (c >> 6 & 0x3f));
    byte(0x80 | (c & 0x3f));
  } else {
    byte(0xf0 | c >> 18);
    byte(0x80 | (c >> 12 & 0x3f));
    byte(0x80 | (c >> 6 & 0x3f));
    byte(0x80 | (c & 0x3f));
  }
}

}  // namespace

std::string_view asUtf8(std::string_view bytes, std::string& decoded) {
  std::size_t mark = 0;
  const Encoding encoding = encodingOf(bytes, mark);
  bytes.remove_prefix(mark);
  if (encoding == Encoding::Bytes) return bytes;
  const std::size_t low = encoding == Encoding::Utf16Little ? 0 : 1;
  const auto unit = [&](std::size_t i) {
    return std::uint32_t{static_cast<unsigned char>(bytes[2 * i + low])} |
           std::uint32_t{static_cast<unsigned char>(bytes[2 * i + 1 - low])} << 8;
  };
  const std::size_t units = bytes.size() / 2;
  decoded.clear();
  decoded.reserve(units + units / 8);
  for (std::size_t i = 0; i < units; ++i) {
    const std::uint32_t c = unit(i);
    if (c < 0xd800 || c > 0xdfff) {
      appendUtf8(decoded, c);
    } else if (c < 0xdc00 && i + 1 < units && unit(i + 1) >= 0xdc00 && unit(i + 1) <= 0xdfff) {
      appendUtf8(decoded, 0x10000 + ((c - 0xd800) << 10) + (unit(++i) - 0xdc00));
    } else {
      appendUtf8(decoded, 0xfffd);
    }
  }
  return decoded;
}

std::optional<double> parseNumber(std::string_view word) {
  if (word.size() > 1 && word.front() == '+') word.remove_prefix(1);
  const auto whole = [](std::string_view text) -> std::optional<double> {
    double value = 0;
    const char* last = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data(), last, value);
    return error == std::errc{} && end == last ? std::optional(value) : std::nullopt;
  };
  if (const auto value = whole(word)) return value;
  const std::size_t comma = word.find(',');
  if (comma == std::string_view::npos) return std::nullopt;
  std::string pointed(word);
  pointed[comma] = '.';
  return whole(pointed);
}

std::string_view unquoted(std::string_view name) {
  const bool quoted = name.size() >= 2 && name.front() == '"' && name.back() == '"';
  return quoted ? name.substr(1, name.size() - 2) : name;
}

std::string counted(std::size_t count, std::string_view noun) {
  return std::to_string(count) + " " + std::string(noun) + (count == 1 ? "" : "s");
}

std::string oneLine(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < ' ' || c == 0x7f) c = ' ';
  }
  return text;
}

std::string lowerCase(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

std::string nearestName(std::string_view word, std::span<const std::string> names) {
  // Optimal string alignment distance, by rows.
  const auto distance = [&](std::string_view name) {
    std::vector<std::size_t> beforeLast, last, row(name.size() + 1);
    for (std::size_t j = 0; j <= name.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= word.size(); ++i) {
      beforeLast = std::move(last);
      last = row;
      row[0] = i;
      for (std::size_t j = 1; j <= name.size(); ++j) {
        row[j] =
            std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (word[i - 1] != name[j - 1])});
        if (i > 1 && j > 1 && word[i - 1] == name[j - 2] && word[i - 2] == name[j - 1])
          row[j] = std::min(row[j], beforeLast[j - 2] + 1);
      }
    }
    return row[name.size()];
  };
  std::string nearest;
  std::size_t least = std::max<std::size_t>(1, word.size() / 3) + 1;
  for (const std::string& name : names) {
    if (const std::size_t d = distance(name); d < least) {
      least = d;
      nearest = name;
    }
  }
  return nearest;
}

}  // namespace exemplar
