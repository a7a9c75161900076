// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/surface/unrolled.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "core/cells.h"
#include "core/parallel.h"
#include "core/random.h"
#include "sdf/resample.h"
#include "synth/surface/local_map.h"

namespace exemplar::surface {
namespace {

/// Where a place of a map is in space, and which way is up there.
struct Lifted {
  Vec3d position, normal;
  bool there = false;
};

/// All places of a square grid around the map's middle, `perSample` to a sample.
std::vector<Lifted> lift(const Sheet& sheet, const LocalMap& map, int side, int perSample) {
  std::vector<Lifted> grid(static_cast<std::size_t>(side) * side);
  const int half = side / 2;
  for (std::uint32_t k = 0; k < map.nodes.size(); ++k) {
    for (const std::uint32_t t : sheet.trianglesAt(map.nodes[k])) {
      std::array<Vec2d, 3> at;
      bool whole = map.nodes[k] == *std::ranges::min_element(sheet.triangles[t]);
      for (int c = 0; c < 3 && whole; ++c) {
        const std::uint32_t n = map.find(sheet.triangles[t][c]);
        whole = n != LocalMap::kNowhere;
        if (whole) at[c] = map.at[n] * perSample;
      }
      if (!whole) continue;
      const Mat2d from{at[1].x - at[0].x, at[2].x - at[0].x, at[1].y - at[0].y, at[2].y - at[0].y};
      if (!(from.determinant() > 0)) continue;
      const Mat2d back = from.inverse();
      const auto low = [&](double a, double b, double c) {
        return std::max(-half, static_cast<int>(std::ceil(std::min({a, b, c}) - 1e-9)));
      };
      const auto high = [&](double a, double b, double c) {
        return std::min(half, static_cast<int>(std::floor(std::max({a, b, c}) + 1e-9)));
      };
      for (int j = low(at[0].y, at[1].y, at[2].y); j <= high(at[0].y, at[1].y, at[2].y); ++j) {
        for (int i = low(at[0].x, at[1].x, at[2].x); i <= high(at[0].x, at[1].x, at[2].x); ++i) {
          const Vec2d w = back * (Vec2d{static_cast<double>(i), static_cast<double>(j)} - at[0]);
          if (w.x < -1e-9 || w.y < -1e-9 || w.x + w.y > 1 + 1e-9) continue;
          Lifted& place = grid[static_cast<std::size_t>(j + half) * side + (i + half)];
          const std::array<double, 3> weights{1 - w.x - w.y, w.x, w.y};
          place = {};
          for (int c = 0; c < 3; ++c) {
            place.position += sheet.positions[sheet.triangles[t][c]] * weights[c];
            place.normal += sheet.normals[t][c] * weights[c];
          }
          place.normal = normalized(place.normal);
          place.there = true;
        }
      }
    }
  }
  return grid;
}

}  // namespace

Unrolled unroll(const Sheet& sheet, const DirectionField& directions,
                const std::vector<std::uint32_t>& dislocations, const DistanceField& field,
                const UnrollOptions& options, const Progress& progress) {
  const Coordinates coordinates = integrate(sheet, directions, {}, options.sample);
  // Of the circle around the square, and more where ways along edges are longest.
  const double radius = 0.85 * options.side;
  LocalMapOptions mapping;
  mapping.sample = options.sample;
  mapping.radius = mapping.leastRadius = radius;
  const LocalMapper mapper(sheet, coordinates, mapping);
  std::vector<std::uint8_t> broken(sheet.positions.size(), 0);
  for (std::uint32_t v = 0; v < broken.size(); ++v) broken[v] = sheet.atBorder[v];
  for (const Singularity& s : directions.singularities) broken[sheet.triangles[s.triangle][0]] = 1;
  for (const std::uint32_t t : dislocations) broken[sheet.triangles[t][0]] = 1;

  // Other draws than those of the synthesis.
  const int places = options.perSample * (options.side - 1) + 1;
  const Random random = Random(options.seed, stream::kSurfaceSeeds).fork(1);
  const auto nodes = static_cast<std::uint32_t>(sheet.positions.size());
  constexpr int kTries = 4;
  const auto tries = static_cast<std::size_t>(kTries) * options.patches;
  std::vector<Array3D<float>> made(tries);
  parallelFor(0, tries, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      progress.check();
      const LocalMap map = mapper.map(random.below(nodes, n));
      const double sample = options.sample * sheet.sizes[map.seed];
      if (std::ranges::any_of(map.nodes, [&](std::uint32_t v) { return broken[v]; })) continue;
      const std::vector<Lifted> grid = lift(sheet, map, places, options.perSample);
      if (!std::ranges::all_of(grid, &Lifted::there)) continue;
      Array3D<float> patch({places, places, options.layers});
      forEachCell(patch.size(), [&](const Vec3i& p) {
        const Lifted& place = grid[static_cast<std::size_t>(p.y) * places + p.x];
        const double up = (p.z - options.zero) * sample * options.height;
        patch[p] =
            static_cast<float>(sampleCubic(field, place.position + place.normal * up) / sample);
      });
      made[n] = std::move(patch);
    }
  });
  Unrolled result;
  result.perSample = options.perSample;
  std::size_t skipped = 0, tried = 0;
  for (Array3D<float>& patch : made) {
    if (static_cast<int>(result.patches.size()) == options.patches) break;
    ++tried;
    if (patch.empty()) {
      ++skipped;
    } else {
      result.patches.push_back(std::move(patch));
    }
  }
  result.skipped = tried == 0 ? 1 : static_cast<double>(skipped) / static_cast<double>(tried);
  return result;
}

}  // namespace exemplar::surface
