// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/texture_charts.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/disjoint_sets.h"
#include "mesh/color.h"
#include "reconstruct/adjacency.h"

namespace exemplar {
namespace {

/// A corner as charts see it: two corners are the same where place and texture coordinates are.
struct ChartCorner {
  Vec3d position;
  Vec2f uv;
  std::uint32_t material, corner;

  auto key() const { return std::tie(position.x, position.y, position.z, uv.x, uv.y, material); }
};

/// Texel indices on both sides of a coordinate, repeating, and how far towards the second.
struct Between {
  int first, second;
  float share;
};

Between between(float t, int size) {
  const float place = (t - std::floor(t)) * static_cast<float>(size) - 0.5f;
  const int below = static_cast<int>(std::floor(place));
  return {(below + size) % size, (below + 1) % size, place - static_cast<float>(below)};
}

std::array<float, 4> texel(const Image8& image, int x, int y) {
  const std::uint8_t* p = image.at(x, y);
  const auto opacity = [&](int channel) { return static_cast<float>(p[channel]) / 255; };
  if (image.channels < 3) {
    const float gray = srgb8ToLinear(p[0]);
    return {gray, gray, gray, image.channels == 2 ? opacity(1) : 1.0f};
  }
  return {srgb8ToLinear(p[0]), srgb8ToLinear(p[1]), srgb8ToLinear(p[2]),
          image.channels == 4 ? opacity(3) : 1.0f};
}

}  // namespace

std::vector<std::uint32_t> textureCharts(const TriangleMesh& mesh) {
  const auto corners = static_cast<std::uint32_t>(3 * mesh.triangles.size());
  std::vector<ChartCorner> sorted(corners);
  for (std::uint32_t c = 0; c < corners; ++c) {
    sorted[c] = {mesh.positions[mesh.triangles[c / 3][c % 3]], mesh.uvs[c / 3][c % 3],
                 mesh.hasMaterials() ? mesh.triangleMaterials[c / 3] : 0, c};
  }
  std::sort(sorted.begin(), sorted.end(), [](const ChartCorner& a, const ChartCorner& b) {
    return std::tuple(a.key(), a.corner) < std::tuple(b.key(), b.corner);
  });
  Triangles chartTriangles(mesh.triangles.size());
  std::uint32_t vertices = 0;
  for (std::uint32_t n = 0; n < corners; ++n) {
    if (n > 0 && sorted[n].key() != sorted[n - 1].key()) ++vertices;
    chartTriangles[sorted[n].corner / 3][sorted[n].corner % 3] = vertices;
  }
  if (corners > 0) ++vertices;

  const EdgeGroups edges = edgeGroups(chartTriangles, vertices);
  DisjointSets charts(mesh.triangles.size());
  for (std::size_t e = 0; e < edges.count(); ++e) {
    const auto group = edges.group(e);
    for (const std::uint32_t h : group) charts.join(group[0] / 3, h / 3);
  }
  return charts.numbered();
}

Vec2f textureCoordinates(const TriangleMesh& mesh, std::uint32_t triangle,
                         const std::array<double, 3>& weights) {
  double x = 0, y = 0;
  for (int c = 0; c < 3; ++c) {
    x += weights[c] * mesh.uvs[triangle][c].x;
    y += weights[c] * mesh.uvs[triangle][c].y;
  }
  return {static_cast<float>(x), static_cast<float>(y)};
}

std::array<float, 4> vertexColor(const TriangleMesh& mesh, std::uint32_t triangle,
                                 const std::array<double, 3>& weights) {
  if (!mesh.hasColors()) return {1, 1, 1, 1};
  std::array<float, 4> color;
  for (int k = 0; k < 4; ++k) {
    double sum = 0;
    for (int c = 0; c < 3; ++c) sum += weights[c] * mesh.colors[mesh.triangles[triangle][c]][k];
    color[k] = static_cast<float>(sum);
  }
  return color;
}

SurfaceColor::SurfaceColor(const TriangleMesh& mesh) : mesh_(mesh), images_(mesh.textures.size()) {
  if (!mesh.hasUvs()) return;
  for (const Material& material : mesh.materials) {
    if (!material.baseColorTexture) continue;
    const std::uint32_t t = *material.baseColorTexture;
    if (images_[t].pixels.empty()) {
      images_[t] = decodeImage(mesh.textures[t].bytes, mesh.textures[t].name);
    }
  }
}

std::array<float, 4> SurfaceColor::at(std::uint32_t triangle,
                                      const std::array<double, 3>& weights) const {
  std::array<float, 4> color = vertexColor(mesh_, triangle, weights);
  if (!mesh_.hasMaterials()) return color;
  const Material& material = mesh_.materials[mesh_.triangleMaterials[triangle]];
  for (int k = 0; k < 4; ++k) color[k] *= material.baseColor[k];
  if (!material.baseColorTexture || !mesh_.hasUvs()) return color;

  const Image8& image = images_[*material.baseColorTexture];
  const Vec2f uv = material.baseColorTransform.apply(textureCoordinates(mesh_, triangle, weights));
  const Between x = between(uv.x, image.width);
  const Between y = between(-uv.y, image.height);  // rows come from the top
  const auto t00 = texel(image, x.first, y.first), t10 = texel(image, x.second, y.first);
  const auto t01 = texel(image, x.first, y.second), t11 = texel(image, x.second, y.second);
  for (int k = 0; k < 4; ++k) {
    const float upper = t00[k] * (1 - x.share) + t10[k] * x.share;
    const float lower = t01[k] * (1 - x.share) + t11[k] * x.share;
    color[k] *= upper * (1 - y.share) + lower * y.share;
  }
  return color;
}

}  // namespace exemplar
