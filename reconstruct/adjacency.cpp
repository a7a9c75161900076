// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/adjacency.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/parallel.h"

namespace exemplar {
namespace {

constexpr std::size_t kGrain = 4096;

template <class T>
void keepOnly(std::vector<T>& items, std::span<const std::uint8_t> keep) {
  if (items.empty()) return;
  std::size_t kept = 0;
  for (std::size_t n = 0; n < items.size(); ++n) {
    if (keep[n]) items[kept++] = items[n];
  }
  items.resize(kept);
}

}  // namespace

EdgeGroups edgeGroups(const Triangles& triangles, std::size_t vertices) {
  // Halfedges are dealt into one bucket for each edge's lower vertex; a bucket is short, so sorting
  // it by the higher vertex costs next to nothing.
  const auto halfedgeCount = static_cast<std::uint32_t>(3 * triangles.size());
  const auto forSides = [&](const auto& body) {  // halfedge, lower vertex, higher vertex
    std::uint32_t h = 0;
    for (const auto& [a, b, c] : triangles) {
      body(h, std::min(a, b), std::max(a, b));
      body(h + 1, std::min(b, c), std::max(b, c));
      body(h + 2, std::min(c, a), std::max(c, a));
      h += 3;
    }
  };
  // One place too far at first: filling a bucket moves its end there.
  std::vector<std::uint32_t> bucket(vertices + 2, 0);
  forSides([&](std::uint32_t, std::uint32_t low, std::uint32_t) { ++bucket[low + 2]; });
  std::partial_sum(bucket.begin(), bucket.end(), bucket.begin());
  struct Side {
    std::uint32_t high, halfedge;
    bool operator<(const Side& b) const {
      return high != b.high ? high < b.high : halfedge < b.halfedge;
    }
  };
  std::vector<Side> sides(halfedgeCount);
  forSides([&](std::uint32_t h, std::uint32_t low, std::uint32_t high) {
    sides[bucket[low + 1]++] = {high, h};
  });

  EdgeGroups groups;
  groups.halfedges.resize(halfedgeCount);
  std::vector<std::uint32_t> edges(vertices + 1, 0);  // where each bucket's groups begin
  parallelFor(0, vertices, kGrain, [&](std::size_t v0, std::size_t v1) {
    for (std::size_t v = v0; v < v1; ++v) {
      const auto begin = sides.begin() + bucket[v], end = sides.begin() + bucket[v + 1];
      std::sort(begin, end);
      for (auto side = begin; side != end; ++side) {
        groups.halfedges[side - sides.begin()] = side->halfedge;
        edges[v + 1] += side == begin || side->high != (side - 1)->high;
      }
    }
  });
  std::partial_sum(edges.begin(), edges.end(), edges.begin());
  groups.begin.resize(edges.back() + std::size_t{1});
  parallelFor(0, vertices, kGrain, [&](std::size_t v0, std::size_t v1) {
    for (std::size_t v = v0; v < v1; ++v) {
      std::uint32_t e = edges[v];
      for (std::uint32_t n = bucket[v]; n < bucket[v + 1]; ++n) {
        if (n == bucket[v] || sides[n].high != sides[n - 1].high) groups.begin[e++] = n;
      }
    }
  });
  groups.begin.back() = halfedgeCount;
  return groups;
}

std::vector<std::uint32_t> mateHalfedges(const Triangles& triangles, std::size_t vertices) {
  const EdgeGroups groups = edgeGroups(triangles, vertices);
  std::vector<std::uint32_t> mates(3 * triangles.size(), kNone);
  parallelFor(0, groups.count(), kGrain, [&](std::size_t e0, std::size_t e1) {
    for (std::size_t e = e0; e < e1; ++e) {
      const auto group = groups.group(e);
      if (group.size() != 2) continue;
      if (fromVertex(triangles, group[0]) == fromVertex(triangles, group[1])) continue;
      mates[group[0]] = group[1];
      mates[group[1]] = group[0];
    }
  });
  return mates;
}

DisjointSets cornerFans(const std::vector<std::uint32_t>& mates) {
  DisjointSets fans(mates.size());
  for (std::uint32_t h = 0; h < mates.size(); ++h) {
    if (mates[h] == kNone || mates[h] < h) continue;
    fans.join(h, nextHalfedge(mates[h]));
    fans.join(nextHalfedge(h), mates[h]);
  }
  return fans;
}

VertexCorners vertexCorners(const Triangles& triangles, std::size_t vertices) {
  VertexCorners result;
  result.begin.assign(vertices + 1, 0);
  for (const auto& t : triangles) {
    for (const std::uint32_t v : t) ++result.begin[v + 1];
  }
  std::partial_sum(result.begin.begin(), result.begin.end(), result.begin.begin());
  result.corners.resize(3 * triangles.size());
  std::vector<std::uint32_t> fill(result.begin.begin(), result.begin.end() - 1);
  std::uint32_t corner = 0;
  for (const auto& t : triangles) {
    for (const std::uint32_t v : t) result.corners[fill[v]++] = corner++;
  }
  return result;
}

std::vector<std::uint32_t> vertexComponents(const Triangles& triangles, std::size_t vertices,
                                            std::uint32_t* count) {
  DisjointSets parts(vertices);
  for (const auto& t : triangles) {
    parts.join(t[0], t[1]);
    parts.join(t[0], t[2]);
  }
  return parts.numbered(count);
}

void keepTriangles(TriangleMesh& mesh, std::span<const std::uint8_t> keep) {
  keepOnly(mesh.uvs, keep);
  keepOnly(mesh.triangleMaterials, keep);
  keepOnly(mesh.triangleObjects, keep);
  keepOnly(mesh.triangles, keep);

  std::vector<std::uint8_t> used(mesh.positions.size(), 0);
  for (const auto& t : mesh.triangles) {
    for (const std::uint32_t v : t) used[v] = 1;
  }
  std::vector<std::uint32_t> place(mesh.positions.size());
  std::exclusive_scan(used.begin(), used.end(), place.begin(), 0u,
                      [](std::uint32_t a, std::uint32_t b) { return a + b; });
  keepOnly(mesh.colors, used);
  keepOnly(mesh.positions, used);
  for (auto& t : mesh.triangles) {
    for (std::uint32_t& v : t) v = place[v];
  }
}

void cutTriangle(TriangleMesh& mesh, std::uint32_t t, const std::array<std::uint32_t, 3>& middle) {
  // Corners 0..2 and the new vertices of the sides 3..5 (3 lies between 0 and 1).
  using Pieces = std::array<std::array<int, 3>, 4>;
  static constexpr Pieces kOne{{{0, 3, 2}, {3, 1, 2}}};
  static constexpr Pieces kTwo{{{3, 1, 4}, {0, 3, 4}, {0, 4, 2}}};
  static constexpr Pieces kTwoOtherDiagonal{{{3, 1, 4}, {0, 3, 2}, {3, 4, 2}}};
  static constexpr Pieces kThree{{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}};

  int count = 0, shift = 0;
  for (const std::uint32_t m : middle) count += m != kNone;
  if (count == 0) return;
  // Turn the triangle so that its cut sides are the first ones.
  while (count < 3 && !(middle[shift] != kNone && middle[(shift + 2) % 3] == kNone)) ++shift;

  std::array<std::uint32_t, 6> vertex;
  std::array<Vec2f, 6> uv{};
  for (int c = 0; c < 3; ++c) {
    vertex[c] = mesh.triangles[t][(c + shift) % 3];
    vertex[3 + c] = middle[(c + shift) % 3];
  }
  if (mesh.hasUvs()) {
    for (int c = 0; c < 3; ++c) uv[c] = mesh.uvs[t][(c + shift) % 3];
    for (int c = 0; c < 3; ++c) {
      const Vec2f &p = uv[c], &q = uv[(c + 1) % 3];
      uv[3 + c] = {(p.x + q.x) / 2, (p.y + q.y) / 2};
    }
  }
  const Pieces* pieces = count == 1 ? &kOne : count == 2 ? &kTwo : &kThree;
  if (count == 2) {
    const auto far = [&](int a, int b) {
      return length(mesh.positions[vertex[a]] - mesh.positions[vertex[b]]);
    };
    if (far(3, 2) < far(0, 4)) pieces = &kTwoOtherDiagonal;
  }
  for (int p = 0; p <= count; ++p) {
    std::array<std::uint32_t, 3> corners;
    std::array<Vec2f, 3> uvs;
    for (int c = 0; c < 3; ++c) {
      corners[c] = vertex[(*pieces)[p][c]];
      uvs[c] = uv[(*pieces)[p][c]];
    }
    if (p == 0) {
      mesh.triangles[t] = corners;
      if (mesh.hasUvs()) mesh.uvs[t] = uvs;
    } else {
      mesh.triangles.push_back(corners);
      if (mesh.hasUvs()) mesh.uvs.push_back(uvs);
      if (mesh.hasMaterials()) {
        mesh.triangleMaterials.push_back(std::uint32_t{mesh.triangleMaterials[t]});
      }
      if (!mesh.triangleObjects.empty())
        mesh.triangleObjects.push_back(std::uint32_t{mesh.triangleObjects[t]});
    }
  }
}

std::vector<Vec3d> vertexNormals(const TriangleMesh& mesh, const VertexCorners& corners) {
  std::vector<Vec3d> normals(mesh.positions.size());
  parallelFor(0, normals.size(), kGrain, [&](std::size_t v0, std::size_t v1) {
    for (std::size_t v = v0; v < v1; ++v) {
      for (const std::uint32_t corner : corners.at(v)) normals[v] += areaNormal(mesh, corner / 3);
    }
  });
  return normals;
}

}  // namespace exemplar
