// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <nlohmann/json.hpp>
#include <type_traits>
#include <variant>
#include <vector>

#include "core/vec.h"
#include "engine/result.h"
#include "measure/figures.h"
#include "mesh/mesh_health.h"

/// What is written about a run, in the order in which it is said. For sources of the house only:
/// the library's headers need no JSON.
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

/// What each figure means, for the table of a page.
inline Json figureMeanings() {
  Json meanings = Json::array();
  for (const auto& group : {figures(Measures{}), figures(Content{})})
    for (const Figure& figure : group)
      meanings.push_back(
          {{"group", figure.group}, {"key", figure.key}, {"meaning", figure.meaning}});
  return meanings;
}

inline Json toJson(const Statistics& statistics) {
  Json json = Json::object();
  for (const auto& [key, statistic] : statistics) {
    std::visit(
        [&, &name = key](const auto& v) {
          if constexpr (std::is_same_v<std::decay_t<decltype(v)>, Vec3i>) {
            json[name] = toJson(v);
          } else {
            json[name] = v;
          }
        },
        statistic);
  }
  return json;
}

inline Json toJson(const MeshHealth& health) {
  return {{"triangles", health.triangles},
          {"vertices", health.vertices},
          {"components", health.components},
          {"closed", health.closed()},
          {"manifold", health.manifold()},
          {"oriented", health.oriented()},
          {"boundary_edges", health.boundaryEdges},
          {"non_manifold_edges", health.nonManifoldEdges},
          {"non_manifold_vertices", health.nonManifoldVertices},
          {"misoriented_edges", health.misorientedEdges},
          {"degenerate_triangles", health.degenerateTriangles},
          {"volume", health.signedVolume}};
}

}  // namespace exemplar
