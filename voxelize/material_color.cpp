// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "voxelize/material_color.h"

#include <algorithm>

#include "core/error.h"
#include "mesh/color.h"
#include "mesh/image.h"

namespace exemplar {
namespace {

/// The mean of what is seen of a picture, linear.
std::array<double, 3> meanColor(const Texture& texture) {
  Image8 image;
  try {
    image = decodeImage(texture.bytes, texture.name);
  } catch (const InputError&) {
    return {1, 1, 1};  // shown without its texture, as everywhere
  }
  std::array<double, 256> linear;
  for (int v = 0; v < 256; ++v) linear[v] = srgb8ToLinear(static_cast<std::uint8_t>(v));
  std::array<double, 3> sum{};
  double weight = 0;
  const std::size_t step = static_cast<std::size_t>(image.channels);
  for (std::size_t n = 0; n + step <= image.pixels.size(); n += step) {
    const std::uint8_t* p = &image.pixels[n];
    const double seen = image.channels == 4 ? p[3] : image.channels == 2 ? p[1] : 255;
    for (int c = 0; c < 3; ++c) sum[c] += seen * linear[p[image.channels < 3 ? 0 : c]];
    weight += seen;
  }
  if (weight == 0) return {1, 1, 1};
  for (double& c : sum) c /= weight;
  return sum;
}

}  // namespace

std::vector<std::array<float, 4>> materialColors(const TriangleMesh& mesh) {
  if (!mesh.hasMaterials()) return {Material{}.baseColor};
  std::vector<std::array<double, 3>> means(mesh.textures.size(), {1, 1, 1});
  std::vector<bool> isMean(mesh.textures.size(), false);
  for (const Material& material : mesh.materials) {
    if (!material.baseColorTexture || isMean[*material.baseColorTexture]) continue;
    means[*material.baseColorTexture] = meanColor(mesh.textures[*material.baseColorTexture]);
    isMean[*material.baseColorTexture] = true;
  }
  std::vector<std::array<float, 4>> colors;
  for (const Material& material : mesh.materials) {
    auto& color = colors.emplace_back(material.baseColor);
    for (int c = 0; c < 3 && material.baseColorTexture; ++c) {
      color[c] *= static_cast<float>(means[*material.baseColorTexture][c]);
    }
    for (float& c : color) c = std::clamp(c, 0.0f, 1.0f);
  }
  return colors;
}

}  // namespace exemplar
