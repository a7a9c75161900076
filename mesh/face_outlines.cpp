// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/face_outlines.h"

#include <list>
#include <map>
#include <set>
#include <utility>

namespace exemplar {
namespace {

/// The outline of the triangles `from` up to `to`; empty where it is not one simple loop.
std::vector<TriangleCorner> outlineOf(const TriangleMesh& mesh, std::uint32_t from,
                                      std::uint32_t to) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, TriangleCorner> edges;
  for (std::uint32_t t = from; t < to; ++t) {
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t a = mesh.triangles[t][c], b = mesh.triangles[t][(c + 1) % 3];
      if (edges.erase({b, a}) == 0 && !edges.emplace(std::pair(a, b), TriangleCorner{t, c}).second)
        return {};
    }
  }
  std::map<std::uint32_t, std::pair<std::uint32_t, TriangleCorner>> next;
  for (const auto& [ends, corner] : edges)
    if (!next.emplace(ends.first, std::pair(ends.second, corner)).second) return {};
  std::vector<TriangleCorner> loop;
  // From the first triangle's first corner on the outline, for an order that follows the mesh's.
  std::uint32_t start = next.begin()->first;
  for (int c = 2; c >= 0; --c)
    if (next.contains(mesh.triangles[from][c])) start = mesh.triangles[from][c];
  std::uint32_t at = start;
  do {
    const auto found = next.find(at);
    if (found == next.end()) return {};
    loop.push_back(found->second.second);
    at = found->second.first;
  } while (at != start && loop.size() <= next.size());
  return loop.size() == next.size() ? loop : std::vector<TriangleCorner>{};
}

/// Triangles `from` up to `to` as polygons with one loop each: from a triangle on, neighbors are
/// added as long as that gives the loop a corner that it has not.
void addPieces(const TriangleMesh& mesh, std::uint32_t from, std::uint32_t to,
               std::size_t mostCorners, std::vector<std::vector<TriangleCorner>>& outlines) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, TriangleCorner> edges;
  for (std::uint32_t t = from; t < to; ++t)
    for (int c = 0; c < 3; ++c)
      edges[{mesh.triangles[t][c], mesh.triangles[t][(c + 1) % 3]}] = {t, c};
  std::vector<bool> taken(to - from);
  for (std::uint32_t first = from; first < to; ++first) {
    if (taken[first - from]) continue;
    taken[first - from] = true;
    std::list<TriangleCorner> loop{{first, 0}, {first, 1}, {first, 2}};
    const auto vertex = [&](const TriangleCorner& c) {
      return mesh.triangles[c.triangle][c.corner];
    };
    std::set<std::uint32_t> has{mesh.triangles[first].begin(), mesh.triangles[first].end()};
    // Edges of the loop, each by the corner that it starts at, that were not looked at.
    for (auto at = loop.begin(); at != loop.end();) {
      const auto next = std::next(at) == loop.end() ? loop.begin() : std::next(at);
      const auto found = edges.find({vertex(*next), vertex(*at)});
      const TriangleCorner across = found == edges.end() ? *at : found->second;
      const TriangleCorner corner{across.triangle, (across.corner + 2) % 3};
      if (found == edges.end() || taken[across.triangle - from] || loop.size() >= mostCorners ||
          !has.insert(vertex(corner)).second) {
        ++at;
        continue;
      }
      taken[across.triangle - from] = true;
      loop.insert(std::next(at), corner);  // and the edge from `at` on is looked at again
    }
    outlines.emplace_back(loop.begin(), loop.end());
  }
}

}  // namespace

std::vector<std::vector<TriangleCorner>> faceOutlines(const TriangleMesh& mesh,
                                                      std::span<const std::uint32_t> faces,
                                                      std::size_t mostCorners) {
  std::vector<std::vector<TriangleCorner>> outlines;
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  for (std::uint32_t from = 0; from < count;) {
    std::uint32_t to = from + 1;
    while (!faces.empty() && to < count && faces[to] == faces[from]) ++to;
    std::vector<TriangleCorner> outline;
    if (to - from > 1) outline = outlineOf(mesh, from, to);
    if (!outline.empty() && outline.size() <= mostCorners) {
      outlines.push_back(std::move(outline));
    } else {
      addPieces(mesh, from, to, mostCorners, outlines);
    }
    from = to;
  }
  return outlines;
}

}  // namespace exemplar
