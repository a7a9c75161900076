// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "apps/words.h"

#include <cmath>
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

std::pair<std::string, std::string> keyAndValue(const std::string& text, const std::string& option,
                                                const std::string& form) {
  const std::size_t at = text.find('=');
  if (at == std::string::npos || at == 0 || at + 1 == text.size())
    throw InputError(option + " " + text + ": expected " + form);
  return {text.substr(0, at), text.substr(at + 1)};
}

double parseNumber(const std::string& text, const std::string& what) {
  std::size_t used = 0;
  double value = 0;
  try {
    value = std::stod(text, &used);
  } catch (const std::exception&) {
    used = 0;
  }
  if (used == 0 || used != text.size() || !std::isfinite(value))
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

int wholeNumber(double value, const std::string& what) {
  if (value != std::floor(value) || std::abs(value) > std::numeric_limits<int>::max())
    throw InputError(what + ": expected whole numbers");
  return static_cast<int>(value);
}

}  // namespace exemplar
