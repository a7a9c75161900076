// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/progress.h"
#include "core/vec.h"
#include "mesh/triangle_mesh.h"
#include "sdf/triangle_tree.h"

namespace exemplar {

/// The triangles of a mesh, prepared for the question what they enclose: vertices at equal
/// positions are one (files split them at seams), triangles without area are left out, and of equal
/// ones those of opposite orientation cancel and the others count once. A wall that is there twice,
/// once for each side, does not cancel but counts once, too: all of a shell that is not flat, or a
/// patch that closes what is open without it. The inner side of a closed shell that is less than a
/// quarter (of `scale`) thick all over is left out. Connected triangles that
/// meet two at an edge are oriented alike, as the larger area is, where that is possible.
struct TriangleSoup {
  std::vector<Vec3d> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  /// Every edge is run through as often one way as the other: the triangles are the boundary of
  /// something, and their winding number is an integer off them.
  bool closed = false;
  /// Every edge has an even number of triangles, however they face: rays from a point agree on the
  /// parity of their crossings.
  bool even = false;
  /// For each triangle and side (corner s to s + 1) the triangle across it, where those two alone
  /// meet there and face the same way; else `kNone`.
  std::vector<std::array<std::uint32_t, 3>> neighbors;

  /// For each triangle its component, numbered by first triangle; and for each component whether it
  /// is closed. Components hang together through common points, and through points on the rims of
  /// their openings that are less than a quarter (of `scale`) apart: parts that were modeled one
  /// by one and never joined.
  std::vector<std::uint32_t> component;
  std::vector<std::uint8_t> componentClosed;

  static constexpr std::uint32_t kNone = 0xffffffff;
};

/// The corners of triangle `t`.
inline Corners cornersOf(const TriangleSoup& soup, std::uint32_t t) {
  const auto& [a, b, c] = soup.triangles[t];
  return {soup.points[a], soup.points[b], soup.points[c]};
}

/// The corners of all triangles, in their order.
std::vector<Corners> cornersOf(const TriangleSoup& soup);

/// O(n log n) for n triangles; positions are (xyz - origin) / scale. Throws `Cancelled`.
TriangleSoup makeSoup(const TriangleMesh& mesh, const Vec3d& origin, double scale,
                      const Progress& progress = {});

}  // namespace exemplar
