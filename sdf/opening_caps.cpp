// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/opening_caps.h"

#include <algorithm>
#include <array>
#include <span>

#include "core/loop_progress.h"
#include "core/parallel.h"

namespace exemplar {
namespace {

// Edges and cells go by the index of their lowest sample, edges with the axis they run along.
using Key = std::uint64_t;

struct Lattice {
  const Array3D<std::uint8_t>& inside;
  const Array3D<float>& distances;
  Vec3d low;  // the position of sample (0, 0, 0)

  Key edge(const Vec3i& a, int axis) const { return inside.index(a) * 3 + axis; }
  Vec3d position(const Vec3i& ijk) const { return low + cast<double>(ijk); }

  // Whether the surface crosses the edge where no triangle can: one that did would be as near to
  // both ends together as the edge is long.
  bool isCap(const Vec3i& a, const Vec3i& b) const {
    return inside[a] != inside[b] && distances[a] + distances[b] > 1.0001f;
  }
};

Vec3i next(Vec3i a, int axis) {
  ++a[axis];
  return a;
}

// The edges that a cap crosses, in ascending order.
std::vector<Key> capEdges(const Lattice& lattice, const Progress& progress) {
  const Vec3i n = lattice.inside.size();
  std::vector<std::vector<Key>> layers(static_cast<std::size_t>(n.z));
  parallelFor(0, layers.size(), 1, [&](std::size_t k0, std::size_t k1) {
    for (std::size_t k = k0; k < k1; ++k) {
      progress.check();
      for (int j = 0; j < n.y; ++j)
        for (int i = 0; i < n.x; ++i)
          for (int axis = 0; axis < 3; ++axis) {
            const Vec3i a{i, j, static_cast<int>(k)}, b = next(a, axis);
            if (lattice.inside.contains(b) && lattice.isCap(a, b)) {
              layers[k].push_back(lattice.edge(a, axis));
            }
          }
    }
  });
  std::vector<Key> edges;
  for (const auto& layer : layers) edges.insert(edges.end(), layer.begin(), layer.end());
  return edges;
}

// Where along each edge the surface crosses it, from 0 to 1. The winding number is smooth there, so
// the edges are halved; the edges of a batch, neighbors mostly, are tested together.
std::vector<float> capCrossings(const SolidTest& solid, const Lattice& lattice,
                                const std::vector<Key>& edges, bool fine,
                                const Progress& progress) {
  constexpr std::size_t kBatch = 32;
  const int halvings = fine ? 6 : 3;
  std::vector<float> shares(edges.size());
  const std::size_t batches = (edges.size() + kBatch - 1) / kBatch;
  LoopProgress done(progress, "closing openings", batches);
  parallelFor(0, batches, 1, [&](std::size_t b0, std::size_t b1) {
    for (std::size_t batch = b0; batch < b1; ++batch) {
      const std::size_t begin = batch * kBatch, count = std::min(kBatch, edges.size() - begin);
      std::array<double, kBatch> low{}, high;
      high.fill(1);
      std::array<Vec3d, kBatch> points;
      std::array<std::uint8_t, kBatch> in;
      for (int halving = 0; halving < halvings; ++halving) {
        for (std::size_t e = 0; e < count; ++e) {
          const Key key = edges[begin + e];
          points[e] = lattice.position(lattice.inside.ijk(key / 3));
          points[e][static_cast<int>(key % 3)] += (low[e] + high[e]) / 2;
        }
        solid.inside({points.data(), count}, {in.data(), count});
        for (std::size_t e = 0; e < count; ++e) {
          const bool asStart = in[e] == lattice.inside.values()[edges[begin + e] / 3];
          (asStart ? low : high)[e] = (low[e] + high[e]) / 2;
        }
      }
      for (std::size_t e = 0; e < count; ++e)
        shares[begin + e] = static_cast<float>((low[e] + high[e]) / 2);
      done.advance();
    }
  });
  return shares;
}

// The four cells around an edge, in turn, or none at the box's sides.
std::span<const Vec3i> cellsAround(const Vec3i& a, int axis, const Vec3i& size,
                                   std::array<Vec3i, 4>& cells) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  if (a[u] == 0 || a[v] == 0 || a[u] + 1 >= size[u] || a[v] + 1 >= size[v]) return {};
  for (int c = 0; c < 4; ++c) {
    cells[c] = a;
    cells[c][u] -= c == 1 || c == 2;
    cells[c][v] -= c >= 2;
  }
  return cells;
}

}  // namespace

std::vector<Corners> openingCaps(const SolidTest& solid, const Vec3i& low,
                                 const Array3D<std::uint8_t>& inside,
                                 const Array3D<float>& distances, bool fine,
                                 const Progress& progress) {
  const Lattice lattice{inside, distances, cast<double>(low)};
  const std::vector<Key> edges = capEdges(lattice, progress);
  const std::vector<float> shares =
      capCrossings(solid, lattice, edges, fine, progress.part(0, 0.8));

  // Where the surface crosses an edge of a cell: a cap as found, triangles about where the
  // distances of the ends say.
  const auto crossing = [&](const Vec3i& a, int axis) {
    const Vec3i b = next(a, axis);
    double share;
    if (lattice.isCap(a, b)) {
      const auto at = std::lower_bound(edges.begin(), edges.end(), lattice.edge(a, axis));
      share = shares[static_cast<std::size_t>(at - edges.begin())];
    } else {
      const double sum = double{distances[a]} + distances[b];
      share = sum > 0 ? distances[a] / sum : 0.5;
    }
    Vec3d p = lattice.position(a);
    p[axis] += share;
    return p;
  };

  std::vector<Key> cells;
  std::array<Vec3i, 4> around;
  for (const Key edge : edges)
    for (const Vec3i& cell :
         cellsAround(inside.ijk(edge / 3), static_cast<int>(edge % 3), inside.size(), around)) {
      cells.push_back(inside.index(cell));
    }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  progress.report("closing openings", 0.8);
  std::vector<Vec3d> vertices(cells.size());
  parallelFor(0, cells.size(), 256, [&](std::size_t c0, std::size_t c1) {
    progress.check();
    for (std::size_t c = c0; c < c1; ++c) {
      Vec3d sum{};
      int count = 0;
      for (int axis = 0; axis < 3; ++axis)
        for (int corner = 0; corner < 4; ++corner) {
          Vec3i a = inside.ijk(cells[c]);
          a[(axis + 1) % 3] += corner & 1;
          a[(axis + 2) % 3] += corner >> 1;
          if (inside[a] == inside[next(a, axis)]) continue;
          sum += crossing(a, axis);
          ++count;
        }
      vertices[c] = sum / count;
    }
  });

  std::vector<Corners> triangles;
  triangles.reserve(edges.size() * 2);
  for (const Key edge : edges) {
    const auto four =
        cellsAround(inside.ijk(edge / 3), static_cast<int>(edge % 3), inside.size(), around);
    if (four.empty()) continue;
    std::array<Vec3d, 4> corner;
    for (int c = 0; c < 4; ++c) {
      const auto at = std::lower_bound(cells.begin(), cells.end(), inside.index(four[c]));
      corner[c] = vertices[static_cast<std::size_t>(at - cells.begin())];
    }
    triangles.push_back({corner[0], corner[1], corner[2]});
    triangles.push_back({corner[0], corner[2], corner[3]});
  }
  return triangles;
}

}  // namespace exemplar
