// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/manifold.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include "core/disjoint_sets.h"
#include "core/parallel.h"
#include "reconstruct/adjacency.h"

namespace exemplar {
namespace {

// A triangle counts as without area where its height is below this share of its longest side.
constexpr double kFlat = 1e-7;

bool isFlat(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const double longest2 = std::max({dot(b - a, b - a), dot(c - b, c - b), dot(a - c, a - c)});
  return length(cross(b - a, c - a)) <= kFlat * longest2;
}

/// Makes vertex `copy` (a new index) from what `mesh` holds at `v`.
void copyVertex(TriangleMesh& mesh, std::uint32_t v) {
  mesh.positions.push_back(Vec3d(mesh.positions[v]));
  if (mesh.hasColors()) mesh.colors.push_back(std::array<float, 4>(mesh.colors[v]));
}

void removeEqualCorners(TriangleMesh& mesh, ManifoldReport& report) {
  std::vector<std::uint8_t> keep(mesh.triangles.size(), 1);
  std::int64_t removed = 0;
  for (std::size_t t = 0; t < keep.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    if (a == b || b == c || c == a) {
      keep[t] = 0;
      ++removed;
    }
  }
  if (removed > 0) keepTriangles(mesh, keep);
  report.removedTriangles += removed;
}

/// Removes pairs of triangles that have the same corners and wind against each other. Removing one
/// pair leaves no new one, so one pass does. Returns the edges of what is left.
EdgeGroups removeFlaps(TriangleMesh& mesh, ManifoldReport& report) {
  const Triangles& triangles = mesh.triangles;
  EdgeGroups groups = edgeGroups(triangles, mesh.positions.size());
  std::vector<std::uint8_t> keep(triangles.size(), 1);
  std::int64_t removed = 0;
  for (std::size_t e = 0; e < groups.count(); ++e) {
    const auto group = groups.group(e);
    for (std::size_t m = 0; m + 1 < group.size(); ++m) {
      for (std::size_t n = m + 1; n < group.size() && keep[group[m] / 3]; ++n) {
        const std::uint32_t g = group[m], h = group[n];
        if (!keep[h / 3] || fromVertex(triangles, g) == fromVertex(triangles, h) ||
            apexVertex(triangles, g) != apexVertex(triangles, h)) {
          continue;
        }
        keep[g / 3] = keep[h / 3] = 0;
        removed += 2;
      }
    }
  }
  report.removedTriangles += removed;
  if (removed == 0) return groups;
  keepTriangles(mesh, keep);
  return edgeGroups(triangles, mesh.positions.size());
}

/// Pairs the halfedges of one edge where three or more meet: seen along the edge, each solid wedge
/// begins at a triangle that runs the edge backwards and ends at the next one that runs it
/// forwards.
void pairByAngle(const TriangleMesh& mesh, std::span<const std::uint32_t> group,
                 std::vector<std::uint32_t>& mates) {
  const Triangles& triangles = mesh.triangles;
  const std::uint32_t low =
      std::min(fromVertex(triangles, group[0]), toVertex(triangles, group[0]));
  const std::uint32_t high =
      std::max(fromVertex(triangles, group[0]), toVertex(triangles, group[0]));
  const Vec3d foot = mesh.positions[low];
  const Vec3d axis = normalized(mesh.positions[high] - foot);
  const Vec3d side = std::abs(axis.x) < 0.6 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
  const Vec3d u = normalized(cross(axis, side)), v = cross(axis, u);

  struct Spoke {
    double angle;
    bool forward;
    std::uint32_t halfedge;
  };
  std::vector<Spoke> spokes;
  for (const std::uint32_t h : group) {
    const Vec3d arm = mesh.positions[apexVertex(triangles, h)] - foot;
    spokes.push_back({std::atan2(dot(arm, v), dot(arm, u)), fromVertex(triangles, h) == low, h});
  }
  std::sort(spokes.begin(), spokes.end(), [](const Spoke& a, const Spoke& b) {
    return std::tie(a.angle, a.forward, a.halfedge) < std::tie(b.angle, b.forward, b.halfedge);
  });

  // Backwards opens, forwards closes: matched like brackets on a circle, hence two rounds.
  std::vector<std::uint32_t> open;
  for (std::size_t n = 0; n < 2 * spokes.size(); ++n) {
    const Spoke& spoke = spokes[n % spokes.size()];
    if (mates[spoke.halfedge] != kNone) continue;
    if (!spoke.forward) {
      if (n < spokes.size()) open.push_back(spoke.halfedge);
    } else if (!open.empty()) {
      mates[spoke.halfedge] = open.back();
      mates[open.back()] = spoke.halfedge;
      open.pop_back();
    }
  }
}

std::vector<std::uint32_t> pairHalfedges(const TriangleMesh& mesh, const EdgeGroups& groups) {
  std::vector<std::uint32_t> mates(3 * mesh.triangles.size(), kNone);
  parallelFor(0, groups.count(), 4096, [&](std::size_t e0, std::size_t e1) {
    for (std::size_t e = e0; e < e1; ++e) {
      const auto group = groups.group(e);
      if (group.size() > 2) {
        pairByAngle(mesh, group, mates);
      } else if (group.size() == 2 &&
                 fromVertex(mesh.triangles, group[0]) != fromVertex(mesh.triangles, group[1])) {
        mates[group[0]] = group[1];
        mates[group[1]] = group[0];
      }
    }
  });
  return mates;
}

/// The halfedges of edges at which more than one sheet of triangles ends or passes, each sheet by
/// its first one. Splitting vertices only ever parts sheets, so no other edge can be shared later.
std::vector<std::uint32_t> sharedEdges(const EdgeGroups& groups,
                                       const std::vector<std::uint32_t>& mates) {
  std::vector<std::uint32_t> shared, sheets;
  for (std::size_t e = 0; e < groups.count(); ++e) {
    const auto group = groups.group(e);
    if (group.size() == 1 || (group.size() == 2 && mates[group[0]] == group[1])) continue;
    sheets.clear();
    for (const std::uint32_t h : group) {
      if (mates[h] == kNone || mates[h] >= h) sheets.push_back(h);
    }
    if (sheets.size() > 1) shared.insert(shared.end(), sheets.begin(), sheets.end());
  }
  return shared;
}

/// Gives each fan of triangles a vertex of its own; marks all vertices that were one before.
void splitVertices(TriangleMesh& mesh, const std::vector<std::uint32_t>& mates,
                   std::vector<std::uint8_t>& touched, ManifoldReport& report) {
  DisjointSets fans = cornerFans(mates);

  std::vector<std::uint32_t> firstFan(mesh.positions.size(), kNone);
  std::vector<std::uint32_t> vertexOfFan(mates.size(), kNone);
  touched.assign(mesh.positions.size(), 0);
  for (std::uint32_t c = 0; c < mates.size(); ++c) {
    std::uint32_t& v = mesh.triangles[c / 3][c % 3];
    const std::uint32_t fan = fans.find(c);
    if (vertexOfFan[fan] == kNone) {
      if (firstFan[v] == kNone) {
        firstFan[v] = fan;
        vertexOfFan[fan] = v;
      } else {
        touched[v] = 1;
        touched.push_back(1);
        vertexOfFan[fan] = static_cast<std::uint32_t>(mesh.positions.size());
        copyVertex(mesh, v);
        ++report.splitVertices;
      }
    }
    v = vertexOfFan[fan];
  }
}

/// Two sheets may still share both ends of an edge where their fans are joined elsewhere. All but
/// one of them get a vertex of their own in the middle of the edge. `shared`: see `sharedEdges`.
void splitEdges(TriangleMesh& mesh, const std::vector<std::uint32_t>& mates,
                std::vector<std::uint32_t> shared, std::vector<std::uint8_t>& touched,
                ManifoldReport& report) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> middles;  // halfedge, new vertex
  const auto addMiddle = [&](std::uint32_t h) {
    const std::uint32_t a = fromVertex(mesh.triangles, h), b = toVertex(mesh.triangles, h);
    const auto m = static_cast<std::uint32_t>(mesh.positions.size());
    copyVertex(mesh, a);
    mesh.positions[m] = (mesh.positions[a] + mesh.positions[b]) * 0.5;
    if (mesh.hasColors()) {
      for (int k = 0; k < 4; ++k) mesh.colors[m][k] = (mesh.colors[a][k] + mesh.colors[b][k]) / 2;
    }
    touched.push_back(1);
    middles.emplace_back(h, m);
    if (mates[h] != kNone) {
      middles.emplace_back(mates[h], m);
    } else {
      ++report.boundaryEdges;
    }
    ++report.splitEdges;
  };
  const auto edgeOf = [&](std::uint32_t h) {
    const std::uint32_t a = fromVertex(mesh.triangles, h), b = toVertex(mesh.triangles, h);
    return std::pair(std::min(a, b), std::max(a, b));
  };
  std::sort(shared.begin(), shared.end(), [&](std::uint32_t g, std::uint32_t h) {
    return std::pair(edgeOf(g), g) < std::pair(edgeOf(h), h);
  });
  for (std::size_t n = 1; n < shared.size(); ++n) {
    if (edgeOf(shared[n]) == edgeOf(shared[n - 1])) addMiddle(shared[n]);
  }
  std::sort(middles.begin(), middles.end());
  for (std::size_t n = 0; n < middles.size();) {
    const std::uint32_t t = middles[n].first / 3;
    std::array<std::uint32_t, 3> middle{kNone, kNone, kNone};
    for (; n < middles.size() && middles[n].first / 3 == t; ++n) {
      middle[middles[n].first % 3] = middles[n].second;
    }
    cutTriangle(mesh, t, middle);
  }
}

Vec3d ringCenter(const TriangleMesh& mesh, const VertexCorners& corners, std::uint32_t v) {
  Vec3d sum{};
  const auto at = corners.at(v);
  for (const std::uint32_t c : at) {
    sum += mesh.positions[toVertex(mesh.triangles, c)];
    sum += mesh.positions[apexVertex(mesh.triangles, c)];
  }
  return at.empty() ? mesh.positions[v] : sum / (2.0 * static_cast<double>(at.size()));
}

/// Moves the chosen vertices a share of the way to the middle of their neighbors, all at once.
void drawIn(TriangleMesh& mesh, const std::vector<std::uint32_t>& vertices, double share) {
  const VertexCorners corners = vertexCorners(mesh.triangles, mesh.positions.size());
  std::vector<Vec3d> moved(vertices.size());
  for (std::size_t n = 0; n < vertices.size(); ++n) {
    const Vec3d& p = mesh.positions[vertices[n]];
    moved[n] = p + (ringCenter(mesh, corners, vertices[n]) - p) * share;
  }
  for (std::size_t n = 0; n < vertices.size(); ++n) mesh.positions[vertices[n]] = moved[n];
}

std::vector<std::uint32_t> flatTriangles(const TriangleMesh& mesh) {
  std::vector<std::uint8_t> flat(mesh.triangles.size());
  parallelFor(0, flat.size(), 4096, [&](std::size_t t0, std::size_t t1) {
    for (std::size_t t = t0; t < t1; ++t) {
      const auto& [a, b, c] = mesh.triangles[t];
      flat[t] = isFlat(mesh.positions[a], mesh.positions[b], mesh.positions[c]);
    }
  });
  std::vector<std::uint32_t> found;
  for (std::uint32_t t = 0; t < flat.size(); ++t) {
    if (flat[t]) found.push_back(t);
  }
  return found;
}

/// Whether an edge joins the vertices at the start of halfedge `h` and `other`.
bool joined(const Triangles& triangles, const std::vector<std::uint32_t>& mates, std::uint32_t h,
            std::uint32_t other) {
  std::uint32_t g = h;
  do {  // anticlockwise
    if (toVertex(triangles, g) == other || apexVertex(triangles, g) == other) return true;
    g = mates[previousHalfedge(g)];
  } while (g != kNone && g != h);
  if (g == h) return false;
  for (g = mates[h]; g != kNone; g = mates[nextHalfedge(g)]) {  // clockwise from the start
    if (apexVertex(triangles, g) == other) return true;
  }
  return false;
}

/// Turns the longest side of flat triangle `t` into the other diagonal of the two triangles beside
/// it, where both come out with area and nothing but geometry changes.
bool turnLongestSide(TriangleMesh& mesh, std::vector<std::uint32_t>& mates, std::uint32_t t) {
  Triangles& triangles = mesh.triangles;
  std::uint32_t h = 3 * t;
  double longest = -1;
  for (std::uint32_t g = 3 * t; g < 3 * t + 3; ++g) {
    const Vec3d side =
        mesh.positions[toVertex(triangles, g)] - mesh.positions[fromVertex(triangles, g)];
    if (dot(side, side) > longest) {
      longest = dot(side, side);
      h = g;
    }
  }
  const std::uint32_t mate = mates[h];
  if (mate == kNone) return false;
  const std::uint32_t other = mate / 3;
  const std::uint32_t a = fromVertex(triangles, h), b = toVertex(triangles, h);
  const std::uint32_t m = apexVertex(triangles, h), c = apexVertex(triangles, mate);
  if (m == c || joined(triangles, mates, previousHalfedge(h), c)) return false;
  const auto& p = mesh.positions;
  if (isFlat(p[a], p[c], p[m]) || isFlat(p[c], p[b], p[m])) return false;
  const Vec3d before = cross(p[a] - p[b], p[c] - p[b]);
  if (dot(cross(p[c] - p[a], p[m] - p[a]), before) <= 0 ||
      dot(cross(p[b] - p[c], p[m] - p[c]), before) <= 0) {
    return false;
  }
  if (mesh.hasMaterials() && mesh.triangleMaterials[t] != mesh.triangleMaterials[other]) {
    return false;
  }
  if (mesh.hasUvs()) {
    const auto uvOf = [&](std::uint32_t corner) { return mesh.uvs[corner / 3][corner % 3]; };
    const Vec2f ua = uvOf(h), ub = uvOf(nextHalfedge(h)), um = uvOf(previousHalfedge(h));
    const Vec2f uc = uvOf(previousHalfedge(mate));
    if (uvOf(mate) != ub || uvOf(nextHalfedge(mate)) != ua) return false;
    mesh.uvs[t] = {ua, uc, um};
    mesh.uvs[other] = {uc, ub, um};
  }
  const std::array<std::uint32_t, 4> outer{mates[nextHalfedge(mate)], mates[previousHalfedge(h)],
                                           mates[previousHalfedge(mate)], mates[nextHalfedge(h)]};
  triangles[t] = {a, c, m};
  triangles[other] = {c, b, m};
  const std::array<std::uint32_t, 4> inner{3 * t, 3 * t + 2, 3 * other, 3 * other + 1};
  for (int k = 0; k < 4; ++k) {
    mates[inner[k]] = outer[k];
    if (outer[k] != kNone) mates[outer[k]] = inner[k];
  }
  mates[3 * t + 1] = 3 * other + 2;
  mates[3 * other + 2] = 3 * t + 1;
  return true;
}

void repairFlat(TriangleMesh& mesh, const Progress& progress, ManifoldReport& report) {
  std::vector<std::uint32_t> flat = flatTriangles(mesh);
  const auto found = static_cast<std::int64_t>(flat.size());
  for (int round = 0; round < 12 && !flat.empty(); ++round) {
    progress.check();
    std::vector<std::uint32_t> mates = mateHalfedges(mesh.triangles, mesh.positions.size());
    std::vector<std::uint32_t> stubborn;
    for (const std::uint32_t t : flat) {
      const auto& [a, b, c] = mesh.triangles[t];
      if (!isFlat(mesh.positions[a], mesh.positions[b], mesh.positions[c])) continue;
      if (!turnLongestSide(mesh, mates, t)) stubborn.insert(stubborn.end(), {a, b, c});
    }
    if (!stubborn.empty()) {
      std::sort(stubborn.begin(), stubborn.end());
      stubborn.erase(std::unique(stubborn.begin(), stubborn.end()), stubborn.end());
      // Ever larger steps: a flat fan whose ring is flat too needs company from further away.
      drawIn(mesh, stubborn, 0.02 * (round + 1));
    }
    flat = flatTriangles(mesh);
  }
  report.degenerateTriangles = static_cast<std::int64_t>(flat.size());
  report.repairedTriangles = found - report.degenerateTriangles;
}

}  // namespace

ManifoldReport makeManifold(TriangleMesh& mesh, const ManifoldOptions& options,
                            const Progress& progress) {
  assert(options.separation >= 0 && options.separation <= 0.5);
  const auto reportDone = [&](double fraction) {
    progress.report("making the surface manifold", fraction);
  };
  ManifoldReport report;
  reportDone(0);
  removeEqualCorners(mesh, report);
  std::vector<std::uint32_t> mates, shared;
  {
    const EdgeGroups groups = removeFlaps(mesh, report);
    reportDone(0.4);
    mates = pairHalfedges(mesh, groups);
    shared = sharedEdges(groups, mates);
  }
  report.boundaryEdges = std::count(mates.begin(), mates.end(), kNone);
  reportDone(0.6);
  std::vector<std::uint8_t> touched;
  splitVertices(mesh, mates, touched, report);
  splitEdges(mesh, mates, std::move(shared), touched, report);
  reportDone(0.8);
  if (options.separation > 0) {
    std::vector<std::uint32_t> vertices;
    for (std::uint32_t v = 0; v < touched.size(); ++v) {
      if (touched[v]) vertices.push_back(v);
    }
    if (!vertices.empty()) drawIn(mesh, vertices, options.separation);
  }
  if (options.repairDegenerate) repairFlat(mesh, progress, report);
  reportDone(1);
  return report;
}

}  // namespace exemplar
