// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/transfer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/parallel.h"
#include "reconstruct/adjacency.h"
#include "reconstruct/material_borders.h"
#include "reconstruct/pull.h"
#include "reconstruct/texture_charts.h"

namespace exemplar {
namespace {

constexpr std::size_t kGrain = 256;

/// All examples' triangles as one mesh, so that each attribute has one list: triangle t of example
/// e is `first[e]` + t.
struct Attributes {
  TriangleMesh joined;  // used for several examples only
  const TriangleMesh* mesh = nullptr;
  std::vector<std::uint32_t> first;

  explicit Attributes(std::span<const ExampleView> examples) {
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

/// What is to be done, decided from what the examples have.
struct Plan {
  bool colors = false;       // vertex colours, or textures baked into them
  bool bake = false;         // textures into vertex colours
  bool coordinates = false;  // texture coordinates
  bool materials = false;
  bool oneMaterial = true;  // the same for all triangles
};

Plan makePlan(const TriangleMesh& example, TextureTransfer textures) {
  Plan plan;
  plan.materials = example.hasMaterials();
  for (const std::uint32_t m : example.triangleMaterials) {
    plan.oneMaterial = plan.oneMaterial && m == example.triangleMaterials.front();
  }
  const bool textured =
      example.hasUvs() && example.hasMaterials() &&
      std::any_of(example.triangleMaterials.begin(), example.triangleMaterials.end(),
                  [&](std::uint32_t m) { return example.materials[m].baseColorTexture; });
  plan.coordinates = textures == TextureTransfer::Coordinates
                         ? example.hasUvs()
                         : textures == TextureTransfer::Automatic && textured;
  plan.bake = textures == TextureTransfer::VertexColors && textured;
  plan.colors = example.hasColors() || plan.bake;
  return plan;
}

/// The best match of each triangle's middle.
struct TriangleSources {
  std::vector<OriginMotion> motion;
  std::vector<std::uint32_t> triangle;  // of the joined example
  std::vector<float> cost;              // voxels
};

/// The heaviest match; by material, the heaviest of those of the material with most weight.
const Match& chooseMatch(const Matches& matches, const Attributes& attributes, bool byMaterial) {
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

Vec3d middleOf(const TriangleMesh& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return (mesh.positions[a] + mesh.positions[b] + mesh.positions[c]) / 3.0;
}

TriangleSources matchTriangles(const TriangleMesh& result, const OriginPullView& pull,
                               const Attributes& attributes, bool byMaterial) {
  const std::size_t count = result.triangles.size();
  TriangleSources sources;
  sources.motion.resize(count);
  sources.triangle.resize(count);
  sources.cost.resize(count);
  parallelFor(0, count, kGrain, [&](std::size_t t0, std::size_t t1) {
    Matches matches;
    for (std::size_t t = t0; t < t1; ++t) {
      pull.match(middleOf(result, t), normalized(areaNormal(result, t)), matches);
      const Match& chosen = chooseMatch(matches, attributes, byMaterial);
      sources.motion[t] = chosen.motion;
      sources.triangle[t] = attributes.triangle(chosen);
      sources.cost[t] = static_cast<float>(chosen.cost);
    }
  });
  return sources;
}

/// Materials for every triangle, with borders where the example has them. `sources` follow: a piece
/// of a cut triangle comes from where its triangle did, but from a triangle of its material.
void transferMaterials(TriangleMesh& result, const OriginPullView& pull,
                       const Attributes& attributes, std::span<const ExampleView> examples,
                       const TransferOptions& options, bool needSources, TriangleSources& sources) {
  const TriangleMesh& example = *attributes.mesh;
  result.triangleMaterials.resize(result.triangles.size());
  for (std::size_t t = 0; t < result.triangles.size(); ++t) {
    result.triangleMaterials[t] = example.triangleMaterials[sources.triangle[t]];
  }
  std::vector<std::uint32_t> parent;
  if (options.cutBorders) {
    parent = cutMaterialBorders(result, [&](const Vec3d& point, const Vec3d& normal) {
      Matches matches;
      pull.match(point, normal, matches);
      return example.triangleMaterials[attributes.triangle(chooseMatch(matches, attributes, true))];
    });
  } else {
    parent.resize(result.triangles.size());
    std::iota(parent.begin(), parent.end(), 0u);
  }
  cleanMaterialBorders(result, options.materialRounds);
  if (!needSources) return;

  const TriangleSources whole = sources;
  sources.motion.resize(parent.size());
  sources.triangle.resize(parent.size());
  sources.cost.resize(parent.size());
  parallelFor(0, parent.size(), kGrain, [&](std::size_t t0, std::size_t t1) {
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
          pull.matchUnder(motion, middleOf(result, t), normalized(areaNormal(result, t)), materials,
                          result.triangleMaterials[t]);
      if (match) {
        sources.triangle[t] = attributes.triangle(*match);
        sources.cost[t] = static_cast<float>(match->cost);
      } else {
        result.triangleMaterials[t] = example.triangleMaterials[whole.triangle[from]];
      }
    }
  });
}

void transferColors(TriangleMesh& result, const std::vector<Vec3d>& normals,
                    const OriginPullView& pull, const Attributes& attributes, bool bake) {
  std::optional<SurfaceColor> surfaceColor;
  if (bake) surfaceColor.emplace(*attributes.mesh);
  result.colors.assign(result.positions.size(), {1, 1, 1, 1});
  parallelFor(0, result.positions.size(), kGrain, [&](std::size_t v0, std::size_t v1) {
    Matches matches;
    for (std::size_t v = v0; v < v1; ++v) {
      pull.match(result.positions[v], normals[v], matches);
      std::array<double, 4> sum{};
      for (const Match& match : matches) {
        const std::uint32_t t = attributes.triangle(match);
        const std::array<float, 4> color =
            bake ? surfaceColor->at(t, match.point.weights)
                 : vertexColor(*attributes.mesh, t, match.point.weights);
        for (int k = 0; k < 4; ++k) sum[k] += match.weight * color[k];
      }
      for (int k = 0; k < 4; ++k) {
        result.colors[v][k] = static_cast<float>(std::clamp(sum[k], 0.0, 1.0));
      }
    }
  });
}

/// Triangles that stand alone among neighbours from elsewhere join them where that fits as well:
/// each joint between copied parts is a jump in the texture, so joints should be short.
void joinNeighbours(const TriangleMesh& result, const std::vector<Vec3d>& triangleNormals,
                    const std::vector<std::uint32_t>& mates, const OriginPullView& pull,
                    const Attributes& attributes, TriangleSources& sources) {
  constexpr int kRounds = 4;
  constexpr float kAllowance = 0.3f;  // voxels
  for (int round = 0; round < kRounds; ++round) {
    TriangleSources next = sources;
    parallelFor(0, result.triangles.size(), kGrain, [&](std::size_t t0, std::size_t t1) {
      for (std::size_t t = t0; t < t1; ++t) {
        for (int c = 0; c < 3; ++c) {
          const std::uint32_t g = mates[3 * t + c], h = mates[3 * t + (c + 1) % 3];
          if (g == kNone || h == kNone) continue;
          const OriginMotion& there = sources.motion[g / 3];
          if (!(there == sources.motion[h / 3]) || there == sources.motion[t]) continue;
          const auto match = pull.matchUnder(there, middleOf(result, t), triangleNormals[t]);
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

/// Each corner's texture coordinates, looked up where the triangle's motion takes it but inside the
/// chart of the triangle's middle.
void transferCoordinates(TriangleMesh& result, const std::vector<Vec3d>& normals,
                         const OriginPullView& pull, const Attributes& attributes,
                         std::span<const ExampleView> examples, const TriangleSources& sources) {
  const TriangleMesh& example = *attributes.mesh;
  const std::vector<std::uint32_t> charts = textureCharts(example);
  const VertexCorners corners = vertexCorners(result.triangles, result.positions.size());
  result.uvs.assign(result.triangles.size(), {});
  parallelFor(0, result.positions.size(), kGrain, [&](std::size_t v0, std::size_t v1) {
    struct Known {
      OriginMotion motion;
      std::uint32_t chart;
      Vec2f uv;
    };
    std::vector<Known> known;
    for (std::size_t v = v0; v < v1; ++v) {
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

void check(const TransferOptions& options, std::span<const ExampleView> examples) {
  if (examples.empty()) throw InputError("no example is given to take materials from");
  for (const ExampleView& example : examples) validate(example.mesh, "example");
  if (options.materialRounds < 0 || options.materialRounds > 100) {
    throw InputError("material rounds: " + std::to_string(options.materialRounds) +
                     " is out of range; 0 to 100 is right");
  }
}

}  // namespace

void transferAppearance(TriangleMesh& result, const DistanceField& field, const Origins& origins,
                        std::span<const ExampleView> examples, const TransferOptions& options,
                        const Progress& progress) {
  check(options, examples);
  const Attributes attributes(examples);
  const TriangleMesh& example = *attributes.mesh;
  const Plan plan = makePlan(example, options.textures);
  result.colors.clear();
  result.uvs.clear();
  result.triangleMaterials.clear();
  result.materials = plan.materials ? example.materials : std::vector<Material>{};
  result.textures = plan.coordinates ? example.textures : std::vector<Texture>{};
  if (!plan.coordinates) {
    for (Material& material : result.materials) material.baseColorTexture.reset();
  }
  if (!plan.colors && !plan.coordinates && !plan.materials) return;

  const OriginPullView pull(field, origins, examples, options.blend);
  TriangleSources sources;
  const bool manyMaterials = plan.materials && !plan.oneMaterial;
  if (plan.coordinates || manyMaterials) {
    progress.report("taking materials from the example", 0);
    sources = matchTriangles(result, pull, attributes, manyMaterials);
  }
  if (manyMaterials) {
    transferMaterials(result, pull, attributes, examples, options, plan.coordinates, sources);
  } else if (plan.materials) {
    result.triangleMaterials.assign(result.triangles.size(), example.triangleMaterials.front());
  }

  std::vector<Vec3d> normals =
      vertexNormals(result, vertexCorners(result.triangles, result.positions.size()));
  for (Vec3d& n : normals) n = normalized(n);
  if (plan.coordinates) {
    progress.report("taking texture coordinates from the example", 0.4);
    std::vector<Vec3d> triangleNormals(result.triangles.size());
    for (std::size_t t = 0; t < triangleNormals.size(); ++t) {
      triangleNormals[t] = normalized(areaNormal(result, t));
    }
    joinNeighbours(result, triangleNormals,
                   mateHalfedges(result.triangles, result.positions.size()), pull, attributes,
                   sources);
    transferCoordinates(result, normals, pull, attributes, examples, sources);
  }
  if (plan.colors) {
    progress.report("taking colours from the example", 0.7);
    transferColors(result, normals, pull, attributes, plan.bake);
    if (plan.bake) {
      // The materials' own colours are in the vertices' now.
      for (Material& material : result.materials) material.baseColor = {1, 1, 1, 1};
    }
  }
  progress.report("appearance taken from the example", 1);
}

void transferAppearance(TriangleMesh& result, const DistanceField& field, const Origins& origins,
                        const TriangleMesh& example, const DistanceField& exampleField,
                        const TransferOptions& options, const Progress& progress) {
  const ExampleView view{example, exampleField};
  transferAppearance(result, field, origins, std::span(&view, 1), options, progress);
}

}  // namespace exemplar
