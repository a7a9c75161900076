// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/shading_normals.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <span>

#include "core/parallel.h"
#include "core/stoppable.h"

namespace exemplar {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kGrain = 4096;
/// Cosine of 40 degrees, less what floats round; and of about 155 degrees: facets that fold back
/// onto each other have no normal in common.
constexpr float kRounding = 1e-5f, kCrease = 0.766044f - kRounding, kFold = -0.9f;

std::uint64_t hashPosition(const Vec3d& p) {
  std::uint64_t h = 0x9e3779b97f4a7c15u;
  for (int axis = 0; axis < 3; ++axis) {
    h ^= std::bit_cast<std::uint64_t>(p[axis] + 0.0);  // -0 is 0
    h *= 0xff51afd7ed558ccdu;
    h ^= h >> 32;
  }
  return h;
}

struct Facet {
  Vec3f normal;  // zero without area
  std::array<float, 3> angles;
};

Facet facetOf(const TriangleMesh& mesh, std::size_t t) {
  std::array<Vec3d, 3> p;
  double largest = 0;
  for (int c = 0; c < 3; ++c) p[c] = mesh.positions[mesh.triangles[t][c]];
  for (int c = 0; c < 3; ++c)
    for (int axis = 0; axis < 3; ++axis)
      largest = std::max(largest, std::abs(p[c][axis] - p[0][axis]));
  Facet facet{};
  if (!(largest > std::numeric_limits<double>::min())) return facet;
  // Edges of size 1, so that neither tiny nor huge coordinates leave the range of numbers.
  std::array<Vec3d, 3> edges;
  for (int c = 0; c < 3; ++c) edges[c] = (p[(c + 1) % 3] - p[c]) / largest;
  const Vec3d area = cross(edges[0], -edges[2]);
  const double doubleArea = length(area);
  if (!(doubleArea > 0)) return facet;
  facet.normal = cast<float>(area / doubleArea);
  for (int c = 0; c < 3; ++c) {
    const Vec3d out = edges[c], in = -edges[(c + 2) % 3];
    facet.angles[c] = static_cast<float>(std::atan2(doubleArea, dot(out, in)));
  }
  return facet;
}

/// The corners (3 t + c) around each vertex, in rising order.
struct Corners {
  std::vector<std::uint64_t> start;
  std::vector<std::uint32_t> corners;

  std::span<const std::uint32_t> around(std::size_t v) const {
    return {corners.data() + start[v], corners.data() + start[v + 1]};
  }
};

/// `vertexOf(v)` is the vertex that v counts as.
template <class VertexOf>
Corners cornersOf(const TriangleMesh& mesh, const VertexOf& vertexOf) {
  Corners out;
  out.start.assign(mesh.positions.size() + 2, 0);
  // Counted two places on, so that filling leaves each start where it belongs.
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle) ++out.start[vertexOf(v) + 2];
  for (std::size_t v = 2; v < out.start.size(); ++v) out.start[v] += out.start[v - 1];
  out.corners.resize(3 * mesh.triangles.size());
  std::uint32_t corner = 0;
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle) out.corners[out.start[vertexOf(v) + 1]++] = corner++;
  out.start.pop_back();
  return out;
}

/// The fans around vertices, one vertex after another.
class FanFinder {
 public:
  FanFinder(const TriangleMesh& mesh, const std::vector<Facet>& facets, float least)
      : mesh_(mesh), facets_(facets), least_(least) {}

  /// Sets `fan` of each of the corners around a vertex to a number from 0; returns how many fans
  /// they are. `first`: the vertex that each counts as, or empty. `open` becomes true where an edge
  /// has no triangle on its other side.
  std::uint32_t find(std::span<const std::uint32_t> corners,
                     const std::vector<std::uint32_t>& first, std::uint32_t* fan, bool& open) {
    parent_.resize(corners.size());
    for (std::uint32_t i = 0; i < corners.size(); ++i) parent_[i] = i;
    edges_.clear();
    for (std::uint32_t i = 0; i < corners.size(); ++i) {
      const auto& triangle = mesh_.triangles[corners[i] / 3];
      const std::uint32_t c = corners[i] % 3, own = triangle[c];
      edges_.push_back({triangle[(c + 1) % 3], own, i, false});
      edges_.push_back({triangle[(c + 2) % 3], own, i, true});
    }
    std::vector<Edge>& left = left_;
    left.clear();
    join(corners, edges_, left);
    if (!left.empty()) {
      open = true;
      if (!first.empty()) {
        // What no index joins may meet at equal positions.
        for (Edge& e : left) {
          e.neighbor = first[e.neighbor];
          e.own = 0;
        }
        edges_.swap(left);
        left.clear();
        join(corners, edges_, left);
      }
    }
    // Fans are numbered as their first corners come; corners without area join the first one.
    std::uint32_t fans = 0;
    label_.assign(corners.size(), kNone);
    for (std::uint32_t i = 0; i < corners.size(); ++i) {
      fan[i] = 0;
      if (facets_[corners[i] / 3].normal == Vec3f{}) continue;
      std::uint32_t& label = label_[root(i)];
      if (label == kNone) label = fans++;
      fan[i] = label;
    }
    return std::max(fans, std::uint32_t{corners.empty() ? 0u : 1u});
  }

 private:
  /// A side of a corner: the edge to a neighbor, along which its triangle goes out or comes in.
  struct Edge {
    std::uint32_t neighbor, own, corner;
    bool in;
  };
  struct Pair {
    float cosine;
    std::uint32_t a, b;
  };

  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  /// Joins the corners on both sides of each edge; edges with one side go to `left`.
  void join(std::span<const std::uint32_t> corners, std::vector<Edge>& edges,
            std::vector<Edge>& left) {
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
      if (a.neighbor != b.neighbor) return a.neighbor < b.neighbor;
      if (a.own != b.own) return a.own < b.own;
      if (a.in != b.in) return a.in < b.in;
      return a.corner < b.corner;
    });
    for (std::size_t begin = 0; begin < edges.size();) {
      std::size_t middle = begin, end;
      const auto same = [&](std::size_t i) {
        return i < edges.size() && edges[i].neighbor == edges[begin].neighbor &&
               edges[i].own == edges[begin].own;
      };
      while (same(middle) && !edges[middle].in) ++middle;
      for (end = middle; same(end);) ++end;
      const std::size_t outs = middle - begin, ins = end - middle;
      if (outs != ins) left.insert(left.end(), edges.begin() + begin, edges.begin() + end);
      if (outs == 1 && ins == 1) {
        if (cosine(corners, edges[begin], edges[middle]) >= least_)
          unite(edges[begin].corner, edges[middle].corner);
      } else if (outs == ins && outs <= 8) {
        // Several sheets share the edge: those that face the same way belong together.
        pairs_.clear();
        for (std::size_t a = begin; a < middle; ++a)
          for (std::size_t b = middle; b < end; ++b)
            pairs_.push_back(
                {cosine(corners, edges[a], edges[b]), edges[a].corner, edges[b].corner});
        std::stable_sort(pairs_.begin(), pairs_.end(),
                         [](const Pair& a, const Pair& b) { return a.cosine > b.cosine; });
        taken_.resize(2 * corners.size());
        for (const Pair& p : pairs_) taken_[2 * p.a] = taken_[2 * p.b + 1] = 0;
        for (const Pair& p : pairs_) {
          if (p.cosine < least_ || taken_[2 * p.a] || taken_[2 * p.b + 1]) continue;
          taken_[2 * p.a] = taken_[2 * p.b + 1] = 1;
          unite(p.a, p.b);
        }
      }
      begin = end;
    }
  }

  float cosine(std::span<const std::uint32_t> corners, const Edge& a, const Edge& b) const {
    const Vec3f &m = facets_[corners[a.corner] / 3].normal,
                &n = facets_[corners[b.corner] / 3].normal;
    return m == Vec3f{} || n == Vec3f{} ? -1.0f : dot(m, n);
  }

  void unite(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

  const TriangleMesh& mesh_;
  const std::vector<Facet>& facets_;
  float least_;
  std::vector<std::uint32_t> parent_, label_;
  std::vector<Edge> edges_, left_;
  std::vector<Pair> pairs_;
  std::vector<char> taken_;
};

}  // namespace

std::vector<std::uint32_t> firstOfEqual(const std::vector<Vec3d>& positions,
                                        const Progress& progress) {
  const std::size_t n = positions.size();
  const std::size_t slots = std::bit_ceil(2 * n + 1);
  std::vector<std::uint32_t> table(slots, kNone), first(n);
  for (std::size_t v = 0; v < n; ++v) {
    if (looksUp(v)) progress.check();
    std::size_t slot = hashPosition(positions[v]) & (slots - 1);
    while (table[slot] != kNone && !(positions[table[slot]] == positions[v]))
      slot = (slot + 1) & (slots - 1);
    if (table[slot] == kNone) table[slot] = static_cast<std::uint32_t>(v);
    first[v] = table[slot];
  }
  return first;
}

namespace {

/// Normals with hard edges where the cosine between faces is below `least`.
ShadingNormals smoothNormals(const TriangleMesh& mesh, float least, const Progress& progress) {
  ShadingNormals out;
  const std::size_t m = mesh.triangles.size(), n = mesh.positions.size();
  progress.report("computing normals", 0);
  std::vector<Facet> facets(m);
  parallelFor(0, m, kGrain, [&](std::size_t begin, std::size_t end) {
    progress.check();
    for (std::size_t t = begin; t < end; ++t) facets[t] = facetOf(mesh, t);
  });
  progress.report("computing normals", 0.3);

  std::vector<std::uint32_t> first;
  Corners corners = cornersOf(mesh, [](std::uint32_t v) { return v; });
  std::vector<std::uint32_t> fan(3 * m);  // of each entry of `corners`
  std::vector<std::uint32_t> fans(n + 1);
  progress.check();
  const auto findFans = [&] {
    std::atomic<bool> open = false;
    parallelFor(0, n, kGrain, [&](std::size_t begin, std::size_t end) {
      progress.check();
      FanFinder finder(mesh, facets, least);
      bool openHere = false;
      for (std::size_t v = begin; v < end; ++v)
        fans[v + 1] = finder.find(corners.around(v), first, &fan[corners.start[v]], openHere);
      if (openHere) open = true;
    });
    return open.load();
  };
  if (findFans()) {
    first = firstOfEqual(mesh.positions, progress);
    bool any = false;
    for (std::size_t v = 0; v < n && !any; ++v) any = first[v] != v;
    if (any) {
      progress.check();
      corners = cornersOf(mesh, [&](std::uint32_t v) { return first[v]; });
      findFans();
    }
  }
  progress.report("computing normals", 0.8);

  fans[0] = 0;
  for (std::size_t v = 0; v < n; ++v) fans[v + 1] += fans[v];
  out.normals.resize(fans[n]);
  out.corners.resize(m);
  parallelFor(0, n, kGrain, [&](std::size_t begin, std::size_t end) {
    progress.check();
    for (std::size_t v = begin; v < end; ++v) {
      Vec3f* normals = &out.normals[fans[v]];
      const auto around = corners.around(v);
      const std::uint32_t* fanOf = &fan[corners.start[v]];
      for (std::size_t i = 0; i < around.size(); ++i) {
        const Facet& facet = facets[around[i] / 3];
        normals[fanOf[i]] += facet.normal * facet.angles[around[i] % 3];
        out.corners[around[i] / 3][around[i] % 3] = fans[v] + fanOf[i];
      }
      for (std::uint32_t f = 0; f < fans[v + 1] - fans[v]; ++f) {
        const double size = length(cast<double>(normals[f]));
        if (size > 1e-6) {
          normals[f] = cast<float>(cast<double>(normals[f]) / size);
          continue;
        }
        // Facets that cancel each other, or none with area.
        normals[f] = {0, 0, 1};
        for (std::size_t i = around.size(); i-- > 0;) {
          const Vec3f& own = facets[around[i] / 3].normal;
          if (fanOf[i] == f && own != Vec3f{}) normals[f] = own;
        }
      }
    }
  });
  return out;
}

}  // namespace

ShadingNormals shadingNormals(const TriangleMesh& mesh, MeshNormals mode,
                              const Progress& progress) {
  if (mode == MeshNormals::None) return {};
  return smoothNormals(mesh, mode == MeshNormals::Crease ? kCrease : kFold, progress);
}

ShadingNormals shadingNormals(const TriangleMesh& mesh, double creaseAngle,
                              const Progress& progress) {
  return smoothNormals(mesh, std::max(static_cast<float>(std::cos(creaseAngle)) - kRounding, kFold),
                       progress);
}

}  // namespace exemplar
