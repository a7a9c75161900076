// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "report/simplify.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/disjoint_sets.h"

namespace exemplar {
namespace {

/// Whatever it costs in looks, as a share of the mesh's size.
constexpr float kAnyError = 1;
/// Parts that would be left with fewer triangles than this are not simplified one by one: they
/// would shrink to nothing, and the surface that they make together with them.
constexpr std::size_t kLeastOfPart = 8;

/// A mesh as meshoptimizer takes it: vertices at the same place are one, and coordinates run from 0
/// to 1 along the longest side, so that single precision serves wherever the mesh is.
struct Welded {
  std::vector<unsigned> indices;
  std::vector<std::array<float, 3>> positions;
  std::vector<std::uint32_t> original;  ///< of each vertex, one in the mesh
};

Welded welded(const TriangleMesh& mesh) {
  Welded w;
  const std::size_t n = mesh.positions.size();
  std::vector<unsigned> number(n);
  const std::size_t count = meshopt_generateVertexRemap(number.data(), nullptr, n,
                                                        mesh.positions.data(), n, sizeof(Vec3d));
  const Box3d box = boundingBox(mesh);
  const Vec3d size = box.size();
  const double longest = std::max({size.x, size.y, size.z});
  const double scale = longest > 0 ? 1 / longest : 0;
  w.positions.resize(count);
  w.original.resize(count);
  for (std::size_t v = n; v-- > 0;) {  // the first of those at one place is kept
    const Vec3f p = cast<float>((mesh.positions[v] - box.min) * scale);
    w.positions[number[v]] = {p.x, p.y, p.z};
    w.original[number[v]] = static_cast<std::uint32_t>(v);
  }
  w.indices.reserve(3 * mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    const std::array<unsigned, 3> corners{number[t[0]], number[t[1]], number[t[2]]};
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[0] == corners[2]) continue;
    w.indices.insert(w.indices.end(), corners.begin(), corners.end());
  }
  return w;
}

/// How many parts the triangles are, connected by vertices.
std::size_t countParts(const Welded& w) {
  DisjointSets parts(w.positions.size());
  std::size_t joins = 0, used = 0;
  std::vector<char> isUsed(w.positions.size());
  for (std::size_t i = 0; i < w.indices.size(); ++i) {
    used += !std::exchange(isUsed[w.indices[i]], 1);
    if (i % 3 > 0) joins += parts.join(w.indices[i - 1], w.indices[i]);
  }
  return used - joins;
}

/// The vertices of the mesh that are still in use, and its triangles.
TriangleMesh compacted(const TriangleMesh& mesh, const Welded& w,
                       const std::vector<unsigned>& indices) {
  constexpr std::uint32_t kUnused = ~0u;
  TriangleMesh kept;
  std::vector<std::uint32_t> number(w.original.size(), kUnused);
  for (std::size_t i = 0; i < indices.size(); ++i) {
    std::uint32_t& v = number[indices[i]];
    if (v == kUnused) {
      v = static_cast<std::uint32_t>(kept.positions.size());
      kept.positions.push_back(mesh.positions[w.original[indices[i]]]);
    }
    if (i % 3 == 0) kept.triangles.emplace_back();
    kept.triangles.back()[i % 3] = v;
  }
  return kept;
}

}  // namespace

TriangleMesh simplified(const TriangleMesh& mesh, std::int64_t triangles) {
  const Welded w = welded(mesh);
  const auto most = static_cast<std::size_t>(3 * triangles);
  if (w.indices.size() <= most) return compacted(mesh, w, w.indices);
  const float* positions = w.positions.empty() ? nullptr : w.positions[0].data();
  constexpr std::size_t kStride = sizeof w.positions[0];
  std::vector<unsigned> indices;
  if (3 * kLeastOfPart * countParts(w) <= most) {
    indices.resize(w.indices.size());
    indices.resize(meshopt_simplify(indices.data(), w.indices.data(), w.indices.size(), positions,
                                    w.positions.size(), kStride, most, kAnyError));
  }
  if (indices.size() > most || indices.empty()) {
    indices.resize(w.indices.size());
    indices.resize(meshopt_simplifySloppy(indices.data(), w.indices.data(), w.indices.size(),
                                          positions, w.positions.size(), kStride, most, kAnyError));
  }
  if (indices.size() > most || indices.empty()) {  // nothing is left of so few: some of its own
    indices = w.indices;
    indices.resize(std::min(most, indices.size()));
  }
  return compacted(mesh, w, indices);
}

}  // namespace exemplar
