// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/triangle_sources.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "reconstruct/adjacency.h"
#include "core/loop_progress.h"

namespace exemplar {
namespace {

constexpr std::size_t kGrain = 256;
/// `kFarthestSource` where the box cuts solid: inside, everything is far from the surface.
constexpr double kFarthestOfCut = 0.25;

/// Whether the triangle closes the surface where the field's box cuts solid.
bool isCut(const TriangleMesh& mesh, std::size_t t, const DistanceField& field) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double face : {-0.5, field.size()[axis] - 0.5}) {
      const auto inFace = [&](std::uint32_t v) {
        return std::abs(field.index(mesh.positions[v])[axis] - face) < 1e-6;
      };
      if (std::ranges::all_of(mesh.triangles[t], inFace)) return true;
    }
  }
  return false;
}

}  // namespace

const Match& chooseMatch(const Matches& matches, const ExampleAttributes& attributes,
                         bool byMaterial) {
  const Match* chosen = matches.begin();
  if (!byMaterial || matches.count < 2) return *chosen;
  const auto materialOf = [&](const Match& match) {
    return attributes.mesh->triangleMaterials[attributes.triangle(match)];
  };
  double most = -1;
  for (const Match& match : matches) {
    double weight = 0;
    for (const Match& other : matches) {
      if (materialOf(other) == materialOf(match)) weight += other.weight;
    }
    if (weight > most) {
      most = weight;
      chosen = &match;
    }
  }
  return *chosen;
}

TriangleSources matchTriangles(const TriangleMesh& result, const DistanceField& field,
                               const OriginPullView& pull, const ExampleAttributes& attributes,
                               bool byMaterial, bool anywhere, const Progress& progress) {
  const std::size_t count = result.triangles.size();
  TriangleSources sources;
  sources.motion.resize(count);
  sources.triangle.resize(count);
  sources.cost.resize(count);
  LoopProgress done(progress, "taking materials from the example", count);
  parallelFor(0, count, kGrain, [&](std::size_t t0, std::size_t t1) {
    Matches matches;
    for (std::size_t t = t0; t < t1; ++t) {
      done.advance();
      const double limit = anywhere                  ? OriginPullView::kAnywhere
                           : isCut(result, t, field) ? kFarthestOfCut
                                                     : kFarthestSource;
      pull.match(triangleMiddle(result, t), normalized(areaNormal(result, t)), matches, limit);
      sources.triangle[t] = kNone;
      sources.cost[t] = std::numeric_limits<float>::infinity();
      if (matches.count == 0) continue;
      const Match& chosen = chooseMatch(matches, attributes, byMaterial);
      if (chosen.cost > limit) continue;
      sources.motion[t] = chosen.motion;
      sources.triangle[t] = attributes.triangle(chosen);
      sources.cost[t] = static_cast<float>(chosen.cost);
    }
  });
  return sources;
}

}  // namespace exemplar
