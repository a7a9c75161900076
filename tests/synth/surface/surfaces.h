// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>

#include "mesh/primitives.h"
#include "mesh/procedural/processes.h"
#include "mesh/triangle_mesh.h"
#include "reconstruct/field_to_mesh.h"
#include "sdf/distance_field.h"
#include "sdf/mesh_to_sdf.h"

/// Surfaces to lay examples on, and examples to lay on them.
namespace exemplar::surface {

/// A sheet of cells, bent by `place` from (column, row).
template <class Place>
TriangleMesh gridMesh(int columns, int rows, bool around, const Place& place) {
  TriangleMesh mesh;
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i < columns + !around; ++i) mesh.positions.push_back(place(i, j));
  const int n = columns + !around;
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(j * n + i % n); };
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

/// In the plane z = 0, normals up.
inline TriangleMesh planeMesh(double side, int cells) {
  return gridMesh(cells, cells, false, [&](int i, int j) {
    return Vec3d{side * i / cells, side * j / cells, 0};
  });
}

/// Around z, normals outward, open at both ends.
inline TriangleMesh cylinderMesh(double radius, double height, int around, int along) {
  return gridMesh(around, along, true, [&](int i, int j) {
    const double angle = 2 * std::numbers::pi * i / around;
    return Vec3d{radius * std::cos(angle), radius * std::sin(angle), height * j / along};
  });
}

/// A plane with a fold that is tighter than what is laid on it.
inline TriangleMesh foldedMesh(double side, int cells) {
  return gridMesh(cells, cells, false, [&](int i, int j) {
    const double x = side * i / cells - side / 2;
    return Vec3d{x * 0.6, side * j / cells, 0.8 * std::abs(x)};
  });
}

/// The zero set of a function in a box.
inline TriangleMesh implicitMesh(const Box3d& box, double voxel,
                                 const std::function<double(const Vec3d&)>& distance) {
  DistanceField field;
  field.voxelSize = voxel;
  field.origin = box.min;
  field.values = Array3D<float>(cast<int>(box.size() / voxel) + Vec3i{1, 1, 1});
  field.truncation = static_cast<float>(8 * voxel);
  for (std::size_t s = 0; s < field.values.count(); ++s)
    field.values.values()[s] =
        static_cast<float>(distance(field.position(cast<double>(field.values.ijk(s)))));
  return fieldToMesh(field);
}

inline double smoothMin(double a, double b, double k) {
  const double h = std::clamp(0.5 + 0.5 * (b - a) / k, 0.0, 1.0);
  return b * (1 - h) + a * h - k * h * (1 - h);
}

/// Three rings grown together: genus 3.
inline TriangleMesh genusThreeMesh() {
  return implicitMesh({{-2.3, -2.3, -0.5}, {2.3, 2.3, 0.5}}, 0.08, [](const Vec3d& p) {
    double d = 9;
    for (int k = 0; k < 3; ++k) {
      const double angle = 2 * std::numbers::pi * k / 3;
      const double off = std::hypot(p.x - std::cos(angle), p.y - std::sin(angle)) - 0.75;
      d = smoothMin(d, std::hypot(off, p.z) - 0.28, 0.1);
    }
    return d;
  });
}

/// A round body with a head and two ears.
inline TriangleMesh bodyMesh(double voxel = 0.07) {
  return implicitMesh({{-1, -0.8, -0.3}, {1.2, 0.8, 2.1}}, voxel, [](const Vec3d& p) {
    const auto ball = [&](const Vec3d& c, double r) { return length(p - c) - r; };
    double d = ball({0, 0, 0.45}, 0.6);
    d = smoothMin(d, ball({0.5, 0, 1.05}, 0.33), 0.2);
    d = smoothMin(d, ball({-0.65, 0, 0.5}, 0.17), 0.1);
    for (const double side : {-1.0, 1.0}) {
      const Vec3d a{0.45, 0.13 * side, 1.25}, along{-0.17, 0.08 * side, 0.5};
      const double t = std::clamp(dot(p - a, along) / dot(along, along), 0.0, 1.0);
      d = smoothMin(d, length(p - a - along * t) - 0.11, 0.1);
    }
    return d;
  });
}

/// The bundled scenes, without their files.
inline DistanceField sceneField(const ProcessSample& sample) {
  MeshToSdfOptions options;
  options.voxelSize = 1;
  options.box = sample.box;
  return meshToSdf(sample.mesh, options);
}
inline DistanceField chainmail() { return sceneField(makeChainmail({}, {1, 1, 1}, 1)); }
inline DistanceField grass() { return sceneField(makeGrass({}, {1, 1, 1}, 1)); }
inline DistanceField metal() { return sceneField(makeMetal({}, {1, 1, 1}, 1)); }
/// Fewer samples of them, for tests of what does not need more.
inline DistanceField littleChainmail() {
  return sceneField(
      makeChainmail({.columns = 2, .rows = 8, .ringRadius = 7, .wireRadius = 1.4}, {1, 1, 1}, 1));
}
inline DistanceField littleMetal() {
  return sceneField(makeMetal({.side = 36, .grain = 8, .relief = 7}, {1, 1, 1}, 1));
}
inline DistanceField littleGrass() {
  return sceneField(makeGrass({.side = 36, .length = 16}, {1, 1, 1}, 1));
}

}  // namespace exemplar::surface
