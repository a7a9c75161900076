// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/random.h"
#include "mesh/primitives.h"
#include "sdf/distance_field.h"
#include "tests/sdf/shapes.h"

/// Meshes for the tests of distances, and what is asked of the fields made of them.
namespace exemplar::test {

/// A rotation about a random axis, and its inverse.
struct Rotation {
  Vec3d axis;
  double angle;

  explicit Rotation(int trial) {
    const Random random(17);
    axis = normalized(
        Vec3d{random.normal(trial, 0), random.normal(trial, 2), random.normal(trial, 4)});
    angle = random.uniform(0, 6.28, trial, 6);
  }
  Vec3d turn(const Vec3d& p, double by) const {
    return p * std::cos(by) + cross(axis, p) * std::sin(by) +
           axis * (dot(axis, p) * (1 - std::cos(by)));
  }
  Vec3d operator()(const Vec3d& p) const { return turn(p, angle); }
  Vec3d inverse(const Vec3d& p) const { return turn(p, -angle); }
};

template <class Move>
inline TriangleMesh moved(TriangleMesh mesh, const Move& move) {
  for (Vec3d& p : mesh.positions) p = move(p);
  return mesh;
}

inline TriangleMesh flipped(TriangleMesh mesh) {
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

inline TriangleMesh joined(TriangleMesh a, const TriangleMesh& b) {
  append(a, b);
  return a;
}

/// Every triangle with vertices of its own, as .stl files have them, and every third one turned
/// over.
inline TriangleMesh asSoup(const TriangleMesh& mesh) {
  TriangleMesh soup;
  for (const auto& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(soup.positions.size());
    for (const std::uint32_t v : t) soup.positions.push_back(mesh.positions[v]);
    soup.triangles.push_back({first, first + 1, first + 2});
    if (soup.triangles.size() % 3 == 0)
      std::swap(soup.triangles.back()[0], soup.triangles.back()[1]);
  }
  return soup;
}

/// A box without the two triangles of its top.
inline TriangleMesh openBox(const Box3d& box) {
  TriangleMesh mesh = makeBox(box);
  std::erase_if(mesh.triangles, [&](const auto& t) {
    for (const std::uint32_t v : t)
      if (mesh.positions[v].z != box.max.z) return false;
    return true;
  });
  return mesh;
}

inline int countInside(const DistanceField& field) {
  int count = 0;
  for (const float v : field.values.values()) count += v < 0;
  return count;
}

/// The numbers of connected parts (across faces) of the inside and of the outside.
inline std::pair<int, int> countParts(const DistanceField& field) {
  const auto& v = field.values;
  Array3D<std::uint8_t> seen(v.size());
  int parts[2] = {0, 0};
  std::vector<Vec3i> open;
  for (std::size_t s = 0; s < v.count(); ++s) {
    if (seen.values()[s]) continue;
    const bool inside = v.values()[s] < 0;
    ++parts[inside];
    open.assign(1, v.ijk(s));
    seen.values()[s] = 1;
    while (!open.empty()) {
      const Vec3i p = open.back();
      open.pop_back();
      for (int axis = 0; axis < 3; ++axis)
        for (const int step : {-1, 1}) {
          Vec3i q = p;
          q[axis] += step;
          if (!v.contains(q) || seen[q] || (v[q] < 0) != inside) continue;
          seen[q] = 1;
          open.push_back(q);
        }
    }
  }
  return {parts[1], parts[0]};
}

/// The largest change between neighbors, in voxels: a distance changes by 1 at most.
inline double steepest(const DistanceField& field) {
  const auto& v = field.values;
  double worst = 0;
  for (std::size_t s = 0; s < v.count(); ++s)
    for (int axis = 0; axis < 3; ++axis) {
      Vec3i b = v.ijk(s);
      if (++b[axis] >= v.size()[axis]) continue;
      worst = std::max(worst, std::abs(double{v[b]} - v.values()[s]));
    }
  return worst / field.voxelSize;
}

/// A small tessellated solid whose triangles are nearly on the ideal surface: the sphere's facets
/// lie up to e^2 / (6 r) inside it, here 0.0003, below a hundredth of the voxels used.
inline TriangleMesh fineSphere(const Vec3d& center = {}, double radius = 1) {
  return makeSphere(center, radius, 20);
}

}  // namespace exemplar::test
