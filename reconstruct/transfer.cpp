// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/transfer.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/loop_progress.h"
#include "core/parallel.h"
#include "reconstruct/adjacency.h"
#include "reconstruct/piece_materials.h"
#include "reconstruct/pull.h"
#include "reconstruct/texture_charts.h"
#include "reconstruct/texture_transfer.h"
#include "reconstruct/triangle_sources.h"

namespace exemplar {
namespace {

constexpr std::size_t kGrain = 256;

/// What is to be done, decided from what the examples have.
struct Plan {
  bool colors = false;       // vertex colors, or textures baked into them
  bool bake = false;         // textures into vertex colors
  bool coordinates = false;  // texture coordinates
  bool materials = false;
  bool oneMaterial = true;  // the same for all triangles
};

/// Whether texture coordinates say anything: some files have the same one everywhere.
bool coordinatesVary(const TriangleMesh& mesh) {
  return std::any_of(mesh.uvs.begin(), mesh.uvs.end(), [&](const auto& corners) {
    return std::any_of(corners.begin(), corners.end(),
                       [&](const Vec2f& uv) { return !(uv == mesh.uvs.front().front()); });
  });
}

Plan makePlan(const TriangleMesh& example, TextureTransfer textures) {
  Plan plan;
  plan.materials = example.hasMaterials();
  for (const std::uint32_t m : example.triangleMaterials) {
    plan.oneMaterial = plan.oneMaterial && m == example.triangleMaterials.front();
  }
  const bool textured =
      example.hasUvs() && example.hasMaterials() &&
      std::any_of(example.triangleMaterials.begin(), example.triangleMaterials.end(),
                  [&](std::uint32_t m) { return example.materials[m].hasTextures(); });
  plan.coordinates =
      textures == TextureTransfer::Coordinates
          ? example.hasUvs()
          : textures == TextureTransfer::Automatic && (textured || coordinatesVary(example));
  plan.bake = textures == TextureTransfer::VertexColors && textured;
  plan.colors = example.hasColors() || plan.bake;
  return plan;
}

void transferColors(TriangleMesh& result, const std::vector<Vec3d>& normals,
                    const OriginPullView& pull, const ExampleAttributes& attributes, bool bake,
                    const Progress& progress) {
  std::optional<SurfaceColor> surfaceColor;
  if (bake) surfaceColor.emplace(*attributes.mesh);
  result.colors.assign(result.positions.size(), {1, 1, 1, 1});
  LoopProgress done(progress, "taking colors from the example", result.positions.size());
  parallelFor(0, result.positions.size(), kGrain, [&](std::size_t v0, std::size_t v1) {
    Matches matches;
    for (std::size_t v = v0; v < v1; ++v) {
      done.advance();
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

/// Takes the base color's textures from materials without texture coordinates. The other ones stay
/// with what the file said of them, unless textures are not wanted or baked.
void dropTextures(TriangleMesh& result, TextureTransfer textures) {
  bool any = false;
  for (Material& material : result.materials) {
    material.baseColorTexture.reset();
    material.baseColorTransform = {};
    if (textures != TextureTransfer::Automatic) {
      material.source.reset();
      material.pictures.clear();
    }
    any = any || material.hasTextures();
  }
  if (!any) result.textures.clear();
}

void check(const TransferOptions& options, std::span<const ExampleView> examples) {
  if (examples.empty()) throw InputError("no example is given to take materials from");
  for (const ExampleView& example : examples) validate(example.mesh, "example");
  if (options.materialRounds < 0 || options.materialRounds > 100) {
    throw InputError("`materialRounds` is " + std::to_string(options.materialRounds) +
                     "; it must be 0..100");
  }
}

}  // namespace

void transferAppearance(TriangleMesh& result, const DistanceField& field, const Origins& origins,
                        std::span<const ExampleView> examples, const TransferOptions& options,
                        const Progress& progress) {
  check(options, examples);
  const ExampleAttributes attributes(examples);
  const TriangleMesh& example = *attributes.mesh;
  const Plan plan = makePlan(example, options.textures);
  result.colors.clear();
  result.uvs.clear();
  result.triangleMaterials.clear();
  result.materials = plan.materials ? example.materials : std::vector<Material>{};
  result.textures = example.textures;
  result.sources.clear();
  if (!plan.coordinates) dropTextures(result, options.textures);
  if (!plan.colors && !plan.coordinates && !plan.materials && !options.sources) return;

  progress.report("preparing the example", 0);
  const OriginPullView pull(field, origins, examples, options.blend, options.map, progress);
  TriangleSources sources;
  const bool manyMaterials = plan.materials && !plan.oneMaterial;
  if (plan.coordinates || manyMaterials) {
    sources = matchTriangles(result, field, pull, attributes, manyMaterials, plan.coordinates,
                             progress.part(0.1, 0.3));
  }
  std::vector<std::uint32_t> charts;
  if (plan.coordinates) {
    charts = textureCharts(example);
    transferTriangleMaterials(result, pull, attributes, examples, charts, options,
                              progress.part(0.3, 0.5), sources);
  } else if (manyMaterials) {
    transferPieceMaterials(result, pull, attributes, examples, field.voxelSize, options, sources,
                           progress.part(0.3, 0.5));
  } else if (plan.materials) {
    result.triangleMaterials.assign(result.triangles.size(), example.triangleMaterials.front());
  }

  std::vector<Vec3d> normals =
      vertexNormals(result, vertexCorners(result.triangles, result.positions.size()));
  for (Vec3d& n : normals) n = normalized(n);
  if (plan.coordinates) {
    transferCoordinates(result, normals, pull, attributes, examples, charts, options.sources,
                        progress.part(0.5, 0.8), std::move(sources));
  } else if (options.sources) {
    transferSources(
        result, normals, pull,
        matchTriangles(result, field, pull, attributes, false, true, progress.part(0.5, 0.65)),
        attributes, progress.part(0.65, 0.8));
  }
  if (plan.colors) {
    transferColors(result, normals, pull, attributes, plan.bake, progress.part(0.8, 1));
    if (plan.bake) {
      // The materials' own colors are in the vertices' now.
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
