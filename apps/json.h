// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <nlohmann/json.hpp>
#include <type_traits>
#include <variant>
#include <vector>

#include "core/vec.h"
#include "measure/figures.h"

/// What commands write about a run, in the order in which it is said.
namespace exemplar {

using Json = nlohmann::ordered_json;

inline Json toJson(const Vec3i& v) { return {v.x, v.y, v.z}; }
inline Json toJson(const Vec3d& v) { return {v.x, v.y, v.z}; }

/// An object for each group, in it a value for each figure; null for what was not measured.
inline Json toJson(const std::vector<Figure>& figures) {
  Json json;
  for (const Figure& figure : figures) {
    Json& value = json[figure.group][figure.key];
    std::visit(
        [&](const auto& v) {
          if constexpr (!std::is_same_v<std::decay_t<decltype(v)>, std::monostate>) value = v;
        },
        figure.value);
  }
  return json;
}

}  // namespace exemplar
