// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/texture_transfer.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "core/loop_progress.h"
#include "core/parallel.h"
#include "reconstruct/adjacency.h"
#include "reconstruct/material_borders.h"
#include "reconstruct/texture_charts.h"

namespace exemplar {
namespace {

constexpr std::size_t kGrain = 256;

/// What ends inside a triangle only where it is cut: charts that are large, and materials.
struct Regions {
  std::vector<std::uint32_t> of;     ///< of each triangle of the joined example
  std::vector<std::uint32_t> first;  ///< the first triangle of each

  Regions(const TriangleMesh& example, const std::vector<std::uint32_t>& charts,
          std::span<const ExampleView> examples)
      : of(example.triangles.size()) {
    // Side of a square that is as large as a chart, in voxels, from which on its borders are cut.
    constexpr double kLarge = 3;
    double voxel = 0;
    for (const ExampleView& view : examples) voxel = std::max(voxel, view.field.voxelSize);
    std::vector<double> area(example.triangles.size(), 0);
    for (std::size_t t = 0; t < charts.size(); ++t)
      area[charts[t]] += length(areaNormal(example, t)) / 2;
    // Those that are small are one region for each material.
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> numbers;
    for (std::uint32_t t = 0; t < of.size(); ++t) {
      const bool large = area[charts[t]] >= kLarge * kLarge * voxel * voxel;
      const std::pair key(large ? charts[t] : kNone,
                          example.hasMaterials() ? example.triangleMaterials[t] : 0);
      const auto [found, added] = numbers.emplace(key, static_cast<std::uint32_t>(numbers.size()));
      if (added) first.push_back(t);
      of[t] = found->second;
    }
  }
};

/// Triangles that are alone among neighbors from elsewhere join them where that fits as well:
/// each joint between copied parts is a jump in the texture, so joints should be short.
void joinNeighbors(const TriangleMesh& result, const std::vector<Vec3d>& triangleNormals,
                   const std::vector<std::uint32_t>& mates, const OriginPullView& pull,
                   const ExampleAttributes& attributes, const Progress& progress,
                   TriangleSources& sources) {
  constexpr int kRounds = 4;
  constexpr float kAllowance = 0.3f;  // voxels
  for (int round = 0; round < kRounds; ++round) {
    TriangleSources next = sources;
    parallelFor(0, result.triangles.size(), kGrain, [&](std::size_t t0, std::size_t t1) {
      progress.check();
      for (std::size_t t = t0; t < t1; ++t) {
        for (int c = 0; c < 3; ++c) {
          const std::uint32_t g = mates[3 * t + c], h = mates[3 * t + (c + 1) % 3];
          if (g == kNone || h == kNone) continue;
          const OriginMotion& there = sources.motion[g / 3];
          if (!(there == sources.motion[h / 3]) || there == sources.motion[t]) continue;
          const auto match = pull.matchUnder(there, triangleMiddle(result, t), triangleNormals[t]);
          if (!match || match->cost > sources.cost[t] + kAllowance) continue;
          const std::uint32_t triangle = attributes.triangle(*match);
          if (attributes.mesh->hasMaterials() &&
              attributes.mesh->triangleMaterials[triangle] !=
                  attributes.mesh->triangleMaterials[sources.triangle[t]]) {
            continue;
          }
          next.motion[t] = there;
          next.triangle[t] = triangle;
          next.cost[t] = static_cast<float>(match->cost);
          break;
        }
      }
    });
    sources = std::move(next);
  }
}

/// Where a corner came from; where its motion finds no place, the middle of its triangle's source.
SourcePoint sourcePoint(const std::optional<Match>& match, const TriangleSources& sources,
                        std::uint32_t t, const ExampleAttributes& attributes) {
  const std::uint32_t example = sources.motion[t].example;
  if (!match) return {sources.triangle[t] - attributes.first[example], example, {1 / 3.f, 1 / 3.f}};
  const auto& weights = match->point.weights;
  return {match->point.triangle,
          example,
          {static_cast<float>(weights[0]), static_cast<float>(weights[1])}};
}

/// Calls `take(corner, match)` for each corner (3 t + c), with the match of `matchAt(vertex, t)`;
/// corners of a vertex whose triangles have one motion and one chart share theirs. `charts` of the
/// example's triangles, or none.
template <class MatchAt, class Take>
void matchCorners(const TriangleMesh& result, const TriangleSources& sources,
                  const std::vector<std::uint32_t>& charts, const MatchAt& matchAt,
                  const Take& take, const char* stage, const Progress& progress) {
  const VertexCorners corners = vertexCorners(result.triangles, result.positions.size());
  LoopProgress done(progress, stage, result.positions.size());
  parallelFor(0, result.positions.size(), kGrain, [&](std::size_t v0, std::size_t v1) {
    struct Known {
      OriginMotion motion;
      std::uint32_t chart;
      std::optional<Match> match;
    };
    std::vector<Known> known;
    for (std::size_t v = v0; v < v1; ++v) {
      done.advance();
      known.clear();
      for (const std::uint32_t corner : corners.at(v)) {
        const std::uint32_t t = corner / 3;
        const std::uint32_t chart = charts.empty() ? 0 : charts[sources.triangle[t]];
        const OriginMotion& motion = sources.motion[t];
        auto found = std::find_if(known.begin(), known.end(), [&](const Known& k) {
          return k.chart == chart && k.motion == motion;
        });
        if (found == known.end()) {
          found =
              known.insert(known.end(), {motion, chart, matchAt(static_cast<std::uint32_t>(v), t)});
        }
        take(corner, found->match);
      }
    }
  });
}

}  // namespace

void transferTriangleMaterials(TriangleMesh& result, const OriginPullView& pull,
                               const ExampleAttributes& attributes,
                               std::span<const ExampleView> examples,
                               const std::vector<std::uint32_t>& charts,
                               const TransferOptions& options, const Progress& progress,
                               TriangleSources& sources) {
  progress.report("taking materials from the example", 0);
  const TriangleMesh& example = *attributes.mesh;
  const std::vector<std::uint32_t>& materials = example.triangleMaterials;
  const Regions regions(example, charts, examples);
  std::vector<std::uint32_t> region(result.triangles.size());
  for (std::size_t t = 0; t < region.size(); ++t) region[t] = regions.of[sources.triangle[t]];
  std::vector<std::uint32_t> parent;
  if (options.cutBorders) {
    const bool byMaterial = example.hasMaterials();
    const auto regionAt = [&](const Vec3d& point, const Vec3d& normal, std::uint32_t) {
      Matches matches;
      pull.match(point, normal, matches);
      return regions.of[attributes.triangle(chooseMatch(matches, attributes, byMaterial))];
    };
    parent = cutBorders(result, region, regionAt, progress.part(0, 0.7));
  } else {
    parent.resize(result.triangles.size());
    std::iota(parent.begin(), parent.end(), 0u);
  }
  result.triangleMaterials.clear();
  if (example.hasMaterials()) {
    for (const std::uint32_t r : region)
      result.triangleMaterials.push_back(materials[regions.first[r]]);
    cleanMaterialBorders(result, options.materialRounds);
  }
  const TriangleSources whole = std::move(sources);
  sources = {};
  sources.motion.resize(parent.size());
  sources.triangle.resize(parent.size());
  sources.cost.resize(parent.size());
  parallelFor(0, parent.size(), kGrain, [&](std::size_t t0, std::size_t t1) {
    progress.check();
    for (std::size_t t = t0; t < t1; ++t) {
      const std::uint32_t from = parent[t], source = whole.triangle[from];
      const OriginMotion& motion = whole.motion[from];
      sources.motion[t] = motion;
      sources.triangle[t] = source;
      sources.cost[t] = whole.cost[from];
      const bool cleaned = example.hasMaterials() &&
                           result.triangleMaterials[t] != materials[regions.first[region[t]]];
      const std::vector<std::uint32_t>& groups = cleaned ? materials : regions.of;
      const std::uint32_t group = cleaned ? result.triangleMaterials[t] : region[t];
      if (groups[source] == group) continue;
      const std::span<const std::uint32_t> those(groups.data() + attributes.first[motion.example],
                                                 examples[motion.example].mesh.triangles.size());
      const auto match = pull.matchUnder(motion, triangleMiddle(result, t),
                                         normalized(areaNormal(result, t)), those, group);
      if (match) {
        sources.triangle[t] = attributes.triangle(*match);
        sources.cost[t] = static_cast<float>(match->cost);
      } else if (example.hasMaterials()) {
        result.triangleMaterials[t] = materials[source];
      }
    }
  });
}

void transferCoordinates(TriangleMesh& result, const std::vector<Vec3d>& normals,
                         const OriginPullView& pull, const ExampleAttributes& attributes,
                         std::span<const ExampleView> examples,
                         const std::vector<std::uint32_t>& charts, bool keepSources,
                         const Progress& progress, TriangleSources sources) {
  constexpr const char* kStage = "taking texture coordinates from the example";
  progress.report(kStage, 0);
  std::vector<Vec3d> triangleNormals(result.triangles.size());
  for (std::size_t t = 0; t < triangleNormals.size(); ++t) {
    triangleNormals[t] = normalized(areaNormal(result, t));
  }
  joinNeighbors(result, triangleNormals, mateHalfedges(result.triangles, result.positions.size()),
                pull, attributes, progress, sources);
  progress.report(kStage, 0.5);
  const TriangleMesh& example = *attributes.mesh;
  result.uvs.assign(result.triangles.size(), {});
  if (keepSources) result.sources.assign(result.triangles.size(), {});
  const auto matchAt = [&](std::uint32_t v, std::uint32_t t) {
    const OriginMotion& motion = sources.motion[t];
    const std::span<const std::uint32_t> groups(charts.data() + attributes.first[motion.example],
                                                examples[motion.example].mesh.triangles.size());
    return pull.matchUnder(motion, result.positions[v], normals[v], groups,
                           charts[sources.triangle[t]]);
  };
  const auto take = [&](std::uint32_t corner, const std::optional<Match>& match) {
    const std::uint32_t t = corner / 3, c = corner % 3;
    if (match) {
      result.uvs[t][c] =
          textureCoordinates(example, attributes.triangle(*match), match->point.weights);
    }
    if (keepSources) result.sources[t][c] = sourcePoint(match, sources, t, attributes);
  };
  matchCorners(result, sources, charts, matchAt, take, kStage, progress.part(0.5, 1));
}

void transferSources(TriangleMesh& result, const std::vector<Vec3d>& normals,
                     const OriginPullView& pull, const TriangleSources& sources,
                     const ExampleAttributes& attributes, const Progress& progress) {
  result.sources.assign(result.triangles.size(), {});
  const auto matchAt = [&](std::uint32_t v, std::uint32_t t) {
    return pull.matchUnder(sources.motion[t], result.positions[v], normals[v]);
  };
  const auto take = [&](std::uint32_t corner, const std::optional<Match>& match) {
    result.sources[corner / 3][corner % 3] = sourcePoint(match, sources, corner / 3, attributes);
  };
  matchCorners(result, sources, {}, matchAt, take, "finding where the surface came from", progress);
}

}  // namespace exemplar
