// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/continuous/stand_ins.h"

#include <algorithm>
#include <map>

#include "core/disjoint_sets.h"

namespace exemplar::continuous {

std::vector<PlacedStandIn> takeStandIns(PolygonModel& model, std::span<const StandIn> standIns) {
  constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::vector<std::size_t> standInOf(model.substances.size(), kNone);
  for (std::size_t s = 0; s < standIns.size(); ++s)
    for (const Substance half : standIns[s].halves) standInOf[half] = s;
  // Corners of one stand-in's faces hang together where a face has them.
  std::vector<DisjointSets> corners(standIns.size(), DisjointSets(model.points.size()));
  const auto forEachSide = [&](const Polygon& polygon, auto&& body) {
    const std::size_t below = standInOf[polygon.below], above = standInOf[polygon.above];
    if (below != kNone) body(below);
    if (above != kNone && above != below) body(above);
  };
  for (const Polygon& polygon : model.polygons) {
    forEachSide(polygon, [&](std::size_t s) {
      for (const auto& loop : polygon.loops)
        for (const std::uint32_t p : loop) corners[s].join(polygon.loops[0][0], p);
    });
  }
  std::map<std::pair<std::size_t, std::uint32_t>, std::size_t> numbers;
  std::vector<PlacedStandIn> placed;
  for (Polygon& polygon : model.polygons) {
    forEachSide(polygon, [&](std::size_t s) {
      const auto [entry, isNew] =
          numbers.emplace(std::pair(s, corners[s].find(polygon.loops[0][0])), placed.size());
      if (isNew) placed.push_back({s, {}});
      for (const auto& loop : polygon.loops)
        for (const std::uint32_t p : loop)
          placed[entry->second].box.add(model.toWorld(model.points[p]));
    });
    if (standInOf[polygon.below] != kNone) polygon.below = kAir;
    if (standInOf[polygon.above] != kNone) polygon.above = kAir;
  }
  std::erase_if(model.polygons, [](const Polygon& p) { return p.below == p.above; });
  return placed;
}

TriangleMesh stretched(const TriangleMesh& mesh, const Box3d& to) {
  TriangleMesh made = mesh;
  const Box3d from = boundingBox(mesh);
  for (Vec3d& p : made.positions) {
    for (int axis = 0; axis < 3; ++axis) {
      const double side = from.size()[axis];
      const double share = side > 0 ? (p[axis] - from.min[axis]) / side : 0.5;
      p[axis] = to.min[axis] + share * to.size()[axis];
    }
  }
  return made;
}

}  // namespace exemplar::continuous
