// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/texture_transfer.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>

#include "core/parallel.h"
#include "reconstruct/adjacency.h"
#include "reconstruct/material_borders.h"
#include "reconstruct/texture_charts.h"
#include "core/loop_progress.h"

namespace exemplar {
namespace {

constexpr std::size_t kGrain = 256;

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

}  // namespace

void transferTriangleMaterials(TriangleMesh& result, const OriginPullView& pull,
                               const ExampleAttributes& attributes,
                               std::span<const ExampleView> examples,
                               const TransferOptions& options, const Progress& progress,
                               TriangleSources& sources) {
  progress.report("taking materials from the example", 0);
  const TriangleMesh& example = *attributes.mesh;
  result.triangleMaterials.resize(result.triangles.size());
  for (std::size_t t = 0; t < result.triangles.size(); ++t) {
    result.triangleMaterials[t] = example.triangleMaterials[sources.triangle[t]];
  }
  std::vector<std::uint32_t> parent;
  if (options.cutBorders) {
    const auto materialAt = [&](const Vec3d& point, const Vec3d& normal, std::uint32_t) {
      Matches matches;
      pull.match(point, normal, matches);
      return example.triangleMaterials[attributes.triangle(chooseMatch(matches, attributes, true))];
    };
    parent = cutMaterialBorders(result, materialAt, progress.part(0, 0.7));
  } else {
    parent.resize(result.triangles.size());
    std::iota(parent.begin(), parent.end(), 0u);
  }
  cleanMaterialBorders(result, options.materialRounds);
  const TriangleSources whole = sources;
  sources.motion.resize(parent.size());
  sources.triangle.resize(parent.size());
  sources.cost.resize(parent.size());
  parallelFor(0, parent.size(), kGrain, [&](std::size_t t0, std::size_t t1) {
    progress.check();
    for (std::size_t t = t0; t < t1; ++t) {
      const std::uint32_t from = parent[t];
      const OriginMotion& motion = whole.motion[from];
      sources.motion[t] = motion;
      sources.triangle[t] = whole.triangle[from];
      sources.cost[t] = whole.cost[from];
      if (result.triangleMaterials[t] == example.triangleMaterials[whole.triangle[from]]) continue;
      const std::span<const std::uint32_t> materials(
          example.triangleMaterials.data() + attributes.first[motion.example],
          examples[motion.example].mesh.triangles.size());
      const auto match =
          pull.matchUnder(motion, triangleMiddle(result, t), normalized(areaNormal(result, t)),
                          materials, result.triangleMaterials[t]);
      if (match) {
        sources.triangle[t] = attributes.triangle(*match);
        sources.cost[t] = static_cast<float>(match->cost);
      } else {
        result.triangleMaterials[t] = example.triangleMaterials[whole.triangle[from]];
      }
    }
  });
}

void transferCoordinates(TriangleMesh& result, const std::vector<Vec3d>& normals,
                         const OriginPullView& pull, const ExampleAttributes& attributes,
                         std::span<const ExampleView> examples, const Progress& progress,
                         TriangleSources sources) {
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
  const std::vector<std::uint32_t> charts = textureCharts(example);
  const VertexCorners corners = vertexCorners(result.triangles, result.positions.size());
  result.uvs.assign(result.triangles.size(), {});
  LoopProgress done(progress.part(0.5, 1), kStage, result.positions.size());
  parallelFor(0, result.positions.size(), kGrain, [&](std::size_t v0, std::size_t v1) {
    struct Known {
      OriginMotion motion;
      std::uint32_t chart;
      Vec2f uv;
    };
    std::vector<Known> known;
    for (std::size_t v = v0; v < v1; ++v) {
      done.advance();
      known.clear();
      for (const std::uint32_t corner : corners.at(v)) {
        const std::uint32_t t = corner / 3, chart = charts[sources.triangle[t]];
        const OriginMotion& motion = sources.motion[t];
        auto found = std::find_if(known.begin(), known.end(), [&](const Known& k) {
          return k.chart == chart && k.motion == motion;
        });
        if (found == known.end()) {
          const std::span<const std::uint32_t> groups(
              charts.data() + attributes.first[motion.example],
              examples[motion.example].mesh.triangles.size());
          const auto match =
              pull.matchUnder(motion, result.positions[v], normals[v], groups, chart);
          const Vec2f uv =
              match ? textureCoordinates(example, attributes.triangle(*match), match->point.weights)
                    : Vec2f{};
          found = known.insert(known.end(), {motion, chart, uv});
        }
        result.uvs[t][corner % 3] = found->uv;
      }
    }
  });
}

}  // namespace exemplar
