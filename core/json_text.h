// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <string>

namespace exemplar {

/// A `nlohmann` JSON value as text, indented by so many spaces a level, or on one line. Names of
/// files and of what they hold may have bytes that are not UTF-8, which JSON cannot say: they
/// become U+FFFD.
template <class Json>
std::string jsonText(const Json& json, int indent = -1) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace exemplar
