// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/words.h"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>

#include "core/error.h"

namespace exemplar {

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> words(1);
  for (const char c : text) {
    if (c == separator)
      words.emplace_back();
    else
      words.back() += c;
  }
  return words;
}

std::string joined(const std::vector<std::string>& words, std::string_view last) {
  std::string text;
  for (std::size_t n = 0; n < words.size(); ++n) {
    if (n > 0) text += n + 1 < words.size() ? ", " : " " + std::string(last) + " ";
    text += words[n];
  }
  return text;
}

std::pair<std::string, std::string> keyAndValue(const std::string& text, const std::string& what,
                                                const std::string& form) {
  const std::size_t at = text.find('=');
  if (at == std::string::npos || at == 0 || at + 1 == text.size())
    throw InputError(what + " " + text + ": expected " + form);
  return {text.substr(0, at), text.substr(at + 1)};
}

double parseNumber(const std::string& text, const std::string& what) {
  const char* begin = text.data();
  const char* end = begin + text.size();
  if (begin != end && *begin == '+') ++begin;
  double value = 0;
  const auto [last, error] = std::from_chars(begin, end, value);
  if (error != std::errc{} || last != end || begin == end || !std::isfinite(value))
    throw InputError(what + ": '" + text + "' is not a number");
  return value;
}

std::vector<double> parseNumbers(const std::string& text, std::size_t count,
                                 const std::string& what) {
  std::vector<double> numbers;
  for (const std::string& word : split(text, ',')) numbers.push_back(parseNumber(word, what));
  if (numbers.size() != count)
    throw InputError(what + ": expected " + std::to_string(count) + " numbers, as in 1,2,3");
  return numbers;
}

Vec3i parseCell(const std::string& text, const std::string& what) {
  const std::vector<double> xyz = parseNumbers(text, 3, what);
  return {wholeNumber(xyz[0], what), wholeNumber(xyz[1], what), wholeNumber(xyz[2], what)};
}

int wholeNumber(double value, const std::string& what) {
  if (value != std::floor(value) || std::abs(value) > std::numeric_limits<int>::max())
    throw InputError(what + ": expected whole numbers");
  return static_cast<int>(value);
}

std::string withThousands(long long n) {
  std::string digits = std::to_string(n < 0 ? -n : n);
  for (int at = static_cast<int>(digits.size()) - 3; at > 0; at -= 3) digits.insert(at, ",");
  return n < 0 ? "-" + digits : digits;
}

std::string readableSize(const Vec3i& size, std::string_view unit) {
  return std::to_string(size.x) + " x " + std::to_string(size.y) + " x " + std::to_string(size.z) +
         " " + std::string(unit);
}

std::string readableSeconds(double seconds) {
  char text[32];
  if (seconds < 10) {
    std::snprintf(text, sizeof text, seconds == std::floor(seconds) ? "%.0f s" : "%.2f s", seconds);
  } else if (seconds < 120) {
    std::snprintf(text, sizeof text, "%.0f s", seconds);
  } else {
    std::snprintf(text, sizeof text, "%d min %d s", static_cast<int>(seconds) / 60,
                  static_cast<int>(seconds) % 60);
  }
  return text;
}

std::string readableBytes(double bytes) {
  char text[32];
  if (bytes < 1e6) {
    std::snprintf(text, sizeof text, "%.0f KB", bytes / 1e3);
  } else {
    std::snprintf(text, sizeof text, bytes < 1e9 ? "%.0f MB" : "%.1f GB",
                  bytes / (bytes < 1e9 ? 1e6 : 1e9));
  }
  return text;
}

}  // namespace exemplar
