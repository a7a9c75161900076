// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/continuous/touching.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <vector>

#include "core/disjoint_sets.h"

namespace exemplar::continuous {
namespace {

/// A triangle's side, by its first corner: 3 t + c.
using Side = std::uint32_t;

class Separation {
 public:
  explicit Separation(TriangleMesh& mesh) : mesh_(mesh), corners_(3 * mesh.triangles.size()) {}

  std::size_t run() {
    std::vector<std::vector<Side>> sidesAt(mesh_.positions.size());
    for (Side s = 0; s < 3 * mesh_.triangles.size(); ++s)
      sidesAt[std::min(from(s), to(s))].push_back(s);
    for (std::vector<Side>& sides : sidesAt) {
      std::ranges::sort(sides, {}, [&](Side s) { return std::pair(std::max(from(s), to(s)), s); });
      for (std::size_t first = 0; first < sides.size();) {
        std::size_t last = first + 1;
        const auto high = [&](std::size_t n) { return std::max(from(sides[n]), to(sides[n])); };
        while (last < sides.size() && high(last) == high(first)) ++last;
        joinAcross({sides.begin() + static_cast<std::ptrdiff_t>(first),
                    sides.begin() + static_cast<std::ptrdiff_t>(last)});
        first = last;
      }
    }
    return copyVertices();
  }

 private:
  std::uint32_t from(Side s) const { return mesh_.triangles[s / 3][s % 3]; }
  std::uint32_t to(Side s) const { return mesh_.triangles[s / 3][(s % 3 + 1) % 3]; }
  static Side next(Side s) { return s - s % 3 + (s % 3 + 1) % 3; }
  bool isForward(Side s) const { return from(s) < to(s); }

  /// Two triangles stay together at both ends of the edge that they share.
  void join(Side a, Side b) {
    const bool alike = from(a) == from(b);
    corners_.join(a, alike ? b : next(b));
    corners_.join(next(a), alike ? next(b) : b);
  }

  void joinAcross(std::vector<Side> sides) {
    if (sides.size() == 2) return join(sides[0], sides[1]);
    const Vec3d start = mesh_.positions[std::min(from(sides[0]), to(sides[0]))];
    const Vec3d axis = normalized(mesh_.positions[std::max(from(sides[0]), to(sides[0]))] - start);
    const auto arm = [&](Side s) {
      const Vec3d d = mesh_.positions[to(next(s))] - start;
      return d - axis * dot(d, axis);
    };
    const Vec3d u = normalized(arm(sides[0])), v = cross(axis, u);
    std::vector<std::pair<double, Side>> around;
    for (const Side s : sides) around.emplace_back(std::atan2(dot(arm(s), v), dot(arm(s), u)), s);
    std::ranges::sort(around);
    // Counterclockwise around the axis a solid begins at a triangle that runs backward.
    bool alternate = sides.size() % 2 == 0;
    for (std::size_t n = 1; n < around.size(); ++n)
      alternate = alternate && isForward(around[n].second) != isForward(around[n - 1].second);
    for (std::size_t n = 0; n < around.size(); ++n) {
      const Side a = around[n].second, b = around[(n + 1) % around.size()].second;
      if (!alternate || !isForward(a)) join(a, b);
    }
  }

  std::size_t copyVertices() {
    constexpr std::uint32_t kNone = 0xFFFFFFFF;
    const std::size_t before = mesh_.positions.size();
    std::vector<std::uint32_t> keeper(before, kNone);  // the set of corners that keeps a vertex
    std::unordered_map<std::uint32_t, std::uint32_t> copies;  // of other sets
    for (std::uint32_t s = 0; s < 3 * mesh_.triangles.size(); ++s) {
      std::uint32_t& vertex = mesh_.triangles[s / 3][s % 3];
      const std::uint32_t set = corners_.find(s);
      if (keeper[vertex] == kNone) keeper[vertex] = set;
      if (keeper[vertex] == set) continue;
      const auto [copy, isNew] =
          copies.emplace(set, static_cast<std::uint32_t>(mesh_.positions.size()));
      if (isNew) {
        mesh_.positions.push_back(mesh_.positions[vertex]);
        if (mesh_.hasColors()) mesh_.colors.push_back(mesh_.colors[vertex]);
      }
      vertex = copy->second;
    }
    return mesh_.positions.size() - before;
  }

  TriangleMesh& mesh_;
  DisjointSets corners_;
};

}  // namespace

std::size_t separateTouching(TriangleMesh& mesh) { return Separation(mesh).run(); }

}  // namespace exemplar::continuous
