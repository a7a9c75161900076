// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/tangents.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <span>
#include <tuple>

namespace exemplar {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// What of a corner decides which vertex it is.
struct Corner {
  Vec3d position;
  Vec3f normal;
  Vec2f uv;

  bool operator==(const Corner&) const = default;
  std::uint64_t hash() const {
    std::uint64_t h = 0x9e3779b97f4a7c15u;
    const auto mix = [&](std::uint64_t bits) {
      h = (h ^ bits) * 0xff51afd7ed558ccdu;
      h ^= h >> 32;
    };
    for (int axis = 0; axis < 3; ++axis) mix(std::bit_cast<std::uint64_t>(position[axis] + 0.0));
    for (const float f : {normal.x, normal.y, normal.z, uv.x, uv.y})
      mix(std::bit_cast<std::uint32_t>(f + 0.0f));
    return h;
  }
};

/// How the texture lies on a triangle.
struct Cover {
  Vec3d along;           // unit: where u grows
  bool upright = false;  // v grows to the left of it, seen from outside
  bool any = true;       // without area: joins whatever is beside it
};

Vec3d unitOrZero(const Vec3d& v) {
  const double size = length(v);
  return size > 0 ? v / size : v;
}

/// Tangents of one mesh.
class TangentFinder {
 public:
  TangentFinder(const TriangleMesh& mesh, const ShadingNormals& normals,
                const std::vector<std::optional<UvTransform>>& lookups, const Progress& progress)
      : mesh_(mesh), normals_(normals), lookups_(lookups), progress_(progress) {}

  CornerTangents find() {
    weld();
    findNeighbors();
    for (std::uint32_t t = 0; t < count(); ++t) {
      if (t % 16384 == 0) progress_.check();
      if (skipped_[t] || covers_[t].any) continue;
      for (int c = 0; c < 3; ++c)
        if (out_.corners[t][c] == kNone) addGroup(t, c);
    }
    fillGaps();
    dropUnneeded();
    return std::move(out_);
  }

 private:
  std::uint32_t count() const { return static_cast<std::uint32_t>(mesh_.triangles.size()); }
  const Vec3d& position(std::uint32_t t, int c) const {
    return mesh_.positions[mesh_.triangles[t][c]];
  }
  const Vec3f& normal(std::uint32_t t, int c) const {
    return normals_.normals[normals_.corners[t][c]];
  }
  Vec2f uv(std::uint32_t t, int c) const {
    const auto& lookup = lookups_[mesh_.triangleMaterials[t]];
    return lookup ? lookup->apply(mesh_.uvs[t][c]) : mesh_.uvs[t][c];
  }

  /// Numbers the vertices, and finds how the texture lies.
  void weld() {
    const std::size_t slots = std::bit_ceil(6 * mesh_.triangles.size() + 1);
    std::vector<std::uint32_t> table(slots, kNone);
    std::vector<Corner> known;
    vertices_.resize(count());
    covers_.resize(count());
    skipped_.assign(count(), false);
    out_.corners.assign(count(), {kNone, kNone, kNone});
    for (std::uint32_t t = 0; t < count(); ++t) {
      if (t % 16384 == 0) progress_.check();
      for (int c = 0; c < 3; ++c) {
        const Corner corner{position(t, c), normal(t, c), uv(t, c)};
        std::size_t slot = corner.hash() & (slots - 1);
        while (table[slot] != kNone && !(known[table[slot]] == corner))
          slot = (slot + 1) & (slots - 1);
        if (table[slot] == kNone) {
          table[slot] = static_cast<std::uint32_t>(known.size());
          known.push_back(corner);
        }
        vertices_[t][c] = table[slot];
      }
      skipped_[t] = position(t, 0) == position(t, 1) || position(t, 1) == position(t, 2) ||
                    position(t, 2) == position(t, 0);
      covers_[t] = coverOf(t);
    }
    vertexCount_ = known.size();
  }

  Cover coverOf(std::uint32_t t) const {
    Cover cover;
    const Vec2f a = uv(t, 0), b = uv(t, 1), c = uv(t, 2);
    const double u1 = double(b.x) - a.x, v1 = double(b.y) - a.y;
    const double u2 = double(c.x) - a.x, v2 = double(c.y) - a.y;
    const double area = u1 * v2 - v1 * u2;
    cover.upright = area > 0;
    if (!(std::abs(area) > std::numeric_limits<float>::min())) return cover;
    const Vec3d d1 = position(t, 1) - position(t, 0), d2 = position(t, 2) - position(t, 0);
    const Vec3d along = d1 * v2 - d2 * v1, up = d2 * u1 - d1 * u2;
    cover.along = unitOrZero(along) * (cover.upright ? 1.0 : -1.0);
    cover.any = !(length(along) > 0 && length(up) > 0);
    return cover;
  }

  /// The triangle across each edge: the first, in order, that runs along it the other way.
  void findNeighbors() {
    struct Edge {
      std::uint32_t low, high, triangle;
      std::uint8_t side;
      bool rising;
    };
    std::vector<Edge> edges;
    edges.reserve(3 * mesh_.triangles.size());
    for (std::uint32_t t = 0; t < count(); ++t) {
      if (skipped_[t]) continue;
      for (std::uint8_t c = 0; c < 3; ++c) {
        const std::uint32_t a = vertices_[t][c], b = vertices_[t][(c + 1) % 3];
        edges.push_back({std::min(a, b), std::max(a, b), t, c, a < b});
      }
    }
    progress_.check();
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
      return std::tie(a.low, a.high, a.triangle, a.side) <
             std::tie(b.low, b.high, b.triangle, b.side);
    });
    progress_.check();
    neighbors_.assign(count(), {kNone, kNone, kNone});
    std::vector<const Edge*> open;  // in one direction
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
      open.clear();
      std::size_t first = 0;
      for (end = begin; end < edges.size() && edges[end].low == edges[begin].low &&
                        edges[end].high == edges[begin].high;
           ++end) {
        const Edge& edge = edges[end];
        if (first < open.size() && open[first]->rising != edge.rising) {
          const Edge& other = *open[first++];
          neighbors_[edge.triangle][edge.side] = other.triangle;
          neighbors_[other.triangle][other.side] = edge.triangle;
        } else {
          open.push_back(&edge);
        }
      }
    }
  }

  /// Gives corner c of triangle t, and all around the vertex that share it, a tangent.
  void addGroup(std::uint32_t t, int c) {
    const std::uint32_t vertex = vertices_[t][c];
    const bool upright = covers_[t].upright;
    const auto group = static_cast<std::uint32_t>(out_.tangents.size());
    members_.clear();
    stack_.assign(1, t);
    while (!stack_.empty()) {
      const std::uint32_t at = stack_.back();
      stack_.pop_back();
      const int corner = cornerOf(at, vertex);
      if (out_.corners[at][corner] != kNone) continue;
      Cover& cover = covers_[at];
      const bool isFree = out_.corners[at] == std::array{kNone, kNone, kNone};
      if (cover.any && isFree) cover.upright = upright;
      if (cover.upright != upright) continue;
      out_.corners[at][corner] = group;
      members_.push_back(at);
      for (const int side : {(corner + 2) % 3, corner})
        if (neighbors_[at][side] != kNone) stack_.push_back(neighbors_[at][side]);
    }
    std::sort(members_.begin(), members_.end());
    out_.tangents.push_back(tangentOf(members_, vertex, cast<double>(normal(t, c)), upright));
  }

  int cornerOf(std::uint32_t t, std::uint32_t vertex) const {
    return vertices_[t][0] == vertex ? 0 : vertices_[t][1] == vertex ? 1 : 2;
  }

  Tangent tangentOf(std::span<const std::uint32_t> triangles, std::uint32_t vertex,
                    const Vec3d& normal, bool upright) const {
    const auto inPlane = [&](const Vec3d& v) { return unitOrZero(v - normal * dot(normal, v)); };
    Vec3d sum{};
    for (const std::uint32_t t : triangles) {
      if (covers_[t].any) continue;
      const int c = cornerOf(t, vertex);
      const Vec3d before = inPlane(position(t, (c + 2) % 3) - position(t, c));
      const Vec3d after = inPlane(position(t, (c + 1) % 3) - position(t, c));
      sum += inPlane(covers_[t].along) * std::acos(std::clamp(dot(before, after), -1.0, 1.0));
    }
    return rounded(length(sum) > 1e-12 ? sum : perpendicular(normal), upright);
  }

  static Vec3d perpendicular(const Vec3d& normal) {
    const Vec3d axis = std::abs(normal.x) < 0.9 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
    return axis - normal * dot(normal, axis);
  }

  static Tangent rounded(const Vec3d& direction, bool upright) {
    const Vec3f unit = cast<float>(normalized(direction));
    return {unit.x, unit.y, unit.z, upright ? 1.0f : -1.0f};
  }

  /// Corners that no group has reached take one that their vertex has, or any.
  void fillGaps() {
    std::vector<std::uint32_t> ofVertex(vertexCount_, kNone);
    for (std::uint32_t t = 0; t < count(); ++t)
      for (int c = 0; c < 3; ++c)
        if (out_.corners[t][c] != kNone && ofVertex[vertices_[t][c]] == kNone)
          ofVertex[vertices_[t][c]] = out_.corners[t][c];
    for (std::uint32_t t = 0; t < count(); ++t) {
      for (int c = 0; c < 3; ++c) {
        if (out_.corners[t][c] != kNone) continue;
        std::uint32_t& known = ofVertex[vertices_[t][c]];
        if (known == kNone) {
          known = static_cast<std::uint32_t>(out_.tangents.size());
          out_.tangents.push_back(rounded(perpendicular(cast<double>(normal(t, c))), false));
        }
        out_.corners[t][c] = known;
      }
    }
  }

  void dropUnneeded() {
    for (std::uint32_t t = 0; t < count(); ++t)
      if (!lookups_[mesh_.triangleMaterials[t]]) out_.corners[t] = {kNone, kNone, kNone};
  }

  const TriangleMesh& mesh_;
  const ShadingNormals& normals_;
  const std::vector<std::optional<UvTransform>>& lookups_;
  const Progress& progress_;
  std::size_t vertexCount_ = 0;
  std::vector<std::array<std::uint32_t, 3>> vertices_;   // of each triangle, welded
  std::vector<std::array<std::uint32_t, 3>> neighbors_;  // across each side
  std::vector<Cover> covers_;
  std::vector<bool> skipped_;  // two corners in one place
  CornerTangents out_;
  std::vector<std::uint32_t> members_, stack_;
};

}  // namespace

CornerTangents cornerTangents(const TriangleMesh& mesh, const ShadingNormals& normals,
                              const std::vector<std::optional<UvTransform>>& lookups,
                              const Progress& progress) {
  return TangentFinder(mesh, normals, lookups, progress).find();
}

}  // namespace exemplar
