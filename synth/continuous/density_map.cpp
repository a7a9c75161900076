// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/continuous/density_map.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"

namespace exemplar::continuous {
namespace {

/// How far from a vertex the map is read, in lengths of the shortest side of its voxels.
constexpr double kStep = 0.05;
/// log2 of a factor at the map's ends, 0 and 1: choices are few, as most of a result follows from
/// them, so that each has to count.
constexpr float kMostLift = 6;

/// Unit vectors into each cell of a class.
std::vector<Vec3d> directionsOf(const Central& central) {
  std::vector<Vec3d> directions;
  for (const std::vector<std::uint32_t>& rays : central.raysOfCell) {
    Vec3d sum;
    for (const std::uint32_t r : rays) sum += normalized(cast<double>(central.rays[r].direction));
    directions.push_back(normalized(sum));
  }
  return directions;
}

}  // namespace

float DensityMap::at(const Vec3d& share) const {
  Vec3i voxel;
  for (int axis = 0; axis < 3; ++axis) {
    const double at = std::floor(share[axis] * size[axis]);
    voxel[axis] = static_cast<int>(std::clamp(at, 0.0, static_cast<double>(size[axis] - 1)));
  }
  return values[(static_cast<std::size_t>(voxel.z) * static_cast<std::size_t>(size.y) +
                 static_cast<std::size_t>(voxel.y)) *
                    static_cast<std::size_t>(size.x) +
                static_cast<std::size_t>(voxel.x)];
}

Guide applyDensityMap(const DensityMap& map, const ExactBox& box,
                      const std::optional<Ground>& ground, Puzzle& puzzle,
                      std::span<const std::uint32_t> vertices) {
  const Arrangement& a = puzzle.arrangement;
  const Vec3d low = cast<double>(box.low), size = cast<double>(box.size());
  double step = size.x;
  for (int axis = 0; axis < 3; ++axis) step = std::min(step, size[axis] / map.size[axis]);
  step *= kStep;
  std::vector<std::vector<Vec3d>> directions;
  for (const Central* central : a.kinds()) directions.push_back(directionsOf(*central));
  Guide guide{std::vector<float>(a.vertices()), std::vector<float>(puzzle.figures.size())};
  for (std::uint32_t f = 0; f < guide.built.size(); ++f) {
    const std::vector<Substance>& cells = puzzle.figures[f].substances;
    const auto built = std::ranges::count_if(
        cells, [&](Substance s) { return s != kAir && !(ground && s == ground->substance); });
    guide.built[f] = static_cast<float>(built) / static_cast<float>(cells.size());
  }
  parallelFor(0, vertices.size(), 256, [&](std::size_t first, std::size_t last) {
    for (std::size_t n = first; n < last; ++n) {
      const std::uint32_t v = vertices[n];
      const VertexClass& c = puzzle.classOf(v);
      const Vec3d p = a.point(v).approximately();
      float sum = 0;
      std::vector<std::uint8_t> forbidden(c.central->cells.size());
      for (std::size_t cell = 0; cell < forbidden.size(); ++cell) {
        const Vec3d q = p + directions[a.kind(v)][cell] * step;
        Vec3d share = q - low;
        for (int axis = 0; axis < 3; ++axis) share[axis] /= size[axis];
        const float value = map.at(share);
        sum += value;
        forbidden[cell] = value <= 0 && !(ground && q.z < static_cast<double>(ground->height));
      }
      guide.lift[v] = kMostLift * (2 * sum / static_cast<float>(c.central->cells.size()) - 1);
      for (std::size_t l = 0; l < c.labels(); ++l) {
        for (std::size_t cell = 0; cell < forbidden.size(); ++cell) {
          if (!forbidden[cell] || c.cells(l)[cell] == kAir) continue;
          takeOut(puzzle.domains[v], l);
          break;
        }
      }
    }
  });
  return guide;
}

}  // namespace exemplar::continuous
