// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/vec.h"

/// What settings' values are made of, and what people read.
namespace exemplar {

/// "a:b::c" by ':' is "a", "b", "", "c".
std::vector<std::string> split(const std::string& text, char separator);

/// "a, b and c", with the last word of your choice.
std::string joined(const std::vector<std::string>& words, std::string_view last);

/// "KEY=VALUE" in two, neither empty; throws `InputError` naming `what` and its `form`.
std::pair<std::string, std::string> keyAndValue(const std::string& text, const std::string& what,
                                                const std::string& form);

/// "1,2.5,-3" as `count` finite numbers; throws `InputError` beginning with `what`.
std::vector<double> parseNumbers(const std::string& text, std::size_t count,
                                 const std::string& what);
double parseNumber(const std::string& text, const std::string& what);
/// "1,2,-3" as three whole numbers; throws `InputError` beginning with `what`.
Vec3i parseCell(const std::string& text, const std::string& what);
/// A number without fraction, as an int; throws `InputError` beginning with `what`.
int wholeNumber(double value, const std::string& what);

/// "12,345,678".
std::string withThousands(long long n);
/// "80 x 80 x 10 cells".
std::string readableSize(const Vec3i& size, std::string_view unit);
/// "0.83 s", "12 s", "3 min 20 s".
std::string readableSeconds(double seconds);
/// "812 MB".
std::string readableBytes(double bytes);

}  // namespace exemplar
