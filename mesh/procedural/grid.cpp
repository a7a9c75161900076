// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "core/array3d.h"
#include "core/random.h"
#include "mesh/procedural/processes.h"

namespace exemplar {
namespace {

constexpr int kAround = 24;  ///< points around a rod; a multiple of 8, to meet a face's corners
constexpr int kRings = 4;    ///< of triangles from a rod's foot to the edge of its face
constexpr std::uint32_t kRodMaterial = 0, kBallMaterial = 1;

/// A unit direction on face `side` of a cube blown up to a sphere: `around` the face's middle,
/// `out` from the rod's foot (0, at angle `foot` from the middle) to the face's edge (1).
Vec3d faceDirection(int axis, int side, int around, double out, double foot) {
  const double angle = 2 * std::numbers::pi * around / kAround;
  const double c = std::cos(angle), s = std::sin(angle);
  const double edge = 1 / std::max(std::abs(c), std::abs(s));  // of the square around the face
  const double radius = std::tan(foot) * (1 - out) + edge * out;
  Vec3d d;
  d[axis] = side;
  d[(axis + 1) % 3] = radius * c;
  d[(axis + 2) % 3] = radius * s;
  return normalized(d);
}

/// Builds the lattice as one closed surface: each ball with six feet, rods from foot to foot.
class Lattice {
 public:
  Lattice(double rodRadius, double ballRadius)
      : ball_(ballRadius), foot_(std::asin(rodRadius / ballRadius)) {}

  using Foot = std::array<std::uint32_t, kAround>;
  using Feet = std::array<Foot, 6>;  ///< -x, +x, -y, +y, -z, +z

  /// A ball with holes where its rods meet it.
  Feet addBall(const Vec3d& center) {
    std::map<std::array<long, 3>, std::uint32_t> known;  // faces share the points of their edges
    const auto vertex = [&](const Vec3d& d) {
      const std::array<long, 3> key{std::lround(d.x * 1e6), std::lround(d.y * 1e6),
                                    std::lround(d.z * 1e6)};
      const auto [it, isNew] =
          known.try_emplace(key, static_cast<std::uint32_t>(mesh_.positions.size()));
      if (isNew) mesh_.positions.push_back(center + d * ball_);
      return it->second;
    };
    Feet feet;
    for (int face = 0; face < 6; ++face) {
      const int axis = face / 2, side = face % 2 ? 1 : -1;
      std::array<std::uint32_t, kAround> inner{}, outer{};
      for (int ring = 0; ring <= kRings; ++ring) {
        for (int a = 0; a < kAround; ++a) {
          outer[a] =
              vertex(faceDirection(axis, side, a, static_cast<double>(ring) / kRings, foot_));
        }
        if (ring == 0) feet[face] = outer;
        if (ring > 0) addBand(inner, outer, side > 0, kBallMaterial);
        inner = outer;
      }
    }
    return feet;
  }

  void addRod(const Foot& from, const Foot& to) { addBand(from, to, false, kRodMaterial); }

  /// Closes a foot that has no rod.
  void addCap(const Foot& foot, const Vec3d& middle, bool positiveSide) {
    const auto m = static_cast<std::uint32_t>(mesh_.positions.size());
    mesh_.positions.push_back(middle);
    for (int a = 0; a < kAround; ++a) {
      const std::uint32_t p = foot[a], q = foot[(a + 1) % kAround];
      addTriangle(m, positiveSide ? p : q, positiveSide ? q : p, kBallMaterial);
    }
  }

  TriangleMesh take() { return std::move(mesh_); }

 private:
  void addBand(const Foot& inner, const Foot& outer, bool positiveSide, std::uint32_t material) {
    for (int a = 0; a < kAround; ++a) {
      const int b = (a + 1) % kAround;
      const std::uint32_t p = inner[a], q = inner[b], r = outer[b], s = outer[a];
      // Inner to outer runs away from the axis, so this is counterclockwise on a positive side.
      addTriangle(p, positiveSide ? s : r, positiveSide ? r : s, material);
      addTriangle(p, positiveSide ? r : q, positiveSide ? q : r, material);
    }
  }
  void addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t material) {
    mesh_.triangles.push_back({a, b, c});
    mesh_.triangleMaterials.push_back(material);
  }

  double ball_, foot_;
  TriangleMesh mesh_;
};

}  // namespace

ProcessSample makeGrid(const GridProcess& process, const Vec3d& extent, std::uint64_t seed,
                       const Progress& progress) {
  const Random random(seed, stream::kGrid);
  ProcessSample sample;
  sample.box.min = {0, 0, 0};
  sample.box.max = extent * (process.cells * process.cell);
  // One cell more on each side, so that rods go on past the window.
  Vec3i size;
  for (int axis = 0; axis < 3; ++axis) {
    size[axis] = static_cast<int>(std::ceil(process.cells * extent[axis])) + 2;
  }
  Lattice lattice(process.rodRadius, process.ballRadius);
  Array3D<Vec3d> centers(size);
  Array3D<Lattice::Feet> feet(size);
  const auto share = [&](std::size_t n) {
    return static_cast<double>(n) / static_cast<double>(centers.count());
  };
  for (std::size_t n = 0; n < centers.count(); ++n) {
    progress.report("making the grid's balls", 0.5 * share(n));
    const Vec3i ijk = centers.ijk(n);
    const std::uint64_t key = (static_cast<std::uint64_t>(ijk.z) * 4096 + ijk.y) * 4096 + ijk.x;
    Vec3d& p = centers.values()[n];
    for (int axis = 0; axis < 3; ++axis) {
      const double deviation = std::clamp(random.normal(key, 2 * axis), -2.0, 2.0) * process.jitter;
      p[axis] = (ijk[axis] - 0.5) * process.cell + deviation;
    }
    feet.values()[n] = lattice.addBall(p);
  }
  for (std::size_t n = 0; n < centers.count(); ++n) {
    progress.report("making the grid's rods", 0.5 + 0.5 * share(n));
    const Vec3i ijk = centers.ijk(n);
    for (int axis = 0; axis < 3; ++axis) {
      Vec3i next = ijk, along{};
      next[axis] += 1;
      along[axis] = 1;
      const Vec3d tip = cast<double>(along) * process.ballRadius;
      if (centers.contains(next)) {
        lattice.addRod(feet[ijk][2 * axis + 1], feet[next][2 * axis]);
      } else {
        lattice.addCap(feet[ijk][2 * axis + 1], centers[ijk] + tip, true);
      }
      if (ijk[axis] == 0) lattice.addCap(feet[ijk][2 * axis], centers[ijk] - tip, false);
    }
  }
  sample.mesh = lattice.take();
  sample.mesh.materials = {
      {.name = "copper", .baseColor = {0.72f, 0.38f, 0.26f, 1}, .metallic = 1, .roughness = 0.4f},
      {.name = "brass", .baseColor = {0.74f, 0.58f, 0.26f, 1}, .metallic = 1, .roughness = 0.35f}};
  return sample;
}

}  // namespace exemplar
