// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/progress.h"
#include "mesh/triangle_mesh.h"
#include "reconstruct/pull.h"
#include "reconstruct/transfer.h"
#include "sdf/distance_field.h"

namespace exemplar {

/// All examples' triangles as one mesh, so that each attribute has one list: triangle t of example
/// e is `first[e]` + t.
struct ExampleAttributes {
  TriangleMesh joined;  // used for several examples only
  const TriangleMesh* mesh = nullptr;
  std::vector<std::uint32_t> first;

  explicit ExampleAttributes(std::span<const ExampleView> examples) {
    std::uint32_t count = 0;
    for (const ExampleView& example : examples) {
      first.push_back(count);
      count += static_cast<std::uint32_t>(example.mesh.triangles.size());
      if (examples.size() > 1) append(joined, example.mesh);
    }
    mesh = examples.size() > 1 ? &joined : &examples[0].mesh;
  }

  std::uint32_t triangle(const Match& match) const {
    return first[match.motion.example] + match.point.triangle;
  }
};

/// The best match of each triangle's middle.
struct TriangleSources {
  std::vector<OriginMotion> motion;
  std::vector<std::uint32_t> triangle;  // of the joined example
  std::vector<float> cost;              // voxels; infinity: no match, and no triangle
};

/// The heaviest match; by material, the heaviest of those of the material with most weight. There
/// is at least one match.
const Match& chooseMatch(const Matches& matches, const ExampleAttributes& attributes,
                         bool byMaterial);

/// Matches farther than this, in voxels, are not where a triangle came from.
inline constexpr double kFarthestSource = 0.75;

/// Where each triangle of `result`, the surface of `field`, came from. `anywhere`: matches however
/// far away; else only those within `kFarthestSource`. The same bytes at any number of threads.
/// Throws `Cancelled`.
TriangleSources matchTriangles(const TriangleMesh& result, const DistanceField& field,
                               const OriginPullView& pull, const ExampleAttributes& attributes,
                               bool byMaterial, bool anywhere, const Progress& progress);

}  // namespace exemplar
