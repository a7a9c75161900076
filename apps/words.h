// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <string>
#include <utility>
#include <vector>

/// What values of options are made of.
namespace exemplar {

/// "a:b::c" by ':' is "a", "b", "", "c".
std::vector<std::string> split(const std::string& text, char separator);

/// "KEY=VALUE" in two, neither empty; throws `InputError` naming `option` and its `form`.
std::pair<std::string, std::string> keyAndValue(const std::string& text, const std::string& option,
                                                const std::string& form);

/// "1,2.5,-3" as `count` finite numbers; throws `InputError` beginning with `what`.
std::vector<double> parseNumbers(const std::string& text, std::size_t count,
                                 const std::string& what);
double parseNumber(const std::string& text, const std::string& what);

/// A number without fraction, as an int; throws `InputError` beginning with `what`.
int wholeNumber(double value, const std::string& what);

}  // namespace exemplar
