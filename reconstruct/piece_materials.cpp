// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/piece_materials.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <vector>

#include "core/disjoint_sets.h"
#include "core/parallel.h"
#include "reconstruct/adjacency.h"
#include "reconstruct/material_borders.h"
#include "reconstruct/material_pieces.h"

namespace exemplar {
namespace {

constexpr std::size_t kGrain = 256;
constexpr const char* kStage = "taking materials from the example";

// Lengths in voxels.
constexpr double kKeep = 2.2;  // weight of a piece's own material, over the regions' width
constexpr double kNarrowest = 10, kWidest = 60;  // limits of the regions' width
constexpr double kTrust = 0.1;  // that there is no border, where no source has evidence

/// How wide, in voxels, what has one material is on the example: the square root of the area of a
/// connected region of one material, the middle one if regions count as much as they cover.
double regionWidth(const TriangleMesh& example, double voxelSize) {
  // Triangles may come with corners of their own: those in one place are joined.
  std::vector<std::uint32_t> order(example.positions.size()), place(order.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto& at = example.positions;
  tbb::parallel_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::tie(at[a].x, at[a].y, at[a].z, a) < std::tie(at[b].x, at[b].y, at[b].z, b);
  });
  for (std::size_t n = 0; n < order.size(); ++n) {
    const bool same = n > 0 && at[order[n]] == at[order[n - 1]];
    place[order[n]] = same ? place[order[n - 1]] : order[n];
  }
  Triangles joined = example.triangles;
  for (auto& corners : joined) {
    for (std::uint32_t& v : corners) v = place[v];
  }
  const std::vector<std::uint32_t> mates = mateHalfedges(joined, place.size());
  DisjointSets regions(joined.size());
  for (std::uint32_t h = 0; h < mates.size(); ++h) {
    if (mates[h] == kNone || mates[h] < h) continue;
    const std::uint32_t t = h / 3, u = mates[h] / 3;
    if (example.triangleMaterials[t] == example.triangleMaterials[u]) regions.join(t, u);
  }
  std::vector<double> areas(joined.size(), 0);
  double total = 0;
  for (std::uint32_t t = 0; t < joined.size(); ++t) {
    const double area = length(areaNormal(example, t)) / 2;
    areas[regions.find(t)] += area;
    total += area;
  }
  std::sort(areas.begin(), areas.end());
  double covered = 0;
  for (const double area : areas) {
    covered += area;
    if (covered >= total / 2) return std::sqrt(area) / voxelSize;
  }
  return 1;
}

/// Materials by pieces: what was copied in one motion and has one material keeps together, and
/// where pieces meet, the material changes only where at least one side has such a border itself.
/// Triangles that have no source (where a box cuts solid) take what is beside them.
///
/// `sources` come from matches within `kFarthestSource`; `own` is each triangle's material as
/// copied.
std::vector<std::uint32_t> materialsByPieces(const TriangleMesh& result,
                                             const std::vector<std::uint32_t>& mates,
                                             const OriginPullView& pull,
                                             const ExampleAttributes& attributes, double voxelSize,
                                             double width, const TriangleSources& sources,
                                             const std::vector<std::uint32_t>& own,
                                             const Progress& progress) {
  const auto count = static_cast<std::uint32_t>(result.triangles.size());
  const auto eachSide = [&](const auto& body) {  // between triangles that have a source
    for (std::uint32_t h = 0; h < mates.size(); ++h) {
      if (mates[h] == kNone || mates[h] < h) continue;
      const std::uint32_t t = h / 3, u = mates[h] / 3;
      if (own[t] != kNone && own[u] != kNone) body(h, t, u);
    }
  };
  const auto sameMotion = [&](std::uint32_t t, std::uint32_t u) {
    return sources.motion[t] == sources.motion[u];
  };
  DisjointSets piece(count);
  std::vector<std::uint32_t> between;  // halfedges between pieces
  eachSide([&](std::uint32_t, std::uint32_t t, std::uint32_t u) {
    if (own[t] == own[u] && sameMotion(t, u)) piece.join(t, u);
  });
  eachSide([&](std::uint32_t h, std::uint32_t t, std::uint32_t u) {
    if (piece.find(t) != piece.find(u)) between.push_back(h);
  });
  std::vector<MaterialPiece> pieces;
  std::vector<std::uint32_t> number(count, kNone);
  for (std::uint32_t t = 0; t < count; ++t) {
    if (own[t] == kNone) continue;
    const std::uint32_t root = piece.find(t);  // the lowest triangle: numbered first
    if (root == t) {
      number[t] = static_cast<std::uint32_t>(pieces.size());
      pieces.push_back({own[t], 0});
    }
    number[t] = number[root];
    // Giving half of a round region another material must pay where the border round it goes.
    pieces[number[t]].weight += kKeep / std::clamp(width, kNarrowest, kWidest) *
                                length(areaNormal(result, t)) / 2 / (voxelSize * voxelSize);
  }
  std::vector<MaterialJoint> joints(between.size());
  parallelFor(0, between.size(), kGrain, [&](std::size_t n0, std::size_t n1) {
    progress.check();
    for (std::size_t n = n0; n < n1; ++n) {
      const std::uint32_t h = between[n], t = h / 3, u = mates[h] / 3;
      const double side = length(result.positions[toVertex(result.triangles, h)] -
                                 result.positions[fromVertex(result.triangles, h)]) /
                          voxelSize;
      MaterialJoint& joint = joints[n] = {number[t], number[u], side, 0};
      if (sameMotion(t, u)) continue;  // the example's own border
      double smooth = kTrust, sum = kTrust;
      const auto ask = [&](std::uint32_t from, std::uint32_t to) {
        const auto match =
            pull.matchUnder(sources.motion[from], triangleMiddle(result, to),
                            normalized(areaNormal(result, to)), {}, 0, kFarthestSource);
        if (!match) return;  // no surface there: no evidence
        const double trust = std::exp(-match->cost * match->cost);
        sum += trust;
        const std::uint32_t there = attributes.triangle(*match);
        if (attributes.mesh->triangleMaterials[there] == own[from]) smooth += trust;
      };
      ask(t, u);
      ask(u, t);
      joint.cost = side * smooth / sum;
    }
  });
  const std::vector<std::uint32_t> settled = settleMaterials(pieces, joints);
  std::vector<std::uint32_t> materials(count, kNone), front, next;
  for (std::uint32_t t = 0; t < count; ++t) {
    if (number[t] == kNone) continue;
    materials[t] = settled[number[t]];
    front.push_back(t);
  }
  // Ring by ring into what has no source.
  while (!front.empty()) {
    next.clear();
    for (const std::uint32_t t : front) {
      for (int c = 0; c < 3; ++c) {
        const std::uint32_t h = mates[3 * t + c];
        if (h == kNone || materials[h / 3] != kNone) continue;
        materials[h / 3] = materials[t];
        next.push_back(h / 3);
      }
    }
    front.swap(next);
  }
  return materials;
}

}  // namespace

void transferPieceMaterials(TriangleMesh& result, const OriginPullView& pull,
                            const ExampleAttributes& attributes,
                            std::span<const ExampleView> examples, double voxelSize,
                            const TransferOptions& options, const TriangleSources& sources,
                            const Progress& progress) {
  const TriangleMesh& example = *attributes.mesh;
  const std::size_t count = result.triangles.size();
  progress.report(kStage, 0);
  const std::vector<std::uint32_t> mates = mateHalfedges(result.triangles, result.positions.size());
  std::vector<std::uint32_t> own(count, kNone);
  for (std::size_t t = 0; t < count; ++t) {
    if (sources.triangle[t] != kNone) own[t] = example.triangleMaterials[sources.triangle[t]];
  }
  result.triangleMaterials =
      materialsByPieces(result, mates, pull, attributes, voxelSize,
                        regionWidth(example, examples[0].field.voxelSize), sources, own, progress);
  progress.report(kStage, 0.6);
  // What lies far from every source: the nearest, however far.
  parallelFor(0, count, kGrain, [&](std::size_t t0, std::size_t t1) {
    progress.check();
    Matches matches;
    for (std::size_t t = t0; t < t1; ++t) {
      if (result.triangleMaterials[t] != kNone) continue;
      pull.match(triangleMiddle(result, t), normalized(areaNormal(result, t)), matches);
      const Match& chosen = chooseMatch(matches, attributes, true);
      result.triangleMaterials[t] = example.triangleMaterials[attributes.triangle(chosen)];
    }
  });
  if (options.cutBorders) {
    // A border is where the triangle's own motion says so; the example's material there is replaced
    // by what triangles around that came with it have now.
    const VertexCorners corners = vertexCorners(result.triangles, result.positions.size());
    const Triangles triangles = result.triangles;
    const std::vector<std::uint32_t> settled = result.triangleMaterials;
    const auto materialAt = [&](const Vec3d& point, const Vec3d& normal, std::uint32_t t) {
      if (own[t] == kNone) return settled[t];
      const auto match = pull.matchUnder(sources.motion[t], point, normal, {}, 0, kFarthestSource);
      if (!match) return settled[t];
      const std::uint32_t material = example.triangleMaterials[attributes.triangle(*match)];
      if (material == own[t]) return settled[t];
      for (const std::uint32_t v : triangles[t]) {
        for (const std::uint32_t corner : corners.at(v)) {
          const std::uint32_t u = corner / 3;
          if (own[u] == material && sources.motion[u] == sources.motion[t]) return settled[u];
        }
      }
      return settled[t];
    };
    cutMaterialBorders(result, materialAt, progress.part(0.7, 0.95));
  }
  cleanMaterialBorders(result, options.materialRounds);
}

}  // namespace exemplar
