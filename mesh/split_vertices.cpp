// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/split_vertices.h"

#include <limits>
#include <map>
#include <tuple>

namespace exemplar {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// All that a corner wants of its vertex in the file.
struct Wanted {
  Vec2f uv;
  std::uint32_t normal = kNone;
  std::uint32_t tangent = kNone;  // none: any will do
  SourcePoint point;

  bool suits(const Wanted& vertex) const {
    return uv == vertex.uv && normal == vertex.normal && point == vertex.point &&
           (tangent == vertex.tangent || tangent == kNone || vertex.tangent == kNone);
  }
  auto key(std::uint32_t vertex) const {
    return std::tuple(vertex, normal, tangent, uv.x, uv.y, point.triangle, point.example,
                      point.weights);
  }
};

}  // namespace

SplitVertices splitVertices(const TriangleMesh& mesh, const ShadingNormals& normals,
                            const CornerTangents& tangents, const SplitOptions& options,
                            const Progress& progress) {
  SplitVertices out;
  std::vector<std::uint32_t> first(mesh.positions.size(), options.keepUnused ? 0 : kNone);
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t v : triangle) first[v] = 0;
  }
  for (std::size_t v = 0; v < first.size(); ++v) {
    if (first[v] == kNone) continue;
    first[v] = static_cast<std::uint32_t>(out.source.size());
    out.source.push_back(static_cast<std::uint32_t>(v));
  }
  out.originals = out.source.size();
  out.triangles.reserve(mesh.triangles.size());
  const bool hasUvs = options.uvs && mesh.hasUvs(), hasNormals = !normals.corners.empty();
  const bool hasTangents = !tangents.corners.empty();
  const bool hasPoints = options.sources && !mesh.sources.empty();
  if (!hasUvs && !hasNormals && !hasTangents && !hasPoints) {
    for (const auto& [a, b, c] : mesh.triangles)
      out.triangles.push_back({first[a], first[b], first[c]});
    return out;
  }
  // Copies of one vertex form a list: next[i] is the copy after vertex i of the file. The copies
  // behind a long list are in a map, so that a vertex with very many costs no square of them.
  constexpr int kLongestList = 16;
  std::map<decltype(Wanted{}.key(0)), std::uint32_t> further;
  std::vector<std::uint32_t> next(out.source.size(), kNone);
  std::vector<Wanted> vertices(out.source.size());
  std::vector<bool> isSet(out.source.size(), false);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (t % 16384 == 0) progress.check();
    auto& triangle = out.triangles.emplace_back();
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t v = mesh.triangles[t][c];
      Wanted wanted;
      if (hasUvs) wanted.uv = mesh.uvs[t][c];
      if (hasNormals) wanted.normal = normals.corners[t][c];
      if (hasTangents) wanted.tangent = tangents.corners[t][c];
      if (hasPoints) wanted.point = mesh.sources[t][c];
      std::uint32_t i = first[v];
      if (!isSet[i]) {
        isSet[i] = true;
        vertices[i] = wanted;
      }
      int steps = 0;
      for (; !wanted.suits(vertices[i]) && next[i] != kNone; ++steps) i = next[i];
      if (!wanted.suits(vertices[i])) {
        const auto copy = static_cast<std::uint32_t>(out.source.size());
        if (steps < kLongestList) {
          next[i] = copy;
        } else {
          const auto [found, added] = further.try_emplace(wanted.key(v), copy);
          if (!added) {
            triangle[c] = found->second;
            continue;
          }
        }
        i = copy;
        out.source.push_back(v);
        vertices.push_back(wanted);
        next.push_back(kNone);
        isSet.push_back(true);
      }
      if (vertices[i].tangent == kNone) vertices[i].tangent = wanted.tangent;
      triangle[c] = i;
    }
  }
  const auto collect = [&](bool has, auto& to, const auto& valueOf) {
    if (!has) return;
    to.reserve(vertices.size());
    for (const Wanted& vertex : vertices) to.push_back(valueOf(vertex));
  };
  collect(hasUvs, out.uvs, [](const Wanted& v) { return v.uv; });
  collect(hasNormals, out.normals, [&](const Wanted& v) {
    return v.normal == kNone ? Vec3f{0, 0, 1} : normals.normals[v.normal];
  });
  collect(hasTangents, out.tangents, [&](const Wanted& v) {
    return v.tangent == kNone ? Tangent{1, 0, 0, 1} : tangents.tangents[v.tangent];
  });
  collect(hasPoints, out.points, [](const Wanted& v) { return v.point; });
  return out;
}

}  // namespace exemplar
