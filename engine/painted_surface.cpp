// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/painted_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <utility>

#include "core/error.h"
#include "engine/words.h"

namespace exemplar {
namespace {

/// The channel of vertex colors that has a name, or -1.
int channelOf(const std::string& name) {
  constexpr std::array<const char*, 4> kChannels{"red", "green", "blue", "alpha"};
  const auto found = std::find(kChannels.begin(), kChannels.end(), name);
  return found == kChannels.end() ? -1 : static_cast<int>(found - kChannels.begin());
}

TriangleMesh ofMaterial(const TriangleMesh& mesh, std::size_t material) {
  TriangleMesh part;
  part.positions = mesh.positions;
  part.colors = mesh.colors;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (mesh.triangleMaterials[t] == material) part.triangles.push_back(mesh.triangles[t]);
  return part;
}

/// Where a channel of the vertex colors, linear between vertices, is at least `limit`.
TriangleMesh above(const TriangleMesh& mesh, std::size_t channel, float limit) {
  TriangleMesh part;
  part.positions = mesh.positions;
  part.colors = mesh.colors;
  const auto value = [&](std::uint32_t v) { return mesh.colors[v][channel]; };
  const auto between = [&](std::uint32_t a, std::uint32_t b) {
    // From the same end whichever triangle asks, also where vertices lie at equal positions.
    const auto key = [&](std::uint32_t v) {
      const Vec3d& p = mesh.positions[v];
      return std::tuple(p.x, p.y, p.z);
    };
    if (key(b) < key(a)) std::swap(a, b);
    const double share = (limit - value(a)) / (static_cast<double>(value(b)) - value(a));
    part.positions.push_back(mesh.positions[a] + (mesh.positions[b] - mesh.positions[a]) * share);
    std::array<float, 4> color = mesh.colors[a];
    for (std::size_t k = 0; k < color.size(); ++k)
      color[k] += static_cast<float>(share * (mesh.colors[b][k] - color[k]));
    part.colors.push_back(color);
    return static_cast<std::uint32_t>(part.positions.size() - 1);
  };
  for (const auto& triangle : mesh.triangles) {
    std::vector<std::uint32_t> corners;
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t a = triangle[c], b = triangle[(c + 1) % 3];
      const bool in = value(a) >= limit;
      if (in) corners.push_back(a);
      if (in != (value(b) >= limit)) corners.push_back(between(a, b));
    }
    for (std::size_t c = 2; c < corners.size(); ++c)
      part.triangles.push_back({corners[0], corners[c - 1], corners[c]});
  }
  return part;
}

}  // namespace

TriangleMesh coveredPart(const TriangleMesh& mesh, const std::string& cover,
                         const std::string& name) {
  const auto material = std::find_if(mesh.materials.begin(), mesh.materials.end(),
                                     [&](const Material& m) { return m.name == cover; }) -
                        mesh.materials.begin();
  const int channel = channelOf(cover);
  TriangleMesh part;
  if (mesh.hasMaterials() && material < static_cast<std::ptrdiff_t>(mesh.materials.size())) {
    part = ofMaterial(mesh, static_cast<std::size_t>(material));
  } else if (channel >= 0 && mesh.hasColors()) {
    constexpr float kHalf = 0.5f;
    part = above(mesh, static_cast<std::size_t>(channel), kHalf);
  } else {
    std::vector<std::string> known;
    if (mesh.hasMaterials())
      for (const Material& m : mesh.materials)
        if (!m.name.empty()) known.push_back("'" + m.name + "'");
    if (mesh.hasColors()) known.push_back("red, green, blue or alpha");
    throw InputError("`cover` " + cover + ": " + name +
                     (known.empty() ? " has neither named materials nor vertex colors"
                                    : " has " + joined(known, "and")));
  }
  if (part.triangles.empty())
    throw InputError("`cover` " + cover + ": nothing of " + name + " is in it");
  return part;
}

std::vector<double> paintedSizes(const TriangleMesh& mesh, const std::string& channel,
                                 const std::string& name) {
  const int k = channelOf(channel);
  if (k < 0) throw InputError("`size-map` " + channel + ": expected red, green, blue or alpha");
  if (!mesh.hasColors())
    throw InputError("`size-map` " + channel + ": " + name + " has no vertex colors");
  std::vector<double> sizes;
  for (const auto& color : mesh.colors)
    sizes.push_back(
        std::exp2(2.0 * std::clamp(color[static_cast<std::size_t>(k)], 0.0f, 1.0f) - 1));
  return sizes;
}

}  // namespace exemplar
