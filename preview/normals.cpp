// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "preview/normals.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>

#include "core/parallel.h"
#include "core/stoppable.h"
#include "mesh/shading_normals.h"

namespace exemplar {
namespace {

constexpr std::size_t kGrain = 4096;

/// A side of a triangle, between two places.
struct Side {
  std::uint32_t low, high, triangle;
  bool rising;

  bool sameEdge(const Side& other) const { return low == other.low && high == other.high; }
  bool operator<(const Side& other) const {
    if (low != other.low) return low < other.low;
    if (high != other.high) return high < other.high;
    return triangle < other.triangle || (triangle == other.triangle && rising < other.rising);
  }
};

/// Sets of triangles, each with whether it is turned against the set's first one.
class Windings {
 public:
  explicit Windings(std::size_t count) : parent_(count), turned_(count, 0) {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }

  std::pair<std::uint32_t, bool> find(std::uint32_t t) {
    std::uint32_t root = t;
    std::uint8_t turned = 0;
    while (parent_[root] != root) {
      turned ^= turned_[root];
      root = parent_[root];
    }
    for (std::uint8_t left = turned; parent_[t] != t && t != root;) {
      const std::uint32_t next = parent_[t];
      const std::uint8_t own = turned_[t];
      parent_[t] = root;
      turned_[t] = left;
      left ^= own;
      t = next;
    }
    return {root, turned != 0};
  }

  /// Nothing where they are in one set: a strip with a twist has no outside.
  void join(std::uint32_t a, std::uint32_t b, bool against) {
    const auto [rootA, turnedA] = find(a);
    const auto [rootB, turnedB] = find(b);
    if (rootA == rootB) return;
    const auto [low, high] = std::minmax(rootA, rootB);
    parent_[high] = low;
    turned_[high] = turnedA != turnedB ? !against : against;
  }

 private:
  std::vector<std::uint32_t> parent_;
  std::vector<std::uint8_t> turned_;  // against the parent
};

/// Which triangles to turn round so that each is wound as its neighbors are; empty for none.
std::vector<bool> turnedRound(const TriangleMesh& mesh, const Progress& progress) {
  const std::vector<std::uint32_t> place = firstOfEqual(mesh.positions, progress);
  std::vector<Side> sides(3 * mesh.triangles.size());
  parallelFor(0, mesh.triangles.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      for (int c = 0; c < 3; ++c) {
        const std::uint32_t a = place[mesh.triangles[t][c]],
                            b = place[mesh.triangles[t][(c + 1) % 3]];
        sides[3 * t + c] = {std::min(a, b), std::max(a, b), static_cast<std::uint32_t>(t), a < b};
      }
    }
  });
  sortInParallel(sides, progress);
  Windings windings(mesh.triangles.size());
  for (std::size_t begin = 0, end = 0, edge = 0; begin < sides.size(); begin = end, ++edge) {
    if (looksUp(edge)) progress.check();
    while (end < sides.size() && sides[end].sameEdge(sides[begin])) ++end;
    // Where several sheets meet, any two of them could belong together.
    if (end - begin != 2 || sides[begin].low == sides[begin].high) continue;
    windings.join(sides[begin].triangle, sides[begin + 1].triangle,
                  sides[begin].rising == sides[begin + 1].rising);
  }
  std::vector<bool> turned(mesh.triangles.size());
  bool any = false;
  for (std::uint32_t t = 0; t < turned.size(); ++t) {
    if (looksUp(t)) progress.check();
    turned[t] = windings.find(t).second;
    any = any || turned[t];
  }
  if (!any) turned.clear();
  return turned;
}

}  // namespace

std::vector<std::array<Vec3f, 3>> cornerNormals(const TriangleMesh& mesh, double creaseAngle,
                                                const Progress& progress) {
  const std::vector<bool> turned = turnedRound(mesh, progress);
  TriangleMesh wound;
  if (!turned.empty()) {
    wound.positions = mesh.positions;
    wound.triangles = mesh.triangles;
    for (std::size_t t = 0; t < turned.size(); ++t)
      if (turned[t]) std::swap(wound.triangles[t][1], wound.triangles[t][2]);
  }
  const ShadingNormals shading =
      shadingNormals(turned.empty() ? mesh : wound, creaseAngle, progress);
  std::vector<std::array<Vec3f, 3>> normals(mesh.triangles.size());
  parallelFor(0, normals.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    progress.check();
    for (std::size_t t = begin; t < end; ++t) {
      const bool isTurned = !turned.empty() && turned[t];
      const Vec3f own = cast<float>(normalized(areaNormal(mesh, t)));
      for (int c = 0; c < 3; ++c) {
        const Vec3f& normal = shading.normals[shading.corners[t][isTurned && c > 0 ? 3 - c : c]];
        const Vec3f facing = isTurned ? -normal : normal;
        normals[t][c] = dot(facing, own) > 0 ? facing : own;
      }
    }
  });
  return normals;
}

}  // namespace exemplar
