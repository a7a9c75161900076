// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/continuous/mesh_parts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "core/disjoint_sets.h"
#include "mesh/polygon.h"
#include "mesh/shading_normals.h"

namespace exemplar::continuous {
namespace {

/// A part with less volume than this times its area to the power 3/2 is a sheet.
constexpr double kLeastFullness = 1e-4;

using Edge = std::pair<std::uint32_t, std::uint32_t>;
using EdgeUsers = std::map<Edge, std::vector<std::uint32_t>>;

/// The number of each vertex's welded one.
std::vector<std::uint32_t> welded(const TriangleMesh& mesh, double distance) {
  std::vector<Vec3d> rounded = mesh.positions;
  for (Vec3d& p : rounded)
    for (int axis = 0; axis < 3; ++axis) p[axis] = std::round(p[axis] / distance);
  return firstOfEqual(rounded);
}

Vec3d normalOf(const PartTriangle& t) {
  return cross(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0]);
}

EdgeUsers usersOf(const std::vector<PartTriangle>& triangles) {
  EdgeUsers users;
  for (std::uint32_t n = 0; n < triangles.size(); ++n) {
    for (int c = 0; c < 3; ++c)
      users[std::minmax(triangles[n].ids[c], triangles[n].ids[(c + 1) % 3])].push_back(n);
  }
  return users;
}

/// 1 where a triangle runs from the first to the second end of an edge, else -1.
int along(const PartTriangle& t, const Edge& edge) {
  for (int c = 0; c < 3; ++c)
    if (t.ids[c] == edge.first && t.ids[(c + 1) % 3] == edge.second) return 1;
  return -1;
}

void turn(PartTriangle& t) {
  std::swap(t.ids[1], t.ids[2]);
  std::swap(t.corners[1], t.corners[2]);
}

/// Turns triangles so that they agree with the first one of what they hang together with, across
/// edges of two.
void orient(std::vector<PartTriangle>& triangles) {
  const EdgeUsers users = usersOf(triangles);
  std::vector<std::vector<std::pair<std::uint32_t, Edge>>> neighbors(triangles.size());
  for (const auto& [edge, of] : users) {
    if (of.size() != 2) continue;
    neighbors[of[0]].emplace_back(of[1], edge);
    neighbors[of[1]].emplace_back(of[0], edge);
  }
  std::vector<std::uint8_t> seen(triangles.size());
  std::vector<std::uint32_t> queue;
  for (std::uint32_t first = 0; first < triangles.size(); ++first) {
    if (seen[first]) continue;
    seen[first] = 1;
    queue = {first};
    while (!queue.empty()) {
      const std::uint32_t n = queue.back();
      queue.pop_back();
      for (const auto& [other, edge] : neighbors[n]) {
        if (seen[other]) continue;
        seen[other] = 1;
        if (along(triangles[n], edge) == along(triangles[other], edge)) turn(triangles[other]);
        queue.push_back(other);
      }
    }
  }
}

/// Adds polygons over the borders of openings; returns how many have area.
std::size_t closeOpenings(std::vector<PartTriangle>& triangles) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> next;
  std::map<std::uint32_t, Vec3d> corner;
  for (const PartTriangle& t : triangles)
    for (int c = 0; c < 3; ++c) corner.emplace(t.ids[c], t.corners[c]);
  for (const auto& [edge, of] : usersOf(triangles)) {
    int excess = 0;
    for (const std::uint32_t n : of) excess += along(triangles[n], edge);
    for (; excess > 0; --excess) next[edge.second].push_back(edge.first);
    for (; excess < 0; ++excess) next[edge.first].push_back(edge.second);
  }
  std::size_t openings = 0;
  for (auto& [start, ends] : next) {
    while (!ends.empty()) {
      // As many border edges leave a vertex as arrive, so the walk comes back.
      std::vector<std::uint32_t> loop;
      std::uint32_t at = start;
      do {
        loop.push_back(at);
        const std::uint32_t to = next[at].back();
        next[at].pop_back();
        at = to;
      } while (at != start);
      if (loop.size() < 3) continue;
      std::vector<Vec3d> corners;
      for (const std::uint32_t v : loop) corners.push_back(corner[v]);
      std::vector<std::array<std::uint32_t, 3>> cut;
      if (!triangulate(corners, cut)) continue;
      double area = 0, reach = 0;
      for (const auto& t : cut) {
        PartTriangle cap;
        for (int c = 0; c < 3; ++c) {
          cap.ids[c] = loop[t[c]];
          cap.corners[c] = corners[t[c]];
          reach = std::max(reach, length(corners[t[c]] - corners[0]));
        }
        area += length(normalOf(cap));
        triangles.push_back(cap);
      }
      openings += area > 1e-6 * reach * reach;
    }
  }
  return openings;
}

}  // namespace

MeshParts partsOf(const TriangleMesh& mesh, double weld) {
  const std::vector<std::uint32_t> vertex = welded(mesh, weld);
  std::vector<PartTriangle> all;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    PartTriangle triangle;
    triangle.origin = t;
    for (int c = 0; c < 3; ++c) {
      triangle.ids[c] = vertex[mesh.triangles[t][c]];
      triangle.corners[c] = mesh.positions[triangle.ids[c]];
    }
    if (length(normalOf(triangle)) > 1e-3 * weld * weld) all.push_back(triangle);
  }
  const auto materialOf = [&](std::uint32_t n) {
    return mesh.hasMaterials() ? mesh.triangleMaterials[all[n].origin] : 0u;
  };
  DisjointSets sets(all.size());
  for (const auto& [edge, users] : usersOf(all))
    if (users.size() == 2) sets.join(users[0], users[1]);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> firstAt;
  for (std::uint32_t n = 0; n < all.size(); ++n) {
    for (const std::uint32_t v : all[n].ids)
      sets.join(n, firstAt.emplace(std::pair(v, materialOf(n)), n).first->second);
  }
  std::uint32_t count = 0;
  const std::vector<std::uint32_t> partOf = sets.numbered(&count);
  std::vector<MeshPart> parts(count);
  std::vector<std::map<std::uint32_t, double>> areas(count);
  for (std::uint32_t n = 0; n < all.size(); ++n) {
    parts[partOf[n]].triangles.push_back(all[n]);
    areas[partOf[n]][materialOf(n)] += length(normalOf(all[n]));
  }
  MeshParts made;
  for (std::uint32_t p = 0; p < count; ++p) {
    MeshPart& part = parts[p];
    part.material = std::ranges::max_element(areas[p], {}, [](const auto& entry) {
                      return entry.second;
                    })->first;
    orient(part.triangles);
    const std::size_t openings = closeOpenings(part.triangles);
    double area = 0;
    for (const PartTriangle& t : part.triangles) {
      for (const Vec3d& corner : t.corners) part.box.add(corner);
      area += length(normalOf(t)) / 2;
      part.volume += dot(t.corners[0] - part.triangles[0].corners[0], normalOf(t)) / 6;
    }
    if (std::abs(part.volume) < kLeastFullness * area * std::sqrt(area)) {
      ++made.sheets;
      continue;
    }
    if (part.volume < 0) {
      part.volume = -part.volume;
      for (PartTriangle& t : part.triangles) turn(t);
    }
    made.openings += openings;
    made.parts.push_back(std::move(part));
  }
  return made;
}

double windingNumber(const MeshPart& part, const Vec3d& p) {
  // Van Oosterom and Strackee, "The Solid Angle of a Plane Triangle" (1983).
  double sum = 0;
  for (const PartTriangle& t : part.triangles) {
    const Vec3d a = t.corners[0] - p, b = t.corners[1] - p, c = t.corners[2] - p;
    const double la = length(a), lb = length(b), lc = length(c);
    sum += std::atan2(dot(a, cross(b, c)),
                      la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return sum / (2 * std::numbers::pi);
}

}  // namespace exemplar::continuous
